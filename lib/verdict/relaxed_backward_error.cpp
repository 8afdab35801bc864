#include "verdict/relaxed_backward_error.h"

#include <algorithm>
#include <cmath>

#include "numbers/dense/dense.h"

namespace gainsmith::verdict {

namespace {

/// tr(Y_k) in balanced units.
double solution_trace(const sdp::Solution& solution, std::size_t k) {
  const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(solution.Y.values[k].size())));
  return Eigen::Map<const numbers::Matrix>(solution.Y.values[k].data(), n, n).trace();
}

}  // namespace

double relaxed_backward_error(const lmi::Lmi& lmi, const lmi::GainBounds& bounds,
                              const lmi::Formulation& formulation, const sdp::Solution& solution) {
  // As in refute(), multipliers that only tend to 0 are left out.
  constexpr double kShares[] = {0, 1e-10, 1e-8, 1e-6, 1e-4};
  std::vector<numbers::Matrix> Y = multipliers(lmi, bounds, formulation, solution);
  double whole = 0;
  for (numbers::Matrix& y : Y) {
    // Y_k is >= 0 up to what the solver leaves: made so, at the price of the residuals.
    numbers::SymmetricEigen eigen(y);
    y = eigen.vectors() * eigen.values().cwiseMax(0).asDiagonal() * eigen.vectors().transpose();
  }
  for (std::size_t k = 0; k < Y.size(); ++k) whole += solution_trace(solution, k);
  double best = 1;
  for (const double share : kShares) {
    std::vector<double> r(static_cast<std::size_t>(lmi.unknowns + bounds.scalars) + 1, 0.0);
    std::vector<double> W = r;
    double kept = 0;
    for (std::size_t k = 0; k < Y.size(); ++k) {
      if (!(solution_trace(solution, k) >= share * whole)) continue;
      kept += Y[k].trace();
      const lmi::Block& block =
          k < lmi.blocks.size() ? lmi.blocks[k] : bounds.blocks[k - lmi.blocks.size()];
      for (const auto& [i, matrix] : block.terms)
        for (int c = 0; c < matrix.outerSize(); ++c)
          for (lmi::Sparse::InnerIterator it(matrix, c); it; ++it) {
            const double term = it.value() * Y[k](it.row(), it.col());
            r[static_cast<std::size_t>(i)] += term;
            W[static_cast<std::size_t>(i)] += std::abs(term);
          }
    }
    double backward_error = kept > 0 ? 0 : 1;
    for (std::size_t i = 0; i < r.size(); ++i)
      if (W[i] > 0 && !(i == 0 && r[0] <= 0))
        backward_error = std::max(backward_error, std::abs(r[i]) / W[i]);
    best = std::min(best, backward_error + 1e-14);
  }
  return best;
}

}  // namespace gainsmith::verdict
