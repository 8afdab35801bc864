#include "hybrid/event_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/number.h"
#include "base/stop.h"
#include "hybrid/branches.h"
#include "hybrid/event_due.h"
#include "hybrid/event_jump.h"
#include "hybrid/event_rhythm.h"
#include "hybrid/event_sliding.h"
#include "hybrid/event_stays.h"
#include "hybrid/event_watch.h"
#include "hybrid/integrator.h"
#include "hybrid/measured_rows.h"
#include "hybrid/run_record.h"
#include "hybrid/track.h"

namespace gainsmith::hybrid {

using Eigen::Index;
using Eigen::VectorXd;
using VariableKind = model::Dynamics::VariableKind;

/// What is compiled once for all runs.
struct EventSimulator::Texts {
  explicit Texts(const EventSystem& system) : movement(system), watch(system), maps(system) {}
  Movement movement;
  EventWatch watch;
  JumpMaps maps;
};

namespace {

constexpr std::int64_t kLongestChain = 1000000;
constexpr std::size_t kKeptOfChain = 1000;
constexpr std::int64_t kMostStepsOfRun = 2000000;
constexpr std::int64_t kMostSlowSteps = 3000;
constexpr double kSlow = 1e-10;            ///< of the horizon
constexpr double kLongestStep = 1.0 / 16;  ///< of the horizon
constexpr double kOfHorizon = 1e-6;        ///< a time near 0 counts as so much of it
/// Of the horizon: how long a flow may be outside of `while` after a jump to its border.
constexpr double kOutside = 1e-9;
constexpr double kEarly = 0.1;            ///< of a step
constexpr double kShorterStep = 1.5;      ///< of the time up to an event
constexpr double kBeyondTurn = 4;         ///< of the time up to a turn near a border
constexpr double kShortestAgain = 1e-13;  ///< of the time
/// Of the terms of a guard: turning points that a twin keeps, to be compared with their errors.
constexpr double kNearOfTerms = 1e-3;
/// At one time, before a kink counts as one that does not matter.
constexpr int kMostTurns = 8;

/// Elements of states and modes among all values.
std::vector<Index> rows_of_states(const EventSystem& system) {
  std::vector<Index> rows;
  for (std::size_t k = 0; k < system.dynamics.variables.size(); ++k) {
    const model::Dynamics::Variable& variable = system.dynamics.variables[k];
    if (variable.kind != VariableKind::state && variable.kind != VariableKind::mode) continue;
    for (Index e = 0; e < variable.shape.size(); ++e)
      rows.push_back(system.layout.slots[k].offset + e);
  }
  return rows;
}

class EventRun {
 public:
  EventRun(const EventSystem& system, const EventScenario& scenario, Movement& movement,
           EventWatch& watch, JumpMaps& maps, std::uint64_t seed, std::uint64_t run,
           const Accuracy& accuracy, const RecordLimits& limits, std::optional<std::uint64_t> moved)
      : system_(system),
        movement_(movement),
        watch_(watch),
        maps_(maps),
        horizon_(scenario.horizon),
        moved_(moved ? std::optional<LastPlaces>(std::in_place, seed, run, *moved) : std::nullopt),
        due_(system, watch, EventClocks(system, scenario, seed, run), scenario.horizon),
        noise_(system, seed, run),
        rows_(system),
        branches_(system, watch, accuracy),
        flow_(make_flow(movement, accuracy, kLongestStep * scenario.horizon, places())),
        rhythm_(scenario.horizon),
        state_rows_(rows_of_states(system)),
        stays_(watch),
        sliding_(system, watch, accuracy, scenario.horizon),
        record_(system, scenario.horizon, limits) {
    values_ = draw_start(system, scenario, seed, run);
  }

