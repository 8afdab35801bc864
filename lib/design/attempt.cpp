#include "design/attempt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/stop.h"
#include "design/certificates.h"
#include "design/in_matrices.h"
#include "design/minimum.h"
#include "verdict/relaxed_backward_error.h"

namespace gainsmith::design {

namespace {

/// The margins of all inequalities at x, with the check of its decimals.
verdict::Margins margins_at(const Posed& posed, const Attempt& attempt,
                            const std::vector<double>& x) {
  return verdict::compute_margins(posed.inequalities, posed.lmi, attempt.formulation.balance,
                                  posed.choices().margin, x, posed.check);
}

/// Whether the gains at x are as small as was asked for.
bool is_within(const lmi::GainBounds& bounds, const std::vector<double>& x) {
  const auto reached = lmi::reached_bounds(bounds, x);
  return std::all_of(reached.begin(), reached.end(),
                     [](const model::GainBound& bound) { return bound.reached <= bound.bound; });
}

/// Sets the point when x is one; its margins are for the last point alone.
void take_point(const Posed& posed, const std::vector<double>& x, Attempt& result) {
  if (!is_positive(posed, x) || !is_within(result.question.bounds, x)) return;
  result.point = true;
  result.x = x;
  result.margins = {};
}

/// The same where double does not tell: by the check of the decimals of x.
void take_point_beyond_double(const Posed& posed, const std::vector<double>& x, Attempt& result) {
  if (!(lmi::interior_margin(result.solution) > 0)) return;
  if (!is_finite(x) || !is_within(result.question.bounds, x)) return;
  verdict::Margins margins = margins_at(posed, result, x);
  if (!verdict::all_hold(margins)) return;
  result.point = true;
  result.x = x;
  result.margins = std::move(margins);
}

/// The attempt at a minimum: large programs by the solver in matrices first, whose point the
/// interior-point method goes on from; then a refinement (minimum.h).
void solve_objective(const Posed& posed, const Solve& solve, Attempt& result) {
  const Question& asked = result.question;
  result.formulation = lmi::pose_objective(posed.lmi, asked.bounds, asked.shift);
  Effort effort = asked.effort;
  auto near = solve_in_matrices(posed, asked, result.formulation, {}, {});
  if (near && near->cause == sdp::Cause::converged &&
      price_of(posed, asked.bounds, result.formulation, *near) <= kFair) {
    near->status = sdp::Status::optimal;
    result.solution = std::move(*near);
    take_point(posed, lmi::read_back(posed.lmi, result.formulation, result.solution), result);
    return;
  }
  if (near) effort.from = &*near;
  lmi::assemble(posed.lmi, asked.bounds, {}, result.formulation);
  result.solution = solve(result.formulation.problem, effort);
  if (near) result.solution.iterations += near->iterations;
  const bool is_refuted = result.solution.status != sdp::Status::optimal &&
                          result.solution.status != sdp::Status::undecided;
  if (is_refuted || result.solution.x.empty()) return;
  refine_minimum(posed, solve, result);
  // Far from the minimum a point serves no one: one inside comes from the other goal.
  if (!result.is_near_optimal()) return;
  take_point(posed, lmi::read_back(posed.lmi, result.formulation, result.solution), result);
}

/// The margins of its point, where they are not known.
void complete(const Posed& posed, Attempt& result) {
  if (result.point && result.margins.margins.empty())
    result.margins = margins_at(posed, result, result.x);
}

/// Programs for the largest margin, of the data as the effort sees them, and their solutions.
class Interior {
 public:
  struct Solved {
    lmi::Formulation formulation;
    sdp::Solution solution;
  };

  Interior(const Posed& posed, const Question& asked, const Solve& solve)
      : posed_(posed), asked_(asked), solve_(solve) {}

  /// More digits are worth having only for data that have them.
  bool is_wide() const { return asked_.effort.precision != "auto"; }

  /// The program of one round and its solution. In double the solver in matrices is tried first; in
  /// more digits the coefficients are those of the file's decimals.
  Solved operator()(const lmi::Round& round) {
    const lmi::Exactly exactly = [this](std::size_t k, const lmi::Balance& balance,
                                        const std::vector<int>& kept) {
      if (!exact_) exact_.emplace(posed_.inequalities, balance);
      return verdict::rounded(exact_->block(posed_.lmi.blocks[k], k, kept));
    };
    Solved result;
    result.formulation = of_all_rows();
    Effort effort = asked_.effort;
    std::optional<sdp::Solution> near;
    if (!is_wide()) {
      effort.enough = enough_for(posed_, asked_, result.formulation, round);
      near = solve_in_matrices(posed_, asked_, result.formulation, round, effort.enough);
      if (near && near->cause == sdp::Cause::enough) {
        result.solution = std::move(*near);
        return result;
      }
      if (near) effort.from = &*near;
    }
    lmi::assemble(posed_.lmi, asked_.bounds, round, result.formulation,
                  is_wide() ? exactly : lmi::Exactly{});
    result.solution = solve_(result.formulation.problem, effort);
    if (near) result.solution.iterations += near->iterations;
    return result;
  }

