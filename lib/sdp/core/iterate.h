// The point of the homogeneous model and a direction in it.
#pragma once

#include "sdp/core/data.h"
#include "sdp/schur/linalg.h"

namespace gainsmith::sdp {

/// (x, X, Y, tau, kappa) with X, Y in the cone's interior and tau, kappa > 0. When tau > 0 wins,
/// (x, X, Y)/tau solves the problem; when kappa does, Y or x is a certificate of infeasibility.
template <typename T>
struct Iterate {
  explicit Iterate(const Data& data)
      : x(Vector<T>::Zero(data.m())), X(data.layout), Y(data.layout) {}

  Vector<T> x;
  Blocks<T> X, Y;
  T tau{1}, kappa{1};

  /// mu = (X.Y + tau kappa) / (n + 1).
  T mu() const {
    return (inner(X, Y) + tau * kappa) / T(static_cast<double>(X.layout().order() + 1));
  }

  /// mu of the problem at a fixed tau: X.Y / n.
  T mu_fixed() const { return inner(X, Y) / T(static_cast<double>(X.layout().order())); }

  /// (x, X, tau) moves by `primal`, (Y, kappa) by `dual`; equal in the homogeneous model.
  void advance(const Iterate& direction, const T& primal, const T& dual) {
    x += primal * direction.x;
    X.flat() += primal * direction.X.flat();
    Y.flat() += dual * direction.Y.flat();
    tau += primal * direction.tau;
    kappa += dual * direction.kappa;
  }
};

/// What a point leaves of the model's equations:
///   primal = sum x_i F_i - tau F_0 - X,   dual_i = tau c_i - F_i . Y.
/// (The third residual, F_0.Y - c'x - kappa, follows from these and mu: see newton.h.)
template <typename T>
struct Defect {
  explicit Defect(const Data& data) : primal(data.layout), dual(Vector<T>::Zero(data.m())) {}

  Blocks<T> primal;
  Vector<T> dual;
};

/// Rounds or widens every number of a point. Both have the same layout.
template <typename To, typename From>
void convert(const Iterate<From>& from, Iterate<To>& to) {
  convert(from.x, to.x);
  convert(from.X.flat(), to.X.flat());
  convert(from.Y.flat(), to.Y.flat());
  to.tau = as<To>(from.tau);
  to.kappa = as<To>(from.kappa);
}

}  // namespace gainsmith::sdp
