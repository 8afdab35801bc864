#include "gainsmith/corrections.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "expr/assembly.h"
#include "hybrid/affine.h"
#include "hybrid/state_layout.h"

namespace gainsmith::app {

namespace {

using model::Dynamics;
using Kind = Dynamics::VariableKind;

std::optional<std::size_t> column_of(const verify::Replay& replay, const std::string& variable,
                                     int element) {
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    const verify::Column& one = replay.columns[k];
    const std::string name = one.observer.empty() ? one.stem : one.observer + "." + one.stem;
    if (name == variable && one.element == element) return k;
  }
  return std::nullopt;
}

/// The texts of the states of observers: of flows and of jumps.
std::vector<const expr::Program*> texts_of(const Dynamics& dynamics) {
  std::vector<const expr::Program*> texts;
  const auto add = [&](const Dynamics::Assignment& one) {
    if (dynamics.components[dynamics.variables[one.variable].component].observer)
      texts.push_back(&one.value.program);
  };
  for (const Dynamics::Assignment& one : dynamics.flow) add(one);
  for (const Dynamics::Reaction& reaction : dynamics.reactions)
    for (const Dynamics::Pass& pass : reaction.passes)
      for (const Dynamics::Assignment& one : pass.map) add(one);
  return texts;
}

/// Whether an instruction is part of a larger difference.
bool is_summed(const expr::Program& text, int at) {
  return std::ranges::any_of(text.code, [&](const expr::Instruction& one) {
    return (one.op == expr::Op::subtract || one.op == expr::Op::add) &&
           std::ranges::find(one.operands, at) != one.operands.end();
  });
}

/// The program of one instruction; a text of a run calls nothing.
expr::Program part_at(const expr::Program& text, std::size_t at) {
  expr::Assembly all;
  std::vector<int> places;
  for (std::size_t k = 0; k <= at; ++k) {
    expr::Instruction one = text.code[k];
    for (int& operand : one.operands) operand = places[static_cast<std::size_t>(operand)];
    places.push_back(
        one.op == expr::Op::input
            ? all.add_input(text.inputs[static_cast<std::size_t>(one.attributes[0])].name,
                            one.shape, one)
            : all.add(std::move(one)));
  }
  return all.extract(places.back());
}

/// Compares the elements of a difference with those of the variables that it reads.
class Difference {
 public:
  Difference(const expr::Program& program, const hybrid::System& system)
      : system_(system),
        function_(program, system.layout, system.constants),
        origin_(at(Eigen::VectorXd::Zero(system.layout.size))) {
    for (const expr::Input& input : program.inputs)
      if (const auto slot = system.slot(input.name);
          slot && *slot < system.dynamics.variables.size())
        read_.push_back(*slot);
  }

  /// Appends what corrects what.
  void tell(const verify::Replay& replay, std::vector<Correction>& found) {
    std::vector<Terms> rows(static_cast<std::size_t>(origin_.size()));
    for (const std::size_t slot : read_)
      for (int k = 0; k < system_.layout.slots[slot].shape.size(); ++k) add(slot, k, rows);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Terms& row = rows[r];
      if (origin_(static_cast<Eigen::Index>(r)) != 0 || row.size() != 2 ||
          row[0].factor != -row[1].factor)
        continue;
      const bool swapped = is_measured(row[1].slot);
      const Term& measured = row[swapped ? 1 : 0];
      const Term& state = row[swapped ? 0 : 1];
      if (!is_measured(measured.slot) || kind(state.slot) != Kind::state) continue;
      const auto of = column_of(replay, shown_name(measured.slot), measured.element);
      const auto by = column_of(replay, name(state.slot), state.element);
      if (!of || !by) continue;
      if (const Correction one{*of, *by}; std::ranges::find(found, one) == found.end())
        found.push_back(one);
    }
  }

 private:
  struct Term {
    std::size_t slot;
    int element;
    double factor;
  };
  using Terms = std::vector<Term>;

  Eigen::VectorXd at(const Eigen::VectorXd& x) { return function_(x, 0).reshaped(); }
  const std::string& name(std::size_t slot) const { return system_.layout.slots[slot].name; }
  /// That of the output that is this measurement; otherwise its own.
  const std::string& shown_name(std::size_t slot) const {
    for (const Dynamics::Signal& signal : system_.dynamics.signals)
      if (const auto& read = signal.value.program.inputs;
          signal.output && read.size() == 1 && read.front().name == name(slot))
        return signal.name;
    return name(slot);
  }
  Kind kind(std::size_t slot) const { return system_.dynamics.variables[slot].kind; }
  bool is_measured(std::size_t slot) const { return kind(slot) == Kind::measured; }

  void add(std::size_t slot, int element, std::vector<Terms>& rows) {
    const Eigen::Index place = system_.layout.slots[slot].offset + element;
    const Eigen::VectorXd moved = at(Eigen::VectorXd::Unit(system_.layout.size, place)) - origin_;
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (const double factor = moved(static_cast<Eigen::Index>(r)); factor != 0)
        rows[r].push_back({slot, element, factor});
  }

  const hybrid::System& system_;
  hybrid::PointFunction function_;
  Eigen::VectorXd origin_;
  std::vector<std::size_t> read_;
};

}  // namespace

std::vector<Correction> corrections(const hybrid::System& system, const verify::Replay& replay) {
  std::vector<Correction> found;
  const auto moves = [&](const std::string& name) { return !system.constants.contains(name); };
  for (const expr::Program* text : texts_of(system.dynamics))
    for (std::size_t k = 0; k < text->code.size(); ++k) {
      if (text->code[k].op != expr::Op::subtract || text->code[k].shape.cols != 1) continue;
      if (is_summed(*text, static_cast<int>(k))) continue;
      const expr::Program part = part_at(*text, k);
      if (hybrid::first_not_affine(part, moves) == nullptr)
        Difference(part, system).tell(replay, found);
    }
  return found;
}

}  // namespace gainsmith::app
