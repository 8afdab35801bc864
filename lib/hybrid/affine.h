// Which maps are affine in the state, found from the text of the program and not from samples of
// it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "expr/program.h"
#include "numbers/matrix.h"

namespace gainsmith::hybrid {

/// x -> linear x + constant.
struct AffineMap {
  numbers::Matrix linear;
  Eigen::VectorXd constant;

  Eigen::VectorXd operator()(const Eigen::VectorXd& x) const { return linear * x + constant; }
};

/// The first instruction whose value is not known to be affine in the inputs that move; nullptr
/// when the whole program is affine. The rules are in numbers/degree.h.
const expr::Instruction* first_not_affine(const expr::Program& program,
                                          const std::function<bool(const std::string&)>& moves);

/// The affine map of R^size whose values are given: constant = map(0), linear e_i = map(e_i) -
/// map(0).
AffineMap sample_affine(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& map,
                        Eigen::Index size);

}  // namespace gainsmith::hybrid
