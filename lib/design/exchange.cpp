#include "design/exchange.h"

#include <map>
#include <utility>

#include "forall/centres.h"

namespace gainsmith::design {

bool is_out_of_reach(const Attempt& attempt) {
  constexpr double kTells = 1e-13;  // what the points found in double tell from 0
  return attempt.question.goal == lmi::Goal::interior && !attempt.on_face &&
         lmi::interior_margin(attempt.solution) < kTells;
}

bool grow(forall::Plan& plan, const lmi::Inequalities& inequalities, const lmi::Lmi& lmi,
          const Attempt& attempt) {
  constexpr std::size_t kMostAtOnce = 24;  // the worst come first
  std::map<std::size_t, std::vector<forall::Point>> fresh;
  for (const verdict::Violation& violation : attempt.margins.violations)
    if (plan.inequalities[violation.inequality].way == model::Way::exchange &&
        fresh[violation.inequality].size() < kMostAtOnce)
      fresh[violation.inequality].push_back(violation.point);
  // Points that a proof shows to fail are added however near another point is; those of a search
  // not.
  bool grown = false;
  for (const verdict::Violation& violation : attempt.margins.violations)
    if (violation.certain && plan.inequalities[violation.inequality].way == model::Way::exchange)
      grown |= forall::add_point(plan.inequalities[violation.inequality],
                                 inequalities.statements[violation.inequality].domain,
                                 violation.point, 0);
  for (auto& [k, points] : fresh) {
    const lmi::Statement& statement = inequalities.statements[k];
    forall::Imposed& imposed = plan.inequalities[k];
    const auto sizes = lmi::multiplier_sizes(lmi, attempt.formulation, attempt.solution,
                                             statement.stated->name, imposed.points.size());
    // tr(Y_k) of the points tells where they draw together.
    for (forall::Point& centre : forall::centres(imposed, statement.domain, sizes))
      points.push_back(std::move(centre));
    for (const forall::Point& point : points)
      grown |= forall::add_point(imposed, statement.domain, point);
  }
  return grown;
}

}  // namespace gainsmith::design