 private:
  /// The same in every round but for its program.
  const lmi::Formulation& of_all_rows() {
    if (!of_all_rows_) of_all_rows_ = lmi::pose_interior(posed_.lmi, asked_.bounds);
    return *of_all_rows_;
  }

  const Posed& posed_;
  const Question& asked_;
  const Solve& solve_;
  std::optional<lmi::Formulation> of_all_rows_;
  /// Made at the first use, for one balance.
  std::optional<verdict::ExactBlocks<Decimal100>> exact_;
};

/// The first round, whose multipliers are a certificate where there is no point; none when it is
/// the one that the result has.
std::optional<Interior::Solved> solve_interior(const Posed& posed, Interior& interior,
                                               Attempt& result) {
  // Each round starts from the margin of the last (lmi/formulation.h). The margin of a round must
  // rise by 1e-3 of itself for another one.
  constexpr int kMostRounds = 8;
  constexpr double kRises = 1e-3;
  lmi::Round round;
  std::optional<Interior::Solved> first;
  for (int k = 0; k < kMostRounds; ++k) {
    Interior::Solved solved = interior(round);
    if (solved.solution.x.empty()) {  // stopped before its first iteration
      if (k == 0) {
        result.formulation = std::move(solved.formulation);
        result.solution = std::move(solved.solution);
      }
      break;
    }
    const auto next =
        lmi::next_round(posed.lmi, result.question.bounds, solved.formulation, solved.solution.x);
    const std::vector<double> x = lmi::read_back(posed.lmi, solved.formulation, solved.solution);
    if (k == 0 || (next && next->margin > round.margin)) {
      if (k > 0 && !first) first = {std::move(result.formulation), std::move(result.solution)};
      result.formulation = std::move(solved.formulation);
      result.solution = std::move(solved.solution);
      take_point(posed, x, result);
      if (interior.is_wide() && !result.point) take_point_beyond_double(posed, x, result);
    }
    if (!next || next->margin >= posed.choices().margin) break;
    if (next->margin <= round.margin * (1 + kRises)) break;
    round = *next;
  }
  return first;
}

/// The multipliers of the first round.
/// Where they exclude every solution, the attempt takes their program.
void refute(const Posed& posed, const Solve& solve, Interior::Solved solved, Attempt& result) {
  result.refutation =
      find_certificate(posed, result.question.effort, solved.formulation, solved.solution, solve);
  if (!result.refuted()) return;
  result.formulation = std::move(solved.formulation);
  result.solution = std::move(solved.solution);
}

}  // namespace

bool is_near_optimal(const sdp::Solution& solution) {
  // A relative gap at which the objective is known to six digits.
  constexpr double kNear = 1e-6;
  if (solution.status == sdp::Status::optimal) return true;
  // A solver that is stopped before its first iteration has no point and no gap.
  return !solution.x.empty() && std::abs(solution.relative_gap) <= kNear;
}

bool Attempt::refuted() const {
  return refutation && (refutation->exact || refutation->backward_error <= verdict::kNothing);
}

bool Attempt::relaxation_refuted() const {
  // What the solver leaves at its own tolerance; a message rests on it, no verdict.
  constexpr double kRounding = 1e-7;
  return !point && relaxed_backward_error <= kRounding;
}

Attempt attempt(const Posed& posed, Question question, const Solve& solve) {
  Attempt result;
  result.question = std::move(question);
  if (result.question.goal == lmi::Goal::objective) {
    solve_objective(posed, solve, result);
    complete(posed, result);
    return result;
  }
  Interior interior(posed, result.question, solve);
  std::optional<Interior::Solved> first = solve_interior(posed, interior, result);
  complete(posed, result);
  if (result.holds()) return result;
  // A margin that was enough in double and does not hold: the largest one is asked for.
  if (result.solution.cause == sdp::Cause::enough) {
    result.question.largest = true;
    return attempt(posed, std::move(result.question), solve);
  }
  if (!first) first = {result.formulation, result.solution};
  if (first->solution.x.empty()) return result;
  if (!result.point)
    result.relaxed_backward_error = verdict::relaxed_backward_error(
        posed.lmi, result.question.bounds, first->formulation, first->solution);
  if (!result.question.bounds.list.empty()) return result;
  try {
    refute(posed, solve, std::move(*first), result);
  } catch (const OutOfAllowance&) {
    result.out_of_allowance = true;
  }
  return result;
}

namespace {

/// The point x + fraction (x_f - x), x_f the point inside, with the records of `minimum`; none
/// where an inequality does not hold there.
std::optional<Attempt> between(const Posed& posed, const Attempt& minimum, std::vector<double> x,
                               const Attempt& inside, double fraction) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += fraction * (inside.x[i] - x[i]);
  if (!is_positive(posed, x) || !is_within(minimum.question.bounds, x)) return std::nullopt;
  verdict::Margins margins = margins_at(posed, minimum, x);
  if (!verdict::all_hold(margins)) return std::nullopt;
  Attempt result = minimum;
  result.point = true;
  result.x = std::move(x);
  result.margins = std::move(margins);
  return result;
}

/// From `least` on towards the point inside, as far as it takes.
std::optional<Attempt> blended_from(const Posed& posed, const Attempt& minimum,
                                    const std::vector<double>& least, const Attempt& inside) {
  if (!is_finite(least)) return std::nullopt;
  constexpr std::array kFractions = {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7,
                                     1e-6,  1e-5,  1e-4,  1e-3, 1e-2, 1e-1};
  // Of the decade between a fraction that fails and one that holds, on a logarithmic scale.
  constexpr int kHalvings = 3;
  for (double e : kFractions) {
    auto result = between(posed, minimum, least, inside, e);
    if (!result) continue;
    // The objective shows what the fraction costs.
    double fails = 0.1 * e;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = std::sqrt(fails * e);
      auto nearer = between(posed, minimum, least, inside, middle);
      (nearer ? e : fails) = middle;
      if (nearer) result = std::move(nearer);
    }
    return result;
  }
  return std::nullopt;
}

