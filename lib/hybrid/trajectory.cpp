#include "hybrid/trajectory.h"

#include "ode/chebyshev.h"

namespace gainsmith::hybrid {

std::string to_string(Ending ending) {
  switch (ending) {
    case Ending::horizon:
      return "horizon";
    case Ending::escaped:
      return "escaped";
    case Ending::undefined:
      return "undefined";
    case Ending::left:
      return "left";
    case Ending::stuck:
      return "stuck";
    case Ending::zeno:
      return "zeno";
    case Ending::chattering:
      return "chattering";
    case Ending::sliding:
      return "sliding";
    case Ending::full:
      return "full";
    case Ending::passes:
      return "passes";
    case Ending::interrupted:
      return "interrupted";
    case Ending::lost:
      break;
  }
  return "lost";
}

Eigen::VectorXd DenseStep::operator()(double t) const {
  return ode::chebyshev::at(coefficients, ode::chebyshev::inner(t, from, to));
}

DenseStep DenseStep::until(double t) const {
  return {from, t, ode::chebyshev::part(coefficients, -1, ode::chebyshev::inner(t, from, to))};
}

}  // namespace gainsmith::hybrid
