#include "response/state_space.h"

#include <cmath>
#include <complex>
#include <limits>

#include "numbers/dense/spectrum.h"

namespace gainsmith::response {

StateSpace state_space(const Matrix& whole, int states, double step) {
  const Eigen::Index n = states, m = whole.cols() - n, p = whole.rows() - n;
  return {whole.topLeftCorner(n, n), whole.topRightCorner(n, m), whole.bottomLeftCorner(p, n),
          whole.bottomRightCorner(p, m), step};
}

StateSpace in_units(StateSpace system, const std::vector<int>& exponents) {
  for (Eigen::Index i = 0; i < system.states(); ++i) {
    const double unit = std::ldexp(1.0, exponents[static_cast<std::size_t>(i)]);
    system.A.row(i) /= unit;
    system.A.col(i) *= unit;
    system.B.row(i) /= unit;
    system.C.col(i) *= unit;
  }
  return system;
}

Matrix poles(const StateSpace& system) {
  if (system.states() == 0) return Matrix(0, 2);
  return numbers::real_eigenvalues<double>(system.A);
}

bool is_stable(const StateSpace& system) {
  const Matrix all = poles(system);
  // What rounding alone may have moved to the inside.
  const double rounding =
      8 * static_cast<double>(all.rows()) * std::numeric_limits<double>::epsilon();
  for (Eigen::Index k = 0; k < all.rows(); ++k) {
    const double size = std::hypot(all(k, 0), all(k, 1));
    const bool inside =
        system.is_sampled() ? size < 1 - rounding : all(k, 0) < 0 && all(k, 0) <= -rounding * size;
    if (!inside) return false;
  }
  return true;
}

StateSpace with_unit_feedback(const StateSpace& loop) {
  const double through = 1 / (1 + loop.D(0, 0));
  return {loop.A - through * loop.B * loop.C, through * loop.B, through * loop.C, through * loop.D,
          loop.step};
}

Mode mode_of(double real, double imaginary, double step) {
  std::complex<double> s(real, imaginary);
  // A pole at z = 0 is gone after one step.
  if (step > 0 && s == 0.0) return {std::numeric_limits<double>::infinity(), 1};
  if (step > 0) s = std::log(s) / step;
  const double frequency = std::abs(s);
  return {frequency, frequency > 0 ? -s.real() / frequency : 1};
}

}  // namespace gainsmith::response
