#include "ode/integrator.h"

#include <optional>
#include <utility>

#include "ode/explicit_steps.h"
#include "ode/guarded_rate.h"
#include "ode/implicit_steps.h"

namespace gainsmith::ode {

class Integrator::Methods {
 public:
  Methods(Eigen::Index size, Rate rate) : rate_(size, std::move(rate)), explicit_(rate_) {}

  void start(double t, const Eigen::VectorXd& x, double last, double relative,
             const Eigen::VectorXd& absolute, double longest) {
    last_ = last;
    relative_ = relative;
    absolute_ = absolute;
    longest_ = longest;
    t_ = t;
    rate_.begin(t, x, last);
    if (next_is_implicit_)
      start_implicit(x);
    else
      explicit_.start(t, x, last, relative, absolute, longest);
    is_implicit_ = next_is_implicit_;
  }

  Step step() {
    rate_.forget_trouble();
    const double from = t_;
    if (next_is_implicit_ && !is_implicit_) start_implicit(explicit_.x());
    if (!is_implicit_) {
      const auto result = explicit_.step();
      t_ = explicit_.t();
      next_is_implicit_ = result != ExplicitSteps::Result::made;
      if (result != ExplicitSteps::Result::failed) return {from, t_, ExplicitSteps::kDegree};
      // An implicit step leaps over a pole, and over where f has no value.
      if (rate_.has_escaped(t_, explicit_.x(), explicit_.slope())) fail(true);
      if (!rate_.trouble().empty()) fail(false);
      start_implicit(explicit_.x());
    }
    const bool made = implicit_->step();
    t_ = implicit_->t();
    if (!made) fail(rate_.trouble().empty() && implicit_->has_escaped());
    return {from, t_, implicit_->degree()};
  }

  void within(double t, Eigen::VectorXd& x) const {
    is_implicit_ ? implicit_->within(t, x) : explicit_.within(t, x);
  }

 private:
  void start_implicit(const Eigen::VectorXd& x) {
    if (!implicit_) implicit_.emplace(rate_);
    implicit_->start(t_, x, last_, relative_, absolute_, longest_);
    is_implicit_ = next_is_implicit_ = true;
  }

  [[noreturn]] void fail(bool escaped) const {
    const std::string& trouble = rate_.trouble();
    const std::string why = escaped           ? "the flow escapes"
                            : trouble.empty() ? "the steps of the integration fall to nothing"
                                              : trouble;
    throw IntegrationError(why, t_, escaped, !escaped && !trouble.empty());
  }

  GuardedRate rate_;
  ExplicitSteps explicit_;
  std::optional<ImplicitSteps> implicit_;
  bool is_implicit_ = false;  ///< the last step
  bool next_is_implicit_ = false;
  double t_ = 0, last_ = 0, relative_ = 0, longest_ = 0;
  Eigen::VectorXd absolute_;
};

Integrator::Integrator(Eigen::Index size, Rate rate)
    : methods_(size > 0 ? std::make_unique<Methods>(size, std::move(rate)) : nullptr) {}
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator& Integrator::operator=(Integrator&&) noexcept = default;
Integrator::~Integrator() = default;

void Integrator::start(double t, const Eigen::VectorXd& x, double last, double relative,
                       const Eigen::VectorXd& absolute, double longest) {
  last_ = last;
  t_ = t;
  if (methods_) methods_->start(t, x, last, relative, absolute, longest);
}

Integrator::Step Integrator::step() {
  if (methods_) return methods_->step();
  return {std::exchange(t_, last_), last_, 0};
}

void Integrator::within(double t, Eigen::VectorXd& x) {
  if (methods_) methods_->within(t, x);
}

}  // namespace gainsmith::ode
