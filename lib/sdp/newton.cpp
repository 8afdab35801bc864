#include "sdp/newton.h"

#include <algorithm>

#include "sdp/scalars.h"

namespace gainsmith::sdp {

template <typename T>
Newton<T>::Newton(const Data& data, unsigned threads)
    : data_(data),
      schur_(data, threads),
      factor_X_(data.layout),
      factor_Y_(data.layout),
      inverse_X_(data.layout),
      residual_term_(data.layout),
      correction_(data.layout),
      k_(data.layout),
      half_(data.layout),
      product_(data.layout),
      order_(static_cast<double>(data.layout.order() + 1)) {
  for (Vector<T>* v : {&a_, &q_, &p_, &z_, &u_, &h_, &c_}) v->setZero(data.m());
  for (int i = 0; i < data.m(); ++i) c_[i] = T(data.c[static_cast<std::size_t>(i)]);
}

template <typename T>
void Newton<T>::scaled_product(const Blocks<T>& left, const Blocks<T>& right, Blocks<T>& out) {
  for (int b = 0; b < data_.layout.blocks(); ++b) {
    auto half = half_.dense(b);
    auto product = product_.dense(b);
    half.noalias() = left.dense(b) * right.dense(b);
    product.noalias() = inverse_X_.dense(b) * half;
    out.dense(b) = T(0.5) * (product + product.transpose());
  }
  out.linear() = inverse_X_.linear().cwiseProduct(left.linear()).cwiseProduct(right.linear());
}

template <typename T>
bool Newton<T>::prepare(const Iterate<T>& point, const Residuals<T>& residuals) {
  if (!factor_X_.factorise(point.X) || !factor_Y_.factorise(point.Y)) return false;
  factor_X_.inverse(inverse_X_);
  schur_.assemble(inverse_X_, point.Y);
  if (!schur_.factorise()) return false;

  mu_ = point.mu();
  scaled_product(residuals.primal, point.Y, residual_term_);
  apply(data_, residual_term_, a_);
  q_ = residuals.dual - a_;
  schur_.solve(q_, p_);
  schur_.solve(c_, z_);
  r_y_ = inner(residuals.primal, point.Y);
  r_r_ = inner(residuals.primal, residual_term_);
  return true;
}

template <typename T>
void Newton<T>::predict(const Iterate<T>& point, const Residuals<T>& residuals,
                        Iterate<T>& direction) {
  correction_.flat().setZero();
  solve(point, residuals, T(0), T(1), T(0), T(0), direction);
}

template <typename T>
void Newton<T>::correct(const Iterate<T>& point, const Residuals<T>& residuals,
                        const Iterate<T>& predictor, const T& sigma, const T& eta,
                        Iterate<T>& direction) {
  scaled_product(predictor.X, predictor.Y, correction_);
  solve(point, residuals, sigma, eta, inner(predictor.X, predictor.Y),
        predictor.tau * predictor.kappa, direction);
}

template <typename T>
void Newton<T>::solve(const Iterate<T>& point, const Residuals<T>& residuals, const T& sigma,
                      const T& eta, const T& trace_c, const T& c_tau_kappa, Iterate<T>& direction) {
  const T target = sigma * mu_;
  k_.flat() = target * inverse_X_.flat() - point.Y.flat() - eta * residual_term_.flat() -
              correction_.flat();
  apply(data_, k_, h_);
  h_ -= eta * residuals.dual;
  schur_.solve(h_, u_);

  const T denominator =
      (order_ * mu_ + T(2.0) * r_y_ + r_r_ - q_.dot(p_)) / point.tau + T(2.0) * c_.dot(p_);
  const T numerator = (eta + sigma - T(1)) * order_ * mu_ - trace_c - c_tau_kappa +
                      inner(residuals.primal, k_) + p_.dot(h_);
  direction.tau = numerator / denominator;
  direction.kappa =
      (target - point.kappa * point.tau - c_tau_kappa - point.kappa * direction.tau) / point.tau;
  direction.x = u_ + direction.tau * ((point.x + p_) / point.tau - T(2.0) * z_);

  adjoint(data_, direction.x, direction.tau, direction.X);
  scaled_product(direction.X, point.Y, direction.Y);
  direction.Y.flat() = k_.flat() - direction.Y.flat();
  direction.X.flat() += eta * residuals.primal.flat();
}

template <typename T>
T Newton<T>::step(const Iterate<T>& point, const Iterate<T>& direction, const T& longest) {
  T a = longest;
  if (direction.tau < T(0)) a = std::min(a, T(-point.tau / direction.tau));
  if (direction.kappa < T(0)) a = std::min(a, T(-point.kappa / direction.kappa));
  a = std::min(a, factor_X_.step(direction.X, a));
  return std::min(a, factor_Y_.step(direction.Y, a));
}

#define GAINSMITH_INSTANTIATE(T) template class Newton<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
