// The dense matrix of the double world.
#pragma once

#include <Eigen/Core>

namespace gainsmith::expr {

using Matrix = Eigen::MatrixXd;

}  // namespace gainsmith::expr
