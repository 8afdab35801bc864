// The keys of a record, said once for the writer and the reader of JSON:
//
//   constexpr auto kMarginFields = [](auto& at, auto& margin) {
//     at("name", margin.name);
//     at("holds", margin.holds);
//   };
//   const Json json = record_json(margin, kMarginFields);
//   read_record(reader, margin, kMarginFields);
//
// `at` is a FieldWriter, which makes keys in this order, or a FieldReader, which takes them in it.
// Numbers, words, texts, matrices, and lists, mappings and std::optional of them are known. What
// holds records is given with their fields: at("margins", margins, kMarginFields).
#pragma once

#include <array>
#include <bit>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/json/json_reader.h"

namespace gainsmith::io {

/// What a double is in a document.
enum class JsonNumbers {
  finite,   ///< a number
  or_null,  ///< null is infinity
  or_text,  ///< "inf" and "-inf" are texts
  exact     ///< NaN and the sign of zero are texts too: read back to the same bits
};

Json number_json(double value, JsonNumbers numbers);
double number_of(const JsonReader& reader, JsonNumbers numbers);

/// Rows with the decimals that gains keep for their path, such as "gains.L"; null: those of the
/// doubles.
Json matrix_json(const numbers::Matrix& matrix, const std::string& path, const model::Gains* gains);
/// The gains keep its decimals where they are not those that would be printed.
numbers::Matrix matrix_of(const JsonReader& reader, model::Gains* gains);

/// All values of an enumeration, whose words are to_string of them.
template <class Word>
inline constexpr std::array<Word, 0> kWords{};
template <>
inline constexpr auto kWords<model::Verdict> =
    std::array{model::Verdict::yes, model::Verdict::no, model::Verdict::undecided};
template <>
inline constexpr auto kWords<model::CampaignVerdict> =
    std::array{model::CampaignVerdict::held, model::CampaignVerdict::violated,
               model::CampaignVerdict::undecided};

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsList = false;
template <class T>
inline constexpr bool kIsList<std::vector<T>> = true;
template <class T, std::size_t N>
inline constexpr bool kIsList<std::array<T, N>> = true;
/// Values by names, in order.
template <class T>
inline constexpr bool kIsMapping = false;
template <class T>
inline constexpr bool kIsMapping<std::map<std::string, T>> = true;
template <class T>
inline constexpr bool kIsMapping<std::vector<std::pair<std::string, T>>> = true;

/// Whether at.some leaves it out: it is empty, or what it would be without a key.
template <class T>
bool is_absent(const T& value, const T& absent) {
  if constexpr (kIsOptional<T>)
    return !value;
  else if constexpr (kIsList<T> || kIsMapping<T>)
    return value.empty();
  else
    return value == absent;
}

/// Whether `at` reads: kReads<decltype(at)>.
template <class At>
inline constexpr bool kReads = std::remove_cvref_t<At>::kIsReader;

class FieldNumbers {
 public:
  /// What `visit` does, with other numbers.
  template <class Visit>
  void with(JsonNumbers numbers, const Visit& visit) {
    const JsonNumbers kept = std::exchange(numbers_, numbers);
    visit();
    numbers_ = kept;
  }

 protected:
  explicit FieldNumbers(JsonNumbers numbers) : numbers_(numbers) {}
  JsonNumbers numbers_;
};

class FieldWriter : public FieldNumbers {
 public:
  static constexpr bool kIsReader = false;

  explicit FieldWriter(JsonNumbers numbers = JsonNumbers::finite,
                       const model::Gains* gains = nullptr)
      : FieldNumbers(numbers), gains_(gains) {}

