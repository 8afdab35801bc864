#include "design/face_program.h"

#include <algorithm>
#include <utility>

#include "base/rational.h"
#include "numbers/dense/dense.h"
#include "verdict/exactness.h"
#include "verdict/weak_duality.h"

namespace gainsmith::design {

namespace {

using verdict::Faces;
using verdict::RationalBlock;

/// c'x in the coordinates of the face.
void pose_objective(const Faces& faces, const lmi::Lmi& stated, lmi::Lmi& left) {
  left.has_objective = stated.has_objective;
  if (!stated.has_objective) return;
  const std::vector<Rational> c(stated.objective.begin(), stated.objective.end());
  const numbers::RationalMatrix& N = faces.directions();
  Rational constant = 0;
  for (std::size_t i = 0; i < c.size(); ++i) constant += c[i] * faces.origin()[i];
  left.objective_constant = stated.objective_constant + nearest_double(constant);
  for (Eigen::Index j = 0; j < N.cols(); ++j) {
    Rational sum = 0;
    for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * N(static_cast<Eigen::Index>(i), j);
    left.objective.push_back(nearest_double(sum));
  }
}

/// A matrix for each block of the face, of what `of` says for those that were solved.
template <class Of>
verdict::FoundMultipliers on_blocks(const Faces& faces, const FaceProgram& program,
                                    const lmi::Formulation& formulation, const Of& of) {
  verdict::FoundMultipliers found;
  for (const RationalBlock& block : faces.blocks()) {
    found.Y.push_back(
        numbers::MatrixOf<DoubleDouble>::Constant(block.size, block.size, DoubleDouble(0)));
    found.rows.emplace_back(static_cast<std::size_t>(block.size), 0);
  }
  for (std::size_t k = 0; k < program.blocks.size(); ++k) {
    const std::size_t at = program.blocks[k];
    const auto& kept = formulation.free_variables.kept[k];
    found.rows[at] = formulation.balance.rows[k];
    found.Y[at](kept, kept) = of(k);
  }
  return found;
}

}  // namespace

FaceProgram program_on(const Faces& faces, const lmi::Lmi& stated) {
  FaceProgram program;
  program.lmi.unknowns = faces.unknowns();
  pose_objective(faces, stated, program.lmi);
  for (std::size_t k = 0; k < faces.blocks().size(); ++k) {
    const RationalBlock& of = faces.blocks()[k];
    if (of.size == 0) continue;
    lmi::Block block;
    block.name = faces.names()[k];
    block.strict = of.strict;
    block.size = of.size;
    for (const auto& [i, matrix] : of.terms) {
      const numbers::Matrix rounded =
          matrix.unaryExpr([](const Rational& x) { return nearest_double(x); });
      double& size = i == 0 ? block.constant_size : block.coefficient_size;
      size = std::max(size, rounded.cwiseAbs().maxCoeff());
      block.terms.emplace_back(i, lmi::sparse(rounded));
    }
    program.lmi.blocks.push_back(std::move(block));
    program.blocks.push_back(k);
  }
  return program;
}

lmi::Formulation formulate(const Faces& faces, const FaceProgram& program,
                           const lmi::Round& round) {
  return lmi::formulate_interior(
      program.lmi, {}, round,
      [&](std::size_t k, const lmi::Balance& balance, const std::vector<int>& kept) {
        return verdict::rounded(
            verdict::exact_block(faces.blocks()[program.blocks[k]], balance, k, kept));
      });
}

verdict::FoundMultipliers multipliers_on(const Faces& faces, const FaceProgram& program,
                                         const FaceSolution& solved) {
  const auto& [solution, formulation] = solved;
  const verdict::Multipliers Y =
      verdict::multipliers_of(formulation, program.blocks.size(), solution);
  verdict::FoundMultipliers found =
      on_blocks(faces, program, formulation, [&](std::size_t k) { return Y[k]; });
  if (formulation.homogenised) found.v = solution.Y.values[Y.size()][0];
  return found;
}

verdict::FoundMultipliers kernels_on(const Faces& faces, const FaceProgram& program,
                                     const FaceSolution& solved) {
  // Of the largest eigenvalue of all blocks: smaller ones count as 0.
  constexpr double kSmall = 1e-6;
  const auto& [solution, formulation] = solved;
  const double one = formulation.homogenised ? solution.x[solution.x.size() - 2] : 1;
  std::vector<numbers::SymmetricEigen> eigen;
  double largest = 0;
  for (const lmi::BalancedBlock& block : formulation.blocks) {
    eigen.emplace_back(lmi::value_of(block, solution.x, one));
    if (block.size > 0) largest = std::max(largest, eigen.back().values().maxCoeff());
  }
  return on_blocks(
      faces, program, formulation, [&](std::size_t k) -> numbers::MatrixOf<DoubleDouble> {
        const Eigen::Index count = (eigen[k].values().array() < kSmall * largest).count();
        const numbers::Matrix K = eigen[k].vectors().leftCols(count);
        return (K * K.transpose()).eval().cast<DoubleDouble>();
      });
}

}  // namespace gainsmith::design
