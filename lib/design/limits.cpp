#include "design/limits.h"

#include <algorithm>
#include <set>

#include "base/stop.h"
#include "bind/instance.h"
#include "design/elastic.h"
#include "design/synthesize.h"

namespace gainsmith::design {

namespace {

using model::Design;

/// The part of the largest price below which a multiplier is what the solver leaves of 0.
constexpr double kNothing = 1e-6;

/// The minimum of a changed problem by an ordinary synthesis.
Changed changed(const model::Instance& instance, const sdp::Options& solver) {
  check_stop();
  const model::Gains gains = synthesize(instance, solver, Depth::verdict);
  Changed result;
  if (gains.verdict != model::Verdict::yes) return result;
  result.unbounded = gains.solver.unbounded;
  result.homogeneous = !gains.objective;
  if (gains.solver.status != "optimal") return result;
  result.minimum = gains.objective;
  result.lower_bound = gains.objective_lower_bound;
  return result;
}

/// The sums of the multipliers of an inequality, in the order of their size.
Limit limit_of(const Design::Inequality& inequality, const model::Gains& gains, double scale) {
  Limit limit{inequality.name, 0, scale, {}, {}};
  for (const model::Multiplier& multiplier : gains.multipliers) {
    if (!model::is_comparison_of(multiplier.name, inequality.name)) continue;
    limit.price += multiplier.trace;
    if (multiplier.point.empty()) continue;
    const auto same =
        std::find_if(limit.points.begin(), limit.points.end(),
                     [&](const auto& point) { return point.first == multiplier.point; });
    if (same != limit.points.end())
      same->second += multiplier.trace;
    else
      limit.points.emplace_back(multiplier.point, multiplier.trace);
  }
  std::stable_sort(limit.points.begin(), limit.points.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return limit;
}

/// Whether a multiplier of the bounds on gains is more than what the solver leaves of 0.
bool bounds_cost(const Design& design, const model::Gains& gains, double largest_trace) {
  return std::any_of(
      gains.multipliers.begin(), gains.multipliers.end(), [&](const model::Multiplier& multiplier) {
        return multiplier.trace > kNothing * largest_trace &&
               std::none_of(design.inequalities.begin(), design.inequalities.end(),
                            [&](const Design::Inequality& inequality) {
                              return model::is_comparison_of(multiplier.name, inequality.name);
                            });
      });
}

/// The default stays one: a bound that is stated is meant in other units.
model::Instance with_wider_bound(const model::Instance& instance, double times) {
  return with_design(instance, [&](Design& design) {
    model::SynthesisOptions& asked = design.synthesis;
    if (asked.gain_bound_stated) return asked.set_gain_bound(times * *asked.gain_bound);
    asked.gain_bound = times * *asked.gain_bound;
  });
}

/// Neither one bound for all gains nor bounds of single gains.
model::Instance without_gain_bound(const model::Instance& instance) {
  return with_design(instance, [](Design& design) {
    design.synthesis.gain_bounds.clear();
    design.synthesis.gain_bound.reset();
  });
}

/// With these inequalities alone. Without any the objective is unbounded; where 0 is a solution of
/// those that are left, nothing constant is left.
Changed with_others(const model::Instance& instance, const std::set<std::string>& others,
                    const sdp::Options& solver) {
  Changed result;
  result.unbounded = others.empty();
  if (others.empty()) return result;
  try {
    return changed(with_inequalities(instance, others), solver);
  } catch (const InputError&) {
    // With all of them nothing was refused: what is left has the solution 0.
    result.homogeneous = true;
    return result;
  }
}

/// Kept where one of them is below what is shown of the minimum within the bounds.
void find_bounds(const model::Instance& instance, const model::Gains& gains,
                 const sdp::Options& solver, Limits& limits) {
  constexpr double kWider = 10;
  const Changed wider = changed(with_wider_bound(instance, kWider), solver);
  const Changed any = changed(without_gain_bound(instance), solver);
  const auto is_better = [&](const Changed& found) {
    return found.unbounded ||
           (found.minimum &&
            *found.minimum < gains.objective_lower_bound.value_or(*gains.objective));
  };
  if (!is_better(wider) && !is_better(any)) return;
  limits.wider_gains = wider;
  limits.any_gains = any;
}

/// With 1 % more of the scalar, or 1 % less where that is refused or leaves no minimum.
std::optional<Influence> influence(const model::Instance& instance, const std::string& name,
                                   const sdp::Options& solver) {
  constexpr double kPart = 0.01;
  const double value = instance.values.at(name)(0, 0);
  if (value == 0) return std::nullopt;
  for (const double other : {value * (1 + kPart), value * (1 - kPart)}) {
    try {
      model::Overrides overrides = instance.overrides;
      overrides[name] = other;
      const Changed found = changed(bind::evaluate(instance.design, overrides), solver);
      if (found.minimum) return Influence{name, value, other, found};
    } catch (const InputError&) {
      // An assumption excludes it, or it is a degree.
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> scalars_in_use(const Design& design) {
  std::set<std::string> used;
  const auto use = [&](const expr::Program& program) {
    for (const expr::Input& input : program.inputs) used.insert(input.name);
  };
  for (const Design::Inequality& inequality : design.inequalities) {
    for (const auto& comparison : inequality.comparisons) use(comparison.difference);
    for (const auto& variable : inequality.domain)
      for (const model::Formula& point : variable.points) use(point.program);
  }
  if (design.objective) use(design.objective->program);
  if (design.quotient) {
    use(design.quotient->numerator);
    use(design.quotient->denominator);
  }
  // Sizes, units and gains that were found are numbers in the programs.
  for (const Design::Rank& rank : design.ranks) {
    use(rank.matrix);
    if (rank.tolerance) use(*rank.tolerance);
  }
  for (const Design::Units& units : design.units) {
    use(units.A);
    use(units.C);
  }
  for (const Design::Plant& plant : design.plants) use(plant.matrix);
  for (std::size_t before = 0; before != used.size();) {
    before = used.size();
    for (const Design::Datum* datum : in_order(design))
      if (datum->value && used.contains(datum->name)) use(datum->value->program);
  }
  std::vector<std::string> names;
  for (const std::string& name : model::scalar_names(design))
    if (used.contains(name)) names.push_back(name);
  return names;
}

Limits find_limits(const model::Instance& instance, const model::Gains& gains,
                   const sdp::Options& solver) {
  Limits limits;
  const Design& design = *instance.design;
  const ByInequality scales = scales_of(without_gains(instance));
  std::vector<Limit> all;
  double largest = 0;
  double largest_trace = 0;
  for (const Design::Inequality& inequality : design.inequalities) {
    all.push_back(limit_of(inequality, gains, scales.at(inequality.name)));
    largest = std::max(largest, all.back().price * all.back().scale);
    largest_trace = std::max(largest_trace, all.back().price);
  }
  for (const model::Multiplier& multiplier : gains.multipliers)
    largest_trace = std::max(largest_trace, multiplier.trace);
  for (Limit& limit : all)
    if (limit.price * limit.scale > kNothing * largest)
      limits.active.push_back(std::move(limit));
    else
      limits.inactive.push_back(limit.name);
  try {
    for (Limit& limit : limits.active) {
      std::set<std::string> others;
      for (const Design::Inequality& inequality : design.inequalities)
        if (inequality.name != limit.name) others.insert(inequality.name);
      limit.without = with_others(instance, others, solver);
      // It is no worse than with all of them, however roughly the solver finds it.
      // A minimum over fewer inequalities is at most that over all.
      if (limit.without->minimum)
        limit.without->minimum = std::min(*limit.without->minimum, *gains.objective);
    }
    if (bounds_cost(design, gains, largest_trace)) find_bounds(instance, gains, solver, limits);
    for (const std::string& name : scalars_in_use(design))
      if (const auto found = influence(instance, name, solver)) limits.scalars.push_back(*found);
  } catch (const Stopped&) {
    // What was found before stays.
  }
  return limits;
}

}  // namespace gainsmith::design
