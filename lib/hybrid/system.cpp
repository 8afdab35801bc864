#include "hybrid/system.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number.h"
#include "expr/compile.h"
#include "model/stated.h"

namespace gainsmith::hybrid {

namespace {

/// Compiles the entry of one state and checks that all it needs has a value.
expr::Program compile_entry(const model::Named& entry, const Slot& slot, const System& system) {
  expr::Program program = expr::compile(entry.value, system.scope, slot.shape);
  const auto missing = missing_values(program, system.layout, system.constants);
  if (!missing.empty())
    throw InputError(entry.place, "there is no value for " + missing.front() + ", which '" +
                                      entry.name + "' needs: the gain file has none");
  return program;
}

std::size_t slot_of(const model::Named& entry, const Layout& layout) {
  for (std::size_t i = 0; i < layout.slots.size(); ++i)
    if (layout.slots[i].name == entry.name) return i;
  throw InputError(entry.place, "'" + entry.name + "' is not a state");
}

/// Compiles the entries of plant and observer, in that order.
std::vector<JumpEntry> compile_map(const System& system, const std::vector<model::Named>& plant,
                                   const std::vector<model::Named>& observer) {
  std::vector<JumpEntry> map;
  for (const auto* part : {&plant, &observer}) {
    for (const model::Named& entry : *part) {
      const std::size_t slot = slot_of(entry, system.layout);
      map.push_back({slot, compile_entry(entry, system.layout.slots[slot], system)});
    }
  }
  return map;
}

/// The values of the entries at (x, tau = 0); the other elements come from `rest`.
Eigen::VectorXd values_at(const System& system, const std::vector<JumpEntry>& map,
                          const Eigen::VectorXd& x, Eigen::VectorXd rest) {
  for (const JumpEntry& entry : map) {
    const Slot& slot = system.layout.slots[entry.slot];
    PointFunction value(entry.program, system.layout, system.constants);
    rest.segment(slot.offset, slot.shape.size()) = value(x, 0).reshaped();
  }
  return rest;
}

void require_exact_flow(const expr::Program& program, const Layout& layout) {
  const auto moves = [&](const std::string& name) { return layout.moves(name); };
  if (const expr::Instruction* at = first_not_affine(program, moves))
    throw InputError(at->place(),
                     "this flow is not affine in the states (" + expr::to_string(at->op) +
                         "): this version steps affine flows exactly, by the matrix exponential, "
                         "and no others");
  if (!program.uses(layout.timer)) return;
  const auto timer = std::find_if(program.code.begin(), program.code.end(),
                                  [&](const expr::Instruction& instruction) {
                                    return instruction.op == expr::Op::input &&
                                           instruction.attributes[0] == program.input(layout.timer);
                                  });
  throw InputError(timer->place(),
                   "this flow depends on the timer " + layout.timer +
                       ": this version steps flows that depend on the states alone");
}

void make_flow(const model::Method& method, System& system) {
  const auto map = compile_map(system, method.plant.flow, method.observer.flow);
  for (const JumpEntry& entry : map) require_exact_flow(entry.program, system.layout);
  const Eigen::Index n = system.layout.size;
  system.flow = sample_affine(
      [&](const Eigen::VectorXd& x) { return values_at(system, map, x, Eigen::VectorXd::Zero(n)); },
      n);
  double fastest = 0;
  for (const auto* part : {&method.plant, &method.observer}) {
    for (const model::Named& entry : part->flow) {
      const Slot& slot = system.layout.slots[slot_of(entry, system.layout)];
      const double size =
          system.flow.linear.middleRows(slot.offset, slot.shape.size()).cwiseAbs().sum();
      if (size > fastest) system.flow_place = entry.place;
      fastest = std::max(fastest, size);
    }
  }
}

std::optional<AffineMap> make_affine_jump(const System& system) {
  const auto moves = [&](const std::string& name) {
    return name != system.layout.timer && system.layout.moves(name);
  };
  for (const JumpEntry& entry : system.jump)
    if (first_not_affine(entry.program, moves) != nullptr) return std::nullopt;
  return sample_affine(
      [&](const Eigen::VectorXd& x) { return values_at(system, system.jump, x, x); },
      system.layout.size);
}

void read_timer(const model::Timer& timer, System& system) {
  const auto value = [&](const expr::Expression& expression) {
    return model::scalar_value(expression, system.scope, system.constants);
  };
  system.low = value(timer.low);
  system.high = value(timer.high);
  system.first_low = value(timer.first_low);
  system.first_high = value(timer.first_high);
  if (!(0 <= system.low && system.low <= system.high && 0 < system.high &&
        std::isfinite(system.high)))
    throw InputError(timer.place, fmt::format("the timer {} is reset to [{}, {}]: expected "
                                              "0 <= low <= high and high > 0",
                                              timer.name, brief(system.low), brief(system.high)));
  if (!(0 <= system.first_low && system.first_low <= system.first_high &&
        std::isfinite(system.first_high)))
    throw InputError(timer.place,
                     fmt::format("the first value of the timer {} is in [{}, {}]: expected "
                                 "0 <= low <= high",
                                 timer.name, brief(system.first_low), brief(system.first_high)));
}

}  // namespace

System make_system(const model::Instance& instance, const model::Gains& gains) {
  const model::Method& method = *instance.method;
  if (!method.timer)
    throw InputError({method.file, 0, 0},
                     "the method has no timer, so there is nothing to simulate");
  System system;
  system.layout = make_layout(instance.states, method.timer->name);
  for (const model::Component* part : {&method.plant, &method.observer})
    for (const model::Declaration& declared : part->states)
      system.starts.push_back(declared.fallback);
  model::Stated stated = model::state(instance, gains);
  system.scope = std::move(stated.scope);
  system.constants = std::move(stated.values);
  read_timer(*method.timer, system);
  make_flow(method, system);
  system.jump = compile_map(system, method.plant.jump, method.observer.jump);
  system.affine_jump = make_affine_jump(system);
  return system;
}

}  // namespace gainsmith::hybrid
