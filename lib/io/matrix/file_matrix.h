// Matrices of files: what the readers of all formats give, and what they refuse alike.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "expr/text/text.h"
#include "model/stated_file.h"

namespace gainsmith::io {

/// A problem has matrices of some hundred rows at most; more is a mistake in what is named.
constexpr int kMostElements = 250'000;

/// A matrix as its file has it: decimals of its elements, row by row.
struct FileMatrix {
  model::StatedMatrix matrix;
  std::vector<expr::Position> positions{};  ///< of the elements, where the file is a text
};

/// A matrix without its elements yet. InputError at `place` for none and for too many elements;
/// `what` names the matrix.
model::StatedMatrix sized_matrix(double rows, double cols, const std::string& what,
                                 const Place& place);

/// The shortest decimal that is read back as the same double. InputError at `place` unless it is
/// finite; `what` names the matrix, of which it is the next element.
void add_element(double value, const std::string& what, const Place& place,
                 model::StatedMatrix& matrix);

/// Up to 8 bytes as a whole number.
std::uint64_t word_of(std::string_view bytes, bool big_endian);

/// Adds the element that `bytes` store: `kind` f, a number of IEEE 754 of 4 or 8 bytes, as
/// add_element does; i and u, a whole number with a sign and without, with all its digits.
void add_stored(char kind, std::string_view bytes, bool big_endian, const std::string& what,
                const Place& place, model::StatedMatrix& matrix);

/// Elements of `text` as JSON spells numbers: "+.5" is 0.5. The text is a finite decimal.
std::string spelt_as_json(const std::string& text);

}  // namespace gainsmith::io
