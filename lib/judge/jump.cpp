#include "judge/jump.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "expr/program/number_type.h"
#include "judge/tolerances.h"

namespace gainsmith::judge {

namespace {

using V = model::Dynamics::VariableKind;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The largest of the terms that the value is the sum of: where they cancel, their rounding is all
/// that is left.
double size_of_terms(MapText& text, const Eigen::VectorXd& before, const numbers::Matrix& value) {
  const double size = value.size() > 0 ? value.cwiseAbs().maxCoeff() : 0;
  if (!text.terms || value.size() == 0) return size;
  try {
    const numbers::Matrix& terms = (*text.terms)(before);
    return terms.allFinite() ? std::max(size, terms.cwiseAbs().maxCoeff()) : size;
  } catch (const expr::EvaluationError&) {
    return size;
  }
}

/// One map on the values before it; `slack` takes what the new values may be off.
void apply_map(Texts& texts, PassTexts& pass, Eigen::VectorXd& x, Eigen::VectorXd& slack) {
  const Eigen::VectorXd before = x;
  for (MapText& text : pass.map) {
    const std::size_t variable = text.variable;
    numbers::Matrix value = text.value(before);
    double asymmetry = 0;
    if (texts.dynamics.variables[variable].structure == model::Structure::symmetric &&
        value.size() > 0) {
      asymmetry = (value - value.transpose()).cwiseAbs().maxCoeff();
      make_symmetric(value);
    }
    const double size = size_of_terms(text, before, value);
    texts.part(x, variable) = value.reshaped();
    texts.part(slack, variable).setConstant(kRounding * size + asymmetry);
  }
}

/// All passes of a reaction on x, of which it changes states of its own component alone.
void apply_reaction(Texts& texts, ReactionTexts& reaction, Eigen::VectorXd& x, JumpValues& result) {
  for (PassTexts& pass : reaction.passes) {
    if (!pass.repeats) {
      apply_map(texts, pass, x, result.slack);
      continue;
    }
    std::int64_t passes = 0;
    bool done = pass.until && (*pass.until)(x);
    while (!done && passes < pass.at_most) {
      apply_map(texts, pass, x, result.slack);
      ++passes;
      done = pass.until && (*pass.until)(x);
    }
    result.passes += passes;
    if (pass.until && !done && !pass.go_on) result.exhausted = true;
  }
}

/// j, count, since, left and passes, which belong to the run.
void count_jump(const Texts& texts, std::size_t event, JumpValues& result) {
  for (std::size_t v = 0; v < texts.dynamics.variables.size(); ++v) {
    const model::Dynamics::Variable& variable = texts.dynamics.variables[v];
    const bool own = variable.of == event;
    if (variable.kind == V::jumps || (variable.kind == V::count && own))
      texts.part(result.after, v).array() += 1;
    if (variable.kind == V::since && own) texts.part(result.after, v).setZero();
    if (variable.kind == V::left && own) texts.part(result.slack, v).setConstant(infinite);
    if (variable.kind == V::passes && own)
      texts.part(result.after, v).setConstant(static_cast<double>(result.passes));
  }
}

/// What to say of a variable that has another value.
std::string complaint(const Texts& texts, std::size_t variable, bool reacts,
                      const std::string& event) {
  const model::Dynamics::Variable& one = texts.dynamics.variables[variable];
  switch (one.kind) {
    case V::state:
    case V::mode:
      if (reacts) return "the jump " + event + " gives another value: " + one.name;
      return "changes in the jump " + event +
             ", to which its component does not react: " + one.name;
    case V::noise:
      return "noise changes in the jump " + event + ", not before it: " + one.name;
    default:
      return "wrong after the jump " + event + ": " + one.name;
  }
}

}  // namespace

/// Every reaction starts from `before`, so that the order of components does not matter. A lost
/// occurrence leaves out observers.
JumpValues jump_values(Texts& texts, std::size_t event, bool lost, const Eigen::VectorXd& before) {
  JumpValues result{before, Eigen::VectorXd::Zero(before.size()), 0, false};
  for (ReactionTexts& reaction : texts.reactions) {
    if (reaction.event != event) continue;
    if (lost && texts.dynamics.components[reaction.component].observer) continue;
    Eigen::VectorXd own = before;
    apply_reaction(texts, reaction, own, result);
    for (const PassTexts& pass : reaction.passes)
      for (const MapText& entry : pass.map)
        texts.part(result.after, entry.variable) = texts.part(own, entry.variable);
  }
  count_jump(texts, event, result);
  return result;
}

void check_jump(Texts& texts, std::size_t part, const hybrid::JumpPoint& jump, Faults& faults) {
  const std::string& event = texts.dynamics.events[jump.event].name;
  const JumpValues again = jump_values(texts, jump.event, jump.lost, jump.before);
  if (again.exhausted) faults.add(part, jump.t, "a loop of " + event + " ends without its `until`");
  for (std::size_t v = 0; v < texts.dynamics.variables.size(); ++v) {
    const hybrid::Slot& slot = texts.layout.slots[v];
    const model::Dynamics::Variable& variable = texts.dynamics.variables[v];
    const bool reacts = std::any_of(
        texts.reactions.begin(), texts.reactions.end(), [&](const ReactionTexts& reaction) {
          return reaction.event == jump.event && reaction.component == variable.component &&
                 !(jump.lost && texts.dynamics.components[reaction.component].observer);
        });
    for (Eigen::Index i = slot.offset; i < slot.offset + slot.shape.size(); ++i)
      faults.check(part, jump.t, complaint(texts, v, reacts, event),
                   std::abs(jump.after(i) - again.after(i)), again.slack(i));
    const auto after = texts.part(jump.after, v);
    if (texts.is(v, V::mode) && (after.array() != after.array().round()).any())
      faults.add(part, jump.t,
                 "a mode is no whole number after the jump " + event + ": " + slot.name);
    if (variable.structure == model::Structure::symmetric) {
      const auto M = after.reshaped(slot.shape.rows, slot.shape.cols);
      if (M != M.transpose())
        faults.add(part, jump.t, "not symmetric after the jump " + event + ": " + slot.name);
    }
  }
}

}  // namespace gainsmith::judge
