#include "sdp/core/residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/scalars.h"

namespace gainsmith::sdp {

template <typename T>
Residuals<T>::Residuals(const Problem& problem, const Presolved& presolved)
    : defect(presolved.data),
      presolved_(presolved),
      largest_c_(0),
      largest_f0_(0),
      norm_f0_(frobenius_norm(problem.f[0])),
      dual_unit_(0),
      products_(Vector<T>::Zero(presolved.data.m())) {
  for (const double c : problem.c) largest_c_ = std::max(largest_c_, std::abs(c));
  for (const Entry& e : problem.f[0]) largest_f0_ = std::max(largest_f0_, std::abs(e.value));
  const auto& scales = presolved.recovery.s;
  // From ||r_i gamma_c / s_i|| <= ||r|| gamma_c / min s_i.
  if (!scales.empty())
    dual_unit_ = (1 + largest_c_) * *std::min_element(scales.begin(), scales.end()) /
                 presolved.recovery.gamma_c;
}

template <typename T>
void Residuals<T>::update(const Iterate<T>& point) {
  const Data& data = presolved_.data;
  const Recovery& recovery = presolved_.recovery;
  Blocks<T>& primal = defect.primal;
  adjoint(data, point.x, point.tau, primal);
  primal.flat() -= point.X.flat();
  const T f0_y = apply(data, point.Y, products_);

  const double tau = static_cast<double>(point.tau);
  // With x_i = gamma_f s_i x'_i, c_i = gamma_c c'_i / s_i, Y = gamma_c Y' (presolve.h) objectives
  // have the unit gamma_c gamma_f, residuals of the dual equation i the unit gamma_c / s_i.
  const double unit = recovery.gamma_c * recovery.gamma_f / tau;
  T cx(0);
  double dual_square = 0, moved = 0, products = 0;
  for (int i = 0; i < data.m(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const T c = coefficient<T>(data.c[at], data.c_rest[at]);
    cx += point.x[i] * c;
    defect.dual[i] = point.tau * c - products_[i];
    const double r = static_cast<double>(defect.dual[i]);
    const double original = r * recovery.gamma_c / (recovery.s[at] * tau);
    dual_square += original * original;
    products += std::abs(static_cast<double>(products_[i])) * recovery.gamma_c / recovery.s[at];
    moved += std::abs(r * static_cast<double>(point.x[i]));
  }
  double primal_square = 0;
  for (int b = 0; b < data.layout.blocks(); ++b) {
    const double norm = static_cast<double>(primal.dense(b).norm());
    primal_square += norm * norm;
    moved += norm * static_cast<double>(point.Y.dense(b).norm());
  }
  for (int k = 0; k < data.layout.linear; ++k) {
    const double r = static_cast<double>(primal.linear()[k]);
    primal_square += r * r;
    moved += std::abs(r * static_cast<double>(point.Y.linear()[k]));
  }

  primal_objective = static_cast<double>(cx) * unit;
  dual_objective = static_cast<double>(f0_y) * unit;
  const double size = 1 + std::abs(primal_objective) + std::abs(dual_objective);
  gap = static_cast<double>(T(cx - f0_y)) * unit / size;
  complementarity = static_cast<double>(inner(point.X, point.Y)) * unit / tau / size;
  primal_infeasibility = std::sqrt(primal_square) * recovery.gamma_f / tau / (1 + largest_f0_);
  dual_infeasibility = std::sqrt(dual_square) / (1 + largest_c_);
  objective_error = moved * unit / tau / size;
  // Working F_i have norms from 1 to 2.
  const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
  primal_rounding = epsilon * static_cast<double>(point.x.template lpNorm<1>()) * recovery.gamma_f /
                    tau / (1 + largest_f0_);
  dual_rounding = epsilon * static_cast<double>(point.Y.flat().norm()) * recovery.gamma_c / tau /
                  (1 + largest_c_);

  const double none = std::numeric_limits<double>::infinity();
  // A*(x) = X + R + tau F_0 with X >= 0, so its negative part is within ||R|| + tau ||F_0||.
  const double ascent = dual_objective * tau, descent = -primal_objective * tau;
  primal_certificate = ascent > 0 ? products / ascent : none;
  dual_certificate =
      descent > 0 ? (std::sqrt(primal_square) * recovery.gamma_f + tau * norm_f0_) / descent : none;
}

template <typename T>
double Residuals<T>::worst() const {
  return std::max(
      {std::abs(gap), complementarity, primal_infeasibility, dual_infeasibility, objective_error});
}

#define GAINSMITH_INSTANTIATE(T) template class Residuals<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
