#include "design/results.h"
#include "bind/stated.h"

namespace gainsmith::design {

Results::Results(const model::Instance& instance, const model::Gains& gains)
    : stated_(bind::state(instance, gains)) {
  if (gains.objective)
    stated_.values["objective"] = numbers::Matrix::Constant(1, 1, *gains.objective);
}

}  // namespace gainsmith::design
