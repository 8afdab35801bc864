// The flow of a system that is linear but for clocks, for all runs at once.
//
// Every flow begins with the clocks at the same values. With t the time since then, the other
// coordinates obey x' = M(t) x + b(t). Integrals of quadratic forms of them may be added, with
// c' = [x; 1]' Q(t) [x; 1]. Then
//
//   x(t) = Phi(t) [x(0); 1],   c(t) = c(0) + [x(0); 1]' W(t) [x(0); 1]
//
// for every run, with Phi' = M Phi + [0 b] and W' = [Phi; 0 1]' Q [Phi; 0 1]. They are integrated
// once over the longest interval (ode/integrator.h) and kept as Chebyshev series. Each piece of the
// interval is so short that its series has ended at the accuracy.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bounded/coordinates.h"
#include "bounded/flow_rate.h"
#include "bounded/sampled_system.h"
#include "numbers/matrix.h"

namespace gainsmith::bounded {

class ClockedFlow {
 public:
  /// The clocks when any flow begins, and 0 for all others; none when the system
  /// is not of this kind. `integrals`: the elements that are integrals, of quadratic forms all.
  static std::optional<Eigen::VectorXd> start_of(const SampledSystem& system,
                                                 const hybrid::Scenario& scenario,
                                                 const Coordinates& coordinates,
                                                 const numbers::Values& constants,
                                                 const std::vector<Eigen::Index>& integrals);

  /// To a relative accuracy, up to `longest`; no step is longer than `step` times half of a piece.
  /// IntegrationError where the flow ends before.
  ClockedFlow(const Coordinates& coordinates, const numbers::Values& constants,
              const Eigen::VectorXd& start, const std::vector<Eigen::Index>& integrals,
              double longest, double relative, double step);

  /// All elements at t, from those at the start of a flow; clocks stay as they are.
  void operator()(const Eigen::VectorXd& from, double t, Eigen::VectorXd& to) const;

  std::size_t pieces() const { return pieces_.size(); }

 private:
  struct Piece {
    double begin = 0, end = 0;
    numbers::Matrix series;  ///< entries x (degree + 1)
  };

  class Stack;

  Eigen::VectorXd sizes(const Eigen::VectorXd& stack, const Eigen::VectorXd& rate,
                        double longest) const;
  static numbers::Matrix series_of(const numbers::Matrix& at_points);

  std::vector<Eigen::Index> linear_;     ///< x: all elements but clocks and integrals
  std::vector<Eigen::Index> quadratic_;  ///< c
  std::vector<Piece> pieces_;
};

}  // namespace gainsmith::bounded
