#include "claims/track.h"

#include "base/words.h"

namespace gainsmith::claims {

std::string to_string(Termination termination) {
  return word_of<Termination::broken_off>(
      termination, {"horizon reached", "a flow that could not be integrated further",
                    "an end before the horizon"});
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
