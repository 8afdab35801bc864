#include "design/explain.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/named.h"
#include "base/stop.h"
#include "bind/instance.h"
#include "design/bisect.h"
#include "design/elastic.h"
#include "design/excluded_inequalities.h"
#include "design/sos_statements.h"
#include "design/synthesize.h"
#include "lmi/compile.h"
#include "lmi/formulation.h"

namespace gainsmith::design {

namespace {

/// Whether nothing keeps all unknowns from being 0.
bool holds_at_zero(const model::Instance& instance) {
  if (instance.design->inequalities.empty()) return true;
  const lmi::Inequalities inequalities(instance);
  if (has_sums_of_squares(*instance.design)) return hold_at_zero(sos_statements(inequalities));
  const lmi::Lmi lmi = lmi::compile(inequalities);
  return lmi::is_homogeneous(lmi.blocks) && std::ranges::none_of(lmi.blocks, &lmi::Block::strict);
}

/// Names, the last inequality first.
std::vector<std::string> in_reverse(const std::vector<model::Design::Inequality>& inequalities) {
  std::vector<std::string> names;
  for (auto at = inequalities.rbegin(); at != inequalities.rend(); ++at) names.push_back(at->name);
  return names;
}

/// Whether the requirements named hold together: with the objective, which leads to solutions of
/// the problem's own size, and where that is not decided (it may be unbounded) without it.
/// Undecided when it is stopped.
model::Gains subset(const model::Instance& instance, const std::set<std::string>& names,
                    const sdp::Options& solver) {
  model::Gains gains;
  try {
    const model::Instance part = with_inequalities(instance, names);
    if (holds_at_zero(part)) {
      gains.verdict = model::Verdict::yes;
      return gains;
    }
    gains = synthesize(part, solver, Depth::verdict);
    if (gains.verdict == model::Verdict::undecided && part.design->objective)
      gains = synthesize(without_objective(part), solver, Depth::verdict);
  } catch (const Stopped&) {
    gains.verdict = model::Verdict::undecided;
  }
  return gains;
}

/// Whether the solver in double finds no point of the requirements named.
bool seems_infeasible(const model::Instance& instance, const std::set<std::string>& names,
                      const sdp::Options& solver) {
  constexpr double kNone = 1e-8;  // of the largest margin
  const model::Instance part = with_inequalities(instance, names);
  if (holds_at_zero(part)) return false;
  if (has_sums_of_squares(*part.design))
    return synthesize(part, solver, Depth::verdict).verdict == model::Verdict::no;
  const lmi::Inequalities inequalities(part);
  const lmi::Lmi lmi = lmi::compile(inequalities);
  sdp::Options narrow = solver;
  narrow.precision = "double";
  const sdp::Solution solution = sdp::solve(lmi::formulate_interior(lmi, {}, {}).problem, narrow);
  return !solution.x.empty() && lmi::interior_margin(solution) <= kNone;
}

/// Those of `names` that the solver in double does not find to be too many, as far as the allowance
/// goes; `open` receives those that it did not get to.
std::set<std::string> guessed(const model::Instance& instance, std::set<std::string> names,
                              const sdp::Options& solver, double seconds,
                              std::vector<std::string>& open) {
  const std::vector<std::string> order = in_reverse(instance.design->inequalities);
  std::size_t at = 0;
  try {
    const Allowance limit(seconds);
    for (; at < order.size(); ++at) {
      std::set<std::string> rest = names;
      rest.erase(order[at]);
      if (seems_infeasible(instance, rest, solver)) names = std::move(rest);
    }
  } catch (const OutOfAllowance&) {
    open.assign(order.begin() + static_cast<std::ptrdiff_t>(at), order.end());
  }
  return names;
}

/// That the requirements named have no solution, where the allowance suffices to find it.
std::optional<model::CertificateRecord> certificate_against(const model::Instance& instance,
                                                            const std::set<std::string>& names,
                                                            const sdp::Options& solver,
                                                            double seconds) {
  try {
    const Allowance limit(seconds);
    const model::Gains gains = subset(instance, names, solver);
    if (gains.verdict == model::Verdict::no) return gains.certificate.value();
  } catch (const OutOfAllowance&) {
    // Nothing is known.
  }
  return std::nullopt;
}

std::vector<std::string> in_order(const model::Design& design, const std::set<std::string>& names) {
  std::vector<std::string> result;
  for (const model::Design::Inequality& inequality : design.inequalities)
    if (names.contains(inequality.name)) result.push_back(inequality.name);
  return result;
}

std::set<std::string> all_names(const model::Design& design) {
  std::set<std::string> names;
  for (const model::Design::Inequality& inequality : design.inequalities)
    names.insert(inequality.name);
  return names;
}

/// For each inequality the smallest slack when it alone is relaxed, and its slack in the smallest
/// sum of all. Appends to `relaxations`, which keep what was found when it is stopped.
void find_relaxations(const model::Instance& instance, const sdp::Options& solver,
                      std::vector<Relaxation>& relaxations) {
  const model::Instance plain = without_gains(instance);
  const auto scales = scales_of(plain);
  const Slacks together = smallest_slacks(plain, scales, solver);
  for (const model::Design::Inequality& inequality : instance.design->inequalities) {
    const std::string& name = inequality.name;
    Relaxation relaxation;
    relaxation.name = name;
    relaxation.scale = scales.at(name);
    if (together.verdict == model::Verdict::yes)
      relaxation.together = together.by_inequality.at(name);
    relaxation.together_at_most = !together.smallest;
    check_stop();
    const Slacks alone = smallest_slacks(plain, {{name, scales.at(name)}}, solver);
    if (alone.verdict == model::Verdict::yes) relaxation.alone = alone.by_inequality.at(name);
    relaxation.alone_at_most = !alone.smallest;
    relaxation.alone_undecided = alone.verdict == model::Verdict::undecided;
    relaxations.push_back(std::move(relaxation));
  }
}

/// The reach in one direction, within the range.
/// It is the bracket of a bisection with a tenth of the default tolerance.
Reach reach(const model::Instance& instance, const SearchedScalar& scalar, double value,
            bool at_most, const sdp::Options& solver) {
  // A fine bracket: the number is what people remember.
  constexpr double kFine = 0.1;
  Reach found{scalar.name, value, at_most, {}, {}, {}};
  found.end = at_most ? scalar.axis.high : scalar.axis.low;
  try {
    const BisectResult result =
        bisect(instance, {}, {scalar, at_most, default_tolerance(scalar.axis) * kFine, {}}, solver);
    check_stop();
    found.feasible = result.found.yes;
    found.beyond = result.found.no;
    if (result.found.open) found.open = result.found.open->near_yes;
    if (found.beyond) found.certificate = result.gains.search->certificate;
  } catch (const InputError&) {
    // The assumptions refuse the whole side: nothing there is feasible.
  }
  return found;
}

/// In both directions along a scalar: towards what is feasible, or where its own value `holds` as
/// far as it stays so.
std::vector<Reach> reaches_along(const model::Instance& instance, const model::Range& range,
                                 bool holds, const sdp::Options& solver) {
  std::vector<Reach> reaches;
  const SearchedScalar whole = searched_scalar(instance, range);
  const double value = model::scalar_named(instance, range.name).value_or(whole.axis.high);
  for (const bool at_most : {true, false}) {
    SearchedScalar side = whole;
    if (at_most == holds)
      side.axis.low = std::max(value, whole.axis.low);
    else
      side.axis.high = std::min(value, whole.axis.high);
    if (!(side.axis.low < side.axis.high)) continue;
    const Reach found = reach(instance, side, value, at_most, solver);
    if (found.feasible) reaches.push_back(found);
  }
  if (reaches.empty() && !holds) reaches.push_back({range.name, value, true, {}, {}, {}});
  return reaches;
}

/// What excludes more of the scalar than the reach says, a little further out.
void find_what_stops(const model::Instance& instance, const sdp::Options& solver, Reach& reach) {
  constexpr double kFurther = 0.01;  // of the distance to the end of the range
  // One hundredth of what is left of the range beyond the bracket.
  const double limit = reach.beyond.value_or(*reach.feasible);
  if (limit == reach.end) return;
  reach.conflict_at = limit + kFurther * (reach.end - limit);
  model::Overrides overrides = instance.overrides;
  overrides[reach.name] = reach.conflict_at;
  try {
    const model::Instance there = bind::evaluate(instance.design, overrides);
    const model::Gains gains = synthesize(there, solver, Depth::verdict);
    reach.conflict = find_conflict(there, gains, solver);
    if (gains.bound_only) reach.conflict.emplace().gain_bound = true;
  } catch (const InputError&) {
    // The assumptions refuse it.
  }
}

/// The smallest bound on gains that is found to be enough, from that which is not up to what gains
/// without it need; none where it is not the bound that excludes them.
std::optional<Reach> sufficient_gain_bound(const model::Instance& instance,
                                           const Explanation& explanation,
                                           const sdp::Options& solver) {
  constexpr double kMost = 1e6;  // times the bound
  constexpr double kRoom = 1.001;
  const auto& needed = explanation.gains.bound_only;
  const auto& conflict = explanation.conflict;
  if (!needed && !(conflict && conflict->gain_bound)) return std::nullopt;
  const double bound = instance.design->synthesis.gain_bound.value();
  const double largest = needed && std::isfinite(*needed) ? kRoom * *needed : kMost * bound;
  if (!(bound < largest)) return std::nullopt;
  Reach found = reach(instance, {"gain_bound", search::axis(bound, largest)}, bound, false, solver);
  if (!found.feasible) return std::nullopt;
  return found;
}

}  // namespace

std::optional<Conflict> find_conflict(const model::Instance& instance, const model::Gains& gains,
                                      const sdp::Options& solver) {
  if (gains.verdict != model::Verdict::no) return std::nullopt;
  const model::Design& design = *instance.design;
  const model::Instance plain = without_gains(instance);
  std::set<std::string> names = all_names(design);
  Conflict conflict;
  const bool is_certified = gains.certificate && gains.certificate->is_about_problem();
  model::Gains certified = is_certified ? gains : subset(plain, names, solver);
  if (certified.verdict != model::Verdict::no) {
    // The inequalities alone are not excluded: the bound on gains is the conflict, or part of it.
    const bool bounded = design.synthesis.gain_bound && !design.gains.empty();
    conflict.gain_bound = bounded && certified.verdict == model::Verdict::yes;
    conflict.within_gain_bound = bounded && !conflict.gain_bound;
    conflict.certificate = gains.certificate.value();
    conflict.names = in_order(design, names);
    if (!conflict.gain_bound) conflict.undecided = conflict.names;
    return conflict;
  }
  // Later inequalities often imply earlier, simpler ones; those are what is kept.
  // The deletion filter (Chinneck & Dravnieks 1991), which needs one synthesis an inequality and
  // leaves an irreducible set where every synthesis decides.
  for (const std::string& name : in_reverse(design.inequalities)) {
    names.erase(name);
    model::Gains rest = subset(plain, names, solver);
    if (rest.verdict == model::Verdict::no) {
      certified = std::move(rest);
      continue;
    }
    names.insert(name);
    if (rest.verdict == model::Verdict::undecided) conflict.undecided.push_back(name);
  }
  conflict.names = in_order(design, names);
  conflict.certificate = certified.certificate.value();
  return conflict;
}

std::optional<Conflict> guess_conflict(const model::Instance& instance, const model::Gains& gains,
                                       const sdp::Options& solver, double seconds) {
  if (gains.verdict != model::Verdict::no) return std::nullopt;
  // What only a bound or a hull excludes is handled separately.
  if (!gains.certificate || !gains.certificate->is_about_problem())
    return find_conflict(instance, gains, solver);
  const model::Design& design = *instance.design;
  const model::Instance plain = without_gains(instance);
  Conflict conflict;
  conflict.certificate = *gains.certificate;
  const std::set<std::string> all = all_names(design);
  const std::set<std::string> few = guessed(plain, all, solver, seconds, conflict.undecided);
  bool excluded = few == all;
  if (!excluded) {
    if (const auto certificate = certificate_against(plain, few, solver, seconds)) {
      conflict.certificate = *certificate;
      excluded = true;
    }
  }
  conflict.names = in_order(design, excluded ? few : all);
  if (!excluded) conflict.undecided = conflict.names;
  std::erase_if(conflict.undecided, [&](const std::string& name) {
    return std::find(conflict.names.begin(), conflict.names.end(), name) == conflict.names.end();
  });
  return conflict;
}

/// Two bisections a scalar, one for each side of the problem's value.
std::vector<Reach> find_reaches(const model::Instance& instance, const sdp::Options& solver) {
  std::vector<Reach> reaches;
  try {
    for (const model::Range& range : instance.design->negotiable) {
      const std::vector<Reach> found = reaches_along(instance, range, false, solver);
      reaches.insert(reaches.end(), found.begin(), found.end());
    }
  } catch (const Stopped&) {
    // Of those that it reached nothing is known.
  }
  return reaches;
}

std::vector<Reach> find_room(const model::Instance& instance, const sdp::Options& solver) {
  const model::Design& design = *instance.design;
  std::vector<Reach> reaches;
  const auto add = [&](const model::Range& range, std::optional<bool> at_most) {
    for (Reach& found : reaches_along(instance, range, true, solver)) {
      if (at_most && found.at_most != *at_most) continue;
      find_what_stops(instance, solver, found);
      reaches.push_back(std::move(found));
    }
  };
  try {
    for (const model::Range& range : design.negotiable) add(range, {});
    const auto is_negotiable = [&](const std::string& name) {
      return has_named(design.negotiable, name);
    };
    if (design.search && design.search->extreme && !is_negotiable(design.search->extreme->name))
      add(*design.search->extreme, design.search->largest);
  } catch (const Stopped&) {
    // Of those that it reached nothing is known.
  }
  return reaches;
}

Explanation explain(const model::Instance& instance, const sdp::Options& solver) {
  Explanation explanation;
  explanation.gains = synthesize(instance, solver);
  explanation.held = held_scalars(instance);
  if (explanation.gains.verdict != model::Verdict::yes && !explanation.held.empty())
    if (const auto found = excluded_inequalities(instance, request_of(instance), solver))
      return explain(found->inequalities, solver);
  try {
    if (explanation.gains.verdict == model::Verdict::yes) {
      if (!explanation.gains.multipliers.empty())
        explanation.limits = find_limits(instance, explanation.gains, solver);
      explanation.reaches = find_room(instance, solver);
    } else {
      explanation.conflict = find_conflict(instance, explanation.gains, solver);
      if (explanation.conflict && !explanation.conflict->gain_bound)
        find_relaxations(instance, solver, explanation.relaxations);
      explanation.reaches = find_reaches(instance, solver);
      const bool is_found = std::ranges::any_of(explanation.reaches, [](const Reach& reach) {
        return reach.name == "gain_bound" && reach.feasible;
      });
      if (!is_found)
        if (const auto bound = sufficient_gain_bound(instance, explanation, solver))
          explanation.reaches.insert(explanation.reaches.begin(), *bound);
    }
  } catch (const Stopped&) {
    // What was found before stays.
  }
  explanation.finished = !is_stopping();
  return explanation;
}

}  // namespace gainsmith::design
