#include "sdp/schur/factor.h"

#include <algorithm>

#include "base/scalars.h"
#include "sdp/schur/kernels.h"

namespace gainsmith::sdp {
namespace {

/// Rows from which Lanczos beats a full tridiagonalisation.
constexpr int kLanczosSize = 32;

}  // namespace

template <typename T>
ConeFactor<T>::ConeFactor(const Layout& layout)
    : layout_(layout),
      factor_(layout),
      inverse_factor_(layout),
      inverse_transpose_(layout),
      inverted_(layout.size.size()),
      work_(layout),
      scaled_(layout) {
  for (const int n : layout.size) {
    spectra_.emplace_back(n);
    lanczos_.emplace_back(n);
  }
}

template <typename T>
bool ConeFactor<T>::factorise(const Blocks<T>& V) {
  for (int b = 0; b < layout_.blocks(); ++b) {
    auto l = factor_.dense(b);
    l = V.dense(b);
    inverted_[static_cast<std::size_t>(b)] = false;
    if (!cholesky(View<T>(l))) return false;
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
void ConeFactor<T>::invert(int b) {
  if (inverted_[static_cast<std::size_t>(b)]) return;
  auto inverse = inverse_factor_.dense(b);
  invert_lower(View<const T>(factor_.dense(b)), View<T>(inverse));
  inverse_transpose_.dense(b) = inverse.transpose();
  inverted_[static_cast<std::size_t>(b)] = true;
}

template <typename T>
void ConeFactor<T>::inverse(Blocks<T>& result) {
  for (int b = 0; b < layout_.blocks(); ++b) {
    invert(b);
    auto target = result.dense(b);
    multiply_transposed(View<const T>(inverse_factor_.dense(b)),
                        View<const T>(inverse_transpose_.dense(b)), View<T>(target));
  }
  result.linear() = inverse_factor_.linear();
}

template <typename T>
void ConeFactor<T>::divide(int b, const View<T>& M, const View<T>& work) {
  invert(b);
  multiply_upper(constant(M), View<const T>(inverse_transpose_.dense(b)), work);
  multiply_lower(constant(work), View<const T>(inverse_factor_.dense(b)), M);
}

/// W = L^-1 D L^-T is formed in T and rounded. Where W - enough I has a Cholesky factor `enough` is
/// the bound; otherwise bisection on a tridiagonal form of W finds it (extreme.h). Large blocks in
/// double try Lanczos' method before that.
template <typename T>
double ConeFactor<T>::smallest_eigenvalue(const Blocks<T>& D, int b, double enough) {
  const auto at = static_cast<std::size_t>(b);
  if constexpr (std::is_same_v<T, double>) {
    if (layout_.size[at] >= kLanczosSize) {
      bool converged = false;
      const double bound =
          lanczos_[at].lower_bound(factor_.dense(b), D.dense(b), enough, converged);
      if (converged) return bound;
    }
  }
  invert(b);
  auto half = work_.dense(b);
  auto w = scaled_.dense(b);
  multiply(View<const T>(D.dense(b)), View<const T>(inverse_transpose_.dense(b)), View<T>(half));
  multiply(View<const T>(inverse_factor_.dense(b)), View<const T>(half), View<T>(w));
  Spectrum& spectrum = spectra_[at];
  for (Eigen::Index j = 0; j < w.cols(); ++j)
    for (Eigen::Index i = 0; i < w.rows(); ++i) spectrum.w(i, j) = static_cast<double>(w(i, j));
  spectrum.shifted = spectrum.w;
  spectrum.shifted.diagonal().array() -= enough;
  if (cholesky(View<double>(spectrum.shifted))) return enough;
  spectrum.reduction.compute(spectrum.w);
  spectrum.diagonal = spectrum.reduction.diagonal();
  spectrum.subdiagonal = spectrum.reduction.subDiagonal();
  return smallest_of_tridiagonal(spectrum.diagonal, spectrum.subdiagonal, enough);
}

template <typename T>
T ConeFactor<T>::step(const Blocks<T>& D, const T& longest) {
  // An eigenvalue above -1 / longest does not shorten the step.
  T smallest = T(-1) / longest;
  const auto reciprocal = inverse_factor_.linear();
  const auto d = D.linear();
  for (Eigen::Index k = 0; k < d.size(); ++k)
    smallest = std::min(smallest, T(d[k] * reciprocal[k]));
  // What is above the least so far is no matter.
  for (int b = 0; b < layout_.blocks(); ++b)
    smallest = std::min(smallest, T(smallest_eigenvalue(D, b, static_cast<double>(smallest))));
  return T(-1) / smallest;
}

#define GAINSMITH_INSTANTIATE(T) template class ConeFactor<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
