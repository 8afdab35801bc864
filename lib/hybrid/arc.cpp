#include "hybrid/arc.h"

namespace gainsmith::hybrid {

std::string to_string(Termination termination) {
  switch (termination) {
    case Termination::horizon:
      return "horizon reached";
    case Termination::diverged:
      return "diverged";
    case Termination::jump_limit:
      return "jump limit reached";
    case Termination::lost:
      return "a flow that could not be integrated further";
    case Termination::undefined:
      return "a map without a value";
    case Termination::broken_off:
      return "an end before the horizon";
  }
  return "?";
}

void Arc::append(double time, std::int64_t jumps, double tau, const Eigen::VectorXd& x) {
  t.push_back(time);
  j.push_back(jumps);
  timer.push_back(tau);
  stacked.insert(stacked.end(), x.begin(), x.end());
}

}  // namespace gainsmith::hybrid
