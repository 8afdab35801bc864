#include "hybrid/initial.h"

#include <fmt/format.h>
#include <algorithm>

#include "base/nearest.h"
#include "expr/compile.h"

namespace gainsmith::hybrid {

namespace {

using Kind = model::InitialValue::Kind;

expr::Program compile_start(const model::Value& value, std::size_t slot, const System& system) {
  expr::Program program =
      model::compile_value(value, system.scope, system.layout.slots[slot].shape);
  for (const expr::Input& input : program.inputs) {
    const auto later = std::find_if(system.layout.slots.begin() + static_cast<std::ptrdiff_t>(slot),
                                    system.layout.slots.end(),
                                    [&](const Slot& other) { return other.name == input.name; });
    if (later != system.layout.slots.end() || input.name == system.layout.timer)
      throw InputError(value.place, "the initial value of " + system.layout.slots[slot].name +
                                        " uses " + input.name +
                                        ", which has no value yet: only states declared before may "
                                        "be used");
  }
  const auto missing = missing_values(program, system.layout, system.constants);
  if (!missing.empty()) throw InputError(value.place, "there is no value for " + missing.front());
  return program;
}

/// A box may be given by scalars for all elements.
numbers::Matrix read_bound(const model::Value& value, expr::Shape shape, const System& system) {
  const expr::Program program = expr::compile(value.value, system.scope);
  if (program.shape().is_scalar()) {
    const double bound = model::scalar_value(value.value, system.scope, system.constants);
    return numbers::Matrix::Constant(shape.rows, shape.cols, bound);
  }
  return model::matrix_value(value, system.scope, system.constants, shape);
}

StartRule make_rule(const model::InitialValue& initial, std::size_t slot, const System& system) {
  const Slot& state = system.layout.slots[slot];
  StartRule rule{initial.kind, {}, {}, initial.place};
  const bool enough = initial.kind == Kind::list  ? !initial.values.empty()
                      : initial.kind == Kind::box ? initial.values.size() == 2
                                                  : initial.values.size() == 1;
  if (!enough)
    throw InputError(initial.place, "the initial value of " + state.name + " is incomplete");
  if (initial.kind == Kind::expression) {
    rule.program = compile_start(initial.values.front(), slot, system);
    return rule;
  }
  for (const model::Value& value : initial.values)
    rule.values.push_back(
        initial.kind == Kind::box
            ? read_bound(value, state.shape, system)
            : model::matrix_value(value, system.scope, system.constants, state.shape));
  if (initial.kind == Kind::box && (rule.values[0].array() > rule.values[1].array()).any())
    throw InputError(initial.place, "the box of " + state.name + " is empty: low > high");
  return rule;
}

}  // namespace

std::vector<StartRule> make_start_rules(const model::Campaign& campaign, const System& system) {
  std::vector<std::string> names;
  for (const Slot& slot : system.layout.slots) names.push_back(slot.name);
  for (const model::InitialValue& initial : campaign.initial)
    if (std::find(names.begin(), names.end(), initial.state) == names.end())
      throw InputError(initial.place, "there is no state '" + initial.state + "'" +
                                          suggestion(initial.state, names));

  std::vector<StartRule> rules;
  for (std::size_t slot = 0; slot < names.size(); ++slot) {
    const auto found =
        std::find_if(campaign.initial.begin(), campaign.initial.end(),
                     [&](const auto& initial) { return initial.state == names[slot]; });
    if (found != campaign.initial.end()) {
      rules.push_back(make_rule(*found, slot, system));
      continue;
    }
    if (const auto& start = system.starts[slot]) {
      const Place place = start->place(*start->root);
      rules.push_back(
          make_rule({names[slot], Kind::expression, {{names[slot], *start, false, place}}, place},
                    slot, system));
      continue;
    }
    const expr::Shape shape = system.layout.slots[slot].shape;
    const numbers::Matrix ones = numbers::Matrix::Ones(shape.rows, shape.cols);
    rules.push_back({Kind::box, {-ones, ones}, {}, {}});
  }
  return rules;
}

Starts::Starts(const std::vector<StartRule>& rules, const System& system)
    : rules_(&rules), layout_(&system.layout) {
  for (const StartRule& rule : rules)
    if (rule.kind == Kind::expression)
      expressions_.emplace_back(rule.program, system.layout, system.constants);
}

Eigen::VectorXd Starts::operator()(std::uint64_t run, RandomStream& random) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(layout_->size);
  std::size_t expression = 0;
  for (std::size_t i = 0; i < rules_->size(); ++i) {
    const StartRule& rule = (*rules_)[i];
    const Slot& slot = layout_->slots[i];
    auto part = x.segment(slot.offset, slot.shape.size());
    switch (rule.kind) {
      case Kind::expression:
        part = expressions_[expression++](x, 0).reshaped();
        break;
      case Kind::list:
        part = rule.values[run % rule.values.size()].reshaped();
        break;
      case Kind::box: {
        const Eigen::VectorXd low = rule.values[0].reshaped();
        const Eigen::VectorXd high = rule.values[1].reshaped();
        for (Eigen::Index k = 0; k < part.size(); ++k)
          part(k) = low(k) + (high(k) - low(k)) * random.uniform();
        break;
      }
    }
  }
  return x;
}

}  // namespace gainsmith::hybrid
