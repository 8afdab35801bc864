// The dense matrix of the double world.
#pragma once

#include <Eigen/Core>

namespace gainsmith::numbers {

using Matrix = Eigen::MatrixXd;

}  // namespace gainsmith::numbers
