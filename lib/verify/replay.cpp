#include "verify/replay.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "hybrid/exact_values.h"
#include "verify/judge.h"
#include "verify/setup.h"
#include "verify/signals.h"

namespace gainsmith::verify {

namespace {

using Eigen::Index;

/// Collects the columns of a replay.
class Table {
 public:
  explicit Table(Replay& replay) : replay_(&replay) {
    replay.table.resize(static_cast<Index>(replay.arc.samples()), 0);
  }

  void add(const std::string& name, const Eigen::VectorXd& values) {
    replay_->columns.push_back(name);
    replay_->table.conservativeResize(Eigen::NoChange, replay_->table.cols() + 1);
    replay_->table.rightCols(1) = values;
  }

  /// One column for each element of a named matrix; values: elements x samples.
  void add_elements(const std::string& name, expr::Shape shape, const numbers::Matrix& values) {
    for (int e = 0; e < shape.size(); ++e) {
      std::string label = name;
      if (!shape.is_scalar()) label += std::to_string(e % shape.rows + 1);
      if (shape.cols > 1) label += "_" + std::to_string(e / shape.rows + 1);
      add(label, values.row(e).transpose());
    }
  }

 private:
  Replay* replay_;
};

void add_signals(const model::Design& design, const hybrid::System& system, const hybrid::Arc& arc,
                 Table& table) {
  const Eigen::Map<const Eigen::VectorXd> timers(arc.timer.data(),
                                                 static_cast<Index>(arc.timer.size()));
  for (const model::NamedFormula& signal : design.signals) {
    const expr::Program program = system.link(signal.value);
    if (!system.missing(program).empty()) continue;
    AlongFunction along(program, system);
    table.add_elements(signal.name, program.shape(), along(arc.states(), timers));
  }
}

/// As a column of the table; a run that is judged further than the states go is cut off there.
Eigen::VectorXd column_of(const std::vector<hybrid::Bounded<double>>& values, Index rows) {
  Eigen::VectorXd column =
      Eigen::VectorXd::Constant(rows, std::numeric_limits<double>::quiet_NaN());
  for (Index k = 0; k < std::min(rows, static_cast<Index>(values.size())); ++k)
    column(k) = values[static_cast<std::size_t>(k)].value;
  return column;
}

void add_claims(Judge& judge, std::uint64_t seed, std::uint64_t run, Replay& replay, Table& table) {
  const std::vector<Finding> findings = judge(seed, run).findings;
  const hybrid::Track<double>& track = judge.track(seed, run);
  const Index rows = replay.table.rows();
  std::size_t next = 0;
  for (ClaimCheck<double>& check : judge.checks()) {
    const JudgedClaim& claim = check.claim();
    replay.claims.push_back({claim.name, findings[next++]});
    table.add(claim.name, column_of(check.values(track), rows));
    if (claim.kind == model::ClaimKind::cost)
      table.add(claim.name + "_cost", column_of(check.running_cost(track), rows));
  }
}

/// The states of a run, all of them.
hybrid::Arc arc_of(const model::Instance& instance, const model::Gains& gains, const Setup& setup,
                   std::uint64_t seed, std::uint64_t run) {
  if (setup.steps)
    return hybrid::Simulator(setup.system, setup.scenario, *setup.steps).run(seed, run);
  const hybrid::Coordinates states = hybrid::states_as_coordinates(
      setup.system, hybrid::exact_values(instance, setup.system, gains));
  hybrid::IntegratedSimulator simulator(setup.system, setup.scenario, states);
  const hybrid::Track<double>& track = simulator.run(seed, run, Judge::kUsual);
  return {track.size,  track.t,       track.j,           track.timer,
          track.moves, track.stacked, track.termination, track.message};
}

}  // namespace

Replay replay(const model::Instance& instance, const model::Gains& gains, std::uint64_t seed,
              std::uint64_t run) {
  const std::unique_ptr<const Setup> made = make_setup(instance, gains);
  const Setup& setup = *made;
  Replay result;
  result.arc = arc_of(instance, gains, setup, seed, run);
  const hybrid::Arc& arc = result.arc;
  Table table(result);
  table.add("t", Eigen::Map<const Eigen::VectorXd>(arc.t.data(), static_cast<Index>(arc.t.size())));
  Eigen::VectorXd jumps(static_cast<Index>(arc.samples()));
  for (std::size_t k = 0; k < arc.samples(); ++k)
    jumps(static_cast<Index>(k)) = static_cast<double>(arc.j[k]);
  table.add("j", jumps);
  table.add(setup.system.layout.timer, Eigen::Map<const Eigen::VectorXd>(
                                           arc.timer.data(), static_cast<Index>(arc.timer.size())));
  for (const hybrid::Slot& slot : setup.system.layout.slots)
    table.add_elements(slot.name, slot.shape,
                       arc.states().middleRows(slot.offset, slot.shape.size()));
  add_signals(*instance.design, setup.system, arc, table);
  Judge judge(setup);
  add_claims(judge, seed, run, result, table);
  return result;
}

}  // namespace gainsmith::verify
