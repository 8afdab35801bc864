#include "model/words.h"

#include "base/words.h"

namespace gainsmith::model {

std::string to_string(Verdict verdict) {
  return word_of<Verdict::undecided>(verdict, {"yes", "no", "undecided"});
}

std::string to_string(CampaignVerdict verdict) {
  return word_of<CampaignVerdict::undecided>(verdict, {"held", "violated", "undecided"});
}

std::string to_string(Way way) {
  return word_of<Way::vertex_gains>(way, {"auto", "hull", "exchange", "vertex_gains"});
}

std::string to_string(LawKind kind) {
  return word_of<LawKind::golden>(
      kind, {"constant", "uniform", "extremes", "sinusoid", "list", "golden"});
}

std::string to_string(ClaimKind kind) {
  return word_of<ClaimKind::above>(kind, {"nonincreasing", "cost", "shrinks", "below", "above"});
}

std::string to_string(Structure structure) {
  return word_of<Structure::scalar>(structure, {"full", "symmetric", "diagonal", "scalar"});
}

std::optional<double> SynthesisOptions::share_of_bound(const std::string& gain) const {
  if (gain_bounds.empty()) return 1;
  for (const BoundOfGain& limit : gain_bounds)
    if (limit.gain == gain) return limit.bound / gain_bound.value();
  return std::nullopt;
}

void SynthesisOptions::set_gain_bound(double bound) {
  for (BoundOfGain& limit : gain_bounds) limit.bound *= bound / gain_bound.value();
  gain_bound = bound;
  gain_bound_stated = true;
}

}  // namespace gainsmith::model
