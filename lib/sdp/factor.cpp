#include "sdp/factor.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "sdp/scalars.h"

namespace gainsmith::sdp {

template <typename T>
ConeFactor<T>::ConeFactor(const Layout& layout)
    : layout_(layout), inverse_factor_(layout), work_(layout), scaled_(layout) {}

template <typename T>
bool ConeFactor<T>::factorise(const Blocks<T>& V) {
  for (int b = 0; b < layout_.blocks(); ++b) {
    auto l = work_.dense(b);
    l = V.dense(b);
    Eigen::Ref<Matrix<T>> in_place(l);
    Eigen::LLT<Eigen::Ref<Matrix<T>>> llt(in_place);
    if (llt.info() != Eigen::Success) return false;
    auto inverse = inverse_factor_.dense(b);
    inverse.setIdentity();
    l.template triangularView<Eigen::Lower>().solveInPlace(inverse);
  }
  const auto v = V.linear();
  auto reciprocal = inverse_factor_.linear();
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    if (!(v[k] > T(0))) return false;
    reciprocal[k] = T(1) / v[k];
  }
  return true;
}

template <typename T>
void ConeFactor<T>::inverse(Blocks<T>& result) const {
  for (int b = 0; b < layout_.blocks(); ++b) {
    const auto l = inverse_factor_.dense(b);
    auto target = result.dense(b);
    target.noalias() = l.transpose() * l;
  }
  result.linear() = inverse_factor_.linear();
}

template <typename T>
T ConeFactor<T>::step(const Blocks<T>& D, const T& longest) {
  T smallest = T(-1) / longest;
  for (int b = 0; b < layout_.blocks(); ++b) {
    const auto l = inverse_factor_.dense(b);
    auto half = work_.dense(b);
    auto w = scaled_.dense(b);
    half.noalias() = D.dense(b) * l.transpose();
    w.noalias() = l * half;
    Eigen::SelfAdjointEigenSolver<Matrix<T>> solver(w, Eigen::EigenvaluesOnly);
    smallest = std::min(smallest, T(solver.eigenvalues()[0]));
  }
  const auto reciprocal = inverse_factor_.linear();
  const auto d = D.linear();
  for (Eigen::Index k = 0; k < d.size(); ++k)
    smallest = std::min(smallest, T(d[k] * reciprocal[k]));
  return T(-1) / smallest;
}

#define GAINSMITH_INSTANTIATE(T) template class ConeFactor<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
