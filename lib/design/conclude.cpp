// What the attempts of a synthesis mean together.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "base/number.h"
#include "base/scalars.h"
#include "design/attempts.h"
#include "verdict/weak_duality.h"

namespace gainsmith::design {

namespace {

/// Status, cause and errors of the solver. The DIMACS error 3 is the infeasibility of the program
/// in x, error 1 that of its dual in Y (sdp/solution.h).
model::SolverRecord record_of(const Attempt& attempt, bool has_objective) {
  const sdp::Solution& solution = attempt.solution;
  model::SolverRecord record;
  // Without an objective every point that holds is as good as another.
  const bool solved = attempt.is_optimal() || solution.cause == sdp::Cause::enough;
  record.status = attempt.refuted() ? "infeasible" : solved ? "optimal" : "undecided";
  // A point that came from inside is no minimum.
  if (has_objective && record.status == "optimal" && attempt.question.goal != lmi::Goal::objective)
    record.status = "feasible";
  record.cause = to_string(solution.cause);
  record.iterations = solution.iterations;
  record.relative_gap = solution.relative_gap;
  record.primal_infeasibility = solution.dimacs[2];
  record.dual_infeasibility = solution.dimacs[0];
  record.precision = solution.precision;
  return record;
}

/// What a point that holds has less than was wished for.
void note_wishes(const Attempt& point, model::Gains& gains) {
  // A minimum lies on the boundary, where nothing is left of a margin.
  if (point.question.goal == lmi::Goal::objective) return;
  std::string small;
  for (const model::Margin& margin : point.margins.margins)
    if (margin.is_far_below())
      small += (small.empty() ? "" : ", ") + margin.name + " " + brief(margin.reached, 2) +
               " instead of " + brief(margin.required, 2);
  if (!small.empty())
    gains.solver.add_message(
        "every inequality holds, but with less margin than asked for (" + small +
        "): the gains are proved for these data, and leave little room for others");
}

/// What a point that does not hold falls short of.
void note_failures(const Attempt& point, model::Gains& gains) {
  std::string violated, open;
  for (const model::Margin& margin : point.margins.margins) {
    if (margin.holds) continue;
    std::string& list = margin.fails ? violated : open;
    list += (list.empty() ? "" : ", ") + margin.name + " (margin " + brief(margin.reached, 2) +
            (margin.worst_point.empty() ? "" : " at " + margin.worst_point) + ")";
  }
  if (!violated.empty()) gains.solver.add_message("the best point found violates " + violated);
  if (!open.empty())
    gains.solver.add_message("the best point found is not shown to satisfy " + open);
  if (!point.margins.open.empty()) gains.solver.add_message("for all values " + point.margins.open);
}

/// A gain that the objective does not determine is limited by its bound alone, wherever between
/// them the solver stops: with a bound ten times smaller the objective stays and the gain shrinks.
void mark_free_gains(const Attempt& tighter, const lmi::Lmi& lmi, model::Gains& gains) {
  // Relative: to the bound, to the objective, and to the gain under the larger bound.
  constexpr double kNear = 0.01;
  constexpr double kSameObjective = 1e-6;
  constexpr double kShrunk = 0.5;
  if (!tighter.is_optimal() || !tighter.point) return;
  if (std::abs(lmi.objective_at(tighter.x) - *gains.objective) >
      kSameObjective * std::abs(*gains.objective))
    return;
  const auto reached = lmi::reached_bounds(tighter.question.bounds, tighter.x);
  for (std::size_t i = 0; i < reached.size(); ++i) {
    model::GainBound& bound = gains.bounds[i];
    bound.active |=
        bound.reached > kNear * bound.bound && reached[i].reached < kShrunk * bound.reached;
  }
}

/// "flow at i = 1, tau = 0.7683593750000002": with the numbers of its point in all decimals.
/// A reader of a certificate evaluates the block at this point, so no decimal may be missing.
std::string name_of(const lmi::Block& block) {
  std::string name = block.name;
  std::string_view rest = block.point;
  for (const char* mark = " at "; !rest.empty(); mark = ", ") {
    const std::string_view part = rest.substr(0, rest.find(", "));
    rest.remove_prefix(std::min(part.size() + 2, rest.size()));
    const std::string variable(part.substr(0, part.find(" = ")));
    const numbers::Matrix* value = nullptr;
    if (block.where)
      if (const auto found = block.where->values.find(variable);
          found != block.where->values.end() && found->second.size() == 1)
        value = &found->second;
    name += mark;
    name += value ? variable + " = " + model::printed((*value)(0, 0)) : std::string(part);
  }
  return name;
}

/// Those of the bounds on gains come last.
const lmi::Block& block_at(const lmi::Lmi& lmi, const lmi::GainBounds& bounds, std::size_t k) {
  return k < lmi.blocks.size() ? lmi.blocks[k] : bounds.blocks[k - lmi.blocks.size()];
}

/// The multipliers by the name and point of their block.
model::NamedMatrices named_multipliers(const Attempts& attempts, const Attempt& attempt) {
  const lmi::Lmi& lmi = attempts.posed().lmi;
  const lmi::GainBounds& bounds = attempt.question.bounds;
  const auto list = lmi::multipliers(lmi, bounds, attempt.formulation, attempt.solution);
  model::NamedMatrices result;
  std::map<std::string, int> times;  // corners of neighbouring slices may be called alike
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string name = name_of(block_at(lmi, bounds, k));
    const int time = ++times[name];
    result.emplace_back(time > 1 ? fmt::format("{} ({})", name, time) : name, list[k]);
  }
  return result;
}

/// What each inequality and each bound on gains costs the minimum, in the units of the objective.
std::vector<model::Multiplier> multipliers_of(const Attempts& attempts, const Attempt& minimum) {
  const lmi::Lmi& lmi = attempts.posed().lmi;
  const lmi::GainBounds& bounds = minimum.question.bounds;
  const auto list = lmi::multipliers(lmi, bounds, minimum.formulation, minimum.solution);
  std::vector<model::Multiplier> result;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const lmi::Block& block = block_at(lmi, bounds, k);
    result.push_back({block.name, block.point, list[k].trace() / minimum.formulation.cost_unit});
  }
  return result;
}

