// Values that a reader gave are looked for in the bytes that it read.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>

namespace gainsmith::fuzz {

/// The numbers that stand in a text, as doubles.
class NumbersOfText {
 public:
  explicit NumbersOfText(std::string_view text);

  /// std::logic_error unless a number of the text has that value.
  void require(double value) const;
  void require(const std::string& decimal) const;

 private:
  std::unordered_set<double> values_;
};

/// std::logic_error unless the bytes of the decimal, as a double, a float or a whole number in either order of bytes,
/// stand in `bytes`.
void require_stored(const std::string& decimal, std::string_view bytes);

}  // namespace gainsmith::fuzz
