// The flow over the steps of FlowSteps in the coordinates of a judgement, with error bounds, and
// integrals of quadratic forms over it.
//
// Over s_k, with G = [M b; 0 0] from the decimals in 100 digits,
//
//   X_k = expm(s_k G),  X_(k+1) = X_k^2          W_(k+1) = W_k + X_k' W_k X_k
//   int_0^(s_k) [x; 1]' Q [x; 1] ds = [x0; 1]' W_k [x0; 1]
//
// X_0 and W_0 by their series. The error of the squarings, element by element
//
//   R <- |X| R + R |X| + R^2 + n u |X|^2,   u = 1e-98,
//
// is carried along; it does not depend on the units of the states, as one of norms would. What is
// rounded once is the result. Over a rest s <= s_0 both are polynomials in s, sums of the same
// series (Series).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "bounded/ball.h"
#include "bounded/coordinates.h"
#include "bounded/steps.h"

namespace gainsmith::bounded {

template <class Scalar>
using ColumnOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// x -> linear x + constant in Scalar, rounded once from the exact one.
template <class Scalar>
struct BoundedMap {
  numbers::MatrixOf<Scalar> linear;
  ColumnOf<Scalar> constant;
  numbers::Matrix rounded;  ///< linear in double
  numbers::Matrix sizes;    ///< |linear|
  Eigen::VectorXd constant_sizes;
  numbers::Matrix errors;       ///< of [linear, constant] besides that rounding
  bool coarse = false;          ///< whether that is more than the rounding of an element
  std::vector<bool> unchanged;  ///< the rows that are those of the identity
  Eigen::VectorXd gamma;        ///< relative rounding of linear x + constant; 0 of those rows
};

template <class Scalar>
BoundedMap<Scalar> bounded_map(const numbers::MatrixOf<Decimal100>& linear,
                               const numbers::MatrixOf<Decimal100>& constant,
                               const numbers::Matrix& errors);

/// A quadratic form [x; 1]' Q [x; 1].
template <class Scalar>
struct Form {
  numbers::MatrixOf<Scalar> matrix;
  numbers::Matrix sizes;  ///< |matrix|, and more where it is not rounded once
};
template <class Scalar>
Form<Scalar> form_of(const numbers::MatrixOf<Decimal100>& Q);

template <class Scalar>
struct Bounded {
  Scalar value{0};
  double bound = 0;
};

/// The form at x with |true x - x| <= r.
template <class Scalar>
Bounded<Scalar> value_of(const Form<Scalar>& form, const Eigen::Ref<const ColumnOf<Scalar>>& x,
                         const Eigen::Ref<const Eigen::VectorXd>& r);

/// A matrix that is 0 at s = 0, as a polynomial in sigma = s 2^-exponent, 0 <= sigma <= 1:
///
///   sum_(k = 1)^K P_k sigma^k,   |that in Scalar - the whole series| <= sigma errors
template <class Scalar>
struct Series {
  int exponent = 0;
  std::vector<numbers::MatrixOf<Scalar>> powers;
  numbers::Matrix errors;
  numbers::Matrix errors_in_double;  ///< of the sum rounded to double
  std::vector<bool> moves;           ///< the rows that are not 0

  /// sigma of s, exactly.
  double share(double s) const { return std::ldexp(s, -exponent); }
  void sum(double sigma, numbers::MatrixOf<Scalar>& out) const;
};

/// The P_k in 100 digits and a bound of what all others add up to, for K = 0, 1, ....
struct ExactSeries {
  int exponent = 0;
  std::vector<numbers::MatrixOf<Decimal100>> powers;
  std::vector<numbers::Matrix> tails;
};
template <class Scalar>
Series<Scalar> series_of(const ExactSeries& exact);

/// All in 100 digits.
struct ExactSteps {
  std::vector<numbers::MatrixOf<Decimal100>> maps;                    ///< X_k
  std::vector<numbers::Matrix> errors;                                ///< R_k
  std::vector<std::vector<numbers::MatrixOf<Decimal100>>> integrals;  ///< [form][k]: W_k
  ExactSeries rest;                                                   ///< expm(s G) - I
  std::vector<ExactSeries> rest_integrals;                            ///< of each form over a rest
};
ExactSteps exact_steps(const Coordinates& coordinates, const FlowSteps& steps,
                       const std::vector<numbers::MatrixOf<Decimal100>>& forms);

template <class Scalar>
struct StepMaps {
  StepMaps() = default;
  explicit StepMaps(const ExactSteps& exact);

  std::vector<BoundedMap<Scalar>> maps;
  std::vector<std::vector<Form<Scalar>>> integrals;
  Series<Scalar> rest;  ///< n x (n+1): what a rest adds to x, of [x; 1]
  std::vector<Series<Scalar>> rest_integrals;
};

}  // namespace gainsmith::bounded
