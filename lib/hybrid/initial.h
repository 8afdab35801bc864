// Where runs start.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/random.h"
#include "expr/program/program.h"
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
  double hollow = 0;  ///< of an ellipsoid: the share of its volume that is left out inside
};

/// Replaces center, matrix Q and level r of an ellipsoid by its center and M = sqrt(r) inv(L)',
/// with Q = L L': {c + M b: |b| <= 1} = {x: (x - c)' Q (x - c) <= r}. Of two levels [r0, r] the
/// part with (x - c)' Q (x - c) < r0 is hollow. InputError when Q is not symmetric and positive
/// definite, or not 0 <= r0 <= r. `state`: the name, for messages.
void read_ellipsoid(StartRule& rule, const std::string& state);

/// A point of the unit ball, moved along its ray into what is not hollow: uniform points stay
/// uniform.
Eigen::VectorXd in_shell(const StartRule& rule, const Eigen::VectorXd& b);

/// M of what is drawn around a center: diagonal with the deviations, or of a covariance V the lower
/// triangular M with M M' = V. V may be semidefinite: a column whose diagonal element would be 0
/// but for rounding is 0. `size`: elements that are drawn, column by column. InputError for a
/// deviation that is negative and for V that is not symmetric and positive semidefinite.
numbers::Matrix spread_map(const numbers::Matrix& spread, bool covariance, Eigen::Index size,
                           const std::string& what, const Place& place);

/// n numbers of the standard normal distribution, two draws each: sqrt(-2 log(1 - u)) cos(2 pi v).
Eigen::VectorXd draw_normal(Eigen::Index n, RandomStream& random);

/// Around a center c. ellipsoid: c + M b, with b uniform in the unit ball: b = u^(1/n) z/|z|, z
/// normal, one more draw, then in_shell(); normal: c + M z; lognormal: c .* exp(M z).
numbers::Matrix draw_around(const StartRule& rule, RandomStream& random);
/// c + M z, or c .* exp(M z), with z reshaped to the shape of c.
numbers::Matrix around(const numbers::Matrix& center, const numbers::Matrix& M,
                       const Eigen::VectorXd& z, bool is_lognormal);

}  // namespace gainsmith::hybrid
