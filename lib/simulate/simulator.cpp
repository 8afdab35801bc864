#include "simulate/simulator.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/number.h"
#include "base/stop.h"
#include "hybrid/zeno.h"
#include "ode/integrator.h"
#include "ode/tolerances.h"
#include "simulate/branches.h"
#include "simulate/due_events.h"
#include "simulate/event_watch.h"
#include "simulate/flow_sets.h"
#include "simulate/jump_maps.h"
#include "simulate/measured_rows.h"
#include "simulate/run_record.h"
#include "simulate/sliding.h"
#include "simulate/tolerances.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::VectorXd;
using VariableKind = model::Dynamics::VariableKind;

/// What is compiled once for all runs.
struct Simulator::Texts {
  explicit Texts(const hybrid::System& system) : field(system), watch(system), maps(system) {}
  VectorField field;
  EventWatch watch;
  JumpMaps maps;
  std::unique_ptr<State31> state_31;  ///< made when it is asked for
};

namespace {

/// One run: the state t, j, values, and what its parts remember.
class EventRun {
 public:
  EventRun(const hybrid::System& system, const hybrid::Scenario& scenario, VectorField& field,
           EventWatch& watch, JumpMaps& maps, std::uint64_t seed, std::uint64_t run,
           const Accuracy& accuracy, const RecordLimits& limits, std::optional<std::uint64_t> moved,
           State31* state)
      : system_(system),
        run_(run),
        state_(state),
        field_(field),
        watch_(watch),
        maps_(maps),
        horizon_(scenario.horizon),
        moved_(moved ? std::optional<LastPlaces>(std::in_place, seed, run, *moved) : std::nullopt),
        due_(system, watch, hybrid::EventClocks(system, scenario, seed, run), scenario.horizon),
        noise_(system, scenario, seed, run),
        rows_(system),
        branches_(system, watch, accuracy),
        flow_(state != nullptr
                  ? flow_31(field, *state, system.longest_step() * scenario.horizon,
                            moved ? kShareOfTwin : 1)
                  : make_flow(field, accuracy, system.longest_step() * scenario.horizon, places())),
        zeno_(system, scenario.horizon),
        flow_sets_(watch),
        sliding_(system, watch, accuracy, scenario.horizon),
        record_(system, scenario.horizon, limits) {
    values_ = hybrid::draw_start(system, scenario, seed, run);
  }

  hybrid::Trajectory trajectory() {
    try {
      begin();
      while (true) {
        instant();
        if (t_ >= horizon_) break;
        flow();
      }
    } catch (const RunEnd& end) {
      record_.ends(end.ending, end.what(), t_, j_);
    } catch (const ode::IntegrationError& error) {
      const hybrid::Ending ending = error.escaped     ? hybrid::Ending::escaped
                                    : error.undefined ? hybrid::Ending::undefined
                                                      : hybrid::Ending::lost;
      record_.ends(ending, error.what(), t_, j_);
    } catch (const expr::EvaluationError& error) {
      record_.ends(hybrid::Ending::undefined, error.what(), t_, j_);
    } catch (const Stopped&) {
      record_.ends(hybrid::Ending::interrupted, "interrupted", t_, j_);
    }
    return record_.take(t_);
  }

 private:
  enum class Went { on, stopped };
  /// In 31 digits: steps of other lengths have other errors.
  static constexpr double kShareOfTwin = 0.8;
  using NearTurns = std::vector<std::pair<hybrid::NearTurn, bool>>;

  // --- The start and the end. ---

  /// t = 0, j = 0: noise, rows, clocks and branches at the start.
  void begin() {
    field_.reset();
    for (std::size_t k = 0; k < system_.noise.size(); ++k) noise_.draw(k, values_);
    rows_.begin(values_);
    due_.begin(values_, field_);
    field_.fill_clocks(0, values_);
    branches_.update(values_);
    if (state_ != nullptr) state_->begin(run_, values_, due_.clocks(), places());
    record_.start(variables(values_));
    require_range();
  }

  const LastPlaces* places() const { return moved_ ? &*moved_ : nullptr; }

  VectorXd variables(const VectorXd& values) const { return values.head(system_.size); }

  /// RunEnd where a variable is beyond kLargestState or no number.
  void require_range() const {
    for (Index k = 0; k < system_.size; ++k)
      if (!(std::abs(values_(k)) <= hybrid::kLargestState))
        throw RunEnd(hybrid::Ending::escaped,
                     fmt::format("{} = {}", system_.element_name(k), brief(values_(k))));
  }

