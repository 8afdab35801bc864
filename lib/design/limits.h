// Why a minimum is no smaller: what each requirement, the bounds on gains and each scalar cost it.
//
// At a minimum of c'x subject to B_k(x) >= 0 with multipliers Y_k >= 0, weak duality says of every
// t >= 0: with B_k(x) + t I >= 0 in the place of B_k(x) >= 0
//   minimum(t) >= minimum(0) - t tr(Y_k),
// for small t nearly with equality. A requirement with Y = 0 costs nothing.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// The minimum of a changed problem.
struct Changed {
  std::optional<double> minimum;      ///< none: not found
  std::optional<double> lower_bound;  ///< of the minimum
  bool unbounded = false;             ///< there is none: the objective is unbounded below
  /// Nothing constant is left, so every solution may be scaled: the infimum is 0 or there is none.
  bool homogeneous = false;
};

/// A requirement that the minimum would be smaller without.
struct Limit {
  std::string name;
  /// Relaxed by t I, the inequality lowers the minimum by price t at most.
  double price = 0;  ///< sum of tr(Y) over its comparisons and points
  double scale = 0;  ///< of the inequality (elastic.h)
  /// Where its multipliers are, and their parts of the price, largest first; without variables
  /// empty.
  std::vector<std::pair<std::string, double>> points;
  std::optional<Changed> without;  ///< none: not examined
};

/// A scalar, and the minimum with another value of it, close to its own.
struct Influence {
  std::string name;
  double value = 0;
  double other = 0;
  Changed changed;
};

struct Limits {
  std::vector<Limit> active;          ///< in the order of the method
  std::vector<std::string> inactive;  ///< requirements that cost nothing
  /// The bounds on gains, where they cost something: the minimum with bounds ten times as large,
  /// and without any.
  std::optional<Changed> wider_gains, any_gains;
  std::vector<Influence> scalars;
};

/// Of gains with a verdict of yes and multipliers. What a stop left out is missing.
Limits find_limits(const model::Instance& instance, const model::Gains& gains,
                   const sdp::Options& solver);

/// The names of the scalar data and parameters that inequalities or the objective rest on.
std::vector<std::string> scalars_in_use(const model::Design& design);

}  // namespace gainsmith::design