  Trajectory trajectory() {
    try {
      begin();
      while (true) {
        instant();
        if (t_ >= horizon_) break;
        flow();
      }
    } catch (const RunEnd& end) {
      record_.ends(end.ending, end.what(), t_, j_);
    } catch (const IntegrationError& error) {
      const Ending ending = error.escaped     ? Ending::escaped
                            : error.undefined ? Ending::undefined
                                              : Ending::lost;
      record_.ends(ending, error.what(), t_, j_);
    } catch (const expr::EvaluationError& error) {
      record_.ends(Ending::undefined, error.what(), t_, j_);
    } catch (const Stopped&) {
      record_.ends(Ending::interrupted, "interrupted", t_, j_);
    }
    return record_.take(t_);
  }

 private:
  enum class Went { on, stopped };
  using Turns = std::vector<std::pair<NearTurn, bool>>;

  // --- The start and the end. ---

  void begin() {
    movement_.reset();
    for (std::size_t k = 0; k < system_.noise.size(); ++k) noise_.draw(k, values_);
    rows_.begin(values_);
    due_.begin(values_, movement_);
    movement_.fill_clocks(0, values_);
    branches_.hold(values_);
    record_.start(variables(values_));
    require_range();
  }

  const LastPlaces* places() const { return moved_ ? &*moved_ : nullptr; }

  VectorXd variables(const VectorXd& values) const { return values.head(system_.size); }

  void require_range() const {
    for (Index k = 0; k < system_.size; ++k)
      if (!(std::abs(values_(k)) <= kLargestState))
        throw RunEnd(Ending::escaped,
                     fmt::format("{} = {}", system_.element_name(k), brief(values_(k))));
  }

  // --- Instants. ---

  void instant() {
    while (const auto event = due_.first(values_, t_)) occurrence(*event);
    stays_.begin(values_);
  }

  void occurrence(std::size_t event) {
    const auto& noise = system_.dynamics.noise;
    for (std::size_t k = 0; k < noise.size(); ++k)
      if (noise[k].event == event) noise_.draw(k, values_);
    const bool goes = !watch_.only_if[event] || (*watch_.only_if[event])(values_);
    if (goes) {
      jump(event);
    } else {
      due_.spend(event, t_, movement_);
      movement_.fill_clocks(t_, values_);
    }
    branches_.hold(values_);
  }

  void jump(std::size_t event) {
    check_stop();
    if (chain_ == 0) watch_rhythm(event);
    sliding_.jumped();
    const VectorXd before = values_;
    const bool lost = system_.dynamics.events[event].lost > 0 && due_.clocks().loses(event);
    values_ = maps_(event, lost, before, places());
    record_.flow_ends();
    due_.spend(event, t_, movement_);
    movement_.set_since(event, t_);
    movement_.fill_clocks(t_, values_);
    due_.jumped(event, values_);
    record_.add(JumpPoint{t_, j_, event, lost, variables(before), variables(values_)});
    ++j_;
    require_range();
    if (++chain_ >= kLongestChain) end_chain(event);
  }

  [[noreturn]] void end_chain(std::size_t event) {
    const std::string names = record_.last_events();
    record_.shorten_chain(kLongestChain, kKeptOfChain);
    const auto next = due_.first(values_, t_);
    const std::size_t due = next.value_or(event);
    const model::Dynamics::Event& one = system_.dynamics.events[due];
    std::string value;
    if (watch_.when[due])
      value = fmt::format(" ('{}' is true, {})", watch_.when[due]->text(),
                          watch_.when[due]->differences(values_));
    throw RunEnd(
        Ending::stuck,
        fmt::format("{} jumps without a flow between them, of {}: then the event {} is due "
                    "again{}; the first {} of them are kept",
                    kLongestChain, names, one.name, value, kKeptOfChain));
  }

