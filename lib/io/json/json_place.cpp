// Places in a JSON text are found when an error needs them: the text is read once more, up to the
// path. Readers so need not keep a place for each value.
#include "io/json/json_place.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "base/utf8.h"
#include "io/json/json_text.h"

namespace gainsmith::io {

namespace {

/// Follows the paths of a document until it comes to the one that is wanted.
class Locator : public nlohmann::json_sax<Json> {
 public:
  Locator(const std::string& text, const std::string& path) : text_(text), path_(path) {}

  /// The byte at which the key or element begins; none where the path leads nowhere.
  std::optional<std::size_t> find() {
    Json::sax_parse(CountingIterator(text_.data(), read_),
                    CountingIterator(text_.data() + text_.size(), read_), this);
    return found_;
  }

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(std::int64_t) override { return value(); }
  bool number_unsigned(std::uint64_t) override { return value(); }
  bool number_float(double, const std::string&) override { return value(); }
  bool string(std::string&) override { return value(); }
  bool binary(Json::binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(true); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;
  }

  bool key(std::string& key) override {
    const Level& level = levels_.back();
    if (level.leads) here_ = level.path + (level.path.empty() ? "" : ".") + key;
    return arrive(level.leads);
  }

 private:
  struct Level {
    std::string path;
    bool object;
    bool leads;            ///< to what is wanted; only then the path is kept
    std::size_t next = 0;  ///< element
  };

  /// A value begins: of a list it has no key that said so.
  bool enter() {
    if (levels_.empty() || levels_.back().object) return true;
    Level& level = levels_.back();
    if (level.leads) here_ = level.path + "[" + std::to_string(level.next++) + "]";
    return arrive(level.leads);
  }

  bool value() {
    const bool goes_on = enter();
    before_ = read_;
    return goes_on;
  }

  /// A list or an object begins. It leads on where its path is a beginning of the wanted one.
  bool open(bool object) {
    if (!enter()) return false;
    const bool leads = (levels_.empty() || levels_.back().leads) && path_.starts_with(here_);
    levels_.push_back({leads ? here_ : "", object, leads});
    before_ = read_;
    return true;
  }

  bool close() {
    levels_.pop_back();
    before_ = read_;
    return true;
  }

  /// False, which ends the reading, at the path that is wanted.
  bool arrive(bool leads) {
    if (leads && here_ == path_)
      found_ = std::min(text_.find_first_not_of(" \t\r\n,:", before_), text_.size());
    before_ = read_;
    return !found_;
  }

  const std::string& text_;
  const std::string& path_;
  std::size_t read_ = 0;
  std::size_t before_ = 0;  ///< what was read before the event that follows
  std::string here_;
  std::vector<Level> levels_;
  std::optional<std::size_t> found_;
};

}  // namespace

Place place_of(const std::string& text, const std::string& file, std::size_t byte) {
  const std::string_view before = std::string_view(text).substr(0, std::min(byte, text.size()));
  // Columns count characters: continuation bytes of UTF-8 do not count.
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto is_first_byte = [](char c) { return !is_continuation(c); };
  return {file, 1 + static_cast<int>(std::ranges::count(before, '\n')),
          1 + static_cast<int>(std::ranges::count_if(before.substr(start), is_first_byte))};
}

Place place_in(const std::string& text, const std::string& file, const std::string& path) {
  if (path.empty()) return {file};
  const auto byte = Locator(text, path).find();
  return byte ? place_of(text, file, *byte) : Place{file};
}

}  // namespace gainsmith::io
