// One question to the solver and its answer.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "forall/plan.h"
#include "lmi/formulation.h"
#include "verdict/margins.h"
#include "verdict/refutation.h"

namespace gainsmith::design {

/// How hard the solver tries: its arithmetic, and the relative gap at which it stops; where it
/// begins, and what is enough (sdp::Options).
struct Effort {
  /// "auto", "double", "quad" (31 digits) or "100" (100 digits).
  std::string precision = "auto";
  /// Relative gap of the objectives and infeasibility (sdp::Options).
  double tolerance = 1e-9;
  const sdp::Solution* from = nullptr;
  std::function<bool(const std::vector<double>& x)> enough = {};
  double certificate_tolerance = 1e-8;  ///< smaller: only certificates against larger x end it
};

/// Solves a semidefinite program: sdp::solve with its options, or a script in a test.
using Solve = std::function<sdp::Solution(const sdp::Problem& problem, const Effort& effort)>;

/// Optimal, or with objectives that nearly agree.
bool is_near_optimal(const sdp::Solution& solution);

/// Inequalities with the blocks that represent them.
struct Posed {
  const lmi::Inequalities& inequalities;
  const forall::Plan& plan;
  const lmi::Lmi& lmi;
  bool wide = true;             ///< whether 31 digits may be tried where double does not decide
  verdict::CheckOptions check;  ///< without `describe` nothing but the verdict is asked for

  const model::SynthesisOptions& choices() const { return inequalities.design().synthesis; }
};

/// What is asked.
struct Question {
  lmi::Goal goal = lmi::Goal::objective;
  lmi::GainBounds bounds;  ///< none: gains of any size
  Effort effort;
  double shift = 0;      ///< objective: what strict blocks keep, in balanced units
  bool largest = false;  ///< interior: the largest margin itself, not any that is enough
};

/// What came of it: why the solver stopped (solution), how good its point is (margins), and what
/// its multipliers exclude (refutation). They are never mixed: a point that is good enough counts
/// however the iteration stopped.
struct Attempt {
  Question question;
  lmi::Formulation formulation;
  sdp::Solution solution;
  /// Every block is positive definite at x, as evaluated in double, and the bounds asked are kept.
  bool point = false;
  std::vector<double> x;     ///< the unknowns
  verdict::Margins margins;  ///< at x, of a point
  /// Of an interior question without bounds and without a point.
  std::optional<verdict::Refutation> refutation;
  /// Of an interior question without a point: what its multipliers leave for the blocks as they
  /// were solved, gain bounds and corners of boxes included (verdict/relaxed_backward_error.h).
  double relaxed_backward_error = 1;
  /// Whether its multipliers would have led further with more work (base/stop.h).
  bool out_of_allowance = false;
  /// Made by facial reduction (facial_reduction.h): the solution says nothing of margins there.
  bool on_face = false;
  /// Of a facial reduction that excludes every solution: the exact steps, as text. Where
  /// one step was enough, the refutation has its multipliers.
  std::string chain;
  /// Of those that lead to a face, but to no point on it: what is known.
  std::string left_open;
  /// Of a minimum that is only approached, as unknowns grow without end (blended()).
  bool approached = false;
  /// On a face: no solution has an objective below it, and what the solver found.
  std::optional<double> least, reached;
  bool unbounded = false;  ///< on a face the solver finds no least objective
  /// Of a point that was found without the gain bounds of the problem: its largest gain.
  double largest_gain = 0;
  double reached_gain = 0;  ///< the same as the bound measures it (lmi::GainBounds)

  bool is_optimal() const { return solution.status == sdp::Status::optimal; }
  bool is_near_optimal() const { return design::is_near_optimal(solution); }
  /// Every inequality holds at the decimals of x: a yes.
  bool holds() const { return point && verdict::all_hold(margins); }
  /// No x satisfies the inequalities.
  bool refuted() const;
  /// No x satisfies the blocks as they were solved, up to rounding.
  bool relaxation_refuted() const;
};

/// Pure: the same question of the same blocks has the same answer.
Attempt attempt(const Posed& posed, Question question, const Solve& solve);

/// A point between the minimum and a point inside: x(e) = x* + e (x_f - x*) with the smallest
///   e = 1e-12, 1e-11, ... for which every inequality holds: B(x(e)) >= e B(x_f) + (1 - e) B(x*).
/// The attempt of the minimum with that point. Where there is no such e below 1, x* is the minimum
/// over unknowns up to 1000 times those of x_f: the infimum is only approached, as they grow
/// without end.
std::optional<Attempt> blended(const Posed& posed, const Attempt& minimum, const Attempt& inside,
                               const Solve& solve);

/// The point between them whose objective is 1e-8 of itself above that of the minimum's point,
/// where every inequality holds there. What fails between the points of an exchange then fails by
/// so little that more points would not change the optimum.
std::optional<Attempt> near_minimum(const Posed& posed, const Attempt& minimum,
                                    const Attempt& inside);

}  // namespace gainsmith::design
