#include <algorithm>
#include <cmath>

#include "ode/chebyshev.h"
#include "simulate/flow.h"
#include "simulate/run_end.h"
#include "simulate/tolerances.h"

namespace gainsmith::simulate {

namespace {

/// Of the polynomials, as many as the steps have stages.
constexpr int kDegree = 16;

/// The terms of a step of length h go like h^16. The next length is 0.9 h terms^(-1/16) times the
/// share, at most twice h. A step whose terms are above 1 is taken again.
class Flow31 : public Flow {
 public:
  Flow31(VectorField& field, State31& state, double longest, double share)
      : field_(&field),
        state_(&state),
        longest_(longest),
        share_(share),
        wanted_(share * longest),
        most_(k31Steps / std::max<std::int64_t>(field.size() / 10, 1)) {}

  void start(double t, const Eigen::VectorXd& values, double last) override {
    t_ = t;
    last_ = last;
    state_->begin_flow(*field_, values);
  }

  hybrid::DenseStep next() override {
    const double from = t_;
    for (int k = 0; k < kMostTries; ++k) {
      if (++steps_ > most_) break;
      const double rest = last_ - from;
      // Two last steps of equal length, in place of a long one and a tiny one.
      const double length = wanted_ >= rest ? rest : std::min(wanted_, rest / 2);
      t_ = length == rest ? last_ : from + length;
      const double terms = state_->step(t_);
      const double factor = 0.9 * share_ * std::pow(terms, -1.0 / kDegree);
      if (terms <= 1) {
        if (length == wanted_ || factor < 1)
          wanted_ = std::min(share_ * longest_, length * std::clamp(factor, 0.3, 2.0));
        return dense(from);
      }
      wanted_ = length * (std::isfinite(terms) ? std::clamp(factor, 0.1, 0.8) : 0.4);
    }
    throw RunEnd(hybrid::Ending::lost, "its steps in 31 digits are too many");
  }

  void arrive(double t) override {
    t_ = t;
    state_->arrive(t);
  }

 private:
  /// Of one step.
  static constexpr int kMostTries = 100;

  /// The polynomial of degree 16 in double, of what changes since the start: so its rounding is
  /// small.
  hybrid::DenseStep dense(double from) const {
    const Eigen::VectorXd& points = ode::chebyshev::points(kDegree);
    const numbers::Matrix all = state_->along((points.array() + 1) / 2);
    numbers::Matrix values(field_->size(), points.size());
    for (Eigen::Index k = 0; k < points.size(); ++k) values.col(k) = field_->gathered(all.col(k));
    const Eigen::VectorXd start = values.col(0);
    values.colwise() -= start;
    numbers::Matrix series = ode::chebyshev::coefficients(values);
    series.col(0) += start;
    return field_->step(from, t_, series);
  }

  VectorField* field_;
  State31* state_;
  double longest_, share_;
  double wanted_;  ///< length of the next step
  double t_ = 0, last_ = 0;
  std::int64_t steps_ = 0, most_;
};

}  // namespace

std::unique_ptr<Flow> flow_31(VectorField& field, State31& state, double longest, double share) {
  return std::make_unique<Flow31>(field, state, longest, share);
}

}  // namespace gainsmith::simulate
