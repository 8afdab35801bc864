// Internal to the judge (judge.h): one recorded step of a flow, integrated again.
//
// The method is the implicit one of Gauss with four stages, of order 8 (ode/gauss.h). Two half
// steps are tried first. If they disagree with the record, the number of steps doubles, up to
// kMostParts, until the result settles.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "hybrid/trajectory.h"
#include "judge/texts.h"
#include "ode/gauss.h"

namespace gainsmith::judge {

/// What of all elements moves in a flow.
struct MovingElements {
  std::vector<Eigen::Index> active;  ///< along a text
  Eigen::VectorXd clocks;            ///< the rate of each element that is a clock, else 0
};

class StepAgain {
 public:
  /// The values of the active elements at the quarters of the step: one column each.
  using Quarters = numbers::Matrix;

  /// All elements are `x` at the start of the step. `allowed`: of each active element; what is
  /// found is certain to a tenth of it. All must outlive it.
  StepAgain(Texts& texts, const MovingElements& moving, const hybrid::DenseStep& step,
            const Eigen::VectorXd& x, const Eigen::VectorXd& allowed);
  StepAgain(const StepAgain&) = delete;  // its integrator points to it
  StepAgain& operator=(const StepAgain&) = delete;

  /// None where no method comes to an end.
  std::optional<Quarters> operator()();

 private:
  /// Two half steps, and a quarter step from the start of each.
  std::optional<Quarters> halves();
  /// In ever more Gauss steps, until they change nothing by a tenth of what is allowed.
  std::optional<Quarters> settled(std::optional<Quarters> coarse);
  /// In `count` Gauss steps, four or more.
  std::optional<Quarters> advance(int count);
  /// Of a step so short that nothing moves by more than a tenth of what is allowed. Next to a
  /// switch of the flow no method converges on it.
  std::optional<Quarters> straight();
  /// One Gauss step from (t, y) of length h. The recorded step is the first guess.
  std::optional<Eigen::VectorXd> gauss(double t, const Eigen::VectorXd& y, double h);
  /// The rates of the active elements at (t, y), with clocks moved on.
  void rate(double t, const Eigen::VectorXd& y, Eigen::VectorXd& out);
  /// Whether compiled programs say what the texts say at both ends of the step.
  bool is_compiled_right();
  Quarters recorded_quarters() const;
  Eigen::VectorXd recorded(double t) const { return (*step_)(t)(moving_->active); }

  Texts* texts_;
  const MovingElements* moving_;
  const hybrid::DenseStep* step_;
  const Eigen::VectorXd* x_;
  const Eigen::VectorXd* allowed_;
  double h_;
  bool compiled_ = false;  ///< rates are those of compiled programs
  Eigen::VectorXd all_, rates_;
  ode::GaussIntegrator gauss_;
};

}  // namespace gainsmith::judge
