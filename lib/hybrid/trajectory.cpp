#include "hybrid/trajectory.h"

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
    case Ending::passes:
      return "passes";
    case Ending::interrupted:
      return "interrupted";
    case Ending::lost:
      return "lost";
  }
  return "";
}

Eigen::VectorXd DenseStep::operator()(double t) const {
  const Eigen::Index n = coefficients.cols();
  // Each end is a difference of its own, so that -1 and 1 are met exactly there.
  const double z = ((t - from) - (to - t)) / (to - from);
  Eigen::VectorXd above = Eigen::VectorXd::Zero(coefficients.rows());  // of Clenshaw's recurrence
  Eigen::VectorXd next = above;
  for (Eigen::Index k = n - 1; k > 0; --k) {
    Eigen::VectorXd here = coefficients.col(k) + 2 * z * next - above;
    above.swap(next);
    next.swap(here);
  }
  return coefficients.col(0) + z * next - above;
}

}  // namespace gainsmith::hybrid
