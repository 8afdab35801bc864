// Costs along a run that has been made.
//
//   c(t) = int_0^t q(x(s)) ds + sum of g(x) before each jump
//
// Before a jump is what its maps see: noise of its event is drawn anew already. The integrals are
// quadratures over the dense output: on the smooth parts of a step (smooth_parts.h) q is a
// sum of Chebyshev polynomials, and its integral one of a degree more. So a cost changes neither
// the steps of a flow nor whether it is exact.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "claims/run_values.h"
#include "hybrid/trajectory.h"

namespace gainsmith::claims {

/// A cost of a run: the programs of q and g, and the element of the variables that holds c.
struct RunCost {
  Eigen::Index element = 0;
  std::optional<expr::Program> flow, jump;  ///< none: 0
};

/// One for each thread. Costs, layout and constants must outlive it.
class RunCosts {
 public:
  RunCosts(const std::vector<RunCost>& costs, const hybrid::StateLayout& layout,
           const numbers::Values& constants);

  /// Writes c to its element, in all flows and jumps of a run. Where q or g has no value c is not a
  /// number from there on. `moved`: c is moved by what the quadrature may be off, so that the
  /// difference of the two runs shows it.
  void add_to(hybrid::Trajectory& run, bool moved);

 private:
  /// One cost: the element of c, q, g, and c so far.
  struct Integral {
    Eigen::Index element;
    std::optional<RunValue> rate, jump;
    double total = 0;
  };

  void add_to(hybrid::FlowPiece& flow, bool moved);
  static void add_to(std::vector<hybrid::DenseStep>& steps, Integral& integral, bool moved);

  std::vector<Integral> integrals_;
};

}  // namespace gainsmith::claims