/// |x_i| <= r_i beside the bounds, as 1 + x_i/r_i >= 0 and 1 - x_i/r_i >= 0, with r_i = kReach
/// times the largest unknown of the point inside, in balanced units.
lmi::GainBounds within_reach(const Attempt& minimum, const Attempt& inside) {
  constexpr double kReach = 1e3;
  lmi::GainBounds bounds = minimum.question.bounds;
  const lmi::Balance& balance = minimum.formulation.balance;
  double largest = 0;
  for (std::size_t i = 0; i < inside.x.size(); ++i)
    largest = std::max(largest, std::abs(inside.x[i]) / balance.unit(static_cast<int>(i) + 1));
  const auto number = [](double value) {
    lmi::Sparse matrix(1, 1);
    matrix.insert(0, 0) = value;
    return matrix;
  };
  for (int i = 1; i <= std::ssize(inside.x); ++i)
    for (const double sign : {1.0, -1.0}) {
      lmi::AffineForm form{{1, 1}, {}};
      form.terms.emplace(std::pair(0, 0), number(1));
      form.terms.emplace(std::pair(0, i), number(sign / (kReach * largest * balance.unit(i))));
      bounds.blocks.push_back(lmi::block_of(form, "reach", "", false, {}));
    }
  return bounds;
}

}  // namespace

std::optional<Attempt> near_minimum(const Posed& posed, const Attempt& minimum,
                                    const Attempt& inside) {
  // Of the objective, and of the distance to the point inside.
  constexpr double kCost = 1e-8, kMost = 1e-3;
  const double least = posed.lmi.objective_at(minimum.x);
  const double cost = std::abs(posed.lmi.objective_at(inside.x) - least);
  const double fraction = std::min(kMost, kCost * std::abs(least) / cost);
  if (!(fraction > 0)) return std::nullopt;
  return between(posed, minimum, minimum.x, inside, fraction);
}

std::optional<Attempt> blended(const Posed& posed, const Attempt& minimum, const Attempt& inside,
                               const Solve& solve) {
  const auto point_of = [&](const Attempt& solved) {
    return lmi::read_back(posed.lmi, solved.formulation, solved.solution);
  };
  if (auto found = blended_from(posed, minimum, point_of(minimum), inside)) return found;
  if (!minimum.is_optimal()) return std::nullopt;
  Question question = minimum.question;
  question.bounds = within_reach(minimum, inside);
  const Attempt near = attempt(posed, std::move(question), solve);
  if (!near.is_near_optimal()) return std::nullopt;
  auto found = blended_from(posed, minimum, point_of(near), inside);
  if (found) found->approached = true;
  return found;
}

}  // namespace gainsmith::design
