// Readers of a document share one note of the keys that were asked for, by object. finish()
// compares it with the keys that are there.
//
// Where tables of keys (keys.h) are given, each reader also has the form of its value, so that it
// finds the table for what is below it.
#include "io/json/json_reader.h"

#include <array>
#include <charconv>
#include <limits>

#include "base/error.h"
#include "base/nearest.h"
#include "base/version.h"
#include "base/visible.h"
#include "io/json/json_place.h"

namespace gainsmith::io {

namespace {

/// "[margin]" and '[': "margin"; nothing for other forms.
std::string_view inner(std::string_view form, char bracket) {
  if (form.empty() || form.front() != bracket) return {};
  return form.substr(1, form.find_last_of("]}") - 1);
}

/// Three numbers of "0.1.0".
std::array<int, 3> parts_of(const std::string& version, const JsonReader& reader) {
  std::array<int, 3> parts{};
  const char* at = version.data();
  const char* const end = at + version.size();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto number = std::from_chars(at, end, parts[k]);
    const bool last = k + 1 == parts.size();
    if (number.ec != std::errc() ||
        (last ? number.ptr != end : number.ptr == end || *number.ptr != '.'))
      reader.fail("expected the version of gainsmith that wrote this file, such as " +
                  std::string(kVersion) + ", not '" + version + "'");
    at = number.ptr + (last ? 0 : 1);
  }
  return parts;
}

}  // namespace

JsonReader::JsonReader(const Json& document, std::string file, std::string text,
                       std::span<const Level* const> levels)
    : value_(document),
      file_(std::move(file)),
      text_(std::make_shared<const std::string>(std::move(text))),
      levels_(levels),
      form_(levels.empty() ? "" : levels.front()->name),
      asked_(std::make_shared<Asked>()) {}

JsonReader::JsonReader(const Json& value, const JsonReader& parent, std::string path,
                       std::string_view form)
    : value_(value),
      file_(parent.file_),
      text_(parent.text_),
      path_(std::move(path)),
      levels_(parent.levels_),
      form_(form),
      asked_(parent.asked_) {}

const Level* JsonReader::level() const {
  for (const Level* level : levels_)
    if (level->name == form_) return level;
  return nullptr;
}

std::string JsonReader::path_to(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

/// The value of a key, with the form that the table says, or that of all entries of a mapping.
JsonReader JsonReader::below(const std::string& key, const Json& value) const {
  const Level* here = level();
  const Key* known = here == nullptr ? nullptr : here->find(key);
  return {value, *this, path_to(key), known == nullptr ? inner(form_, '{') : known->form};
}

/// A missing key is often a misspelt one: keys that nobody asked for yet are compared with it.
JsonReader JsonReader::at(const std::string& key) const {
  if (const Level* here = level()) require_known(*here, key);
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
  if (const Level* here = level()) require_known(*here, key);
  (*asked_)[&value_].insert(key);
  return value_.is_object() && value_.contains(key);
}

std::string JsonReader::text(std::string_view allowed) const {
  if (control_character(source(), allowed) != std::string::npos)
    fail("control characters are no part of this: '" + visible(source(), allowed) + "'");
  return source();
}

std::string JsonReader::source() const {
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

std::uint64_t JsonReader::count() const {
  if (!value_.is_number_unsigned()) fail("expected a whole number from 0 on");
  return value_.get<std::uint64_t>();
}

bool JsonReader::truth() const {
  if (!value_.is_boolean()) fail("expected true or false");
  return value_.get<bool>();
}

std::vector<JsonReader> JsonReader::items() const {
  if (!value_.is_array()) fail("expected a list");
  std::vector<JsonReader> result;
  for (std::size_t i = 0; i < value_.size(); ++i)
    result.push_back({value_[i], *this, path_ + "[" + std::to_string(i) + "]", inner(form_, '[')});
  return result;
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
  if (!value_.is_object()) fail("expected an object");
  std::vector<std::pair<std::string, JsonReader>> result;
  for (const auto& item : value_.items()) {
    (*asked_)[&value_].insert(item.key());
    if (control_character(item.key()) != std::string::npos)
      fail("control characters are no part of a name: '" + visible(item.key(), "") + "'");
    result.emplace_back(item.key(), below(item.key(), item.value()));
  }
  return result;
}

/// A number is 1 x 1. An empty list is 0 x 0; rows have equal lengths.
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

/// An object of which nothing was asked is left alone.
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

std::string version_of(const JsonReader& reader) {
  const std::string version = reader.text();
  if (parts_of(version, reader) > parts_of(kVersion, reader))
    reader.fail("gainsmith " + version + " wrote this file, this is " + kVersion +
                ": take that version, or synthesize again");
  return version;
}

}  // namespace gainsmith::io
