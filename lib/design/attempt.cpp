#include "design/attempt.h"

#include <algorithm>
#include <utility>

namespace gainsmith::design {

Attempt attempt(const Posed& posed, Question question, const Solve& solve) {
  Attempt result;
  result.question = std::move(question);
  const Question& asked = result.question;
  result.formulation =
      lmi::formulate(posed.lmi, asked.bounds, posed.choices(), asked.goal, asked.backoff);
  result.solution = solve(result.formulation.problem);
  const double margin = posed.choices().margin;
  result.point = result.is_optimal() &&
                 !(asked.goal == lmi::Goal::feasibility && result.largest_margin() < margin);
  if (!result.point) return result;
  result.x = lmi::read_back(posed.lmi, result.formulation, result.solution);
  if (!asked.recomputed) return result;
  result.margins =
      lmi::compute_margins(posed.inequalities, posed.lmi, posed.plan, result.formulation.scales,
                           result.formulation.homogeneous(), margin, result.x);
  return result;
}

bool is_kept(const Attempt& attempt) {
  const auto& margins = attempt.margins.margins;
  return attempt.margins.open.empty() &&
         std::all_of(margins.begin(), margins.end(),
                     [](const model::Margin& margin) { return lmi::is_kept(margin); });
}

double shortfall(const Attempt& attempt) {
  constexpr double kExplained = 1e-6;
  double worst = 0;
  for (const model::Margin& margin : attempt.margins.margins)
    if (!lmi::is_kept(margin))
      worst = std::max(worst, (margin.strict ? margin.required : 0.0) - margin.reached);
  return worst < kExplained ? worst : 0;
}

}  // namespace gainsmith::design
