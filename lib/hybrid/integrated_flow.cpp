#include <algorithm>
#include <cmath>

#include "hybrid/chebyshev.h"
#include "hybrid/flow.h"
#include "hybrid/integrator.h"

namespace gainsmith::hybrid {

namespace {

/// Of the time: a flow that CVODE does not begin.
constexpr double kInstant = 1e-14;

class IntegratedFlow : public Flow {
 public:
  IntegratedFlow(Movement& movement, const Accuracy& accuracy, double longest)
      : movement_(&movement),
        accuracy_(accuracy),
        longest_(longest),
        integrator_(movement.size(),
                    [&movement](double t, const Eigen::VectorXd& y, Eigen::VectorXd& rate) {
                      movement.rate(t, y, rate);
                    }) {}

  void start(double t, const Eigen::VectorXd& values, double last) override {
    t_ = t;
    last_ = last;
    y_ = movement_->gathered(values);
    instant_ = last - t <= kInstant * std::max(std::abs(t), std::abs(last));
    if (instant_) return;
    const Eigen::VectorXd absolute = accuracy_.absolute_of.size() > 0
                                         ? movement_->gathered(accuracy_.absolute_of)
                                         : Eigen::VectorXd::Constant(y_.size(), accuracy_.absolute);
    integrator_.start(t, y_, last, accuracy_.relative, absolute * part_, longest_);
  }

  void sharpen(double part) override { part_ = part; }

  DenseStep next() override {
    if (instant_) return straight();
    const Integrator::Step step = integrator_.step();
    const Eigen::VectorXd& points = chebyshev::points(step.degree);
    numbers::Matrix values(y_.size(), points.size());
    for (Eigen::Index k = 0; k < points.size(); ++k) {
      integrator_.within(chebyshev::outer(points(k), step.from, step.to), y_);
      values.col(k) = y_;
    }
    return movement_->step(step.from, step.to, chebyshev::coefficients(values));
  }

 private:
  /// Along the tangent, over what is too short for steps.
  DenseStep straight() {
    Eigen::VectorXd rate(y_.size());
    movement_->rate(t_, y_, rate);
    numbers::Matrix series(y_.size(), 2);
    series.col(1) = rate * ((last_ - t_) / 2);
    series.col(0) = y_ + series.col(1);
    return movement_->step(t_, last_, series);
  }

  Movement* movement_;
  Accuracy accuracy_;
  double longest_;
  double part_ = 1;
  double t_ = 0, last_ = 0;
  bool instant_ = false;  ///< from t_ to last_
  Integrator integrator_;
  Eigen::VectorXd y_;
};

}  // namespace

Accuracy Accuracy::times(double factor) const {
  constexpr double kLeast = 1e-13;
  return {std::max(relative * factor, kLeast), absolute * factor, absolute_of * factor};
}

std::unique_ptr<Flow> integrated_flow(Movement& movement, const Accuracy& accuracy,
                                      double longest) {
  return std::make_unique<IntegratedFlow>(movement, accuracy, longest);
}

}  // namespace gainsmith::hybrid
