#include "sdp/schur/matrix_scaling.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/stop.h"
#include "sdp/core/extreme.h"
#include "sdp/core/work.h"
#include "sdp/schur/kernels.h"

namespace gainsmith::sdp {
namespace {

using Dense = Matrix<double>;

/// From this size on the smallest eigenvalue is sought by Lanczos' method.
constexpr Eigen::Index kSizeForLanczos = 40;

/// A lower bound of the smallest eigenvalue of M where that is below `enough`.
double smallest_eigenvalue(const Dense& M, double enough) {
  if (M.rows() >= kSizeForLanczos) {
    bool converged = false;
    const Dense identity = Dense::Identity(M.rows(), M.cols());
    const double bound = Lanczos(M.rows()).lower_bound(identity, M, enough, converged);
    if (converged) return bound;
  }
  Dense shifted = M;
  shifted.diagonal().array() -= enough;
  if (cholesky(View<double>(shifted))) return enough;
  const Eigen::Tridiagonalization<Dense> reduced(M);
  Vector<double> diagonal = reduced.diagonal(), beside = reduced.subDiagonal();
  return smallest_of_tridiagonal(diagonal, beside, enough);
}

}  // namespace

bool is_inside(const Blocks<double>& S) {
  for (int b = 0; b < S.layout().blocks(); ++b)
    if (Eigen::LLT<Dense>(S.dense(b)).info() != Eigen::Success) return false;
  return S.linear().size() == 0 || S.linear().minCoeff() > 0;
}

Scaling::Scaling(const Layout& layout)
    : G_(layout), W_(layout), d_(static_cast<std::size_t>(layout.blocks())) {}

void square(const Blocks<double>& R, Blocks<double>& X) {
  for (int b = 0; b < R.layout().blocks(); ++b)
    X.dense(b).noalias() = R.dense(b) * R.dense(b).transpose();
  X.linear() = R.linear();
}

bool Scaling::factor(const Blocks<double>& M, double a, Blocks<double>& R) const {
  R.linear() = G_.linear().cwiseAbs2().cwiseProduct(linear_d_ + a * M.linear());
  if (R.linear().size() > 0 && !(R.linear().minCoeff() > 0)) return false;
  for (int b = 0; b < M.layout().blocks(); ++b) {
    Dense moved = a * M.dense(b);
    moved.diagonal() += d_[static_cast<std::size_t>(b)];
    const Eigen::LLT<Dense> root(moved);
    if (root.info() != Eigen::Success) return false;
    R.dense(b) = G_.dense(b) * Dense(root.matrixL());
  }
  return true;
}

bool Scaling::prepare(const Blocks<double>& R, const Blocks<double>& S) {
  if (R.linear().size() > 0 && !(std::min(R.linear().minCoeff(), S.linear().minCoeff()) > 0))
    return false;
  for (int b = 0; b < R.layout().blocks(); ++b) {
    check_stop();
    const auto n = static_cast<double>(R.dense(b).rows());
    spend_on<double>(20 * n * n * n);
    // With S = L L' and R'S R = V diag(d^2) V':  G = R V diag(d)^-1/2.
    const Eigen::LLT<Dense> s(S.dense(b));
    if (s.info() != Eigen::Success) return false;
    const Dense L = R.dense(b);
    const Dense T = s.matrixU() * L;
    const Eigen::SelfAdjointEigenSolver<Dense> product(T.transpose() * T);
    if (product.info() != Eigen::Success || !(product.eigenvalues()[0] > 0)) return false;
    Vector<double>& d = d_[static_cast<std::size_t>(b)];
    d = product.eigenvalues().cwiseSqrt();
    G_.dense(b) = L * (product.eigenvectors() * d.cwiseSqrt().cwiseInverse().asDiagonal());
    W_.dense(b).noalias() = G_.dense(b) * G_.dense(b).transpose();
  }
  linear_d_ = (R.linear().array() * S.linear().array()).sqrt();
  G_.linear() = (R.linear().array() / S.linear().array()).sqrt().sqrt();
  W_.linear() = R.linear().array() / S.linear().array();
  return true;
}

void Scaling::outward(const Blocks<double>& M, Blocks<double>& result) const {
  for (int b = 0; b < M.layout().blocks(); ++b) {
    const Dense half = G_.dense(b) * M.dense(b);
    result.dense(b).noalias() = half * G_.dense(b).transpose();
  }
  result.linear() = G_.linear().cwiseAbs2().cwiseProduct(M.linear());
}

void Scaling::inward(const Blocks<double>& M, Blocks<double>& result) const {
  for (int b = 0; b < M.layout().blocks(); ++b) {
    const Dense half = G_.dense(b).transpose() * M.dense(b);
    result.dense(b).noalias() = half * G_.dense(b);
  }
  result.linear() = G_.linear().cwiseAbs2().cwiseProduct(M.linear());
}

double Scaling::step(const Blocks<double>& M, double longest) const {
  double smallest = -1 / longest;
  if (linear_d_.size() > 0)
    smallest = std::min(smallest, M.linear().cwiseQuotient(linear_d_).minCoeff());
  for (int b = 0; b < M.layout().blocks(); ++b) {
    // diag(d) + a M >= 0 where I + a diag(d)^-1/2 M diag(d)^-1/2 is.
    const auto root = d_[static_cast<std::size_t>(b)].cwiseSqrt().cwiseInverse();
    const Dense relative = root.asDiagonal() * M.dense(b) * root.asDiagonal();
    smallest = std::min(smallest, smallest_eigenvalue(relative, smallest));
  }
  return -1 / smallest;
}

}  // namespace gainsmith::sdp
