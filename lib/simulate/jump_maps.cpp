#include "simulate/jump_maps.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/number.h"
#include "hybrid/rounding_terms.h"

namespace gainsmith::simulate {

using Eigen::VectorXd;

namespace {

bool is_mode(const hybrid::System& system, std::size_t variable) {
  return system.dynamics.variables[variable].kind == model::Dynamics::VariableKind::mode;
}

/// The constants that a text may take as they are, and their opposites, in rising order.
std::vector<double> constants_of(const expr::Program& program, const hybrid::System& system) {
  std::vector<double> all;
  for (const expr::Input& input : program.inputs)
    if (const auto known = system.constants.find(input.name); known != system.constants.end())
      all.insert(all.end(), known->second.reshaped().begin(), known->second.reshaped().end());
  for (const expr::Instruction& instruction : program.code)
    if (instruction.op == expr::Op::constant)
      if (const auto value = parse_decimal(instruction.text)) all.push_back(*value);
  for (std::size_t k = all.size(); k-- > 0;) all.push_back(-all[k]);
  std::ranges::sort(all);
  return all;
}

bool is_symmetric_state(const hybrid::System& system, std::size_t variable) {
  return system.dynamics.variables[variable].structure == model::Structure::symmetric;
}

}  // namespace

JumpMaps::JumpMaps(const hybrid::System& system) : system_(&system) {
  for (const model::Dynamics::Reaction& reaction : system.dynamics.reactions) {
    Maps& maps = maps_.emplace_back();
    for (const model::Dynamics::Pass& pass : reaction.passes) {
      Map& map = maps.emplace_back();
      for (const model::Dynamics::Assignment& assignment : pass.map) {
        map.entries.push_back({assignment.variable,
                               &assignment.value.program,
                               hybrid::SystemFunction(assignment.value.program, system),
                               {},
                               assignment.place,
                               nullptr,
                               {},
                               constants_of(assignment.value.program, system)});
        MapEntry& entry = map.entries.back();
        auto terms = hybrid::rounding_terms(assignment.value.program);
        if (!terms || is_mode(system, assignment.variable)) continue;
        entry.terms_program = std::make_unique<const expr::Program>(std::move(*terms));
        entry.terms.emplace(*entry.terms_program, system);
      }
      if (pass.until) map.until.emplace(*pass.until, system);
    }
  }
}

VectorXd JumpMaps::operator()(std::size_t event, bool lost, const VectorXd& before,
                              const LastPlaces* moved, const State31* state) {
  moved_ = moved;
  state_ = state;
  if (state_ != nullptr) after_31_ = state_->values();
  if (moved_ != nullptr) terms_ = VectorXd::Zero(system_->size);
  VectorXd after = before;
  std::int64_t passes = 0;
  const auto& reactions = system_->dynamics.reactions;
  for (std::size_t r = 0; r < reactions.size(); ++r) {
    if (reactions[r].event != event) continue;
    if (lost && system_->dynamics.components[reactions[r].component].observer) continue;
    passes += react(r, before, after);
  }
  count(event, passes, after);
  return after;
}

std::int64_t JumpMaps::react(std::size_t reaction, const VectorXd& before, VectorXd& after) {
  const model::Dynamics::Reaction& one = system_->dynamics.reactions[reaction];
  VectorXd own = before;
  if (state_ != nullptr) own_31_ = state_->values();
  std::int64_t passes = 0;
  for (std::size_t k = 0; k < one.passes.size(); ++k) {
    Map& map = maps_[reaction][k];
    if (one.passes[k].repeats) {
      passes += repeat(one.passes[k], system_->most_passes[reaction][k], map, own);
    } else {
      apply(map, own);
    }
  }
  for (const Map& map : maps_[reaction])
    for (const MapEntry& entry : map.entries) {
      const hybrid::Slot& slot = system_->layout.slots[entry.variable];
      after.segment(slot.offset, slot.shape.size()) = own.segment(slot.offset, slot.shape.size());
      if (state_ != nullptr)
        after_31_.segment(slot.offset, slot.shape.size()) =
            own_31_.segment(slot.offset, slot.shape.size());
    }
  return passes;
}

std::int64_t JumpMaps::repeat(const model::Dynamics::Pass& pass, std::int64_t most, Map& map,
                              VectorXd& own) {
  for (std::int64_t passes = 0;; ++passes) {
    if (map.until && (*map.until)(own)) return passes;
    if (passes < most) {
      apply(map, own);
      continue;
    }
    if (!map.until || pass.go_on) return passes;
    throw RunEnd(hybrid::Ending::passes,
                 fmt::format("{}: after {} passes '{}' is not true ({})", to_string(pass.place),
                             passes, map.until->text(), map.until->differences(own)));
  }
}

void JumpMaps::apply(Map& map, VectorXd& own) {
  results_.resize(map.entries.size());
  results_31_.resize(map.entries.size());
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    MapEntry& entry = map.entries[i];
    if (state_ != nullptr) {
      if (!entry.value_31) entry.value_31.emplace(*entry.program, *system_, state_->constants());
      results_31_[i] = (*entry.value_31)(own_31_);
      results_[i] =
          results_31_[i].unaryExpr([](const DoubleDouble& number) { return number.hi(); });
    } else {
      results_[i] = entry.value(own);
    }
    check(entry, own, results_[i]);
    if (moved_ != nullptr) move(entry, own, i);
  }
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    const hybrid::Slot& slot = system_->layout.slots[map.entries[i].variable];
    own.segment(slot.offset, slot.shape.size()) = results_[i].reshaped();
    if (state_ != nullptr)
      own_31_.segment(slot.offset, slot.shape.size()) = results_31_[i].reshaped();
  }
}

