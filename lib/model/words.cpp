#include "model/words.h"

#include "model/problem.h"

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
  return verdict == CampaignVerdict::held ? "held" : "violated";
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

std::string to_string(SamplingLaw::Kind kind) {
  switch (kind) {
    case SamplingLaw::Kind::constant:
      return "constant";
    case SamplingLaw::Kind::uniform:
      return "uniform";
    case SamplingLaw::Kind::extremes:
      return "extremes";
    case SamplingLaw::Kind::sinusoid:
      return "sinusoid";
    case SamplingLaw::Kind::list:
      return "list";
  }
  return "?";
}

}  // namespace gainsmith::model
