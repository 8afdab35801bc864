#include "hybrid/initial.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "base/number.h"
#include "hybrid/tolerances.h"

namespace gainsmith::hybrid {

void read_ellipsoid(StartRule& rule, const std::string& state) {
  const numbers::Matrix Q = rule.values[1];
  const double level = rule.values[2](0, 0);
  const auto fail = [&](const std::string& why) {
    throw InputError(rule.place, "the ellipsoid of " + state + ": " + why);
  };
  const double size = Q.size() > 0 ? Q.cwiseAbs().maxCoeff() : 0;
  const double asymmetry = Q.size() > 0 ? (Q - Q.transpose()).cwiseAbs().maxCoeff() : 0;
  if (asymmetry > kMeantEqual * size) fail("its matrix is not symmetric");
  if (!(level >= 0 && std::isfinite(level)))
    fail("its level is " + brief(level) + ": expected a number from 0 on");
  const Eigen::LLT<numbers::Matrix> factors((Q + Q.transpose()) / 2);
  if (!Q.allFinite() || factors.info() != Eigen::Success)
    fail("its matrix is not positive definite");
  const numbers::Matrix unit = numbers::Matrix::Identity(Q.rows(), Q.cols());
  rule.values = {rule.values[0], std::sqrt(level) * factors.matrixU().solve(unit)};
}

Eigen::VectorXd draw_ellipsoid(const StartRule& rule, RandomStream& random) {
  const Eigen::Index n = rule.values[0].size();
  Eigen::VectorXd z(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double u = random.uniform();
    z(k) = std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * random.uniform());
  }
  const double u = random.uniform();
  const double length = z.norm();
  if (length > 0) z *= std::pow(u, 1 / static_cast<double>(n)) / length;
  return rule.values[0].col(0) + rule.values[1] * z;
}

}  // namespace gainsmith::hybrid
