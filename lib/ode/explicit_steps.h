// Steps of the method of order 8 of Dormand and Prince (dormand_prince.h), each with a polynomial
// of order 7 within.
//
//   k_i = f(t + c_i h, x + h sum_{j<i} a_ij k_j),   x(t + h) = x + h sum_j b_j k_j
//
// The error at the end of a step is estimated by the embedded methods of orders 5 and 3,
//   e = h |e5|^2 / sqrt(|e5|^2 + 0.01 |e3|^2),
// in the root mean square of elements over what is allowed (Hairer, Norsett & Wanner, II.10). That
// of the polynomial is estimated by what its rate is off from f at one place.
#pragma once

#include <Eigen/Core>

#include "ode/guarded_rate.h"

namespace gainsmith::ode {

class ExplicitSteps {
 public:
  enum class Result {
    made,
    /// Made; but what decays fast, or noise of f, keeps the steps short, and not the error.
    stiff,
    failed  ///< no step is short enough
  };
  static constexpr int kDegree = 7;

  /// `rate` must outlive it.
  explicit ExplicitSteps(GuardedRate& rate);

  /// As Integrator::start, after GuardedRate::begin. Evaluates nothing.
  void start(double t, const Eigen::VectorXd& x, double last, double relative,
             const Eigen::VectorXd& absolute, double longest);
  /// The next step, accepted by both errors. After `failed` t() and x() are as before.
  Result step();

  double t() const { return t_; }
  const Eigen::VectorXd& x() const { return x_; }
  Eigen::VectorXd slope() const { return k_.col(0); }
  /// x at a time of the last step, or at the start.
  void within(double t, Eigen::VectorXd& x) const;

 private:
  using Stages = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;

  /// The length of the first step: 0.3 of the least max(|x_i/x_i'|, |x_i'/x_i''|) of the elements,
  /// within what is left and `longest`.
  double first_length();
  /// Stages 2 to 13 of a step of length h, and its end. False: f has no value.
  bool try_step(double h);
  /// Stages 14 to 16, and the polynomial.
  bool try_inner(double h);
  struct Error {
    double part = 0;        ///< of what is allowed
    bool is_noise = false;  ///< both embedded methods err alike, whatever their orders
  };
  Error error(double h) const;
  /// Of the polynomial, as a part of what is allowed.
  double inner_error(double h);
  /// What an error of each element counts as, between x and `other`: a_i + r max(|x_i|, |other_i|).
  Eigen::ArrayXd allowed(const Eigen::VectorXd& other) const;
  /// Whether stability or noise, and not the error, has kept the last steps short.
  bool is_kept_short(double h, bool by_noise);

  GuardedRate* rate_;
  Stages k_;                     ///< n x 16
  Eigen::VectorXd x_;            ///< now
  Eigen::VectorXd at_;           ///< of a stage
  Eigen::VectorXd next_;         ///< at the end of the step
  Eigen::VectorXd before_next_;  ///< of stage 12, which is at the same time
  Eigen::VectorXd absolute_;
  Stages terms_;  ///< n x 8: of the polynomial
  double from_ = 0, t_ = 0, last_ = 0, relative_ = 0, longest_ = 0;
  double h_ = 0;              ///< of the next step
  bool forgives_ = false;     ///< in this step all elements may err alike
  bool has_first_ = false;    ///< whether stage 1 of the next step is known
  int short_ = 0, free_ = 0;  ///< steps in a row that seem stiff, and those after them that do not
};

}  // namespace gainsmith::ode
