#include "verdict/stated_point.h"

namespace gainsmith::verdict {

const expr::Program* stated_at(const lmi::Statement& statement, std::size_t v,
                               const lmi::Block& block,
                               const std::function<bool(const expr::Program&, End)>& reaches) {
  const forall::Variable& variable = statement.domain[v];
  const auto& stated = statement.stated->domain[v].points;
  const numbers::Matrix& at = block.where->values.at(variable.name);
  if (variable.is_interval()) {
    const expr::Program& low = stated[0].program;
    const expr::Program& high = stated[1].program;
    if (at(0, 0) == variable.low || reaches(low, End::low)) return &low;
    if (at(0, 0) == variable.high || reaches(high, End::high)) return &high;
    return nullptr;
  }
  for (std::size_t e = 0; e < variable.elements.size(); ++e)
    if (variable.elements[e] == at) return &stated[e].program;
  return nullptr;
}

}  // namespace gainsmith::verdict
