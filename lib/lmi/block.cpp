#include "lmi/block.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <deque>

#include "expr/evaluate.h"

namespace gainsmith::lmi {

double smallest_eigenvalue(const numbers::Matrix& matrix) {
  return Eigen::SelfAdjointEigenSolver<numbers::Matrix>(0.5 * (matrix + matrix.transpose()),
                                                     Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

numbers::Matrix Block::value(const std::vector<double>& x) const {
  numbers::Matrix result = numbers::Matrix::Zero(size, size);
  for (const auto& [i, matrix] : terms)
    result += (i == 0 ? 1.0 : x[static_cast<std::size_t>(i) - 1]) * numbers::Matrix(matrix);
  return result;
}

bool is_homogeneous(const std::vector<Block>& blocks) {
  return std::all_of(blocks.begin(), blocks.end(),
                     [](const Block& block) { return block.constant_size == 0; });
}

AffineForm evaluate_affine(const expr::Program& program, const Unknowns& unknowns,
                           MonomialTable& monomials, const numbers::Values& values) {
  expr::Evaluator<AffineAlgebra> evaluator(program, {&monomials, &unknowns});
  std::deque<AffineForm> inputs;
  for (const expr::Input& input : program.inputs) {
    if (const int variable = monomials.find_variable(input.name); variable >= 0) {
      inputs.push_back(variable_form(monomials, variable));
    } else if (const Unknown* unknown = unknowns.find(input.name)) {
      inputs.push_back(unknown_form(*unknown));
    } else {
      inputs.push_back(constant_form(values.at(input.name)));
    }
    evaluator.set(input.name, inputs.back());
  }
  // An input alone is its own result.
  return evaluator.run();
}

namespace {

/// InputError when a product or sum of the data left the range of double.
void check_finite(const Sparse& matrix, const Place& place, const std::string& name) {
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      if (!std::isfinite(it.value()))
        throw InputError(place, "the inequality '" + name +
                                    "' has a coefficient that is not "
                                    "finite: its data are too large for double");
}

/// Makes a coefficient exactly symmetric; InputError when it is not so up to rounding.
Sparse symmetric_part(const Sparse& matrix, double scale, const Place& place,
                      const std::string& name) {
  const Sparse mirrored = matrix.transpose();
  const Sparse difference = matrix - mirrored;
  for (int k = 0; k < difference.outerSize(); ++k)
    for (Sparse::InnerIterator it(difference, k); it; ++it)
      if (std::abs(it.value()) > 1e-12 * scale)
        throw InputError(place, "the inequality '" + name + "' is not symmetric: elements (" +
                                    std::to_string(it.row() + 1) + ", " +
                                    std::to_string(it.col() + 1) + ") and (" +
                                    std::to_string(it.col() + 1) + ", " +
                                    std::to_string(it.row() + 1) + ") differ");
  return 0.5 * (matrix + mirrored);
}

}  // namespace

Block block_of(const AffineForm& form, std::string name, std::string point, bool strict,
               const Place& place) {
  Block block;
  block.name = std::move(name);
  block.point = std::move(point);
  block.strict = strict;
  block.size = form.shape.rows;
  if (block.size == 0) throw InputError(place, "the inequality '" + block.name + "' has no rows");
  for (const auto& [key, matrix] : form.terms) {
    check_finite(matrix, place, block.name);
    double& size = key.second == 0 ? block.constant_size : block.coefficient_size;
    size = std::max(size, largest_element(matrix));
  }
  const double scale = std::max(block.constant_size, block.coefficient_size);
  for (const auto& [key, matrix] : form.terms)
    block.terms.emplace_back(key.second, symmetric_part(matrix, scale, place, block.name));
  return block;
}

}  // namespace gainsmith::lmi
