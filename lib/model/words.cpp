#include "model/words.h"

namespace gainsmith::model {

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::yes:
      return "yes";
    case Verdict::no:
      return "no";
    case Verdict::undecided:
      return "undecided";
  }
  return "?";
}

std::string to_string(CampaignVerdict verdict) {
  switch (verdict) {
    case CampaignVerdict::held:
      return "held";
    case CampaignVerdict::violated:
      return "violated";
    case CampaignVerdict::undecided:
      return "undecided";
  }
  return "?";
}

std::string to_string(Way way) {
  switch (way) {
    case Way::automatic:
      return "auto";
    case Way::hull:
      return "hull";
    case Way::exchange:
      return "exchange";
    case Way::vertex_gains:
      return "vertex_gains";
  }
  return "?";
}

std::string to_string(LawKind kind) {
  switch (kind) {
    case LawKind::constant:
      return "constant";
    case LawKind::uniform:
      return "uniform";
    case LawKind::extremes:
      return "extremes";
    case LawKind::sinusoid:
      return "sinusoid";
    case LawKind::list:
      return "list";
    case LawKind::golden:
      return "golden";
  }
  return "?";
}

std::string to_string(ClaimKind kind) {
  switch (kind) {
    case ClaimKind::nonincreasing:
      return "nonincreasing";
    case ClaimKind::cost:
      return "cost";
    case ClaimKind::shrinks:
      return "shrinks";
    case ClaimKind::below:
      return "below";
    case ClaimKind::above:
      return "above";
  }
  return "?";
}

std::string to_string(Structure structure) {
  switch (structure) {
    case Structure::full:
      return "full";
    case Structure::symmetric:
      return "symmetric";
    case Structure::diagonal:
      return "diagonal";
    case Structure::scalar:
      return "scalar";
  }
  return "?";
}

std::optional<double> SynthesisOptions::share_of_bound(const std::string& gain) const {
  if (gain_bounds.empty()) return 1;
  for (const BoundOfGain& one : gain_bounds)
    if (one.gain == gain) return one.bound / gain_bound.value();
  return std::nullopt;
}

void SynthesisOptions::set_gain_bound(double bound) {
  for (BoundOfGain& one : gain_bounds) one.bound *= bound / gain_bound.value();
  gain_bound = bound;
  gain_bound_stated = true;
}

}  // namespace gainsmith::model