  /// std::optional without a value is null.
  template <class T, class... Fields>
  void operator()(const std::string& key, const T& value, const Fields&... fields) {
    object_[key] = json(value, below(key), fields...);
  }
  /// A key that is left out where its value is `absent`, or empty.
  template <class T, class... Fields>
  void some(const std::string& key, const T& value, const Fields&... fields) {
    some_but(key, value, T{}, fields...);
  }
  template <class T, class... Fields>
  void some_but(const std::string& key, const T& value, const T& absent, const Fields&... fields) {
    if (!is_absent(value, absent)) (*this)(key, value, fields...);
  }
  /// A key that may be missing where it is read.
  template <class T, class... Fields>
  void loose(const std::string& key, const T& value, const Fields&... fields) {
    (*this)(key, value, fields...);
  }
  /// Texts without line breaks.
  template <class T>
  void name(const std::string& key, const T& value) {
    (*this)(key, value);
  }
  /// The text of a file as it is.
  void source(const std::string& key, const std::string& text) { object_[key] = text; }
  /// An object with these fields.
  template <class Visit>
  void group(const std::string& key, const Visit& visit) {
    FieldWriter part(*this, below(key));
    visit(part);
    object_[key] = std::move(part.object_);
  }
  /// Records by the names that they have; left out where there are none. `value`: their fields, or
  /// the member that is written.
  template <class T, class Value>
  void by_name(const std::string& key, const std::vector<T>& list, std::string T::*name,
               const Value& value) {
    for (const T& item : list) {
      Json& into = object_[key][item.*name];
      const std::string path = below(key) + "." + item.*name;
      if constexpr (std::is_member_object_pointer_v<Value>)
        into = json(item.*value, path);
      else
        into = json(item, path, value);
    }
  }
  /// What has its own writer and reader.
  template <class T, class Write, class Read>
  void as(const std::string& key, const T& value, const Write& write, const Read&) {
    object_[key] = write(value);
  }
  bool has(const std::string&) const { return true; }
  /// What is written so far.
  Json& object() { return object_; }

  template <class T, class... Fields>
  Json json(const T& value, const std::string& path, const Fields&... fields) const {
    if constexpr (kIsOptional<T>) {
      return value ? json(*value, path, fields...) : Json();
    } else if constexpr (kIsMapping<T>) {
      Json object = Json::object();
      for (const auto& [name, item] : value)
        object[name] = json(item, path + "." + name, fields...);
      return object;
    } else if constexpr (kIsList<T>) {
      Json list = Json::array();
      for (const auto& item : value) {
        const std::string at = path + "[" + std::to_string(list.size()) + "]";
        if constexpr (std::is_same_v<typename T::value_type, numbers::Matrix>)
          list.push_back(matrix_json(item, at, gains_));
        else
          list.push_back(json(item, at, fields...));
      }
      return list;
    } else if constexpr (std::is_same_v<T, numbers::Matrix>) {
      Json rows = matrix_json(value, path, gains_);
      return value.size() == 1 ? rows[0][0] : rows;
    } else if constexpr (sizeof...(Fields) > 0) {
      FieldWriter part(*this, path);
      (fields(part, value), ...);
      return std::move(part.object_);
    } else if constexpr (std::is_enum_v<T>) {
      return to_string(value);
    } else if constexpr (std::is_same_v<T, double>) {
      return number_json(value, numbers_);
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      return std::bit_cast<std::uint64_t>(value);
    } else if constexpr (std::is_same_v<T, char>) {
      return value != 0;
    } else {
      return value;
    }
  }

 private:
  FieldWriter(const FieldWriter& above, std::string path)
      : FieldNumbers(above.numbers_), gains_(above.gains_), path_(std::move(path)) {}
  std::string below(const std::string& key) const {
    return path_.empty() ? key : path_ + "." + key;
  }

  const model::Gains* gains_;
  std::string path_;
  Json object_ = Json::object();
};

/// Each member is the inverse of the writer's; InputError with the place, as of JsonReader.
class FieldReader : public FieldNumbers {
 public:
  static constexpr bool kIsReader = true;

  explicit FieldReader(const JsonReader& reader, JsonNumbers numbers = JsonNumbers::finite,
                       model::Gains* gains = nullptr)
      : FieldNumbers(numbers), reader_(reader), gains_(gains) {}

