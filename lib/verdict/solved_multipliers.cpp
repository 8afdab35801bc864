#include "verdict/solved_multipliers.h"

#include "base/eigen_scalars.h"

namespace gainsmith::verdict {

namespace {

using numbers::MatrixOf;

/// The symmetric parts of the multipliers whose elements are `element(block, place)`.
template <class S, class Element>
std::vector<MatrixOf<S>> multipliers(const lmi::Formulation& formulation, std::size_t blocks,
                                     Element element) {
  std::vector<MatrixOf<S>> result;
  for (std::size_t k = 0; k < blocks; ++k) {
    const Eigen::Index n = formulation.sizes[k];
    MatrixOf<S> Y(n, n);
    for (Eigen::Index at = 0; at < n * n; ++at) Y(at) = element(k, static_cast<std::size_t>(at));
    result.push_back((Y + Y.transpose().eval()) * S(0.5));
  }
  return result;
}

}  // namespace

Multipliers multipliers_of(const lmi::Formulation& formulation, std::size_t blocks,
                           const sdp::Solution& solution) {
  return multipliers<DoubleDouble>(formulation, blocks, [&](std::size_t k, std::size_t at) {
    const double rest = solution.rest.Y.values.empty() ? 0 : solution.rest.Y.values[k][at];
    return DoubleDouble(solution.Y.values[k][at], rest);
  });
}

std::vector<MatrixOf<Decimal100>> wide_multipliers_of(const lmi::Formulation& formulation,
                                                      std::size_t blocks,
                                                      const sdp::Solution& solution) {
  const auto& rest = solution.rest;
  return multipliers<Decimal100>(formulation, blocks, [&](std::size_t k, std::size_t at) {
    const double next = rest.Y.values.empty() ? 0 : rest.Y.values[k][at];
    return with_finer({solution.Y.values[k][at], next},
                      rest.finer_Y.empty() ? Finer{} : rest.finer_Y[k][at]);
  });
}

}  // namespace gainsmith::verdict
