#include "design/attempt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/stop.h"
#include "design/certificates.h"
#include "design/in_matrices.h"
#include "lmi/correlation.h"
#include "verdict/relaxed_backward_error.h"

namespace gainsmith::design {

namespace {

bool is_finite(const std::vector<double>& x) {
  return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

bool is_positive(const Posed& posed, const std::vector<double>& x) {
  constexpr double kTells = 1e-15;  // what double tells from 0

  return is_finite(x) && std::all_of(posed.lmi.blocks.begin(), posed.lmi.blocks.end(),
                                     [&](const lmi::Block& block) {
                                       return lmi::correlation_margin(block.value(x)) > kTells;
                                     });
}

verdict::Margins margins_at(const Posed& posed, const Attempt& attempt,
                            const std::vector<double>& x) {
  return verdict::compute_margins(posed.inequalities, posed.lmi, attempt.formulation.balance,
                                  posed.choices().margin, x, posed.look);
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

/// What the margins are said to cost, by the objective's size (lmi::objective_lower_bound).
double price_of(const Posed& posed, const Attempt& attempt, const sdp::Solution& solution) {
  const lmi::Formulation& formulation = attempt.formulation;
  const double value = posed.lmi.objective_at(lmi::read_back(posed.lmi, formulation, solution));
  const double least =
      lmi::objective_lower_bound(posed.lmi, attempt.question.bounds, formulation, solution);
  return (value - least) / std::abs(value);
}

/// A price that is no matter of the solver's digits, and one that ill-conditioned minima of large
/// programs have in the dense solver too.
constexpr double kCheap = 3e-7, kFair = 1e-6;

/// The shift that costs a part of kCheap in other units: to first order it costs shift tr(Y).
double cheap_shift(const Posed& posed, const Attempt& attempt, const lmi::Formulation& there) {
  constexpr double kPart = 0.3;
  constexpr double kLeast = 1e-13;  // less is no margin beside rounding
  constexpr double kMost = 1e-8;    // more than the solver leaves undone
  const lmi::Formulation& here = attempt.formulation;
  const sdp::Solution& solution = attempt.solution;
  double trace = 0;
  for (std::size_t k = 0; k < posed.lmi.blocks.size(); ++k) {
    const std::vector<int>& kept = here.free_variables.kept[k];
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double unit = here.balance.row(k, kept[i]) / there.balance.row(k, kept[i]);
      trace += solution.Y.values[k][i * (kept.size() + 1)] * unit * unit;
    }
  }
  const double value = posed.lmi.objective_at(lmi::read_back(posed.lmi, here, solution));
  const double cheap = kPart * kCheap * std::abs(value) * here.cost_unit;
  return trace > 0 ? std::clamp(cheap / trace, kLeast, kMost) : kMost;
}

bool has_point(const Posed& posed, const Attempt& attempt) {
  return attempt.solution.status == sdp::Status::optimal &&
         is_positive(posed, lmi::read_back(posed.lmi, attempt.formulation, attempt.solution));
}

/// The solution of the formulation takes the place of the result's where it is a point and that is none,
/// or where it is cheaper.
void take_better(const Posed& posed, const lmi::Formulation& formulation, sdp::Solution solution,
                 Attempt& result) {
  if (solution.status != sdp::Status::optimal) return;
  Attempt again = result;
  again.formulation = formulation;
  again.solution = std::move(solution);
  const bool was_point = has_point(posed, result);
  if (was_point != has_point(posed, again)
          ? was_point
          : !(price_of(posed, again, again.solution) < price_of(posed, result, result.solution)))
    return;
  again.solution.iterations += result.solution.iterations;
  result = std::move(again);
}

/// Units of the data may be far from those of the solution: then the program is solved in these too, with
/// a margin and a weight that cost little, unless a larger margin is wished for.
void solve_in_units_of(const Posed& posed, const Solve& solve, const Attempt& near,
                       Attempt& result) {
  constexpr double kPart = 0.01;
  const Question& asked = result.question;
  lmi::Formulation again =
      lmi::in_units_of_solution(posed.lmi, asked.bounds, near.formulation, near.solution.x);
  const bool is_wished = asked.shift > model::SynthesisOptions{}.margin;
  if (!is_wished) again.shift = cheap_shift(posed, near, again);
  // The traces of the blocks are not above their numbers of rows.
  const double value =
      posed.lmi.objective_at(lmi::read_back(posed.lmi, near.formulation, near.solution));
  again.weight = kPart * kCheap * std::abs(value) * again.cost_unit /
                 std::accumulate(again.sizes.begin(), again.sizes.end(), 0);
  lmi::assemble(posed.lmi, asked.bounds, {}, again);
  take_better(posed, again, solve(again.problem, asked.effort), result);
}

/// The minimum with a weight in units of the data; its price is no matter.
Attempt weighted(const Posed& posed, const Solve& solve, const Attempt& plain) {
  constexpr double kWeight = 1e-8;
  Attempt result = plain;
  result.formulation.weight = kWeight;
  lmi::assemble(posed.lmi, plain.question.bounds, {}, result.formulation);
  result.solution = solve(result.formulation.problem, plain.question.effort);
  return result;
}

/// Until the point costs little. A gap that is small beside the solver's 1 may be large beside the
/// objective: then the program is solved to a finer one.
void refine_price(const Posed& posed, const Solve& solve, Attempt& result) {
  constexpr double kDear = 1e-3;  // dearer is no matter of the solver's digits
  constexpr double kFiner = 1e-3;
  const auto is_good = [&] {
    return has_point(posed, result) && price_of(posed, result, result.solution) <= kCheap;
  };
  if (is_good()) return;
  const Attempt near = weighted(posed, solve, result);
  solve_in_units_of(posed, solve, near.is_near_optimal() ? near : Attempt(result), result);
  if (!result.is_near_optimal()) return;
  const double price = price_of(posed, result, result.solution);
  if (is_good() || !(kCheap < price && price < kDear)) return;
  Effort finer = result.question.effort;
  finer.tolerance *= kFiner;
  take_better(posed, result.formulation, solve(result.formulation.problem, finer), result);
}

void solve_objective(const Posed& posed, const Solve& solve, Attempt& result) {
  const Question& asked = result.question;
  result.formulation = lmi::pose_objective(posed.lmi, asked.bounds, asked.shift);
  Effort effort = asked.effort;
  auto near = solve_in_matrices(posed, asked, result.formulation, {}, {});
  if (near && near->cause == sdp::Cause::converged && price_of(posed, result, *near) <= kFair) {
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
  refine_price(posed, solve, result);
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

  Solved operator()(const lmi::Round& round, const std::vector<std::vector<int>>& rows = {}) {
    const lmi::Exactly exactly = [this](std::size_t k, const lmi::Balance& balance,
                                        const std::vector<int>& kept) {
      if (!exact_) exact_.emplace(posed_.inequalities, balance);
      return verdict::rounded(exact_->block(posed_.lmi.blocks[k], k, kept));
    };
    Solved result;
    result.formulation =
        rows.empty() ? of_all_rows() : lmi::pose_interior(posed_.lmi, asked_.bounds, rows);
    Effort effort = asked_.effort;
    std::optional<sdp::Solution> near;
    if (!is_wide() && rows.empty()) {
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
  std::optional<verdict::ExactBlocks<Decimal100>> exact_;
};

/// The first round, whose multipliers are a certificate where there is no point; none when it is
/// the one that the result has.
std::optional<Interior::Solved> solve_interior(const Posed& posed, Interior& interior,
                                               Attempt& result) {
  const int most_rounds = result.question.single ? 1 : 8;
  constexpr double kRises = 1e-3;
  lmi::Round round;
  std::optional<Interior::Solved> first;
  for (int k = 0; k < most_rounds; ++k) {
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

/// The multipliers of the first round, and in more digits also those of the rows that they live on.
void refute(const Posed& posed, const Solve& solve, Interior& interior, Interior::Solved solved,
            Attempt& result) {
  const int most_restrictions = result.question.single ? 0 : 3;
  for (int k = 0;; ++k) {
    const verdict::Refutation found =
        find_certificate(posed, result.question.effort, solved.formulation, solved.solution, solve);
    const bool better = !result.refutation || found.exact ||
                        found.backward_error < result.refutation->backward_error;
    if (better) result.refutation = found;
    if (result.refuted() && !result.refutation->exact && k == 0)
      if (const auto few = lmi::rows_of_multipliers(solved.formulation, solved.solution);
          !few.empty()) {
        // On the coordinates that they live on certificates are exact, as a rule.
        Interior::Solved inner = interior({}, few);
        const verdict::Refutation exact =
            find_exact_certificate(posed, inner.formulation, inner.solution);
        if (exact.exact) {
          result.refutation = exact;
          solved = std::move(inner);
        }
      }
    if (result.refuted()) {
      result.formulation = std::move(solved.formulation);
      result.solution = std::move(solved.solution);
      return;
    }
    if (!interior.is_wide() || k == most_restrictions) return;
    const auto rows = lmi::rows_of_multipliers(solved.formulation, solved.solution);
    if (rows.empty()) return;
    solved = interior({}, rows);
  }
}

}  // namespace

bool Attempt::is_near_optimal() const {
  constexpr double kNear = 1e-6;
  if (is_optimal()) return true;
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
    refute(posed, solve, interior, std::move(*first), result);
  } catch (const OutOfAllowance&) {
    result.out_of_allowance = true;
  }
  return result;
}

namespace {

/// From `least` on towards the point inside, as far as it takes; by the records of `minimum`.
std::optional<Attempt> blended_from(const Posed& posed, const Attempt& minimum,
                                    const std::vector<double>& least, const Attempt& inside) {
  if (!is_finite(least)) return std::nullopt;
  std::optional<Attempt> result;
  const auto holds_at = [&](double fraction) {
    std::vector<double> x = least;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += fraction * (inside.x[i] - least[i]);
    if (!is_positive(posed, x) || !is_within(minimum.question.bounds, x)) return false;
    verdict::Margins margins = margins_at(posed, minimum, x);
    if (!verdict::all_hold(margins)) return false;
    result = minimum;
    result->point = true;
    result->x = std::move(x);
    result->margins = std::move(margins);
    return true;
  };
  constexpr std::array kFractions = {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7,
                                     1e-6,  1e-5,  1e-4,  1e-3, 1e-2, 1e-1};
  constexpr int kHalvings = 3;
  for (double e : kFractions) {
    if (!holds_at(e)) continue;
    // What the fraction costs is seen in the objective.
    double fails = 0.1 * e;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = std::sqrt(fails * e);
      (holds_at(middle) ? e : fails) = middle;
    }
    break;
  }
  return result;
}

/// 1 + x_i/r_i >= 0 and 1 - x_i/r_i >= 0 beside the bounds, with r_i = kReach times the largest unknown of
/// the point inside, in balanced units.
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