  template <class T, class... Fields>
  void operator()(const std::string& key, T& value, const Fields&... fields) const {
    take(reader_.at(key), value, fields...);
  }
  template <class T, class... Fields>
  void some(const std::string& key, T& value, const Fields&... fields) const {
    some_but(key, value, T{}, fields...);
  }
  template <class T, class... Fields>
  void some_but(const std::string& key, T& value, const T& absent, const Fields&... fields) const {
    if (!has(key)) {
      value = absent;
      return;
    }
    if constexpr (kIsOptional<T>)
      take(reader_.at(key), value.emplace(), fields...);
    else
      take(reader_.at(key), value, fields...);
  }
  template <class T, class... Fields>
  void loose(const std::string& key, T& value, const Fields&... fields) const {
    if (has(key)) take(reader_.at(key), value, fields...);
  }
  template <class T>
  void name(const std::string& key, T& value) const {
    FieldReader strict = *this;
    strict.allowed_ = "";
    strict(key, value);
  }
  void source(const std::string& key, std::string& text) const { text = reader_.at(key).source(); }
  template <class Visit>
  void group(const std::string& key, const Visit& visit) const {
    FieldReader part = within(reader_.at(key));
    visit(part);
  }
  template <class T, class Value>
  void by_name(const std::string& key, std::vector<T>& list, std::string T::*name,
               const Value& value) const {
    if (!has(key)) return;
    for (const auto& [text, item] : reader_.at(key).members()) {
      T& added = list.emplace_back();
      added.*name = text;
      if constexpr (std::is_member_object_pointer_v<Value>)
        take(item, added.*value);
      else
        take(item, added, value);
    }
  }
  template <class T, class Write, class Read>
  void as(const std::string& key, T& value, const Write&, const Read& read) const {
    value = read(reader_.at(key));
  }
  bool has(const std::string& key) const { return reader_.has(key); }
  const JsonReader& reader() const { return reader_; }

  template <class T, class... Fields>
  void take(const JsonReader& from, T& value, const Fields&... fields) const {
    if constexpr (kIsOptional<T>) {
      value.reset();
      if (!from.is_null()) take(from, value.emplace(), fields...);
    } else if constexpr (kIsMapping<T>) {
      for (const auto& [name, item] : from.members()) {
        typename T::value_type::second_type element{};
        take(item, element, fields...);
        if constexpr (requires { typename T::mapped_type; })
          value[name] = std::move(element);
        else
          value.emplace_back(name, std::move(element));
      }
    } else if constexpr (requires { value.emplace_back(); } && kIsList<T>) {
      for (const JsonReader& item : from.items()) {
        typename T::value_type element{};
        take(item, element, fields...);
        value.push_back(std::move(element));
      }
    } else if constexpr (kIsList<T>) {
      const std::vector<JsonReader> items = from.items();
      if (items.size() != value.size())
        from.fail("expected " + std::to_string(value.size()) + " elements");
      for (std::size_t k = 0; k < value.size(); ++k) take(items[k], value[k], fields...);
    } else if constexpr (std::is_same_v<T, numbers::Matrix>) {
      value = matrix_of(from, gains_);
    } else if constexpr (sizeof...(Fields) > 0) {
      FieldReader part = within(from);
      (fields(part, value), ...);
    } else if constexpr (std::is_enum_v<T>) {
      value = word<T>(from);
    } else if constexpr (std::is_same_v<T, double>) {
      value = number_of(from, numbers_);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = from.text(allowed_);
    } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, char>) {
      value = from.truth();
    } else if constexpr (std::is_same_v<T, int>) {
      value = from.whole();
    } else {
      value = std::bit_cast<T>(from.count());
    }
  }

 private:
  FieldReader within(const JsonReader& part) const { return FieldReader(part, numbers_, gains_); }
  template <class Word>
  static Word word(const JsonReader& reader) {
    std::string expected;
    for (const Word value : kWords<Word>) {
      if (to_string(value) == reader.text()) return value;
      expected += (expected.empty()               ? ""
                   : value == kWords<Word>.back() ? " or "
                                                  : ", ") +
                  to_string(value);
    }
    reader.fail("expected " + expected);
  }

  JsonReader reader_;
  model::Gains* gains_;
  std::string_view allowed_ = "\n\t";
};

template <class Record, class Fields>
Json record_json(const Record& record, const Fields& fields,
                 JsonNumbers numbers = JsonNumbers::finite) {
  return FieldWriter(numbers).json(record, "", fields);
}

template <class Record, class Fields>
void read_record(const JsonReader& reader, Record& record, const Fields& fields,
                 JsonNumbers numbers = JsonNumbers::finite) {
  FieldReader(reader, numbers).take(reader, record, fields);
}

}  // namespace gainsmith::io
