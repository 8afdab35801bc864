#include "sdp/core/newton.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "base/scalars.h"
#include "sdp/core/work.h"
#include "sdp/schur/kernels.h"

namespace gainsmith::sdp {
namespace {

/// Refinement of a direction: a residual that counts as none, in units of epsilon but not below
/// what any use of it needs; the part of the present defect, and of what X.Y and the allowance
/// permit, that it may be.
constexpr double kRefineUnits = 1e4, kRefineGoal = 1e-20;
constexpr double kRefineShare = 1e-3, kAllowanceShare = 0.1;
/// A residual of this part of the defect is the first sign of lost digits; one of that part stops
/// progress.
constexpr double kImprecise = 0.02, kExhausted = 0.5;
/// A bound of X^-1 R below which H(X^-1 R Y) is nothing beside Y.
constexpr double kNegligible = 1e-4;
/// The most steps, and how many of them may pass without a smaller residual.
constexpr int kRefineSteps = 100, kRefinePatience = 20;
/// The most steps with B in double, in wide arithmetic.
constexpr int kRoundedSteps = 30;

}  // namespace

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
      refinement_(data),
      trial_(data),
      order_(static_cast<double>(data.layout.order() + 1)) {
  for (Vector<T>* v : {&a_, &q_, &p_, &z_, &u_, &h_, &c_}) v->setZero(data.m());
  for (int i = 0; i < data.m(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    c_[i] = coefficient<T>(data.c[at], data.c_rest[at]);
  }
}

// As the symmetric part of (right left) X^-1, which is the same: `left` is the factor with the
// data's pattern. Wide arithmetic has the digits for the shorter computation.
template <typename T>
void Newton<T>::scaled_product(const Blocks<T>& left, const Blocks<T>& right, Blocks<T>& out) {
  for (int b = 0; b < data_.layout.blocks(); ++b) {
    const BlockData& block = data_.dense[static_cast<std::size_t>(b)];
    auto half = half_.dense(b);
    auto product = product_.dense(b);
    const auto n = static_cast<double>(product.rows());
    if (std::is_same_v<T, double>) spend_on<T>(3 * n * n * n);
    if (block.sparse())
      multiply_sparse(View<const T>(right.dense(b)), View<const T>(left.dense(b)),
                      block.pattern_start, block.pattern_row, View<T>(half));
    else
      multiply(View<const T>(right.dense(b)), View<const T>(left.dense(b)), View<T>(half));
    if constexpr (std::is_same_v<T, double>) {
      factor_X_.divide(b, View<T>(half), View<T>(product));
      out.dense(b) = T(0.5) * (half + half.transpose());
    } else {
      multiply(View<const T>(half), View<const T>(inverse_X_.dense(b)), View<T>(product));
      out.dense(b) = T(0.5) * (product + product.transpose());
    }
  }
  out.linear() = inverse_X_.linear().cwiseProduct(left.linear()).cwiseProduct(right.linear());
}

template <typename T>
bool Newton<T>::factorise(const Iterate<T>& point) {
  return factor_X_.factorise(point.X) && factor_Y_.factorise(point.Y);
}

template <typename T>
bool Newton<T>::prepare(const Iterate<T>& point, const Defect<T>& defect, Model model,
                        double allowance) {
  model_ = model;
  factor_X_.inverse(inverse_X_);
  schur_.assemble(inverse_X_, point.Y, model != Model::fixed);
  if (!schur_.factorise()) return false;

  mu_ = model == Model::fixed ? point.mu_fixed() : point.mu();
  // A dual residual e moves c'x by e'x at most: by X.Y where ||e|| is this.
  harmless_ = inner(point.X, point.Y) / (T(1) + point.x.norm());
  goal_ = refinement_goal(defect, allowance);
  // ||X^-1 R|| bounds the size of H(X^-1 R Y) beside Y.
  if (std::is_same_v<T, double> && model == Model::fixed &&
      defect.primal.flat().norm() * inverse_X_.flat().norm() < T(kNegligible)) {
    residual_term_.flat().setZero();
    return true;
  }
  scaled_product(defect.primal, point.Y, residual_term_);
  if (model == Model::fixed) return true;
  apply(data_, residual_term_, a_);
  q_ = defect.dual - a_;
  schur_.solve(q_, p_);
  schur_.solve(c_, z_);
  r_y_ = inner(defect.primal, point.Y);
  r_r_ = inner(defect.primal, residual_term_);
  return true;
}

// In double conjugate gradients cost little, and every digit of a direction helps.
template <typename T>
T Newton<T>::refinement_goal(const Defect<T>& defect, double allowance) const {
  T none(kRefineUnits * std::numeric_limits<T>::epsilon());
  // Of a B with all digits nothing is asked that its first solution does not bring.
  if (!schur_.rounded()) none = std::max(none, T(kRefineGoal));
  if constexpr (std::is_same_v<T, double>) return none;
  return std::max({none, T(T(kRefineShare) * defect.dual.norm()),
                   std::min(T(T(kRefineShare) * harmless_), T(kAllowanceShare * allowance))});
}

// Newton's direction to mu = 0. The corrector repeats it with C = dX_a dY_a.
template <typename T>
void Newton<T>::predict(const Iterate<T>& point, const Defect<T>& defect, Iterate<T>& direction) {
  correction_.flat().setZero();
  solve(point, defect, T(0), T(1), T(0), T(0), direction);
}

template <typename T>
void Newton<T>::correct(const Iterate<T>& point, const Defect<T>& defect,
                        const Iterate<T>& predictor, const T& sigma, const T& eta,
                        Iterate<T>& direction) {
  scaled_product(predictor.X, predictor.Y, correction_);
  solve(point, defect, sigma, eta, inner(predictor.X, predictor.Y), predictor.tau * predictor.kappa,
        direction);
}

// K, h = A(K) - eta r and u = B^-1 h come first, then dx, and dX and dY from dx, and refinement. dX
// gets its part eta R last, since refinement works on A*(dx) - dtau F_0 alone. Where B in double
// does not lead to the goal, the direction is computed again with B in T.
template <typename T>
void Newton<T>::solve(const Iterate<T>& point, const Defect<T>& defect, const T& sigma,
                      const T& eta, const T& trace_c, const T& c_tau_kappa, Iterate<T>& direction) {
  const T target = sigma * mu_;
  k_.flat() = target * inverse_X_.flat() - point.Y.flat() - eta * residual_term_.flat() -
              correction_.flat();
  apply(data_, k_, h_);
  h_ -= eta * defect.dual;
  schur_.solve(h_, u_);

  if (model_ == Model::fixed) {
    direction.x = u_;
    direction.tau = direction.kappa = T(0);
  } else {
    move_tau(point, defect, sigma, eta, trace_c, c_tau_kappa, direction);
  }
  adjoint(data_, direction.x, direction.tau, direction.X);
  scaled_product(direction.X, point.Y, direction.Y);
  direction.Y.flat() = k_.flat() - direction.Y.flat();
  refine(point, defect, eta, direction);
  if (missed_ && schur_.widen())
    return solve(point, defect, sigma, eta, trace_c, c_tau_kappa, direction);
  direction.X.flat() += eta * defect.primal.flat();
}

// The residual of the dual equation, A(dY) - eta r - dtau c, is brought down by conjugate gradients
// on the operator dx -> A(H(X^-1 A*(dx) Y)) itself, of which B is a rounded picture; dX and dY move
// along. Rounding makes the residual rise again in the end, so the best direction is kept.
template <typename T>
void Newton<T>::refine(const Iterate<T>& point, const Defect<T>& defect, const T& eta,
                       Iterate<T>& direction) {
  apply(data_, direction.Y, a_);
  h_ = a_ - eta * defect.dual - direction.tau * c_;
  T best = h_.norm(), rho(0);
  exhausted_ = imprecise_ = missed_ = false;
  if (!(best > goal_)) return;
  trial_ = direction;
  int since_best = 0;
  const int most = schur_.rounded() ? kRoundedSteps : kRefineSteps;
  for (int step = 0; step < most && since_best < kRefinePatience && best > goal_; ++step) {
    spend_on<T>(static_cast<double>(data_.m()) * data_.m());
    schur_.solve(h_, p_);
    const T next = h_.dot(p_);
    if (step == 0)
      u_ = p_;
    else
      u_ = p_ + (next / rho) * u_;
    rho = next;
    adjoint(data_, u_, T(0), refinement_.X);
    scaled_product(refinement_.X, point.Y, refinement_.Y);
    apply(data_, refinement_.Y, a_);
    const T curvature = u_.dot(a_);
    if (!(curvature > T(0)) || !(rho > T(0))) break;
    const T length = rho / curvature;
    trial_.x += length * u_;
    trial_.X.flat() += length * refinement_.X.flat();
    trial_.Y.flat() -= length * refinement_.Y.flat();
    h_ -= length * a_;
    const T error = h_.norm();
    ++since_best;
    if (!(error < best)) continue;
    best = error;
    direction.x = trial_.x;
    direction.X.flat() = trial_.X.flat();
    direction.Y.flat() = trial_.Y.flat();
    since_best = 0;
  }
  missed_ = best > goal_;
  imprecise_ = best > std::max(goal_, T(T(kImprecise) * defect.dual.norm()));
  // Negative curvature ends the loop too, but that is a matter of luck and may be gone next time.
  exhausted_ = since_best == kRefinePatience &&
               best > std::max({goal_, harmless_, T(T(kExhausted) * defect.dual.norm())});
}

// The formulas of newton.h for dx and dtau; dkappa is from
//   kappa dtau + tau dkappa = sigma mu - tau kappa - c_tk.
template <typename T>
void Newton<T>::move_tau(const Iterate<T>& point, const Defect<T>& defect, const T& sigma,
                         const T& eta, const T& trace_c, const T& c_tau_kappa,
                         Iterate<T>& direction) const {
  const T denominator =
      (order_ * mu_ + T(2.0) * r_y_ + r_r_ - q_.dot(p_)) / point.tau + T(2.0) * c_.dot(p_);
  const T numerator = (eta + sigma - T(1)) * order_ * mu_ - trace_c - c_tau_kappa +
                      inner(defect.primal, k_) + p_.dot(h_);
  direction.tau = numerator / denominator;
  direction.kappa =
      (sigma * mu_ - point.kappa * point.tau - c_tau_kappa - point.kappa * direction.tau) /
      point.tau;
  direction.x = u_ + direction.tau * ((point.x + p_) / point.tau - T(2.0) * z_);
}

// The least of the ratios of X, Y, tau and kappa. In the homogeneous model both steps are equal, or
// the residuals, which have tau in common, would not fall together.
template <typename T>
Steps<T> Newton<T>::step(const Iterate<T>& point, const Iterate<T>& direction, const T& longest) {
  if (model_ == Model::fixed)
    return {factor_X_.step(direction.X, longest), factor_Y_.step(direction.Y, longest)};
  T a = longest;
  if (direction.tau < T(0)) a = std::min(a, T(-point.tau / direction.tau));
  if (direction.kappa < T(0)) a = std::min(a, T(-point.kappa / direction.kappa));
  a = std::min(a, factor_X_.step(direction.X, a));
  a = std::min(a, factor_Y_.step(direction.Y, a));
  return {a, a};
}

#define GAINSMITH_INSTANTIATE(T) template class Newton<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
