#include "hybrid/event_functions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number.h"
#include "hybrid/affine.h"
#include "hybrid/rounding_terms.h"
#include "ode/tolerances.h"

namespace gainsmith::hybrid {

namespace {

using ConditionKind = expr::Condition::Kind;
using Eigen::VectorXd;

}  // namespace

numbers::StackedFunctions stacked(std::vector<const expr::Program*> programs,
                                  const System& system) {
  const auto place = [&](const std::string& name) -> std::optional<Eigen::Index> {
    const auto slot = system.slot(name);
    if (!slot) return std::nullopt;
    return system.layout.slots[*slot].offset;
  };
  return {std::move(programs), place, system.constants, system.whole};
}

SystemFunction::SystemFunction(const expr::Program& program, const System& system)
    : function_(stacked({&program}, system)) {
  // A line needs affine dependence on variables of constant rate alone: its root is one division.
  bool flows = false;
  for (const expr::Input& input : program.inputs) {
    const auto slot = system.slot(input.name);
    if (!slot) continue;
    rests_ = rests_ && system.moves[*slot] == Moves::rests;
    flows = flows || system.moves[*slot] == Moves::flows;
  }
  is_line_ = !rests_ && !flows && first_not_affine(program, [&](const std::string& name) {
                                    return system.is_moving(name);
                                  }) == nullptr;
}

EventFunction::EventFunction(const expr::Program& program, const System& system)
    : size_(program.shape().size()),
      waves_(may_wave(program)),
      value_(program, system),
      elements_(value_.elements()),
      terms_program_(std::make_unique<const expr::Program>(terms_of_sign(program))),
      terms_(*terms_program_, system),
      breaks_(program, system.layout, system.constants,
              [&](const std::string& name) { return system.is_moving(name); }) {}

/// |f_e| <= kTermRounding T_e, with T_e the sum of the sizes of its terms at this point.
bool EventFunction::is_noise(const VectorXd& values, Eigen::Index element) {
  const double size = std::abs(value_(values)(element));
  return size <= kTermRounding * terms_(values)(element);
}

/// sign(f) where |f| >= least(f) > kTermRounding T + max(near T, kTurnsNear |f|_max) on the box. T
/// bounds the sum of the sizes of the terms. Else 0.
const std::vector<int>& EventFunction::sides(const numbers::Box& values, double near) {
  sides_.clear();
  if (!value_.enclose(values) || !terms_.enclose(values)) return sides_;
  sides_.assign(static_cast<std::size_t>(size_), 0);
  for (std::size_t e = 0; e < sides_.size(); ++e) {
    const numbers::Range& value = value_.range(e);
    const double terms = terms_.range(e).largest();
    const double noise =
        kTermRounding * terms + std::max(near * terms, ode::kTurnsNear * value.largest());
    if (value.least() > noise) sides_[e] = value.low > 0 ? 1 : -1;
  }
  return sides_;
}

EventCondition::EventCondition(const expr::Condition& condition, const System& system)
    : text_(condition.text), place_(condition.place) {
  whole_ = make(condition, system);
}

EventCondition::Part EventCondition::make(const expr::Condition& condition, const System& system) {
  Part part;
  part.kind = condition.kind;
  if (condition.is_comparison()) {
    part.comparison = comparisons_.size();
    comparisons_.push_back(
        {EventFunction(condition.difference, system), condition.kind, condition.text});
  }
  for (const expr::Condition& one : condition.parts) part.parts.push_back(make(one, system));
  return part;
}

template <class Compare>
Truth EventCondition::truth(const Part& part, const Compare& compare) {
  if (part.kind != ConditionKind::all && part.kind != ConditionKind::any &&
      part.kind != ConditionKind::none)
    return compare(part.comparison);
  return expr::joined(part.kind, part.parts,
                      [&](const Part& inner) { return truth(inner, compare); });
}

bool EventCondition::is_true(std::size_t comparison, const VectorXd& values) {
  Comparison& one = comparisons_[comparison];
  const auto difference = one.function(values).array();
  if (one.kind == ConditionKind::positive) return (difference > 0).all();
  if (one.kind == ConditionKind::nonnegative) return (difference >= 0).all();
  return (difference == 0).all();
}

bool EventCondition::operator()(const VectorXd& values) {
  return truth(whole_, [&](std::size_t comparison) {
           return truth_of(is_true(comparison, values));
         }) == Truth::yes;
}

Truth EventCondition::at_rest(const VectorXd& values) {
  return truth(whole_, [&](std::size_t comparison) {
    if (!comparisons_[comparison].function.rests()) return Truth::unknown;
    return truth_of(is_true(comparison, values));
  });
}

bool EventCondition::if_changed(const VectorXd& values, std::size_t comparison) {
  return truth(whole_, [&](std::size_t one) {
           return truth_of(is_true(one, values) != (one == comparison));
         }) == Truth::yes;
}

std::string EventCondition::differences(const VectorXd& values) {
  std::string result;
  for (Comparison& comparison : comparisons_) {
    const numbers::Matrix& difference = comparison.function(values);
    if (difference.size() == 0) continue;
    if (!result.empty()) result += ", ";
    result += comparison.text + ": " + brief(difference.minCoeff(), 4);
  }
  return result;
}

}  // namespace gainsmith::hybrid
