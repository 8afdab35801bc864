#include "hybrid/initial.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "base/number.h"
#include "hybrid/tolerances.h"

namespace gainsmith::hybrid {

void read_ellipsoid(StartRule& rule, const std::string& state) {
  const numbers::Matrix Q = rule.values[1];
  const numbers::Matrix levels = rule.values[2];
  const double level = levels.reshaped().tail(1)(0), least = levels.size() > 1 ? levels(0) : 0;
  const auto fail = [&](const std::string& why) {
    throw InputError(rule.place, "the ellipsoid of " + state + ": " + why);
  };
  const double size = Q.size() > 0 ? Q.cwiseAbs().maxCoeff() : 0;
  const double asymmetry = Q.size() > 0 ? (Q - Q.transpose()).cwiseAbs().maxCoeff() : 0;
  if (asymmetry > kMeantEqual * size) fail("its matrix is not symmetric");
  if (!(level >= 0 && std::isfinite(level)))
    fail("its level is " + brief(level) + ": expected a number from 0 on");
  if (!(least >= 0 && least <= level))
    fail("its levels are " + brief(least) + " and " + brief(level) +
         ": expected [low, high], with 0 <= low <= high");
  const Eigen::LLT<numbers::Matrix> factors((Q + Q.transpose()) / 2);
  if (!Q.allFinite() || factors.info() != Eigen::Success)
    fail("its matrix is not positive definite");
  const numbers::Matrix unit = numbers::Matrix::Identity(Q.rows(), Q.cols());
  rule.values = {rule.values[0], std::sqrt(level) * factors.matrixU().solve(unit)};
  // The share of the volume inside the lower level: (sqrt(r0/r))^n in n dimensions.
  if (least > 0) rule.hollow = std::pow(least / level, static_cast<double>(Q.rows()) / 2);
}

Eigen::VectorXd in_shell(const StartRule& rule, const Eigen::VectorXd& b) {
  if (rule.hollow <= 0) return b;
  const double length = b.norm(), n = static_cast<double>(b.size());
  // The radius rho is uniform in rho^n on [hollow, 1]. So the density stays uniform in the shell.
  const double moved = std::pow(rule.hollow + (1 - rule.hollow) * std::pow(length, n), 1 / n);
  return length > 0 ? Eigen::VectorXd(b * (moved / length))
                    : Eigen::VectorXd(moved * Eigen::VectorXd::Unit(b.size(), 0));
}

numbers::Matrix spread_map(const numbers::Matrix& spread, bool covariance, Eigen::Index size,
                           const std::string& what, const Place& place) {
  if (!covariance) {
    if (!(spread.array() >= 0).all() || !spread.allFinite())
      throw InputError(place, "the deviation of " + what + " is negative or not finite");
    if (spread.size() == 1) return spread(0, 0) * numbers::Matrix::Identity(size, size);
    return spread.reshaped().asDiagonal();
  }
  // Cholesky: M_ij = (V_ij - sum_(k<j) M_ik M_jk) / M_jj, without pivoting, so that M stays lower
  // triangular.
  numbers::Matrix M = numbers::Matrix::Zero(size, size);
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index i = j; i < size; ++i) {
      double left = spread(i, j);
      for (Eigen::Index k = 0; k < j; ++k) left -= M(i, k) * M(j, k);
      if (i > j && M(j, j) > 0) M(i, j) = left / M(j, j);
      if (i == j && left > kTermRounding * spread(j, j)) M(j, j) = std::sqrt(left);
    }
  // |(M M' - V)_ij| <= kMeantEqual s_i s_j, s the deviations; this does not depend on units.
  const Eigen::VectorXd deviation = spread.diagonal().cwiseAbs().cwiseSqrt();
  const double least = size > 0 ? kTermRounding * spread.cwiseAbs().maxCoeff() : 0;
  const auto rounding = kMeantEqual * (deviation * deviation.transpose()).array() + least;
  if (!((M * M.transpose() - spread).array().abs() <= rounding).all())
    throw InputError(place,
                     "the covariance of " + what + " is not symmetric and positive semidefinite");
  return M;
}

/// Box & Muller 1958, the cosine alone: every number takes two draws, so that draws have fixed
/// places.
Eigen::VectorXd draw_normal(Eigen::Index n, RandomStream& random) {
  Eigen::VectorXd z(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double u = random.uniform();
    z(k) = std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * random.uniform());
  }
  return z;
}

numbers::Matrix around(const numbers::Matrix& center, const numbers::Matrix& M,
                       const Eigen::VectorXd& z, bool is_lognormal) {
  const numbers::Matrix away = (M * z).reshaped(center.rows(), center.cols());
  if (is_lognormal) return center.cwiseProduct(numbers::Matrix(away.array().exp()));
  return center + away;
}

numbers::Matrix draw_around(const StartRule& rule, RandomStream& random) {
  const Eigen::Index n = rule.values[0].size();
  Eigen::VectorXd z = draw_normal(n, random);
  if (rule.kind == model::StartKind::ellipsoid) {
    const double u = random.uniform();
    const double length = z.norm();
    if (length > 0) z *= std::pow(u, 1 / static_cast<double>(n)) / length;
    z = in_shell(rule, z);
  }
  return around(rule.values[0], rule.values[1], z, rule.kind == model::StartKind::lognormal);
}

}  // namespace gainsmith::hybrid
