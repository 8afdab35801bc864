// Where runs start.
#pragma once

#include <Eigen/Core>
#include <cstdint>
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
  /// box: low, high; list: the elements; ellipsoid: its center and the map M of draw_ellipsoid.
  std::vector<numbers::Matrix> values;
  expr::Program program;  ///< expression
  Place place;
};

/// Replaces center, matrix Q and level r of an ellipsoid by its center and M = sqrt(r) inv(L)',
/// with Q = L L': {c + M b: |b| <= 1} = {x: (x - c)' Q (x - c) <= r}. InputError when Q is not
/// symmetric and positive definite, or r is negative. `state`: the name, for messages.
void read_ellipsoid(StartRule& rule, const std::string& state);

/// A point c + M b, with b uniform in the unit ball: b = u^(1/n) z/|z|, z normal. 2n + 1 draws: two
/// an element of z, sqrt(-2 log(1 - u)) cos(2 pi v), and u.
Eigen::VectorXd draw_ellipsoid(const StartRule& rule, RandomStream& random);

}  // namespace gainsmith::hybrid
