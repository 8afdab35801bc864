#include "hybrid/trajectory.h"

#include "base/words.h"
#include "ode/chebyshev.h"

namespace gainsmith::hybrid {

std::string to_string(Ending ending) {
  return word_of<Ending::lost>(
      ending, {"horizon", "escaped", "undefined", "left", "stuck", "zeno", "chattering", "sliding",
               "full", "passes", "interrupted", "lost"});
}

Eigen::VectorXd DenseStep::operator()(double t) const {
  return ode::chebyshev::at(coefficients, ode::chebyshev::inner(t, from, to));
}

DenseStep DenseStep::until(double t) const {
  return {from, t, ode::chebyshev::part(coefficients, -1, ode::chebyshev::inner(t, from, to))};
}

}  // namespace gainsmith::hybrid
