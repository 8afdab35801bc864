#include "io/matrix/file_matrix.h"

#include <bit>
#include <cctype>
#include <cmath>

#include "base/number.h"
#include "model/gains.h"

namespace gainsmith::io {

model::StatedMatrix sized_matrix(double rows, double cols, const std::string& what,
                                 const Place& place) {
  const std::string size = brief(rows, 15) + " x " + brief(cols, 15);
  if (!(rows * cols >= 1))
    throw InputError(place, what + " is " + size +
                                ": there is nothing in it. Write zeros(...) in the problem for a "
                                "matrix without rows or columns");
  if (!(rows * cols <= kMostElements))
    throw InputError(place, what + " is " + size + ", of more than the " +
                                std::to_string(kMostElements) + " elements that a matrix may have");
  model::StatedMatrix result;
  result.rows = static_cast<int>(rows);
  result.cols = static_cast<int>(cols);
  result.elements.reserve(static_cast<std::size_t>(rows * cols));
  return result;
}

void add_element(double value, const std::string& what, const Place& place,
                 model::StatedMatrix& matrix) {
  if (!std::isfinite(value)) {
    const std::size_t at = matrix.elements.size();
    const auto cols = static_cast<std::size_t>(matrix.cols);
    throw InputError(place, what + " has " + (std::isnan(value) ? "NaN" : "Inf") + " in row " +
                                std::to_string(at / cols + 1) + ", column " +
                                std::to_string(at % cols + 1) +
                                "; the elements of a matrix are finite numbers");
  }
  matrix.elements.push_back(model::printed(value));
}

std::uint64_t word_of(std::string_view bytes, bool big_endian) {
  std::uint64_t result = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const std::size_t at = big_endian ? k : bytes.size() - 1 - k;
    result = result << 8U | static_cast<unsigned char>(bytes[at]);
  }
  return result;
}

void add_stored(char kind, std::string_view bytes, bool big_endian, const std::string& what,
                const Place& place, model::StatedMatrix& matrix) {
  const std::uint64_t word = word_of(bytes, big_endian);
  if (kind == 'f') {
    const double value = bytes.size() == 4
                             ? double{std::bit_cast<float>(static_cast<std::uint32_t>(word))}
                             : std::bit_cast<double>(word);
    return add_element(value, what, place, matrix);
  }
  // Shifted up and down, a whole number keeps its sign.
  const auto unused = static_cast<unsigned>(64 - 8 * bytes.size());
  matrix.elements.push_back(
      kind == 'i' ? std::to_string(static_cast<std::int64_t>(word << unused) >> unused)
                  : std::to_string(word));
}

/// A sign "+" and zeros at the front go; a digit is put before a point, and a point without digits
/// behind it goes.
std::string spelt_as_json(const std::string& text) {
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
  };
  std::size_t at = 0;
  std::string result;
  if (text[at] == '-') result += '-';
  if (text[at] == '-' || text[at] == '+') ++at;
  while (text[at] == '0' && is_digit(at + 1)) ++at;
  if (!is_digit(at)) result += '0';
  while (is_digit(at)) result += text[at++];
  if (at < text.size() && text[at] == '.') {
    if (is_digit(at + 1)) result += '.';
    for (++at; is_digit(at); ++at) result += text[at];
  }
  result += text.substr(at);
  // A whole number of JSON has no sign when it is 0.
  return result == "-0" ? "-0.0" : result;
}

}  // namespace gainsmith::io
