#include "model/words.h"

namespace gainsmith::model {

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::yes: return "yes";
    case Verdict::no: return "no";
    case Verdict::undecided: return "undecided";
  }
  return "?";
}

std::string to_string(CampaignVerdict verdict) {
  return verdict == CampaignVerdict::held ? "held" : "violated";
}

}  // namespace gainsmith::model