void JumpMaps::move(MapEntry& entry, const VectorXd& own, std::size_t result) {
  numbers::Matrix& value = results_[result];
  const bool symmetric = is_symmetric_state(*system_, entry.variable);
  const Eigen::Index first = system_->layout.slots[entry.variable].offset;
  numbers::Matrix sizes = numbers::Matrix::Zero(value.rows(), value.cols());
  if (entry.terms) {
    try {
      sizes = (*entry.terms)(own);
    } catch (const expr::EvaluationError&) {
      sizes = value.cwiseAbs();  // those of its terms have no value
    }
  }
  for (Eigen::Index column = 0; column < value.cols(); ++column)
    for (Eigen::Index row = symmetric ? column : 0; row < value.rows(); ++row) {
      const double before = own(first + column * value.rows() + row);
      double& found = value(row, column);
      double& terms = terms_(first + column * value.rows() + row);
      terms = sizes(row, column);
      if (terms == 0 && std::ranges::binary_search(entry.constants, found))
        terms = hybrid::kConstantTerms;
      else if (terms == 0 && found != before)
        terms = std::numeric_limits<double>::denorm_min();
      // What a branch leaves as it was has not been computed.
      else if (found != before && state_ != nullptr)
        found = (results_31_[result](row, column) += k31LastPlaces * moved_->of(found, terms)).hi();
      else if (found != before)
        found += moved_->of(found, terms);
      if (symmetric) value(column, row) = found;
      if (symmetric && state_ != nullptr)
        results_31_[result](column, row) = results_31_[result](row, column);
    }
}

void JumpMaps::check(const MapEntry& entry, const VectorXd& own, numbers::Matrix& value) const {
  const model::Dynamics::Variable& variable = system_->dynamics.variables[entry.variable];
  if (variable.kind == model::Dynamics::VariableKind::mode && value(0) != std::round(value(0)))
    throw InputError(entry.place, "the mode " + variable.name + " jumps to " + brief(value(0), 17) +
                                      ": expected a whole number");
  if (variable.structure != model::Structure::symmetric || value.size() == 0) return;
  const hybrid::Slot& slot = system_->layout.slots[entry.variable];
  const double asymmetry = (value - value.transpose()).cwiseAbs().maxCoeff();
  const double largest = std::max(value.cwiseAbs().maxCoeff(),
                                  own.segment(slot.offset, value.size()).cwiseAbs().maxCoeff());
  if (asymmetry > hybrid::kMeantEqual * largest)
    throw InputError(entry.place, "the state " + variable.name +
                                      " is symmetric and its jump is not: elements differ by " +
                                      brief(asymmetry));
  value = ((value + value.transpose()) / 2).eval();
}

void JumpMaps::count(std::size_t event, std::int64_t passes, VectorXd& after) {
  using Kind = model::Dynamics::VariableKind;
  for (std::size_t i = 0; i < system_->dynamics.variables.size(); ++i) {
    const model::Dynamics::Variable& variable = system_->dynamics.variables[i];
    const Eigen::Index at = system_->layout.slots[i].offset;
    if (variable.kind == Kind::jumps || (variable.kind == Kind::count && variable.of == event))
      after(at) += 1;
    if (variable.kind == Kind::passes && variable.of == event)
      after(at) = static_cast<double>(passes);
    const bool counts = variable.kind == Kind::jumps || variable.kind == Kind::count ||
                        variable.kind == Kind::passes;
    if (counts && state_ != nullptr) after_31_(at) = after(at);
  }
}

}  // namespace gainsmith::simulate
