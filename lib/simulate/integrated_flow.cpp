#include "simulate/integrated_flow.h"

#include <algorithm>
#include <cmath>

#include "ode/chebyshev.h"
#include "ode/integrator.h"

namespace gainsmith::simulate {

namespace {

class IntegratedFlow : public Flow {
 public:
  IntegratedFlow(VectorField& field, const Accuracy& accuracy, double longest)
      : field_(&field),
        accuracy_(accuracy),
        longest_(longest),
        integrator_(field.size(), [&field](double t, const Eigen::VectorXd& y,
                                           Eigen::VectorXd& rate) { field.rate(t, y, rate); }) {}

  void start(double t, const Eigen::VectorXd& values, double last) override {
    t_ = t;
    last_ = last;
    y_ = field_->gathered(values);
    instant_ = last - t <= hybrid::kOneInstant * std::max(std::abs(t), std::abs(last));
    if (instant_) return;
    const Eigen::VectorXd absolute = accuracy_.absolute_of.size() > 0
                                         ? field_->gathered(accuracy_.absolute_of)
                                         : Eigen::VectorXd::Constant(y_.size(), accuracy_.absolute);
    integrator_.start(t, y_, last, accuracy_.relative, absolute * part_,
                      accuracy_.longest * std::min(longest_, last - t));
  }

  void sharpen(double part) override { part_ = part; }

  hybrid::DenseStep next() override {
    if (instant_) return straight();
    const ode::Integrator::Step step = integrator_.step();
    const Eigen::VectorXd& points = ode::chebyshev::points(step.degree);
    numbers::Matrix values(y_.size(), points.size());
    for (Eigen::Index k = 0; k < points.size(); ++k) {
      integrator_.within(ode::chebyshev::outer(points(k), step.from, step.to), y_);
      values.col(k) = y_;
    }
    // Of a short step what changes is small beside the values, and so is then its rounding.
    const Eigen::VectorXd start = values.col(0);
    values.colwise() -= start;
    numbers::Matrix series = ode::chebyshev::coefficients(values);
    series.col(0) += start;
    return field_->step(step.from, step.to, series);
  }

 private:
  /// Along the tangent, over what is too short for steps.
  hybrid::DenseStep straight() {
    Eigen::VectorXd rate(y_.size());
    field_->rate(t_, y_, rate);
    numbers::Matrix series(y_.size(), 2);
    series.col(1) = rate * ((last_ - t_) / 2);
    series.col(0) = y_ + series.col(1);
    return field_->step(t_, last_, series);
  }

  VectorField* field_;
  Accuracy accuracy_;
  double longest_;
  double part_ = 1;
  double t_ = 0, last_ = 0;
  bool instant_ = false;  ///< from t_ to last_
  ode::Integrator integrator_;
  Eigen::VectorXd y_;
};

}  // namespace

std::unique_ptr<Flow> integrated_flow(VectorField& field, const Accuracy& accuracy,
                                      double longest) {
  return std::make_unique<IntegratedFlow>(field, accuracy, longest);
}

}  // namespace gainsmith::simulate
