#include "io/json_reader.h"

#include <cstdint>
#include <limits>

#include "base/error.h"
#include "base/nearest.h"
#include "io/json_place.h"

namespace gainsmith::io {

JsonReader::JsonReader(const Json& document, std::string file, std::string text)
    : value_(document),
      file_(std::move(file)),
      text_(std::make_shared<const std::string>(std::move(text))),
      asked_(std::make_shared<Asked>()) {}

JsonReader::JsonReader(const Json& value, const JsonReader& parent, std::string path)
    : value_(value),
      file_(parent.file_),
      text_(parent.text_),
      path_(std::move(path)),
      asked_(parent.asked_) {}

std::string JsonReader::path_to(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

JsonReader JsonReader::below(const std::string& key, const Json& value) const {
  return {value, *this, path_to(key)};
}

JsonReader JsonReader::at(const std::string& key) const {
  if (!value_.is_object()) fail("expected an object");
  auto& asked = (*asked_)[&value_];
  asked.insert(key);
  if (const auto found = value_.find(key); found != value_.end()) return below(key, *found);
  for (const auto& item : value_.items())
    if (!asked.contains(item.key()) && nearest(item.key(), {key}))
      fail_at(item.key(), "unknown key '" + item.key() + "'; did you mean '" + key + "'?");
  fail("the key '" + key + "' is missing");
}

bool JsonReader::has(const std::string& key) const {
  (*asked_)[&value_].insert(key);
  return value_.is_object() && value_.contains(key);
}

std::string JsonReader::text() const {
  if (!value_.is_string()) fail("expected a text");
  return value_.get<std::string>();
}

double JsonReader::number() const {
  if (!is_number(value_)) fail("expected a number");
  return number_of(value_);
}

std::string JsonReader::decimal() const {
  number();
  return decimal_of(value_);
}

double JsonReader::number_or_infinity() const {
  return value_.is_null() ? std::numeric_limits<double>::infinity() : number();
}

int JsonReader::whole() const {
  if (!value_.is_number_integer()) fail("expected a whole number");
  const bool fits = value_.is_number_unsigned() ? std::in_range<int>(value_.get<std::uint64_t>())
                                                : std::in_range<int>(value_.get<std::int64_t>());
  if (!fits) fail("this whole number is too large");
  return value_.get<int>();
}

bool JsonReader::truth() const {
  if (!value_.is_boolean()) fail("expected true or false");
  return value_.get<bool>();
}

std::vector<JsonReader> JsonReader::items() const {
  if (!value_.is_array()) fail("expected a list");
  std::vector<JsonReader> result;
  for (std::size_t i = 0; i < value_.size(); ++i)
    result.push_back({value_[i], *this, path_ + "[" + std::to_string(i) + "]"});
  return result;
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
  if (!value_.is_object()) fail("expected an object");
  std::vector<std::pair<std::string, JsonReader>> result;
  for (const auto& item : value_.items()) {
    (*asked_)[&value_].insert(item.key());
    result.emplace_back(item.key(), below(item.key(), item.value()));
  }
  return result;
}

numbers::Matrix JsonReader::matrix() const {
  if (is_number(value_)) return numbers::Matrix::Constant(1, 1, number());
  const auto rows = items();
  numbers::Matrix result(rows.size(), rows.empty() ? 0 : rows.front().items().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = rows[i].items();
    if (row.size() != static_cast<std::size_t>(result.cols()))
      rows[i].fail("a row of another length");
    for (std::size_t j = 0; j < row.size(); ++j)
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = row[j].number();
  }
  return result;
}

std::vector<std::string> JsonReader::decimals() const {
  if (is_number(value_)) return {decimal_of(value_)};
  std::vector<std::string> result;
  for (const Json& row : value_)
    for (const Json& element : row) result.push_back(decimal_of(element));
  return result;
}

void JsonReader::finish() const {
  if (value_.is_array())
    for (const JsonReader& item : items()) item.finish();
  const auto asked = asked_->find(&value_);
  if (!value_.is_object() || asked == asked_->end()) return;
  for (const auto& item : value_.items()) {
    if (!asked->second.contains(item.key()))
      fail_at(item.key(), "unknown key '" + item.key() + "'" +
                              suggestion(item.key(), {asked->second.begin(), asked->second.end()}));
    below(item.key(), item.value()).finish();
  }
}

void JsonReader::fail(const std::string& message) const { fail_with(path_, message); }

void JsonReader::fail_at(const std::string& key, const std::string& message) const {
  fail_with(path_to(key), message);
}

void JsonReader::fail_with(const std::string& place, const std::string& message) const {
  throw InputError(place_in(*text_, file_, place), (path_.empty() ? "" : path_ + ": ") + message);
}

}  // namespace gainsmith::io