/// Shown by weak duality, within the gain bounds.
void add_lower_bound(const Attempts& attempts, const Attempt& point, model::Gains& gains) {
  const auto add = [&](double least) {
    gains.objective_lower_bound = std::min(*gains.objective, least);
  };
  if (point.on_face) {
    if (point.least) add(*point.least);
    return;
  }
  const lmi::Lmi& lmi = attempts.posed().lmi;
  lmi::GainBounds bounds = point.question.bounds;
  // What limits unknowns alone is no inequality of the problem (blended()).
  if (point.approached) bounds.blocks.resize(attempts.bounds().blocks.size());
  const auto within = [&](const lmi::GainBounds& gain_bounds) {
    return verdict::lower_bound(attempts.posed().inequalities, lmi, gain_bounds, point.formulation,
                                point.solution);
  };
  // What the inequalities alone show is about all gains, and anybody can repeat it.
  // Of the objective.
  constexpr double kSame = 1e-7;
  auto least = within({});
  if (!least || least->value < *gains.objective - kSame * std::abs(*gains.objective))
    if (auto less_free = within(bounds); less_free && (!least || least->value < less_free->value))
      least = std::move(less_free);
  if (!least) return;
  add(least->value);
  for (std::size_t k = 0; k < least->Y.size(); ++k)
    if (const numbers::Matrix& Y = least->Y[k]; Y.size() > 0)
      gains.optimum_multipliers.emplace_back(
          name_of(block_at(lmi, bounds, k)),
          lmi::in_data_units(lmi, bounds, point.formulation, k, Y) / point.formulation.cost_unit);
}

/// What the solver found, whatever is shown of it.
std::optional<double> solver_objective(const Attempts& attempts) {
  for (const AttemptKind kind : {AttemptKind::on_equations, AttemptKind::facial_reduction})
    if (const Attempt* face = attempts.find(kind); face != nullptr && face->reached)
      return face->reached;
  const Attempt* minimum = attempts.find(AttemptKind::minimum);
  if (minimum == nullptr || !minimum->is_near_optimal()) return std::nullopt;
  return attempts.posed().lmi.objective_at(
      lmi::read_back(attempts.posed().lmi, minimum->formulation, minimum->solution));
}

