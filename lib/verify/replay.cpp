#include "verify/replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/number.h"
#include "base/stop.h"
#include "claims/run_values.h"
#include "verify/pack_judge.h"
#include "verify/tolerances.h"

namespace gainsmith::verify {

namespace {

using Eigen::Index;
using VariableKind = model::Dynamics::VariableKind;

Column::Kind kind_of(VariableKind kind) {
  if (kind == VariableKind::state) return Column::Kind::state;
  return kind == VariableKind::mode ? Column::Kind::mode : Column::Kind::other;
}

/// "xh1", "P2_1"; a number has no indices.
std::string element(const std::string& name, expr::Shape shape, int at) {
  std::string label = name;
  if (!shape.is_scalar()) label += std::to_string(at % shape.rows + 1);
  if (shape.cols > 1) label += "_" + std::to_string(at / shape.rows + 1);
  return label;
}

/// t and j have columns of their own, what a log says is an output; costs belong to claims.
bool is_shown_otherwise(const model::RunTexts& texts, const model::Dynamics::Variable& variable) {
  const model::Dynamics& dynamics = texts.dynamics;
  for (const model::Design::Claim& claim : texts.claims)
    if (variable.name == model::cost_name(claim.name)) return true;
  return variable.kind == VariableKind::time || variable.kind == VariableKind::jumps ||
         variable.kind == VariableKind::measured_rate ||
         (variable.kind == VariableKind::measured && dynamics.measured[variable.of].output);
}

/// What makes the columns of one name.
struct Source {
  Column column;
  expr::Shape shape;
  std::optional<Index> offset;            ///< of a variable
  std::optional<claims::RunValue> value;  ///< of a signal or claim
  std::optional<std::size_t> at;          ///< the event at which alone it exists
};

/// The columns of a run: t, j, variables, signals and stated claims. Signals and claims of all rows
/// are evaluated together.
class EventTable {
 public:
  explicit EventTable(const claims::RunSetup& setup) : setup_(setup) {
    const model::Dynamics& dynamics = setup.texts.dynamics;
    for (const model::Dynamics::Component& component : dynamics.components)
      if (component.observer) observers_.push_back(component.name);
    for (std::size_t k = 0; k < dynamics.variables.size(); ++k) {
      const model::Dynamics::Variable& variable = dynamics.variables[k];
      if (is_shown_otherwise(setup.texts, variable)) continue;
      const hybrid::Slot& slot = setup.system.layout.slots[k];
      sources_.push_back({column(variable.name, kind_of(variable.kind)), slot.shape, slot.offset,
                          std::nullopt, std::nullopt});
    }
    for (const model::Dynamics::Signal& signal : dynamics.signals)
      add(signal.name, signal.value.program, Column::Kind::signal, signal.at);
    for (const claims::Claim& claim : setup.claims)
      if (claim.stated() && add(claim.name, claim.value, Column::Kind::claim, std::nullopt))
        sources_.back().column.scope = scope(claim);
    together_.emplace(hybrid::stacked(programs_, setup.layout, setup.system.constants));
  }

  /// One row a moment (claims::visit), and the columns with their names.
  void fill(double step, Replay& replay) {
    replay.columns = {{"t", "t", "", Column::Kind::time}, {"j", "j", "", Column::Kind::jumps}};
    for (const Source& source : sources_)
      for (int e = 0; e < source.shape.size(); ++e) {
        replay.columns.push_back(source.column);
        replay.columns.back().name = element(source.column.name, source.shape, e);
        replay.columns.back().element = e;
      }
    std::vector<double> values;
    claims::visit(replay.run, step, [&](const claims::Moment& moment) {
      values.push_back(moment.t);
      values.push_back(static_cast<double>(moment.j));
      replay.events.push_back(moment.jump == nullptr ? "" : event_of(*moment.jump));
      add_values(moment.x, moment.jump, values);
    });
    replay.table = Rows::Map(values.data(), static_cast<Index>(replay.events.size()),
                             static_cast<Index>(replay.columns.size()));
  }

