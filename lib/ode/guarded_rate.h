// The right side of x' = f(t, x), whose exceptions and infinities become a text.
#pragma once

#include <Eigen/Core>
#include <string>

#include "ode/integrator.h"

namespace gainsmith::ode {

class GuardedRate {
 public:
  GuardedRate(Eigen::Index size, Integrator::Rate rate);

  Eigen::Index size() const { return slope_.size(); }
  /// A flow from x at t to `last`, after which f is not evaluated.
  void begin(double t, const Eigen::VectorXd& x, double last);
  /// False: f has no value there, and trouble() says why.
  bool at(double t, const Eigen::VectorXd& x, double* slope);

  /// Why f had no value, the last time that it had none; empty: it had one since forget_trouble().
  const std::string& trouble() const { return trouble_; }
  void forget_trouble() { trouble_.clear(); }
  /// Whether x has grown, and at this rate would go on to grow in the time that is left:
  ///   |x| > kEscape size,  (last - t) |slope| > kEscape |x|   in the largest element.
  bool has_escaped(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& slope) const;

 private:
  Integrator::Rate rate_;
  Eigen::VectorXd slope_;  ///< as f writes it
  std::string trouble_;
  double last_ = 0;
  /// Of x at the start, and of what the flow does in all its time at its first rate.
  double size_ = 0;
};

}  // namespace gainsmith::ode
