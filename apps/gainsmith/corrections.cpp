#include "gainsmith/corrections.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "expr/program/assembly.h"
#include "hybrid/affine.h"
#include "hybrid/state_layout.h"

namespace gainsmith::app {

namespace {

using model::Dynamics;
using Kind = Dynamics::VariableKind;

std::optional<std::size_t> column_of(const verify::Replay& replay, const std::string& variable,
                                     int element) {
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    const verify::Column& column = replay.columns[k];
    const std::string name =
        column.observer.empty() ? column.stem : column.observer + "." + column.stem;
    if (name == variable && column.element == element) return k;
  }
  return std::nullopt;
}

/// The texts of the states of observers: of flows and of jumps.
std::vector<const expr::Program*> texts_of(const Dynamics& dynamics) {
  std::vector<const expr::Program*> texts;
  const auto add = [&](const Dynamics::Assignment& assignment) {
    if (dynamics.components[dynamics.variables[assignment.variable].component].observer)
      texts.push_back(&assignment.value.program);
  };
  for (const Dynamics::Assignment& assignment : dynamics.flow) add(assignment);
  for (const Dynamics::Reaction& reaction : dynamics.reactions)
    for (const Dynamics::Pass& pass : reaction.passes)
      for (const Dynamics::Assignment& assignment : pass.map) add(assignment);
  return texts;
}

/// Whether an instruction is part of a larger difference.
bool is_summed(const expr::Program& text, int at) {
  return std::ranges::any_of(text.code, [&](const expr::Instruction& instruction) {
    return (instruction.op == expr::Op::subtract || instruction.op == expr::Op::add) &&
           std::ranges::find(instruction.operands, at) != instruction.operands.end();
  });
}

/// The program of one instruction; a text of a run calls nothing.
expr::Program part_at(const expr::Program& text, std::size_t at) {
  expr::Assembly all;
  std::vector<int> places;
  for (std::size_t k = 0; k <= at; ++k) {
    expr::Instruction instruction = text.code[k];
    for (int& operand : instruction.operands) operand = places[static_cast<std::size_t>(operand)];
    places.push_back(
        instruction.op == expr::Op::input
            ? all.add_input(text.inputs[static_cast<std::size_t>(instruction.attributes[0])].name,
                            instruction.shape, instruction)
            : all.add(std::move(instruction)));
  }
  return all.extract(places.back());
}

struct Term {
  std::size_t slot;
  int element;
  double factor;

  bool operator==(const Term&) const = default;
};
using Terms = std::vector<Term>;

/// Of each element of an affine program what it reads; nothing for one with a constant.
std::vector<Terms> terms_of(const expr::Program& program, const hybrid::System& system) {
  hybrid::PointFunction function(program, system.layout, system.constants);
  const auto at = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return function(x, 0).reshaped();
  };
  const Eigen::VectorXd origin = at(Eigen::VectorXd::Zero(system.layout.size));
  std::vector<Terms> rows(static_cast<std::size_t>(origin.size()));
  for (const expr::Input& input : program.inputs) {
    const auto slot = system.slot(input.name);
    if (!slot || *slot >= system.dynamics.variables.size()) continue;
    for (int k = 0; k < system.layout.slots[*slot].shape.size(); ++k) {
      const Eigen::Index place = system.layout.slots[*slot].offset + k;
      const Eigen::VectorXd moved = at(Eigen::VectorXd::Unit(system.layout.size, place)) - origin;
      for (std::size_t r = 0; r < rows.size(); ++r)
        if (const double factor = moved(static_cast<Eigen::Index>(r)); factor != 0)
          rows[r].push_back({*slot, k, factor});
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (origin(static_cast<Eigen::Index>(r)) != 0) rows[r].clear();
  return rows;
}

bool is_affine(const expr::Program& program, const hybrid::System& system) {
  const auto moves = [&](const std::string& name) { return !system.constants.contains(name); };
  return hybrid::first_not_affine(program, moves) == nullptr;
}

/// An element of an output of the plant, and what it reads.
struct Measured {
  std::size_t column = 0;
  Terms terms;
};

/// Those that show something: a state of the plant alone is drawn already.
std::vector<Measured> outputs_of(const hybrid::System& system, const verify::Replay& replay) {
  const Dynamics& dynamics = system.dynamics;
  std::vector<Measured> outputs;
  for (const Dynamics::Signal& signal : dynamics.signals) {
    if (!signal.output || !is_affine(signal.value.program, system)) continue;
    const std::vector<Terms> rows = terms_of(signal.value.program, system);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const bool state = rows[r].size() == 1 && rows[r][0].factor == 1 &&
                         dynamics.variables[rows[r][0].slot].kind == Kind::state;
      const auto column = column_of(replay, signal.name, static_cast<int>(r));
      if (rows[r].empty() || state || !column) continue;
      outputs.push_back({*column, rows[r]});
    }
  }
  return outputs;
}

bool is_of_observer(const Dynamics& dynamics, const Term& term) {
  const Dynamics::Variable& variable = dynamics.variables[term.slot];
  return variable.kind == Kind::state && dynamics.components[variable.component].observer;
}

/// What is left of y - h where h is one state of an observer: y. Nothing otherwise.
std::optional<std::pair<Term, Terms>> compared(const Dynamics& dynamics, Terms row) {
  const auto of_observer = [&](const Term& term) { return is_of_observer(dynamics, term); };
  if (std::ranges::count_if(row, of_observer) != 1) return std::nullopt;
  const auto found = std::ranges::find_if(row, of_observer);
  const Term estimate = *found;
  row.erase(found);
  for (Term& term : row) term.factor /= -estimate.factor;
  return std::pair(estimate, std::move(row));
}

}  // namespace

std::vector<Correction> corrections(const hybrid::System& system, const verify::Replay& replay) {
  std::vector<Correction> found;
  const std::vector<Measured> outputs = outputs_of(system, replay);
  const auto tell = [&](const Terms& row) {
    const auto pair = compared(system.dynamics, row);
    if (!pair) return;
    const auto& [estimate, terms] = *pair;
    const auto output = std::ranges::find(outputs, terms, &Measured::terms);
    std::optional<std::size_t> measured;
    if (output != outputs.end())
      measured = output->column;
    else if (terms.size() == 1 && terms[0].factor == 1 &&
             system.dynamics.variables[terms[0].slot].kind == Kind::measured)
      measured = column_of(replay, system.layout.slots[terms[0].slot].name, terms[0].element);
    const auto of = column_of(replay, system.layout.slots[estimate.slot].name, estimate.element);
    if (!measured || !of) return;
    const Correction correction{*measured, *of};
    if (std::ranges::find(found, correction) == found.end()) found.push_back(correction);
  };
  for (const expr::Program* text : texts_of(system.dynamics))
    for (std::size_t k = 0; k < text->code.size(); ++k) {
      if (text->code[k].op != expr::Op::subtract || text->code[k].shape.cols != 1) continue;
      if (is_summed(*text, static_cast<int>(k))) continue;
      const expr::Program part = part_at(*text, k);
      if (is_affine(part, system))
        for (const Terms& row : terms_of(part, system)) tell(row);
    }
  return found;
}

}  // namespace gainsmith::app
