// From affine blocks to a semidefinite program that means what an engineer asks, and back.
//
// Scales. Each block k has a scale s_k: the larger of its constant data and of kappa times its
// coefficients, where kappa is the smallest ratio constant/coefficient among the blocks (the size
// of the unknowns that the data set); all points of one inequality share the largest. The program
// is written in x/kappa and B/kappa (kappa = 1 when homogeneous): multiplying all constant parts by a
// number multiplies all scales by it and leaves the program as it is.
//
// Which program is solved:
//   bounded objective   some block has constant data, and there is an objective:
//                         minimise c'x,  B_k(x) >= margin s_k I (strict),  B_k(x) >= 0 (else)
//   normalised objective   all blocks are homogeneous: x can be scaled, so strict blocks are
//                         B_k(x) >= c_k I with c_k the size of the coefficients; x = 0 never counts
//   homogeneous feasibility   no objective, homogeneous:
//                         minimise r,  B_k(x) >= c_k I (strict),  B_k(x) >= 0,  -r <= x_i <= r;
//                       1/r is the largest margin relative to the size of x
//   feasibility         no objective, constant data:
//                         maximise t <= 1,  B_k(x) >= t s_k I (strict),  B_k(x) >= 0,  |x_i| <=
//                         limit;
//                       feasible when t >= margin; otherwise the program at t = margin is solved
//                       for a certificate
#pragma once

#include <optional>
#include <vector>

#include "lmi/compile.h"
#include "lmi/gain_bounds.h"
#include "lmi/release.h"
#include "sdp/problem.h"
#include "sdp/solution.h"

namespace gainsmith::lmi {

enum class Goal {
  bounded_objective,
  normalised_objective,
  homogeneous_feasibility,
  feasibility,
  certificate  ///< `feasibility` with t fixed at the margin
};

struct Formulation {
  Goal goal = Goal::bounded_objective;
  double margin = 0;           ///< as asked for
  double unit = 1;             ///< kappa: x = unit times the program's variables
  std::vector<double> scales;  ///< s_k, or c_k when homogeneous; one a block of the Lmi
  sdp::Problem problem;  ///< its first blocks are those of the Lmi, then the gain bounds, then
                         ///< limits on x
  std::vector<double> shifts;  ///< what B_k(x) must keep: margin and back-off, in the data's units
  Releases releases;           ///< scalars left out, and the rows of each block that stay

  bool homogeneous() const {
    return goal == Goal::normalised_objective || goal == Goal::homogeneous_feasibility;
  }
  /// What strict blocks keep, in units of their scale.
  double strict_margin() const { return homogeneous() ? 1.0 : margin; }
};

/// The goal that the Lmi asks for; a bound with constant data makes it inhomogeneous.
Goal goal_of(const Lmi& lmi, const GainBounds& bounds);

/// `backoff`, relative to the scales, is kept in every inequality beyond its margin: a second
/// attempt when the solver's own tolerance left one of them short.
Formulation formulate(const Lmi& lmi, const GainBounds& bounds,
                      const model::SynthesisOptions& options, Goal goal, double backoff = 0);

/// The scalars x of the Lmi from the solution (the program has more variables: those of the gain
/// bounds and of the goal), released ones restored.
std::vector<double> read_back(const Lmi& lmi, const Formulation& formulation,
                              const sdp::Solution& solution);

/// A lower bound on the objective without margins: weak duality with the dual solution Y,
///   c'x >= F_0(margin 0) . Y   for every x that satisfies the inequalities.
double objective_lower_bound(const Lmi& lmi, const Formulation& formulation,
                             const sdp::Solution& solution);

/// The multiplier matrices of a certificate by the name and point of their block.
model::NamedMatrices multipliers(const Lmi& lmi, const GainBounds& bounds,
                                 const Formulation& formulation, const sdp::Solution& solution);

/// tr(Y) of an inequality at each of its points, over all its comparisons and vertices of
/// polytopes.
std::vector<double> multiplier_sizes(const Lmi& lmi, const Formulation& formulation,
                                     const sdp::Solution& solution, const std::string& inequality,
                                     std::size_t points);

}  // namespace gainsmith::lmi
