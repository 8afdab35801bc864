// The methods of Gauss with s stages, of order 2 s (gauss.h), in any real arithmetic.
//
//   c the roots of the Legendre polynomial P_s on [0, 1], b its weights,
//   a_ij = b_j (c_i + sum_{k=1}^{s-1} P_k(z_j) (P_{k+1}(z_i) - P_{k-1}(z_i)) / 2),  z = 2 c - 1
//
// since the Lagrange polynomial of c_j is b_j sum_k (2 k + 1) P_k(z_j) P_k.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "numbers/matrix.h"

namespace gainsmith::ode {

template <class Scalar>
struct GaussStages {
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  Column c, b;
  numbers::MatrixOf<Scalar> A;         ///< s x s
  numbers::MatrixOf<Scalar> legendre;  ///< P_k(z_i) at (i, k), k = 0 ... s

  /// s > 0. The z_i are found by Newton's method, P_s' = s (z P_s - P_{s-1}) / (z^2 - 1).
  explicit GaussStages(int s);

  /// P_0(z), ..., P_s(z).
  static Column polynomials(int s, const Scalar& z) {
    Column P(s + 1);
    P(0) = Scalar(1);
    P(1) = z;
    for (int k = 1; k < s; ++k)
      P(k + 1) = (Scalar(2 * k + 1) * z * P(k) - Scalar(k) * P(k - 1)) / Scalar(k + 1);
    return P;
  }
  /// The integrals of P_0, ..., P_(s-1) from -1 to z, times k + 1/2.
  static Column integrals(int s, const Scalar& z) {
    const Column P = polynomials(s, z);
    Column sums(s);
    sums(0) = (z + Scalar(1)) / Scalar(2);
    for (int k = 1; k < s; ++k) sums(k) = (P(k + 1) - P(k - 1)) / Scalar(2);
    return sums;
  }
};

template <class Scalar>
GaussStages<Scalar>::GaussStages(int s) : c(s), b(s), A(s, s), legendre(s, s + 1) {
  constexpr int kSteps = 8;  // of Newton, from six digits
  for (int i = 0; i < s; ++i) {
    Scalar z(-std::cos(std::numbers::pi * (i + 0.75) / (s + 0.5)));
    const auto slope = [&](const Column& P) {
      return Scalar(s) * (z * P(s) - P(s - 1)) / (z * z - Scalar(1));
    };
    for (int k = 0; k < kSteps; ++k) {
      const Column P = polynomials(s, z);
      z = z - P(s) / slope(P);
    }
    const Column P = polynomials(s, z);
    const Scalar d = slope(P);
    c(i) = (z + Scalar(1)) / Scalar(2);
    b(i) = Scalar(1) / ((Scalar(1) - z * z) * d * d);
    legendre.row(i) = P.transpose();
  }
  for (int i = 0; i < s; ++i) {
    const Column to = integrals(s, Scalar(2) * c(i) - Scalar(1));
    for (int j = 0; j < s; ++j) {
      Scalar sum(0);
      for (int k = 0; k < s; ++k) sum = sum + legendre(j, k) * to(k);
      A(i, j) = b(j) * sum;
    }
  }
}

}  // namespace gainsmith::ode
