// The flow over the steps of FlowSteps in the coordinates of a judgement, with error bounds, and
// integrals of quadratic forms over it.
//
// Over s_k, with G = [M b; 0 0] from the decimals in 100 digits,
//
//   X_k = expm(s_k G),  X_(k+1) = X_k^2          W_(k+1) = W_k + X_k' W_k X_k
//   int_0^(s_k) [x; 1]' Q [x; 1] ds = [x0; 1]' W_k [x0; 1]
//
// X_0 and W_0 by their series. The error of the squarings, e <- 2 |X| e + e^2 + n u |X|^2 with
// u = 1e-98, is carried along; what is rounded once is the result.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hybrid/ball.h"
#include "hybrid/coordinates.h"
#include "hybrid/steps.h"

namespace gainsmith::hybrid {

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
  double error = 0;             ///< besides that rounding, in the norm of the largest row sum
  std::vector<bool> unchanged;  ///< the rows that are those of the identity
};

template <class Scalar>
BoundedMap<Scalar> bounded_map(const numbers::MatrixOf<Decimal100>& linear,
                               const numbers::MatrixOf<Decimal100>& constant, double error);

/// A quadratic form [x; 1]' Q [x; 1].
template <class Scalar>
struct Form {
  numbers::MatrixOf<Scalar> matrix;
  numbers::Matrix rounded;
  numbers::Matrix sizes;
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

/// All in 100 digits.
struct ExactSteps {
  std::vector<numbers::MatrixOf<Decimal100>> maps;  ///< X_k
  std::vector<double> errors;
  std::vector<std::vector<numbers::MatrixOf<Decimal100>>> integrals;  ///< [form][k]: W_k
};
ExactSteps exact_steps(const Coordinates& coordinates, const FlowSteps& steps,
                       const std::vector<numbers::MatrixOf<Decimal100>>& forms);

template <class Scalar>
struct StepMaps {
  StepMaps(const Coordinates& coordinates, const ExactSteps& exact,
           const std::vector<numbers::MatrixOf<Decimal100>>& forms);

  std::vector<BoundedMap<Scalar>> maps;
  numbers::MatrixOf<Scalar> linear;  ///< of the flow itself
  ColumnOf<Scalar> constant;
  numbers::Matrix rounded;
  numbers::Matrix sizes;
  Eigen::VectorXd constant_sizes;
  double norm = 0;  ///< of linear, the largest row sum
  std::vector<Form<Scalar>> forms;
  std::vector<std::vector<Form<Scalar>>> integrals;
};

}  // namespace gainsmith::hybrid