  void watch_rhythm(std::size_t event) {
    const FlowPiece& flow = record_.flow();
    if (flow.steps.empty()) return;
    VectorXd largest = VectorXd::Zero(static_cast<Index>(state_rows_.size()));
    for (const DenseStep& step : flow.steps)
      largest = largest.cwiseMax(step.coefficients.cwiseAbs().rowwise().sum()(state_rows_));
    rhythm_.push(t_, flow.to() - flow.from(), event, due_.has_clock(event), values_(state_rows_),
                 largest);
    const double part = rhythm_.shrinkage() * rhythm_.shrinkage();
    flow_->sharpen(part);
    branches_.sharpen(part);
    std::string names;
    for (const std::size_t one : rhythm_.events())
      names += (names.empty() ? "" : ", ") + system_.dynamics.events[one].name;
    if (const auto accumulation = rhythm_.accumulation()) {
      record_.accumulates(*accumulation);
      throw RunEnd(Ending::zeno,
                   fmt::format("the flows between the jumps of {} shrink by a steady factor; they "
                               "accumulate at t = {}",
                               names, brief(*accumulation, 12)));
    }
    if (rhythm_.chatters())
      throw RunEnd(Ending::chattering, "flows of hardly any length between the jumps of " + names);
  }

  // --- Flows. ---

  void flow() {
    if (rows_.leave(t_, values_)) {
      branches_.hold(values_);
      if (due_.first(values_, t_)) return;  // by the last of several rows at t
    }
    branches_.hold_kinks(values_);
    double stop = std::min({horizon_, due_.clocks().next(), noise_.next(), rows_.next()});
    movement_.begin(t_, values_);
    stop = watch_.next_line(movement_, t_, stop, values_);
    flow_->start(t_, values_, stop);
    record_.flow_begins(j_, variables(values_));
    starts_ = true;
    Went went = Went::on;
    while (went == Went::on && t_ < stop) {
      check_stop();
      if (++steps_ > kMostStepsOfRun)
        throw RunEnd(Ending::lost, fmt::format("more than {} steps", kMostStepsOfRun));
      watch_progress();
      went = take(flow_->next());
    }
    const bool drawn = noise_.draw_due(t_, values_);
    if (rows_.arrive(t_, values_) || drawn) branches_.hold(values_);
  }

  /// Goes along a step up to where something happens. A kink that turns at its start again and
  /// again does not matter.
  Went take(const DenseStep& whole) {
    const auto turn = branches_.first_turn(StepValues(movement_, values_, whole), values_);
    const bool back = turn && turn->t == whole.from;
    if (back && (!branches_.is_kink(turn->branch) || ++turned_back_ < kMostTurns)) {
      turns_over(*turn);
      return Went::stopped;
    }
    const bool turns = turn && turn->t > whole.from;
    const Went went = along(turns && turn->t < whole.to ? movement_.until(whole, turn->t) : whole);
    if (!turns || t_ != turn->t) return went;
    turns_over(*turn);
    return Went::stopped;
  }

  void turns_over(const Branches::Turn& turn) {
    values_(turn.held) = turn.to;
    if (!branches_.is_kink(turn.branch)) sliding_.switched(turn.branch, t_, values_);
  }

  /// The same of a step on which no branch turns.
  Went along(const DenseStep& step) {
    const StepValues inside(movement_, values_, step);
    stays_.require_inside(inside, std::min(inside.to(), inside.from() + kOutside * horizon_));
    Turns near;
    std::optional<double> hidden;
    const auto crossings = watch_.crossings(
        inside, values_, moved_ ? kNearOfTerms : 0,
        [&](const NearTurn& turn, bool reached) { near.emplace_back(turn, reached); },
        starts_ ? &hidden : nullptr);
    if (hidden && is_coarse(step, step.from + *hidden * (step.to - step.from)))
      return take_shorter(step.from + kBeyondTurn * *hidden * (step.to - step.from));
    const std::vector<DueEvents::Mark> marks = due_.marks();
    const EventStays::Marks was_inside = stays_.marks();
    for (const double t : crossings) {
      VectorXd values = inside.at(t);
      const bool due = due_.first(values, t).has_value();
      const bool left = !due && stays_.leaves(values);
      if (!due && !left) continue;
      if (is_coarse(step, t)) {
        due_.set_marks(marks);
        stays_.set_marks(was_inside);
        return take_shorter(step.from + kShorterStep * (t - step.from));
      }
      note(near, t);
      arrive(t < step.to ? movement_.until(step, t) : step, std::move(values));
      if (left) stays_.leave_first(values_);
      return Went::stopped;
    }
    note(near, step.to);
    arrive(step, inside.at(step.to));
    if (stays_.leaves(values_)) stays_.leave_first(values_);
    return due_.first(values_, t_) ? Went::stopped : Went::on;
  }

