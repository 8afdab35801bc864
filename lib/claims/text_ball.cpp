#include "claims/text_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "claims/tolerances.h"

namespace gainsmith::claims {

using Eigen::Index;
using Eigen::VectorXd;

bounded::BallsOf<double> rounded_once(const numbers::Values& constants) {
  const auto error = [](double x) {
    return std::rint(x) == x ? 0 : bounded::unit_roundoff<double>() * std::abs(x);
  };
  bounded::BallsOf<double> balls;
  for (const auto& [name, value] : constants)
    balls.emplace(name, bounded::Ball<double>{value, value.unaryExpr(error)});
  return balls;
}

TextBall::TextBall(const expr::Program& program, RunValue& value, const hybrid::StateLayout& layout,
                   const bounded::BallsOf<double>& constants)
    : value_(&value), function_(program, layout, constants), exact_(VectorXd::Zero(layout.size)) {
  for (const expr::Program* difference : value.differences())
    differences_.emplace_back(*difference, layout, constants);
}

double TextBall::rounding(const VectorXd& x) {
  try {
    const double radius = function_(x.head(exact_.size()), exact_, 0, 0).rad(0);
    return std::isfinite(radius) ? radius : 0;
  } catch (const InputError&) {
    return 0;
  }
}

bool TextBall::is_open(const VectorXd& x, const VectorXd& r) {
  for (std::size_t k = 0; k < differences_.size(); ++k)
    if (is_open(k, x, r)) return true;
  return false;
}

bool TextBall::is_open(std::size_t k, const VectorXd& x, const VectorXd& r) {
  const Index size = exact_.size();
  const double distance = value_->distance(k, x, r.head(size));
  if (distance > kFarBranch) return false;
  try {
    const bounded::Ball<double>& d = differences_[k](x.head(size), r.head(size), 0, 0);
    if (!d.rad.allFinite()) return true;
    return (d.mid.array().abs() <= d.rad.array() * bounded::kBoundSlack && d.rad.array() > 0).any();
  } catch (const InputError&) {
    return true;
  }
}

bounded::Bounded<double> TextBall::hull(const VectorXd& x, const VectorXd& r) {
  const Index size = exact_.size();
  try {
    const bounded::Ball<double>& ball = function_(x.head(size), r.head(size), 0, 0);
    return {ball.mid(0), ball.rad(0)};
  } catch (const InputError&) {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  }
}

}  // namespace gainsmith::claims