/// The greater of two lower bounds near the objective that a certificate shows.
void bound_by_certificate(const ExcludesObjective& excludes, model::Gains& gains) {
  // Parts of the objective; the first is within the bracket of an optimum, 1e-6.
  for (const double away : {9e-7, 1e-4}) {
    const double below = *gains.objective - away * std::abs(*gains.objective);
    if (gains.objective_lower_bound >= below) return;
    const auto found = excludes(below);
    if (!found) continue;
    gains.objective_lower_bound = below;
    gains.optimum_multipliers.clear();
    if (!found->exact)
      gains.solver.add_message("the lower bound is shown by a certificate in " +
                               std::to_string(found->digits) +
                               " digits: no solution below it survives a relative change of " +
                               brief(found->backward_error, 1) + " of the coefficients");
    return;
  }
}

/// A minimum is one that a bound brackets to 1e-6 of its size: for all solutions, or for those
/// whose unknowns are at most twice as large. A margin that was asked for has its price.
void note_bracket(const Attempts& attempts, const Attempt& point, const ExcludesObjective& excludes,
                  model::Gains& gains) {
  const auto& least = gains.objective_lower_bound;
  const auto is_near = [&](double low) {
    return lmi::is_narrow_bracket(low, *gains.objective, point.formulation);
  };
  if (least && is_near(*least)) return;
  if (point.holds() && excludes) bound_by_certificate(excludes, gains);
  if (least && is_near(*least)) return;
  const bool is_priced = attempts.posed().choices().margin > model::SynthesisOptions{}.margin;
  const bool is_estimated = !point.on_face && is_near(lmi::objective_lower_bound(
                                                  attempts.posed().lmi, point.question.bounds,
                                                  point.formulation, point.solution));
  if (!is_priced && !is_estimated) gains.solver.status = "feasible";
  gains.solver.add_message(
      least ? "the optimum is between the lower bound " + brief_below(*least, 10) +
                  " and the objective"
      : is_estimated
          ? std::string("the objective is the optimum of solutions at most twice as large; of all "
                        "it is not shown")
          : std::string("how near the objective is to the optimum is not shown"));
}

/// The objective of a point: with a lower bound where it is a minimum, else with the reason why
/// not.
void note_objective(const Attempts& attempts, const Attempt& point,
                    const ExcludesObjective& excludes, model::Gains& gains) {
  const lmi::Lmi& lmi = attempts.posed().lmi;
  if (!lmi.has_objective) return;
  if (!lmi::has_minimum(lmi, attempts.bounds())) {
    // Its value at a point that may be scaled says nothing.
    gains.solver.add_message(
        "the objective was not used: without constant parts every solution may be scaled, so its "
        "infimum is 0 or there is none; the gains, which scaling leaves as they are, are those of "
        "the largest margin");
    return;
  }
  gains.objective = lmi.objective_at(point.x);
  if (point.question.goal == lmi::Goal::objective) {
    add_lower_bound(attempts, point, gains);
    if (!point.on_face) gains.multipliers = multipliers_of(attempts, point);
    if (point.approached)
      gains.solver.add_message(
          "the least value of the objective is only approached, as unknowns and gains grow without "
          "end; this one is near it");
    else
      note_bracket(attempts, point, excludes, gains);
    return;
  }
  const Attempt* minimum = attempts.find(AttemptKind::minimum);
  gains.solver.unbounded =
      point.unbounded ||
      (minimum != nullptr && minimum->solution.status == sdp::Status::dual_infeasible);
  if (gains.solver.unbounded) {
    gains.solver.add_message(
        "the objective is that of a point inside: the solver finds it unbounded below");
    return;
  }
  const auto value = solver_objective(attempts);
  gains.solver.add_message(
      "the objective is that of a point inside, not its minimum: the minimum was not found" +
      (value ? "; the solver's is " + brief(*value, 10) + ", near no decimals that hold"
             : std::string()));
}

