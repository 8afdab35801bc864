// Reads a JSON document whose keys are known, and says where it is when something is wrong.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/json/json_text.h"
#include "io/schema/keys.h"
#include "model/gains.h"

namespace gainsmith::io {

/// A value of a document, with its path: "solver.iterations", "margins[2].name". All members throw
/// InputError with the place and the path for a value of another kind. The document must outlive
/// its readers, which note together which keys were asked for.
class JsonReader {
 public:
  /// `text`: what the document was read from; errors then name line and column too. `levels`: the
  /// tables of the keys, the first that of the document: asking for another key is
  /// std::logic_error.
  JsonReader(const Json& document, std::string file, std::string text = {},
             std::span<const Level* const> levels = {});

  /// The value of a key that must be there. Of a missing key the message names a misspelling.
  JsonReader at(const std::string& key) const;
  /// Whether the optional key is there.
  bool has(const std::string& key) const;
  bool is_null() const { return value_.is_null(); }
  bool is_list() const { return value_.is_array(); }
  bool is_text() const { return value_.is_string(); }

  /// Without control characters other than those of `allowed`: of a name none.
  std::string text(std::string_view allowed = "\n\t") const;
  /// The text of a file as it is.
  std::string source() const;
  /// The double nearest to a number.
  double number() const;
  /// The decimal of a number.
  std::string decimal() const;
  /// null represents infinity.
  double number_or_infinity() const;
  /// A number without point and exponent that an int has.
  int whole() const;
  /// The same from 0 on, of 64 bits.
  std::uint64_t count() const;
  bool truth() const;
  /// The elements of a list.
  std::vector<JsonReader> items() const;
  /// All keys, whatever they are, with their values.
  std::vector<std::pair<std::string, JsonReader>> members() const;
  /// A list of rows, or a number.
  numbers::Matrix matrix() const;
  /// The decimals of a matrix, row by row.
  std::vector<std::string> decimals() const;
  /// "gains.L"; empty for the document.
  const std::string& path() const { return path_; }

  /// InputError for the first key below here that nothing asked for, with the nearest known one.
  void finish() const;

  /// InputError with the place and the path of this value.
  [[noreturn]] void fail(const std::string& message) const;
  /// The same at a key below here.
  [[noreturn]] void fail_at(const std::string& key, const std::string& message) const;

 private:
  /// The keys that were asked for, by the object that was asked.
  using Asked = std::map<const Json*, std::set<std::string>>;

  JsonReader(const Json& value, const JsonReader& parent, std::string path, std::string_view form);
  JsonReader below(const std::string& key, const Json& value) const;
  /// The table of the keys here; null where there is none.
  const Level* level() const;
  std::string path_to(const std::string& key) const;
  [[noreturn]] void fail_with(const std::string& place, const std::string& message) const;

  const Json& value_;
  std::string file_;
  std::shared_ptr<const std::string> text_;
  std::string path_;
  std::span<const Level* const> levels_;
  std::string_view form_;  ///< as in Key
  std::shared_ptr<Asked> asked_;
};

/// The version that wrote a file, "0.1.0". InputError for a later one than this: it may say things
/// that this one would not understand.
std::string version_of(const JsonReader& reader);

}  // namespace gainsmith::io
