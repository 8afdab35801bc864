#include "design/attempt.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lmi/correlation.h"

namespace gainsmith::design {

namespace {

/// What is left of a certificate that is not exact: rounding of 100 digits.
constexpr double kNothing = 1e-30;

bool is_finite(const std::vector<double>& x) {
  return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

bool is_positive(const Posed& posed, const std::vector<double>& x) {
  return is_finite(x) && std::all_of(posed.lmi.blocks.begin(), posed.lmi.blocks.end(),
                                     [&](const lmi::Block& block) {
                                       return lmi::correlation_margin(block.value(x)) > 0;
                                     });
}

lmi::Margins margins_at(const Posed& posed, const Attempt& attempt, const std::vector<double>& x) {
  return lmi::compute_margins(posed.inequalities, posed.lmi, attempt.formulation.balance,
                              posed.choices().margin, x);
}

/// Whether the gains at x are as small as was asked for.
bool is_within(const lmi::GainBounds& bounds, const std::vector<double>& x) {
  constexpr double kRounding = 1e-9;
  const auto reached = lmi::reached_bounds(bounds, x);
  return std::all_of(reached.begin(), reached.end(), [](const model::GainBound& bound) {
    return bound.reached <= bound.bound * (1 + kRounding);
  });
}

/// Sets the point when x is one.
void take_point(const Posed& posed, const std::vector<double>& x, Attempt& result) {
  if (!is_positive(posed, x) || !is_within(result.question.bounds, x)) return;
  result.point = true;
  result.x = x;
}

void solve_objective(const Posed& posed, const Solve& solve, Attempt& result) {
  const Question& asked = result.question;
  result.formulation = lmi::formulate_objective(posed.lmi, asked.bounds, asked.shift);
  result.solution = solve(result.formulation.problem, asked.effort);
  // Far from the minimum a point serves no one: one inside comes from the other goal.
  if (!result.is_near_optimal()) return;
  take_point(posed, lmi::read_back(posed.lmi, result.formulation, result.solution), result);
}

void solve_interior(const Posed& posed, const Solve& solve, Attempt& result) {
  constexpr int kMostRounds = 8;
  constexpr double kRises = 1e-3;
  const Question& asked = result.question;
  // More digits are worth having only for data that have them.
  const bool wide = asked.effort.precision != "auto";
  std::optional<lmi::ExactBlocks<Decimal100>> exact;
  const lmi::Exactly exactly = [&](std::size_t k, const lmi::Balance& balance,
                                   const std::vector<int>& kept) {
    if (!exact) exact.emplace(posed.inequalities, balance);
    return lmi::rounded(exact->block(posed.lmi.blocks[k], k, kept), static_cast<int>(kept.size()));
  };
  lmi::Round round;
  for (int k = 0; k < kMostRounds; ++k) {
    lmi::Formulation formulation =
        lmi::formulate_interior(posed.lmi, asked.bounds, round, wide ? exactly : lmi::Exactly{});
    sdp::Solution solution = solve(formulation.problem, asked.effort);
    const auto next = lmi::next_round(formulation, solution);
    const std::vector<double> x = lmi::read_back(posed.lmi, formulation, solution);
    if (k == 0 || (next && next->margin > round.margin)) {
      result.formulation = std::move(formulation);
      result.solution = std::move(solution);
      take_point(posed, x, result);
    }
    if (!next || next->margin >= posed.choices().margin) return;
    if (next->margin <= round.margin * (1 + kRises)) return;
    round = *next;
  }
}

void refute(const Posed& posed, Attempt& result) {
  const lmi::Formulation& formulation = result.formulation;
  const auto Y = lmi::multipliers_of(formulation, posed.lmi.blocks.size(), result.solution);
  result.refutation = lmi::refute<DoubleDouble>(posed.inequalities, posed.lmi, formulation, Y);
  // What 31 digits see is not of the data's making when 100 are asked for.
  if (result.refutation->exact || result.question.effort.precision == "auto") return;
  result.refutation = lmi::refute<Decimal100>(posed.inequalities, posed.lmi, formulation, Y);
}

}  // namespace

bool Attempt::is_near_optimal() const {
  constexpr double kNear = 1e-6;
  return is_optimal() || std::abs(solution.relative_gap) <= kNear;
}

bool Attempt::refuted() const {
  return refutation && (refutation->exact || refutation->omega <= kNothing);
}

bool Attempt::relaxation_refuted() const {
  constexpr double kRounding = 1e-9;
  return !point && relaxed_omega <= kRounding;
}

Attempt attempt(const Posed& posed, Question question, const Solve& solve) {
  Attempt result;
  result.question = std::move(question);
  const bool interior = result.question.goal == lmi::Goal::interior;
  if (interior)
    solve_interior(posed, solve, result);
  else
    solve_objective(posed, solve, result);
  if (result.point) {
    result.margins = margins_at(posed, result, result.x);
  } else if (interior && !result.solution.x.empty()) {
    result.relaxed_omega =
        lmi::relaxed_omega(posed.lmi, result.question.bounds, result.formulation, result.solution);
    if (result.question.bounds.list.empty()) refute(posed, result);
  }
  return result;
}

std::optional<Attempt> blended(const Posed& posed, const Attempt& minimum, const Attempt& inside) {
  const std::vector<double> least =
      lmi::read_back(posed.lmi, minimum.formulation, minimum.solution);
  if (!is_finite(least)) return std::nullopt;
  for (double e = 1e-12; e < 1; e *= 10) {
    std::vector<double> x = least;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += e * (inside.x[i] - least[i]);
    if (!is_positive(posed, x) || !is_within(minimum.question.bounds, x)) continue;
    lmi::Margins margins = margins_at(posed, minimum, x);
    if (!lmi::all_hold(margins)) continue;
    Attempt result = minimum;
    result.point = true;
    result.x = std::move(x);
    result.margins = std::move(margins);
    return result;
  }
  return std::nullopt;
}

}  // namespace gainsmith::design