  // --- Instants. ---

  /// Jumps, one after the other, until no event is due. Which flow sets hold is noted for the flow.
  void instant() {
    while (const auto event = due_.first(values_, t_)) occurrence(*event);
    flow_sets_.begin(values_);
  }

  /// Draws the noise of the event; then `if` decides between a jump and a spent occurrence.
  void occurrence(std::size_t event) {
    const auto& noise = system_.dynamics.noise;
    for (std::size_t k = 0; k < noise.size(); ++k)
      if (noise[k].event == event) noise_.draw(k, values_);
    const bool goes = !watch_.only_if[event] || (*watch_.only_if[event])(values_);
    if (goes) {
      jump(event);
    } else {
      due_.spend(event, t_, field_);
      field_.fill_clocks(t_, values_);
    }
    branches_.update(values_);
  }

  /// x+ = g(x) at t, j + 1. Clocks and marks follow; the record takes the values before and after.
  void jump(std::size_t event) {
    check_stop();
    if (chain_ == 0) watch_zeno(event);
    sliding_.jumped();
    slow_steps_ = 0;
    if (state_ != nullptr) meet(event);
    const VectorXd before = values_;
    const bool lost = system_.dynamics.events[event].lost > 0 && due_.clocks().loses(event);
    values_ = maps_(event, lost, before, places(), state_);
    record_.flow_ends();
    due_.spend(event, t_, field_);
    field_.set_clock(model::Dynamics::VariableKind::since, event, t_);
    field_.fill_clocks(t_, values_);
    due_.jumped(event, before, values_);
    if (state_ != nullptr) state_->jumped(event, maps_.in_31_digits(), due_.clocks());
    record_.add(hybrid::JumpPoint{t_, j_, event, lost, variables(before), variables(values_),
                                  moved_ ? maps_.terms() : VectorXd()});
    ++j_;
    require_range();
    if (++chain_ >= hybrid::kMost) end_chain(event);
  }

  /// To the time of the event in 31 digits.
  void meet(std::size_t event) {
    state_->adopt(values_);
    const bool by_flow = chain_ == 0 && t_ > 0;
    state_->meet(event, watch_, values_, due_.clocks(), by_flow);
    round_state();
  }

  /// The double values are those of 31 digits, also where the flow ends.
  void round_state() {
    values_.head(system_.size) = rounded(state_->values()).head(system_.size);
    record_.ended_at(variables(values_));
  }

  /// RunEnd that names the events and the condition that stays true.
  [[noreturn]] void end_chain(std::size_t event) {
    const std::string names = record_.last_events();
    record_.shorten_chain(hybrid::kMost);
    const auto next = due_.first(values_, t_);
    const std::size_t due = next.value_or(event);
    const model::Dynamics::Event& one = system_.dynamics.events[due];
    std::string value;
    if (watch_.when[due])
      value = fmt::format(" ('{}' is true, {})", watch_.when[due]->text(),
                          watch_.when[due]->differences(values_));
    const char* const cure = watch_.when[due] && due == event
                                 ? "; its own jump leaves the condition true: add a part that the "
                                   "jump makes false, such "
                                   "as the sign of a velocity"
                                 : "";
    throw RunEnd(
        hybrid::Ending::stuck,
        fmt::format("{} jumps without a flow between them, of {}: then the event {} is due "
                    "again{}; the first {} of them are kept{}",
                    hybrid::kMost, names, one.name, value, RunRecord::kept_of_chain, cure));
  }

  /// RunEnd where the flow that this event ends is one of flows that accumulate or chatter.
  void watch_zeno(std::size_t event) {
    const hybrid::FlowPiece& flow = record_.flow();
    if (flow.steps.empty()) return;
    VectorXd largest = VectorXd::Zero(system_.size);
    for (const hybrid::DenseStep& step : flow.steps)
      largest = largest.cwiseMax(step.coefficients.cwiseAbs().rowwise().sum().head(system_.size));
    zeno_.push(t_, flow.to() - flow.from(), event, values_, largest);
    const double part = zeno_.shrinkage() * zeno_.shrinkage();
    flow_->sharpen(part);
    branches_.sharpen(part);
    std::string names;
    for (const std::size_t one : zeno_.events())
      names += (names.empty() ? "" : ", ") + system_.dynamics.events[one].name;
    if (const auto accumulation = zeno_.accumulation()) {
      record_.accumulates(*accumulation);
      throw RunEnd(hybrid::Ending::zeno,
                   fmt::format("the flows between the jumps of {} shrink by a steady factor; they "
                               "accumulate at t = {}",
                               names, brief(*accumulation, 12)));
    }
    if (zeno_.chatters())
      throw RunEnd(hybrid::Ending::chattering,
                   "flows of hardly any length between the jumps of " + names);
  }

