#include "verify/text_rounding.h"

#include <cmath>

#include "base/error.h"

namespace gainsmith::verify {

hybrid::BallsOf<double> rounded_once(const numbers::Values& constants) {
  const auto error = [](double x) {
    return std::rint(x) == x ? 0 : hybrid::unit_roundoff<double>() * std::abs(x);
  };
  hybrid::BallsOf<double> balls;
  for (const auto& [name, value] : constants)
    balls.emplace(name, hybrid::Ball<double>{value, value.unaryExpr(error)});
  return balls;
}

TextRounding::TextRounding(const expr::Program& program, const hybrid::StateLayout& layout,
                           const hybrid::BallsOf<double>& constants)
    : function_(program, layout, constants), exact_(Eigen::VectorXd::Zero(layout.size)) {}

double TextRounding::operator()(const Eigen::VectorXd& x) {
  try {
    const double radius = function_(x.head(exact_.size()), exact_, 0, 0).rad(0);
    return std::isfinite(radius) ? radius : 0;
  } catch (const InputError&) {
    return 0;
  }
}

}  // namespace gainsmith::verify
