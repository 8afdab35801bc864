// Where runs start.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/random.h"
#include "expr/program.h"
#include "model/design.h"
#include "numbers/matrix.h"

namespace gainsmith::hybrid {

/// How one state starts, with its numbers.
struct StartRule {
  model::StartKind kind = model::StartKind::box;
  /// box: low, high; list: the elements; others: the center and the map M of draw_around.
  std::vector<numbers::Matrix> values;
  expr::Program program;  ///< expression
  Place place;
};

/// Replaces center, matrix Q and level r of an ellipsoid by its center and M = sqrt(r) inv(L)',
/// with Q = L L': {c + M b: |b| <= 1} = {x: (x - c)' Q (x - c) <= r}. InputError when Q is not
/// symmetric and positive definite, or r is negative. `state`: the name, for messages.
void read_ellipsoid(StartRule& rule, const std::string& state);

/// M of what is drawn around a center: diagonal with the deviations, or of a covariance V the lower
/// triangular M with M M' = V. V may be semidefinite: a column whose diagonal element would be 0
/// but for rounding is 0. `size`: elements that are drawn, column by column. InputError for a
/// deviation that is negative and for V that is not symmetric and positive semidefinite.
numbers::Matrix spread_map(const numbers::Matrix& spread, bool covariance, Eigen::Index size,
                           const std::string& what, const Place& place);

/// n numbers of the standard normal distribution, two draws each: sqrt(-2 log(1 - u)) cos(2 pi v).
Eigen::VectorXd draw_normal(Eigen::Index n, RandomStream& random);

/// Around a center c. ellipsoid: c + M b, with b uniform in the unit ball: b = u^(1/n) z/|z|, z
/// normal, one more draw; normal: c + M z; lognormal: c .* exp(M z).
numbers::Matrix draw_around(const StartRule& rule, RandomStream& random);
numbers::Matrix around(const numbers::Matrix& center, const numbers::Matrix& M,
                       const Eigen::VectorXd& z, bool is_lognormal);

}  // namespace gainsmith::hybrid