/// A yes with its unknowns, margins and bounds, or what the best point falls short of. A yes
/// without the bounds on gains is undecided where the problem states a bound and its gains exceed
/// it.
void accept_point(const Attempts& attempts, const Attempt& point, const ExcludesObjective& excludes,
                  model::Gains& gains) {
  const lmi::Lmi& lmi = attempts.posed().lmi;
  const lmi::Unknowns& unknowns = attempts.posed().inequalities.unknowns;
  gains.margins = point.margins.margins;
  if (point.holds()) gains.solution_within = point.margins.solution_within;
  const numbers::Values values = unknowns.values(point.x);
  for (const lmi::Unknown& unknown : unknowns.list())
    gains.unknowns.emplace_back(unknown.name, values.at(unknown.name));
  const lmi::GainBounds& bounds = attempts.bounds();
  gains.bounds = lmi::reached_bounds(bounds, point.x);
  note_objective(attempts, point, excludes, gains);
  if (!point.holds()) return note_failures(point, gains);
  gains.verdict = model::Verdict::yes;
  if (attempts.is_free(point)) {
    const double largest = point.largest_gain;
    for (model::GainBound& bound : gains.bounds) bound.active = false;
    if (!(largest <= bounds.beta) && attempts.posed().choices().gain_bound_stated) {
      gains.verdict = model::Verdict::undecided;
      gains.bound_only = largest;
      // They are those of the inequalities without the bound.
      gains.solver.status = "undecided";
      gains.objective.reset();
      gains.objective_lower_bound.reset();
      gains.optimum_multipliers.clear();
      gains.multipliers.clear();
      gains.margins.clear();
      gains.solver.add_message(
          (attempts.posed().choices().gain_bounds.empty()
               ? "no gains were found under the gain bound " + brief(bounds.beta) +
                     ", whose condition is sufficient only; without it there are gains"
               : std::string("no gains were found under the gain bounds, whose conditions are "
                             "sufficient only; without them there are gains")) +
          ": raise synthesis.gain_bound; explain and 'bisect --smallest gain_bound' find the "
          "smallest that is enough");
      return;
    }
    if (!(point.reached_gain <= bounds.beta))
      gains.solver.add_message(
          "gains of " + brief(largest, 2) + ": none within the default of " + brief(bounds.beta) +
          " in balanced units were found; synthesis.gain_bound states what is acceptable");
  }
  note_wishes(point, gains);
  if (const Attempt* tighter = attempts.find(AttemptKind::tighter))
    mark_free_gains(*tighter, lmi, gains);
}

/// The certificate as exact decimals or fractions in text: p, and (z_k, c_k) of each multiplier.
model::AlgebraicRecord record_of(const verdict::AlgebraicCertificate& certificate,
                                 const lmi::Lmi& lmi) {
  model::AlgebraicRecord record{certificate.matrix,
                                nearest_double(certificate.root.re),
                                nearest_double(certificate.root.im),
                                {},
                                {}};
  for (const Rational& c : certificate.p) record.polynomial.push_back(c.str());
  for (const auto& [block, Z, W, step] : certificate.multipliers) {
    model::AlgebraicRecord::Term term{
        name_of(lmi.blocks[block]), {}, {W(0, 0).str(), W(0, 1).str(), W(1, 1).str()}, step};
    for (const auto& row : Z.rowwise()) {
      auto& texts = term.vector.emplace_back();
      for (const Rational& x : row) texts.push_back(x.str());
    }
    record.terms.push_back(std::move(term));
  }
  return record;
}

/// Their sums by blocks, in double.
model::NamedMatrices rounded_multipliers(const verdict::AlgebraicCertificate& certificate,
                                         const lmi::Lmi& lmi) {
  model::NamedMatrices result;
  for (const verdict::AlgebraicMultiplier& multiplier : certificate.multipliers) {
    const std::string name = name_of(lmi.blocks[multiplier.block]);
    const numbers::Matrix Y = verdict::rounded(multiplier, certificate.root);
    const auto known = std::ranges::find(result, name, [](const auto& one) { return one.first; });
    if (known != result.end())
      known->second += Y;
    else
      result.emplace_back(name, Y);
  }
  return result;
}

