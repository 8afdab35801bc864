#include "claims/track.h"

namespace gainsmith::claims {

std::string to_string(Termination termination) {
  switch (termination) {
    case Termination::horizon:
      return "horizon reached";
    case Termination::lost:
      return "a flow that could not be integrated further";
    case Termination::broken_off:
      return "an end before the horizon";
  }
  return "?";
}

void Track::clear() {
  for (auto* list : {&t, &values, &bounds}) list->clear();
  for (auto* list : {&is_fixed, &within_instant}) list->clear();
  j.clear();
  moves.clear();
  sampled_for.clear();
  termination = Termination::horizon;
  message.clear();
}

}  // namespace gainsmith::claims
