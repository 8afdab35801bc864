#include "response/frequency_response.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

#include "numerics/balance.h"

namespace gainsmith::response {

using Complex = std::complex<double>;

FrequencyResponse::FrequencyResponse(const StateSpace& system) : D_(system.D), step_(system.step) {
  const Eigen::Index n = system.states();
  const auto [A, B, C, D, step] = in_units(system, numerics::balance(system.A.cwiseAbs()));
  if (n < 2) {
    A_ = A;
    B_ = B;
    C_ = C;
    return;
  }
  const Eigen::HessenbergDecomposition<Matrix> form(A);
  const Matrix Q = form.matrixQ();
  A_ = form.matrixH();
  B_ = Q.transpose() * B;
  C_ = C * Q;
}

/// C (s I - A)^-1 B + D with s I - A in Hessenberg form, n x n. Elimination has one row below each
/// pivot; the larger of the two is taken. So it costs O(n^2 m).
ComplexMatrix FrequencyResponse::at(double w) const {
  const Eigen::Index n = A_.rows();
  const Complex s = step_ > 0 ? std::polar(1.0, w * step_) : Complex(0, w);
  ComplexMatrix M = -A_.cast<Complex>();
  M.diagonal().array() += s;
  ComplexMatrix X = B_.cast<Complex>();
  // Below the diagonal there is one row to eliminate.
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    if (std::norm(M(k + 1, k)) > std::norm(M(k, k))) {
      M.row(k).tail(n - k).swap(M.row(k + 1).tail(n - k));
      X.row(k).swap(X.row(k + 1));
    }
    if (M(k + 1, k) == Complex(0)) continue;
    const Complex factor = M(k + 1, k) / M(k, k);
    M.row(k + 1).tail(n - k) -= factor * M.row(k).tail(n - k);
    X.row(k + 1) -= factor * X.row(k);
  }
  M.triangularView<Eigen::Upper>().solveInPlace(X);
  return C_.cast<Complex>() * X + D_.cast<Complex>();
}

numbers::Vector gains_of(const ComplexMatrix& response) {
  if (response.size() == 1) return numbers::Vector::Constant(1, std::abs(response(0, 0)));
  return Eigen::JacobiSVD<ComplexMatrix>(response).singularValues();
}

double FrequencyResponse::largest_gain(double w) const {
  const ComplexMatrix response = at(w);
  return response.size() == 0 ? 0 : gains_of(response)(0);
}

}  // namespace gainsmith::response
