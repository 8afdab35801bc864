#include "hybrid/simulate.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number.h"

namespace gainsmith::hybrid {

namespace {

constexpr double kDefaultIntervals = 40;

bool within_range(const Eigen::VectorXd& x) {
  return (x.array().abs() <= kLargestState).all();  // false for a NaN
}

double read_first(const model::Formula& formula, const System& system) {
  const double first = system.scalar(formula);
  const double slack = 1e-12 * system.first_high;
  if (!(first >= system.first_low - slack && first <= system.first_high + slack))
    throw InputError(formula.place,
                     fmt::format("the first value {} of the timer is outside its range [{}, {}]",
                                 brief(first), brief(system.first_low), brief(system.first_high)));
  return std::clamp(first, system.first_low, system.first_high);
}

}  // namespace

Scenario make_scenario(const model::Design& design, const System& system) {
  const model::Design::Campaign& campaign = design.campaign;
  Scenario scenario;
  scenario.laws = make_laws(campaign, system);
  scenario.starts = make_start_rules(design, system);
  if (campaign.first) scenario.first = read_first(*campaign.first, system);
  scenario.horizon = kDefaultIntervals * system.high;
  if (campaign.horizon) {
    scenario.horizon = system.scalar(*campaign.horizon);
    if (!(scenario.horizon > 0 && std::isfinite(scenario.horizon)))
      throw InputError(campaign.horizon->place,
                       "the horizon is " + brief(scenario.horizon) + ": expected a positive time");
  }
  return scenario;
}

bool expires(double timer, double t, double horizon) {
  constexpr double kRounding = 1e-12;
  return timer <= horizon - t + kRounding * horizon;
}

double first_timer(const System& system, const Scenario& scenario, RandomStream& random) {
  if (scenario.first) return *scenario.first;
  return system.first_low + (system.first_high - system.first_low) * random.uniform();
}

FlowSteps make_steps(const System& system) {
  return {system.flow.value(), std::max(system.high, system.first_high), system.flow_place};
}

Simulator::Simulator(const System& system, const Scenario& scenario, const FlowSteps& steps)
    : system_(&system), scenario_(&scenario), steps_(&steps), starts_(scenario.starts, system) {
  if (system.affine_jump) return;
  for (const MapEntry& entry : system.jump)
    jump_entries_.emplace_back(entry.program, system.layout, system.constants);
}

Arc Simulator::run(std::uint64_t seed, std::uint64_t run) {
  RandomStream random(seed, run);
  const Law& law = scenario_->laws[run % scenario_->laws.size()];
  Arc arc;
  arc.size = system_->layout.size;
  const Eigen::VectorXd start = starts_(run, random);
  arc.append(0, 0, first_timer(*system_, *scenario_, random), start);

  for (std::size_t jumps = 0;; ++jumps) {
    const double left = scenario_->horizon - arc.t.back();
    const bool jumps_again = expires(arc.timer.back(), arc.t.back(), scenario_->horizon);
    flow(jumps_again ? arc.timer.back() : left, arc);
    if (arc.termination != Termination::horizon || !jumps_again) return arc;
    if (arc.j.back() >= scenario_->jump_limit) {
      arc.termination = Termination::jump_limit;
      return arc;
    }
    jump(arc, law.reset_value(jumps, arc.t.back(), random));
    if (arc.termination != Termination::horizon || arc.t.back() >= scenario_->horizon) return arc;
  }
}

void Simulator::flow(double interval, Arc& arc) {
  cuts_.clear();
  steps_->cut(interval, cuts_);
  const double start = arc.t.back();
  const double timer = arc.timer.back();
  double elapsed = 0;
  Eigen::VectorXd next(arc.size);
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    steps_->advance(cuts_[i], arc.state(arc.samples() - 1), next);
    elapsed = i + 1 == cuts_.size() ? interval : elapsed + cuts_[i].length;
    arc.moves.push_back({false, cuts_[i]});
    arc.append(start + elapsed, arc.j.back(), timer - elapsed, next);
    if (within_range(next)) continue;
    arc.termination = Termination::diverged;
    return;
  }
}

void Simulator::jump(Arc& arc, double reset_value) {
  const Eigen::VectorXd before = arc.state(arc.samples() - 1);
  Eigen::VectorXd after = before;
  if (system_->affine_jump) {
    after = (*system_->affine_jump)(before);
  } else {
    try {
      for (std::size_t i = 0; i < jump_entries_.size(); ++i) {
        const Slot& slot = system_->layout.slots[system_->jump[i].slot];
        after.segment(slot.offset, slot.shape.size()) = jump_entries_[i](before, 0).reshaped();
      }
    } catch (const InputError& error) {
      arc.termination = Termination::undefined;
      arc.message = error.what();
      return;
    }
  }
  arc.moves.push_back({true, {}});
  arc.append(arc.t.back(), arc.j.back() + 1, reset_value, after);
  if (!within_range(after)) arc.termination = Termination::diverged;
}

}  // namespace gainsmith::hybrid