  /// To a table that has been filled.
  void round(double step, Replay& replay) {
    replay.rounding.setZero(replay.table.rows(), replay.table.cols());
    Index row = 0;
    std::vector<double> higher, lower;
    hybrid::JumpPoint jump;
    claims::visit(replay.run, step, [&](const claims::Moment& moment) {
      for (const double direction : {1.0, -1.0}) {
        moved_ = moment.x;
        move(direction, moved_);
        if (moment.jump != nullptr) {
          jump.event = moment.jump->event;
          jump.before = moment.jump->before;
          move(direction, jump.before);
        }
        std::vector<double>& values = direction > 0 ? higher : lower;
        values.clear();
        add_values(moved_, moment.jump == nullptr ? nullptr : &jump, values);
      }
      Index column = kFirstSource;
      std::size_t k = 0;
      for (const Source& source : sources_)
        for (int e = 0; e < source.shape.size(); ++e, ++k, ++column) {
          if (source.offset) continue;
          const double value = replay.table(row, column);
          replay.rounding(row, column) =
              std::fmin(std::abs(higher[k] - value), std::abs(lower[k] - value));
        }
      ++row;
    });
  }

 private:
  static constexpr Index kFirstSource = 2;  ///< columns: t and j come before it
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  ClaimScope scope(const claims::Claim& claim) const {
    const auto constant =
        [&](const std::optional<expr::Program>& program) -> std::optional<double> {
      if (!program) return std::nullopt;
      return claims::RunValue(*program, setup_.layout, setup_.system.constants)
          .number(Eigen::VectorXd::Zero(setup_.layout.size));
    };
    return {claim.after, claim.over ? name_of(*claim.over) : std::string(), constant(claim.bound),
            constant(claim.factor)};
  }

  /// Whether it has a value.
  bool add(const std::string& name, const expr::Program& program, Column::Kind kind,
           std::optional<std::size_t> at) {
    for (const expr::Input& input : program.inputs)
      if (!setup_.system.slot(input.name) && !setup_.system.constants.contains(input.name))
        return false;
    sources_.push_back({column(name, kind), program.shape(), std::nullopt,
                        claims::RunValue(program, setup_.layout, setup_.system.constants), at});
    if (!at) programs_.push_back(&program);
    return true;
  }

  std::string event_of(const hybrid::JumpPoint& jump) const {
    return jump.lost ? name_of(jump.event) + " (lost)" : name_of(jump.event);
  }

  const std::string& name_of(std::size_t event) const {
    return setup_.texts.dynamics.events[event].name;
  }

  /// Of the only observer a name needs no prefix.
  Column column(const std::string& name, Column::Kind kind) const {
    for (const std::string& observer : observers_)
      if (name.starts_with(observer + ".")) {
        const std::string own = name.substr(observer.size() + 1);
        return {observers_.size() == 1 ? own : name, own, observer, kind};
      }
    return {name, name, "", kind};
  }

  /// Each element by another part of kShownPlaces units in the last place, so that differences move too.
  static void move(double direction, Eigen::VectorXd& x) {
    constexpr double kMost = kShownPlaces * std::numeric_limits<double>::epsilon() / 2;
    constexpr double kGolden = 0.6180339887498949;
    for (Index i = 0; i < x.size(); ++i) {
      const double turn = kGolden * static_cast<double>(i + 1);
      x(i) *= 1 + direction * kMost * (2 * (turn - std::floor(turn)) - 1);
    }
  }

  /// Those of all sources in a row of the table; `jump`: the one just before it, if any.
  void add_values(const Eigen::VectorXd& x, const hybrid::JumpPoint* jump,
                  std::vector<double>& values) {
    const bool known = together_->run(x);
    std::size_t k = 0;
    for (Source& source : sources_) {
      const auto size = static_cast<std::size_t>(source.shape.size());
      if (source.offset) {
        const double* const first = x.data() + *source.offset;
        values.insert(values.end(), first, first + size);
      } else if (!source.at) {
        const numbers::Matrix& value = known ? together_->value(k) : (*source.value)(x);
        values.insert(values.end(), value.data(), value.data() + size);
        ++k;
      } else if (jump != nullptr && jump->event == *source.at) {
        const numbers::Matrix& value = (*source.value)(jump->before);
        values.insert(values.end(), value.data(), value.data() + size);
      } else {
        values.insert(values.end(), size, std::numeric_limits<double>::quiet_NaN());
      }
    }
  }

