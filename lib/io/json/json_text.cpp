// Documents with the decimals of their numbers. A float whose text is not the one that would be
// printed is kept as bytes; all other numbers are those of the library.
//
// The text is read by events (SAX), so that doubled keys are seen and decimals are not lost.
#include "io/json/json_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/number.h"
#include "io/json/json_place.h"
#include "model/gains.h"

namespace gainsmith::io {

namespace {

/// Whether a list has neither lists nor objects in it: it is written on one line.
bool is_flat(const Json& list) { return std::ranges::none_of(list, &Json::is_structured); }

/// Bytes that are no UTF-8 (in the name of a file) are replaced: JSON has no spelling for them.
std::string dumped(const Json& text) {
  return text.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write(const Json& value, std::size_t indent, std::string& out);

/// An object, or a list, indented by two spaces a level.
void write_items(const Json& value, std::size_t indent, std::string& out) {
  const bool object = value.is_object();
  const bool one_line = value.empty() || (!object && is_flat(value));
  const std::string inner = one_line ? "" : "\n" + std::string(indent + 2, ' ');
  out += object ? '{' : '[';
  bool first = true;
  for (const auto& item : value.items()) {
    if (!first) out += one_line ? ", " : ",";
    first = false;
    out += inner;
    if (object) out += dumped(item.key()) + ": ";
    write(item.value(), indent + 2, out);
  }
  if (!one_line) out += "\n" + std::string(indent, ' ');
  out += object ? '}' : ']';
}

void write(const Json& value, std::size_t indent, std::string& out) {
  if (value.is_structured()) {
    write_items(value, indent, out);
  } else {
    out += is_number(value) ? decimal_of(value) : dumped(value);
  }
}

/// Builds a document, keeps decimals and refuses keys that occur twice.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  Json parse() {
    Json::sax_parse(CountingIterator(text_.data(), read_),
                    CountingIterator(text_.data() + text_.size(), read_), this);
    return std::move(root_);
  }

  bool null() override { return add(Json()); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(std::int64_t value) override { return add(value); }
  bool number_unsigned(std::uint64_t value) override { return add(value); }
  /// A decimal that is printed as it was read needs no text of its own.
  bool number_float(double value, const std::string& decimal) override {
    if (!parse_decimal(decimal)) refuse_number(decimal, read_);
    return add(decimal == model::printed(value) ? Json(value) : decimal_json(decimal));
  }
  bool string(std::string& value) override { return add(std::move(value)); }
  bool binary(Json::binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& key) override {
    // The key has just been read, to its closing quotation mark.
    const auto [known, fresh] = keys_.back().emplace(key, read_);
    if (!fresh)
      throw InputError(place_of(text_, file_, begin_of_key(read_)),
                       "the key '" + key + "' is given twice; first in line " +
                           std::to_string(place_of(text_, file_, known->second).line));
    key_ = std::move(key);
    return true;
  }

  bool parse_error(std::size_t byte, const std::string& token,
                   const Json::exception& error) override {
    if (dynamic_cast<const Json::out_of_range*>(&error) != nullptr) refuse_number(token, byte);
    if (text_.find_first_not_of(" \t\r\n") == std::string::npos)
      throw InputError({file_}, "the file is empty; expected a JSON document");
    const std::string message = error.what();
    const std::size_t known = message.find("syntax error");
    throw InputError(place_of(text_, file_, byte > 0 ? byte - 1 : 0),
                     "this is no complete JSON document: " +
                         message.substr(known == std::string::npos ? 0 : known));
  }

 private:
  /// `end`: just behind it, or one further.
  [[noreturn]] void refuse_number(const std::string& number, std::size_t end) const {
    throw InputError(place_of(text_, file_, text_.rfind(number, end - number.size())),
                     "the number " + number + " is beyond the range of double");
  }

  bool add(Json value) {
    place(std::move(value));
    return true;
  }

  /// `end`: behind its closing quotation mark.
  std::size_t begin_of_key(std::size_t end) const {
    std::size_t at = end - 1;
    do at = text_.rfind('"', at - 1);
    while (at > 0 && text_[at - 1] == '\\');
    return at;
  }

  bool open(Json empty) {
    if (open_.size() >= kDeepest)
      throw InputError(place_of(text_, file_, read_ - 1), "lists or objects are nested too deeply");
    keys_.emplace_back();
    open_.push_back(&place(std::move(empty)));
    return true;
  }

  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  /// An element stays where it is as long as those inside it are read: its list grows later.
  Json& place(Json value) {
    if (open_.empty()) return root_ = std::move(value);
    Json& parent = *open_.back();
    if (parent.is_object()) {
      // No search for the key: it is a new one.
      auto& items = static_cast<Json::object_t::Container&>(parent.get_ref<Json::object_t&>());
      return items.emplace_back(key_, std::move(value)).second;
    }
    parent.push_back(std::move(value));
    return parent.back();
  }

  static constexpr std::size_t kDeepest = 500;  ///< as in YAML

  const std::string& text_;
  const std::string& file_;
  Json root_;
  std::vector<Json*> open_;
  std::vector<std::map<std::string, std::size_t>> keys_;  ///< of open_, with their ends
  std::string key_;
  std::size_t read_ = 0;  ///< bytes
};

}  // namespace

std::string to_text(const Json& document) {
  std::string out;
  write(document, 0, out);
  out += '\n';
  return out;
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json decimal_json(const std::string& text) {
  return Json::binary(std::vector<std::uint8_t>(text.begin(), text.end()));
}

bool is_number(const Json& value) { return value.is_number() || value.is_binary(); }

double number_of(const Json& number) {
  if (!number.is_binary()) return number.get<double>();
  const auto value = parse_decimal(decimal_of(number));
  if (!value) throw std::invalid_argument(decimal_of(number) + " is no number in double");
  return *value;
}

std::string decimal_of(const Json& number) {
  if (number.is_binary()) return {number.get_binary().begin(), number.get_binary().end()};
  if (!number.is_number_float()) return number.dump();
  const double value = number.get<double>();
  if (!std::isfinite(value))
    throw std::invalid_argument("JSON has no spelling for " + decimal17(value));
  return model::printed(value);
}

Json parse_json(const std::string& text, const std::string& file) {
  return Builder(text, file).parse();
}

}  // namespace gainsmith::io
