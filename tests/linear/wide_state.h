// Programs and states in 100 digits, for the tests of linear.
#pragma once

#include <Eigen/Core>

#include "base/eigen_scalars.h"
#include "base/random.h"
#include "base/scalars.h"
#include "hybrid/state_layout.h"
#include "linear/wide_function.h"

namespace gainsmith::linear {

using Wide = numbers::MatrixOf<Decimal100>;

inline Wide wide(const numbers::Matrix& matrix) {
  return matrix.unaryExpr([](double value) { return Decimal100(value); });
}

inline numbers::Matrix drawn(RandomStream& random, Eigen::Index rows, Eigen::Index cols,
                             double size = 1) {
  return numbers::Matrix::NullaryExpr(rows, cols,
                                      [&] { return size * (2 * random.uniform() - 1); });
}

/// A layout of these slots, stacked.
inline hybrid::StateLayout layout_of(
    const std::vector<std::pair<std::string, expr::Shape>>& slots) {
  hybrid::StateLayout layout;
  layout.timer = "tau";
  for (const auto& [name, shape] : slots) {
    layout.slots.push_back({name, shape, layout.size});
    layout.size += shape.size();
  }
  return layout;
}

}  // namespace gainsmith::linear