  const claims::RunSetup& setup_;
  std::vector<std::string> observers_;
  std::vector<Source> sources_;
  std::vector<const expr::Program*> programs_;         ///< of the signals and claims of all rows
  std::optional<numbers::StackedFunctions> together_;  ///< of these; what they share is made once
  Eigen::VectorXd moved_;
};

/// Starts that the campaign gives are asked about with what is drawn.
std::vector<judge::Fault> faults_of(const hybrid::Trajectory& run, const claims::RunSetup& setup,
                                    std::uint64_t seed, std::uint64_t number) {
  const simulate::Accuracy accuracy = setup.accuracy(claims::kAccuracyOfOne);
  judge::Question question{accuracy.relative, accuracy.absolute, accuracy.absolute_of, {}, {}};
  // What is given is not drawn again.
  if (setup.scenario.given == nullptr)
    question.drawn = judge::DrawnFrom{seed, number, &setup.texts.campaign};
  for (const model::Design::Start& start : setup.texts.campaign.starts) {
    const hybrid::Slot& slot = setup.layout.slots[start.state];
    const numbers::Matrix value = run.start.segment(slot.offset, slot.shape.size())
                                      .reshaped(slot.shape.rows, slot.shape.cols);
    question.starts.push_back({start.state, value, value});
  }
  return judge::check_trajectory(run, setup.texts.dynamics, setup.texts.stated, question);
}

/// InputError for a step that makes too many points.
void check_points(double length, double step) {
  constexpr double kMostPoints = 1e7;
  if (step > 0 && length / step > kMostPoints)
    throw InputError({}, "a step of " + brief(step) + " makes " + brief(length / step, 2) +
                             " points of a run of length " + brief(length) +
                             "; at most 1e7 are written");
}

}  // namespace

Replay table_of_run(const Setup& setup, hybrid::Trajectory run, double step, bool with_rounding) {
  check_points(run.end, step);
  Replay result;
  result.run = std::move(run);
  std::optional<Concluding> concluding;
  if (result.run.ending == hybrid::Ending::interrupted) concluding.emplace();
  EventTable table(*setup.events);
  table.fill(step, result);
  if (with_rounding) table.round(step, result);
  return result;
}

void add_rounding(const Setup& setup, double step, Replay& replay) {
  std::optional<Concluding> concluding;
  if (replay.run.ending == hybrid::Ending::interrupted) concluding.emplace();
  EventTable(*setup.events).round(step, replay);
}

hybrid::Trajectory run_of(const Setup& setup, std::uint64_t seed, std::uint64_t run) {
  const claims::RunSetup& events = *setup.events;
  return simulate::Simulator(events.system, events.scenario)
      .run(seed, run, events.accuracy(claims::kAccuracyOfOne));
}

Replay table_of_run(const Setup& setup, std::uint64_t seed, std::uint64_t run, double step,
                    bool with_rounding) {
  check_points(setup.horizon(), step);
  return table_of_run(setup, run_of(setup, seed, run), step, with_rounding);
}

Replay replay_run(const Setup& setup, std::uint64_t seed, std::uint64_t run, double step,
                  bool judged) {
  const claims::RunSetup& events = *setup.events;
  Replay result = table_of_run(setup, seed, run, step);
  if (result.run.ending == hybrid::Ending::interrupted) return result;
  if (judged) result.faults = faults_of(result.run, events, seed, run);
  if (events.judged.empty()) return result;
  Judge judge(setup);
  std::vector<claims::Finding> findings = judge(seed, run).findings;
  // Proofs take longer than one run.
  if (std::ranges::any_of(findings, &claims::Finding::undecided))
    if (const auto linear = make_linear_packs(setup))
      findings = verdict_on_run(judge, linear.get(), seed, run).findings;
  for (std::size_t k = 0; k < findings.size(); ++k)
    result.claims.push_back({events.judged[k].name, events.judged[k].kind, findings[k]});
  return result;
}

}  // namespace gainsmith::verify