  // --- Flows. ---

  /// One flow from t up to the first of horizon, clock, noise, row and line, or to an event before.
  void flow() {
    if (rows_.leave(t_, values_)) {
      if (state_ != nullptr) state_->adopt_given(values_, false);
      branches_.update(values_);
      if (due_.first(values_, t_)) return;  // by the last of several rows at t
    }
    branches_.update_kinks(values_);
    double stop = std::min({horizon_, due_.clocks().next(), noise_.next(), rows_.next()});
    field_.begin(t_, values_);
    stop = watch_.next_line(field_, t_, stop, values_);
    record_.flow_begins(j_, variables(values_));
    starts_ = true;
    // A flow may end about as soon as the one before: then its steps are not too long for it.
    const double from = t_;
    const double early = t_ + kShorterStep * last_flow_;
    const bool is_split = system_.affine && t_ < early && early < stop;
    if (!is_split || go(early) == Went::on) go(stop);
    last_flow_ = t_ - from;
    const bool drawn = noise_.draw_due(t_, values_);
    if (rows_.arrive(t_, values_) || drawn) {
      branches_.update(values_);
      if (state_ != nullptr) state_->adopt_given(values_, true);
    }
  }

  /// Steps up to `last` at most.
  Went go(double last) {
    flow_->start(t_, values_, last);
    Went went = Went::on;
    while (went == Went::on && t_ < last) {
      check_stop();
      if (++steps_ > hybrid::kMost)
        throw RunEnd(hybrid::Ending::lost, fmt::format("more than {} steps", hybrid::kMost));
      watch_progress();
      went = take(flow_->next());
    }
    return went;
  }

  /// Goes along a step up to where something happens. A kink that changes at its start again
  /// and again does not matter.
  Went take(const hybrid::DenseStep& whole) {
    const auto change = branches_.first_change(StepValues(field_, values_, whole), values_);
    const bool back = change && change->t == whole.from;
    if (back && (!branches_.is_kink(change->branch) || ++changed_back_ < hybrid::kAtOnce)) {
      change_branch(*change);
      return Went::stopped;
    }
    const bool changes = change && change->t > whole.from;
    const Went went =
        along(changes && change->t < whole.to ? field_.until(whole, change->t) : whole);
    if (!changes || t_ != change->t) return went;
    change_branch(*change);
    return Went::stopped;
  }

  void change_branch(const Branches::Change& change) {
    // At a kink both branches are the same.
    const bool jumps = state_ != nullptr && !branches_.is_kink(change.branch);
    if (jumps) state_->meet_switch(change.branch, change.element - branches_.offset(change.branch));
    values_(change.element) = change.to;
    if (!branches_.is_kink(change.branch)) sliding_.switched(change.branch, t_, values_);
  }

  /// The same of a step on which no branch changes.
  Went along(const hybrid::DenseStep& step) {
    const StepValues inside(field_, values_, step);
    flow_sets_.require_inside(inside,
                              std::min(inside.to(), inside.from() + hybrid::kHardly * horizon_));
    NearTurns near;
    double left_zero = step.from;
    std::optional<double> hidden;
    const auto crossings = watch_.crossings(
        inside, values_, moved_ ? kNearOfTerms : 0,
        [&](const hybrid::NearTurn& turn, bool reached) { near.emplace_back(turn, reached); },
        left_zero, starts_ ? &hidden : nullptr);
    constexpr double beyond = 4;  // of the turning point, so that the root behind it is inside
    if (hidden && is_coarse(step, step.from + *hidden * (step.to - step.from)))
      return take_shorter(step.from + beyond * *hidden * (step.to - step.from));
    const std::vector<DueEvents::Mark> marks = due_.marks();
    const FlowSets::Marks was_inside = flow_sets_.marks();
    for (const double t : crossings) {
      VectorXd values = inside.at(t);
      const bool due = due_.first(values, t).has_value();
      const bool left = !due && flow_sets_.leaves(values);
      if (!due && !left) continue;
      if (t > left_zero && is_coarse(step, t)) {
        due_.set_marks(marks);
        flow_sets_.set_marks(was_inside);
        return take_shorter(step.from + kShorterStep * (t - step.from));
      }
      note(near, t);
      arrive(t < step.to ? field_.until(step, t) : step, std::move(values));
      if (left) flow_sets_.leave_first(values_);
      return Went::stopped;
    }
    note(near, step.to);
    arrive(step, inside.at(step.to));
    if (state_ != nullptr) round_state();
    if (flow_sets_.leaves(values_)) flow_sets_.leave_first(values_);
    return due_.first(values_, t_) ? Went::stopped : Went::on;
  }

