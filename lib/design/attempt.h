// One question to the solver and its answer.
#pragma once

#include <functional>
#include <vector>

#include "forall/plan.h"
#include "lmi/formulation.h"
#include "lmi/margins.h"

namespace gainsmith::design {

/// Solves a semidefinite program: sdp::solve with its options, or a script in a test.
using Solve = std::function<sdp::Solution(const sdp::Problem& problem)>;

/// Inequalities with the blocks that stand for them.
struct Posed {
  const lmi::Inequalities& inequalities;
  const forall::Plan& plan;
  const lmi::Lmi& lmi;

  const model::SynthesisOptions& choices() const { return inequalities.design().synthesis; }
};

/// What is asked.
struct Question {
  lmi::Goal goal = lmi::Goal::bounded_objective;
  lmi::GainBounds bounds;  ///< none: gains of any size
  double backoff = 0;      ///< see lmi::formulate
  bool recomputed = true;  ///< whether the margins of a point are wanted
};

/// What came of it: why the solver stopped, with its point or certificate (solution), and how good
/// the point is (margins). The two are never mixed.
struct Attempt {
  Question question;
  lmi::Formulation formulation;
  sdp::Solution solution;
  /// An optimal solution that leaves the margin that was asked for, as far as the solver knows.
  bool point = false;
  std::vector<double> x;  ///< the unknowns, of a point
  lmi::Margins margins;   ///< at x, recomputed; of a point

  bool is_optimal() const { return solution.status == sdp::Status::optimal; }
  /// A certificate counts when it was checked.
  bool is_infeasible() const {
    return solution.status == sdp::Status::primal_infeasible && solution.certificate.checked;
  }
  /// Of Goal::feasibility, when optimal.
  double largest_margin() const { return solution.x.back(); }
};

/// Pure: the same question of the same blocks has the same answer.
Attempt attempt(const Posed& posed, Question question, const Solve& solve);

/// Whether the recomputed margins of a point say yes: every inequality keeps its margin, and
/// nothing is open between the points of an exchange.
bool is_kept(const Attempt& attempt);

/// How much the worst inequality of a point is short of its margin, relative to its scale, when
/// that is no more than the solver's tolerance explains; 0 when none is, or when it is worse than
/// that.
double shortfall(const Attempt& attempt);

}  // namespace gainsmith::design