/// A no with its certificate: exact multipliers, a chain of steps, or multipliers in double.
void accept_refutation(const Attempts& attempts, const Attempt& refuted, model::Gains& gains) {
  const verdict::Refutation& found = *refuted.refutation;
  const lmi::Lmi& lmi = attempts.posed().lmi;
  gains.verdict = model::Verdict::no;
  gains.certificate = model::CertificateRecord{found.exact, found.backward_error, found.digits, {}};
  if (!refuted.chain.empty()) {
    gains.solver.add_message(refuted.chain);
    if (gains.solver.iterations == 0) gains.solver.cause = model::kNothingToSolve;
  }
  if (found.algebraic) {
    gains.certificate->algebraic = record_of(*found.algebraic, lmi);
    gains.certificate->multipliers = rounded_multipliers(*found.algebraic, lmi);
  } else if (refuted.chain.empty()) {
    gains.certificate->multipliers = named_multipliers(attempts, refuted);
  }
}

/// What shows that the last program has no solution. It is exact of the coefficients in double
/// where these are of corners that no value of the variables reaches.
model::CertificateRecord relaxed_certificate(const Attempts& attempts) {
  const lmi::Lmi& lmi = attempts.posed().lmi;
  const Attempt& last = attempts.last();
  model::CertificateRecord record{false, last.relaxed_backward_error, kDoubleDigits,
                                  named_multipliers(attempts, last), ""};
  if (lmi.represents_points()) return record;
  const auto found = verdict::refute<Decimal100>(
      attempts.posed().inequalities, lmi, last.formulation,
      verdict::multipliers_of(last.formulation, lmi.blocks.size(), last.solution));
  if (!found.exact) return record;
  record.exact = true;
  record.digits = found.digits;
  return record;
}

/// What is known where neither a point nor a certificate decides.
/// The largest margin, and the backward error of the best certificate.
void note_undecided(const Attempts& attempts, model::Gains& gains) {
  const Attempt& last = attempts.last();
  const auto& refutation = last.refutation;
  // A certificate is a direction, and an iterate outside has no margin.
  if (last.question.goal == lmi::Goal::interior && !last.solution.x.empty() &&
      last.solution.cause != sdp::Cause::certificate)
    if (const double margin = lmi::interior_margin(last.solution); margin >= 0 && margin <= 1)
      gains.solver.add_message("the largest margin found is " + brief(margin, 2));
  if (refutation && refutation->backward_error < 0.1)
    gains.solver.add_message("solutions, if any, do not survive a relative change of " +
                             brief(refutation->backward_error, 2) + " of the coefficients");
}

}  // namespace

void conclude(const Attempts& attempts, const ExcludesObjective& excludes, model::Gains& gains) {
  gains.verdict = model::Verdict::undecided;
  const Attempt* point = attempts.point();
  const Attempt* refuted = attempts.refutation();
  const bool has_objective = attempts.posed().lmi.has_objective;
  if (point == nullptr || !point->holds()) gains.solver = record_of(attempts.last(), has_objective);
  if (point != nullptr && (point->holds() || refuted == nullptr)) {
    gains.solver = record_of(*point, has_objective);
    if (!point->holds()) gains.solver.status = "undecided";
    return accept_point(attempts, *point, excludes, gains);
  }
  if (refuted != nullptr) {
    gains.solver = record_of(*refuted, has_objective);
    return accept_refutation(attempts, *refuted, gains);
  }
  if (attempts.is_out_of_allowance()) {
    gains.solver.out_of_allowance = true;
    gains.solver.add_message(
        "the search for a point or a certificate in more digits was ended after its allowance of "
        "work; `--effort full`, or `effort: full` under `synthesis`, lets it go on");
  }
  if (attempts.posed().lmi.has_objective) gains.objective = solver_objective(attempts);
  for (const AttemptKind kind : {AttemptKind::on_equations, AttemptKind::facial_reduction})
    if (const Attempt* faces = attempts.find(kind))
      return gains.solver.add_message(faces->left_open);
  if (attempts.last().relaxation_refuted()) {
    // What it is about is said by the plan (synthesize.cpp).
    gains.certificate = relaxed_certificate(attempts);
    gains.solver.status = "undecided";
    return;
  }
  note_undecided(attempts, gains);
}

}  // namespace gainsmith::design
