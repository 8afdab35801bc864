#include "bounded/track.h"

namespace gainsmith::bounded {

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

}  // namespace gainsmith::bounded
