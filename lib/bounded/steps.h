// The exact flow of x' = M x + b, cut into steps short enough to see everything that it does.
//
// A step of length s maps  x -> E(s) x + f(s),  [E f; 0 1] = expm(s [M b; 0 0]).  The lengths are
// s_k = s_0 2^k, k = 0 .. K, so each map is the square of the one before: one table serves every
// interval of every run. What is left of an interval below s_0 is stepped by the Taylor series of
// degree 12. Its remainder is below rounding because ||M||_1 s_0 <= 1/4.
//
//   s_K = min(longest/8, 1/w),  w = the largest |Im lambda| or Re lambda over the eigenvalues of M
//   K   = the smallest with ||M||_1 s_0 <= 1/4, at least 3
//
// An interval is cut as s_0, s_1, ..., s_{K-1}, then s_K while it fits. What is left follows in
// falling powers of two, and then the rest below s_0. Fast modes that decay live right behind a
// jump, and there the steps grow with the time since it. So each mode is resolved while it is
// alive, at the price of log2 of the stiffness and not of the stiffness itself.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hybrid/affine.h"
#include "numbers/matrix.h"

namespace gainsmith::bounded {

/// Degrees of series: what is left of one is a part of the bound of its error.
namespace degree {

/// Largest 1-norm of a matrix whose exponential is a series.
constexpr double norm = 0.25;

constexpr int wide_exponential = 80;   ///< in 100 digits, of a norm up to 1: below 1e-118
constexpr int wide_rest = 40;          ///< of what is left of an interval, in 100 digits
constexpr int short_exponential = 20;  ///< in long double: below 1e-31
constexpr int rest = 12;               ///< of what is left of an interval, in double
constexpr int shared_flow = 16;        ///< of Chebyshev polynomials over a piece of a flow

}  // namespace degree

/// One step of a flow. `level` is k of s_k, or kRest.
struct FlowStep {
  static constexpr int kRest = -1;
  int level = kRest;
  double length = 0;
};

class FlowSteps {
 public:
  /// `longest`: the longest interval to be cut, > 0. InputError, at `place`, when M or b is not
  /// finite or ||M||_1 longest exceeds 2^40.
  FlowSteps(const hybrid::AffineMap& flow, double longest, const Place& place = {});

  /// Appends the steps of an interval >= 0; their lengths add up to it. An interval of 0 has none.
  void cut(double interval, std::vector<FlowStep>& steps) const;

  /// x after a step.
  void advance(const FlowStep& step, const Eigen::Ref<const Eigen::VectorXd>& x,
               Eigen::Ref<Eigen::VectorXd> out) const;

  double shortest() const { return shortest_; }
  int levels() const { return static_cast<int>(maps_.size()); }

 private:
  numbers::Matrix taylor_terms(double length, const Eigen::Ref<const Eigen::VectorXd>& x) const;

  hybrid::AffineMap flow_;
  double shortest_ = 0;                  ///< s_0
  std::vector<hybrid::AffineMap> maps_;  ///< over s_k
};

}  // namespace gainsmith::bounded
