// The point of the homogeneous model and a direction in it.
#pragma once

#include "sdp/data.h"
#include "sdp/linalg.h"

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

  void advance(const Iterate& direction, const T& step) {
    x += step * direction.x;
    X.flat() += step * direction.X.flat();
    Y.flat() += step * direction.Y.flat();
    tau += step * direction.tau;
    kappa += step * direction.kappa;
  }
};

}  // namespace gainsmith::sdp