  /// Whether something happens so early in a step that its rounding, which is that of all of it,
  /// tells in what is short: the flights of a ball that comes to rest.
  bool is_coarse(const hybrid::DenseStep& step, double t) const {
    const double length = t - step.from;
    return length < kEarly * (step.to - step.from) &&
           length > ode::kFinest * std::max(std::abs(t), hybrid::kHardly * horizon_);
  }

  /// The same flow in steps up to `last` at most.
  Went take_shorter(double last) {
    go(last);
    return Went::stopped;
  }

  void arrive(const hybrid::DenseStep& step, VectorXd values) {
    record_.add(step, variables(values));
    values_ = std::move(values);
    t_ = step.to;
    flow_->arrive(t_);
    if (moved_) moved_->next();
    chain_ = 0;
    changed_back_ = 0;
    starts_ = false;
    sliding_.moved(values_);
    require_range();
  }

  /// What came near to zero up to a time.
  void note(const NearTurns& near, double until) {
    for (const auto& [turn, reached] : near) {
      if (turn.t > until) continue;
      if (moved_) {
        record_.add(turn);
      } else if (!reached && turn.of == hybrid::NearTurn::Of::when) {
        record_.note(fmt::format("t = {}: '{}' comes near without being reached", brief(turn.t, 12),
                                 turn.text));
      }
    }
  }

  /// Steps of a flow without end that hardly advance.
  void watch_progress() {
    if (t_ - slow_since_ > hybrid::kSlow * t_) {
      slow_since_ = t_;
      slow_steps_ = 0;
    }
    if (++slow_steps_ > ode::kPatience)
      throw RunEnd(hybrid::Ending::lost,
                   fmt::format("the steps have become too short: {} of them for {} "
                               "of the time so far",
                               ode::kPatience, brief(hybrid::kSlow)));
  }

  const hybrid::System& system_;
  std::uint64_t run_;
  State31* state_;  ///< of a run in 31 digits
  VectorField& field_;
  EventWatch& watch_;
  JumpMaps& maps_;
  double horizon_;
  std::optional<LastPlaces> moved_;
  DueEvents due_;
  hybrid::NoiseDraws noise_;
  MeasuredRows rows_;
  Branches branches_;
  std::unique_ptr<Flow> flow_;
  hybrid::ZenoDetector zeno_;
  FlowSets flow_sets_;
  SlidingDetector sliding_;
  VectorXd values_;  ///< variables and branches
  double t_ = 0;
  double last_flow_ = 0;  ///< its length
  std::int64_t j_ = 0;
  std::int64_t chain_ = 0;  ///< jumps without a flow between them
  std::int64_t steps_ = 0;
  double slow_since_ = 0;
  std::int64_t slow_steps_ = 0;   ///< since then
  bool starts_ = true;            ///< no step of the flow has been taken
  std::size_t changed_back_ = 0;  ///< changes of kinks at this time
  RunRecord record_;
};

}  // namespace

Simulator::Simulator(const hybrid::System& system, const hybrid::Scenario& scenario)
    : system_(&system), scenario_(&scenario), texts_(std::make_unique<Texts>(system)) {}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

hybrid::Trajectory Simulator::run(std::uint64_t seed, std::uint64_t run, const Accuracy& accuracy,
                                  const RecordLimits& limits, std::optional<std::uint64_t> moved) {
  if (accuracy.in_31_digits && texts_->state_31 == nullptr)
    texts_->state_31 = std::make_unique<State31>(*system_, *scenario_);
  return EventRun(*system_, *scenario_, texts_->field, texts_->watch, texts_->maps, seed, run,
                  accuracy, limits, moved, accuracy.in_31_digits ? texts_->state_31.get() : nullptr)
      .trajectory();
}

}  // namespace gainsmith::simulate
