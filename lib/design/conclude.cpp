// What the attempts of a synthesis mean together.
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "design/ladder.h"

namespace gainsmith::design {

namespace {

model::SolverRecord record_of(const Attempt& attempt) {
  const sdp::Solution& solution = attempt.solution;
  model::SolverRecord record;
  record.status = attempt.is_infeasible() ? "infeasible"
                  : attempt.is_optimal()  ? "optimal"
                                          : "undecided";
  record.cause = to_string(solution.cause);
  record.message = solution.message;
  record.iterations = solution.iterations;
  record.relative_gap = solution.relative_gap;
  record.primal_infeasibility = solution.dimacs[2];
  record.dual_infeasibility = solution.dimacs[0];
  record.precision = solution.precision;
  return record;
}

void leave_undecided(model::Gains& gains, const std::string& message) {
  gains.solver.status = "undecided";
  gains.solver.message = message;
}

/// The verdict of a point, with what it falls short of.
void judge(const Attempt& point, model::Gains& gains) {
  gains.verdict = is_kept(point) ? model::Verdict::yes : model::Verdict::undecided;
  if (gains.verdict == model::Verdict::yes) return;
  std::string failed;
  bool positive = true;
  for (const model::Margin& margin : point.margins.margins) {
    if (lmi::is_kept(margin)) continue;
    failed += (failed.empty() ? "" : "; ") + margin.name + ": margin " + brief(margin.reached) +
              ", asked for " + brief(margin.required);
    positive &= margin.reached > 0;
  }
  std::string message =
      failed.empty() ? "the solver converged, but for all values " + point.margins.open
                     : "the solver converged, but recomputed from the written decimals " + failed;
  if (!failed.empty() && positive && point.formulation.homogeneous())
    message += "; a smaller synthesis.margin, or P > I instead of P > 0, may do";
  leave_undecided(gains, message);
}

/// A gain that the objective does not determine is limited by its bound alone, wherever between
/// them the solver stops: with a bound ten times smaller the objective stays and the gain shrinks.
void mark_free_gains(const Attempt& tighter, const lmi::Lmi& lmi, model::Gains& gains) {
  constexpr double kNear = 0.01;
  constexpr double kSameObjective = 1e-6;
  constexpr double kShrunk = 0.5;
  if (!tighter.is_optimal()) return;
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

void accept_point(const Climb& climb, const Attempt& point, model::Gains& gains) {
  const lmi::Lmi& lmi = climb.posed().lmi;
  const lmi::Unknowns& unknowns = climb.posed().inequalities.unknowns;
  gains.margins = point.margins.margins;
  const numbers::Values values = unknowns.values(point.x);
  for (const lmi::Unknown& unknown : unknowns.list())
    gains.unknowns.emplace_back(unknown.name, values.at(unknown.name));
  gains.bounds = lmi::reached_bounds(point.question.bounds, point.x);
  if (lmi.has_objective) {
    gains.objective = lmi.objective_at(point.x);
    // The dual solution is feasible to the solver's tolerance only.
    if (point.question.goal == lmi::Goal::bounded_objective)
      gains.objective_lower_bound = std::min(
          *gains.objective, lmi::objective_lower_bound(lmi, point.formulation, point.solution));
  }
  judge(point, gains);
  if (const Attempt* tighter = climb.find(Rung::tighter)) mark_free_gains(*tighter, lmi, gains);
}

void accept_certificate(const Climb& climb, const Attempt& infeasible, bool within_bounds,
                        model::Gains& gains) {
  gains.verdict = model::Verdict::no;
  const sdp::Certificate& certificate = infeasible.solution.certificate;
  gains.certificate =
      model::CertificateRecord{certificate.value,
                               certificate.residual,
                               certificate.min_eigenvalue,
                               infeasible.formulation.unit * certificate.excluded_radius,
                               certificate.checked,
                               lmi::multipliers(climb.posed().lmi, infeasible.question.bounds,
                                                infeasible.formulation, infeasible.solution)};
  if (within_bounds)
    gains.solver.message = "no gains within the gain bound " +
                           brief(infeasible.question.bounds.beta) +
                           ": the certificate needs it; raise synthesis.gain_bound";
}

}  // namespace

void conclude(const Climb& climb, model::Gains& gains) {
  gains.verdict = model::Verdict::undecided;
  if (const Attempt* point = climb.point()) {
    gains.solver = record_of(*point);
    return accept_point(climb, *point, gains);
  }
  bool within_bounds = false;
  if (const Attempt* infeasible = climb.certificate(within_bounds)) {
    gains.solver = record_of(*infeasible);
    return accept_certificate(climb, *infeasible, within_bounds, gains);
  }
  const Attempt& own = climb.own();
  const Attempt* margin = climb.find(Rung::margin);
  gains.solver = record_of(margin != nullptr ? *margin : own);
  if (margin != nullptr)
    leave_undecided(gains, own.is_infeasible()
                               ? "solutions, if any, are far larger than the data suggest"
                               : "the largest margin is " + brief(own.largest_margin()) +
                                     ", below the one asked for");
  if (own.solution.status == sdp::Status::dual_infeasible)
    leave_undecided(
        gains,
        "the objective is unbounded below: some direction of the unknowns lowers it without end");
}

}  // namespace gainsmith::design
