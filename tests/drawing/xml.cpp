#include "drawing/xml.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

namespace gainsmith::test {

namespace {

/// Thrown and caught in this file.
struct Malformed {};

void demand(bool condition) {
  if (!condition) throw Malformed();
}

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  std::vector<Element> read() {
    element();
    while (take("\n")) {
    }
    demand(rest_.empty());
    return std::move(elements_);
  }

 private:
  bool take(std::string_view prefix) {
    if (!rest_.starts_with(prefix)) return false;
    rest_.remove_prefix(prefix.size());
    return true;
  }

  /// A Char of XML 1.0 in UTF-8.
  void character(std::string& into) {
    demand(!rest_.empty());
    const auto lead = static_cast<std::uint8_t>(rest_[0]);
    std::size_t bytes = 1;
    std::uint32_t code = lead;
    if (lead >= 0x80) {
      demand(lead >= 0xC0 && lead < 0xF8);
      bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
      demand(rest_.size() >= bytes);
      code = lead & (0x7FU >> bytes);
      for (std::size_t i = 1; i < bytes; ++i) {
        const auto next = static_cast<std::uint8_t>(rest_[i]);
        demand(next >> 6U == 2);
        code = code << 6U | (next & 0x3FU);
      }
      constexpr std::array<std::uint32_t, 3> least = {0x80, 0x800, 0x10000};
      demand(code >= least[bytes - 2]);
    }
    demand(code == 9 || code == 10 || code == 13 || (code >= 0x20 && code < 0xD800) ||
           (code >= 0xE000 && code < 0xFFFE) || (code >= 0x10000 && code < 0x110000));
    into += rest_.substr(0, bytes);
    rest_.remove_prefix(bytes);
  }

  /// Characters and entities up to one of the two, which is not taken.
  std::string characters(char end) {
    std::string text;
    while (!rest_.empty() && rest_[0] != end && rest_[0] != '<') {
      if (rest_[0] != '&') {
        character(text);
        continue;
      }
      constexpr std::array<std::pair<std::string_view, char>, 5> entities = {
          {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
      bool known = false;
      for (const auto& [name, stands_for] : entities)
        if (!known && take(name)) {
          text += stands_for;
          known = true;
        }
      demand(known);
    }
    return text;
  }

  std::string name() {
    std::string found;
    while (!rest_.empty() &&
           (std::isalnum(static_cast<unsigned char>(rest_[0])) || rest_[0] == '-')) {
      found += rest_[0];
      rest_.remove_prefix(1);
    }
    demand(!found.empty());
    return found;
  }

  void attribute(Element& element) {
    const std::string key = name();
    demand(take("=\""));
    demand(element.attributes.emplace(key, characters('"')).second);
    demand(take("\""));
  }

  void element() {
    demand(take("<"));
    const std::size_t index = elements_.size();
    elements_.push_back({name(), {}, {}});
    while (take(" ")) attribute(elements_[index]);
    if (take("/>")) return;
    demand(take(">"));
    elements_[index].text = characters('<');
    while (!rest_.starts_with("</")) {
      element();
      characters('<');
    }
    demand(take("</") && name() == elements_[index].name && take(">"));
  }

  std::string_view rest_;
  std::vector<Element> elements_;
};

}  // namespace

std::optional<std::vector<Element>> read_xml(std::string_view text) {
  try {
    return Reader(text).read();
  } catch (const Malformed&) {
    return std::nullopt;
  }
}

bool has_text(const std::vector<Element>& all, const std::string& text) {
  return std::any_of(all.begin(), all.end(),
                     [&](const Element& e) { return e.name == "text" && e.text == text; });
}

}  // namespace gainsmith::test
