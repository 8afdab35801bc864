#include "support/sdp_catalogue.h"

#include "support/sdp_build.h"

namespace gainsmith::sdp::testing {

std::vector<CatalogueProblem> sdp_catalogue() {
  std::vector<CatalogueProblem> result;
  for (const auto& part : {planted_problems(), control_problems(), closed_forms(),
                           infeasible_problems(), delicate_problems()})
    result.insert(result.end(), part.begin(), part.end());
  return result;
}

CatalogueProblem copies(const CatalogueProblem& known, int count) {
  return direct_sum(known.name + ", copied",
                    std::vector<CatalogueProblem>(static_cast<std::size_t>(count), known));
}

}  // namespace gainsmith::sdp::testing
