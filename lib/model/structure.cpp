#include "model/structure.h"

#include <cmath>
#include <string>

#include "base/number.h"

namespace gainsmith::model {

namespace {

/// The place of element (i, j) when the matrix is written element by element, of the whole
/// otherwise.
Place element_place(const Design::Datum& datum, const numbers::Matrix& matrix, int i, int j) {
  if (std::ssize(datum.elements) != matrix.size()) return datum.place;
  return datum.elements[static_cast<std::size_t>(i * matrix.cols() + j)];
}

std::string element_text(int i, int j, double value) {
  return "element (" + std::to_string(i + 1) + ", " + std::to_string(j + 1) + ") is " +
         brief(value, 17);
}

}  // namespace

void enforce_structure(const Design::Datum& datum, numbers::Matrix& matrix) {
  const Structure structure = datum.structure;
  if (structure != Structure::symmetric && structure != Structure::diagonal) return;
  const double rounding = 1e-12 * matrix.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < i; ++j) {
      const double upper = matrix(j, i);
      const double lower = matrix(i, j);
      if (structure == Structure::symmetric && std::abs(upper - lower) > rounding)
        throw InputError(element_place(datum, matrix, i, j),
                         "the datum " + datum.name + " must be symmetric, but " +
                             element_text(i, j, lower) + " and " + element_text(j, i, upper));
      if (structure == Structure::diagonal && (upper != 0 || lower != 0))
        throw InputError(element_place(datum, matrix, i, j),
                         "the datum " + datum.name + " must be diagonal, but " +
                             element_text(i, j, lower != 0 ? lower : upper));
    }
  }
  matrix = (0.5 * (matrix + matrix.transpose())).eval();
}

}  // namespace gainsmith::model