  /// Whether something happens so early in a step that its rounding, which is that of all of it,
  /// tells in what is short: the flights of a ball that comes to rest.
  bool is_coarse(const DenseStep& step, double t) const {
    const double length = t - step.from;
    return length < kEarly * (step.to - step.from) &&
           length > kShortestAgain * std::max(std::abs(t), kOfHorizon * horizon_);
  }

  /// The same flow in steps up to `last` at most.
  Went take_shorter(double last) {
    flow_->start(t_, values_, last);
    Went went = Went::on;
    while (went == Went::on && t_ < last) went = take(flow_->next());
    return Went::stopped;
  }

  void arrive(const DenseStep& step, VectorXd values) {
    record_.add(step, variables(values));
    values_ = std::move(values);
    t_ = step.to;
    if (moved_) moved_->next();
    chain_ = 0;
    turned_back_ = 0;
    starts_ = false;
    sliding_.moved(values_);
    require_range();
  }

  /// Borders that came near up to a time.
  void note(const Turns& near, double until) {
    for (const auto& [turn, reached] : near) {
      if (turn.t > until) continue;
      if (moved_) {
        record_.add(turn);
      } else if (!reached && turn.of == NearTurn::Of::when) {
        record_.note(fmt::format("t = {}: '{}' comes near without being reached", brief(turn.t, 12),
                                 turn.text));
      }
    }
  }

  /// Steps without end that hardly advance.
  void watch_progress() {
    if (t_ - slow_since_ > kSlow * horizon_) {
      slow_since_ = t_;
      slow_steps_ = 0;
    }
    if (++slow_steps_ > kMostSlowSteps)
      throw RunEnd(Ending::lost, fmt::format("the steps have become too short: {} of them for {} "
                                             "of the horizon",
                                             kMostSlowSteps, brief(kSlow)));
  }

  const EventSystem& system_;
  Movement& movement_;
  EventWatch& watch_;
  JumpMaps& maps_;
  double horizon_;
  std::optional<LastPlaces> moved_;
  DueEvents due_;
  NoiseDraws noise_;
  MeasuredRows rows_;
  Branches branches_;
  std::unique_ptr<Flow> flow_;
  EventRhythm rhythm_;
  std::vector<Index> state_rows_;
  EventStays stays_;
  EventSliding sliding_;
  VectorXd values_;  ///< variables and branches
  double t_ = 0;
  std::int64_t j_ = 0;
  std::int64_t chain_ = 0;  ///< jumps without a flow between them
  std::int64_t steps_ = 0;
  double slow_since_ = 0;
  std::int64_t slow_steps_ = 0;  ///< since then
  bool starts_ = true;           ///< no step of the flow has been taken
  int turned_back_ = 0;          ///< turns of kinks at this time
  RunRecord record_;
};

}  // namespace

EventSimulator::EventSimulator(const EventSystem& system, const EventScenario& scenario)
    : system_(&system), scenario_(&scenario), texts_(std::make_unique<Texts>(system)) {}
EventSimulator::EventSimulator(EventSimulator&&) noexcept = default;
EventSimulator& EventSimulator::operator=(EventSimulator&&) noexcept = default;
EventSimulator::~EventSimulator() = default;

Trajectory EventSimulator::run(std::uint64_t seed, std::uint64_t run, const Accuracy& accuracy,
                               const RecordLimits& limits, std::optional<std::uint64_t> moved) {
  return EventRun(*system_, *scenario_, texts_->movement, texts_->watch, texts_->maps, seed, run,
                  accuracy, limits, moved)
      .trajectory();
}

}  // namespace gainsmith::hybrid
