// Matrix functions with bounds of their errors, instantiated by one source a scalar: inverse,
// singular values and vectors, bases of subspaces, exponential. The first start from an
// approximation without bounds, and bound its error by a residual in balls. The exponential is a
// series in balls.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "numbers/types/enclosed.h"
#include "numbers/types/real_rules.h"
#include "numerics/balance.h"

namespace gainsmith::numbers::enclosed {

/// The Frobenius norm of sizes >= 0, rounded upward.
inline double norm_upward(const Matrix& sizes) {
  const double largest = sizes.size() == 0 ? 0 : sizes.maxCoeff();
  if (!(largest > 0)) return bound_or_nothing(largest);
  if (!std::isfinite(largest)) return kNothingKnown;
  const double norm = (sizes / largest).norm() * largest;
  return up(norm, static_cast<double>(sizes.size()) + 6) + kTiny;
}

/// I - X, with its size.
template <class S>
Enclosed<S> defect(const Enclosed<S>& x) {
  return difference(exact_identity<S>(x.rows()), x);
}

/// A^-1 = (I - (I - R A))^-1 R, so that |A^-1 - R| <= (I - G)^-1 G |R| for G >= |I - R A| with
/// spectral radius below 1; R, A, G n x n. With v > 0 and G v <= q v, q < 1, and T = G |R|,
/// T_ij <= c_j v_i, the bound is at most
///   T + G T + v c' q^2 / (1 - q).
/// Nothing is known when v = |R| max_j |A_ij| gives no q < 1/2.
template <class S>
Enclosed<S> inverse_around(const MatrixOf<S>& R, const Enclosed<S>& A) {
  const Eigen::Index n = A.rows();
  const Matrix size = magnitudes<S>(R);
  const Matrix G = magnitudes<S>(defect(product(exactly<S>(R), A)));
  if (!G.allFinite() || !size.allFinite()) return nothing_known<S>(R);
  const Vector v = size * magnitudes<S>(A.mid).rowwise().maxCoeff();
  if (!(v.array() > 0).all()) return nothing_known<S>(R);
  const double slack = up(1, static_cast<double>(n) + 6);
  const double q = ((G * v).array() / v.array()).maxCoeff() * slack;
  if (!(q < 0.5)) return nothing_known<S>(R);
  const Matrix T = product_upward(G, size);
  Matrix bound = (T + product_upward(G, T)) * slack;
  const double rest = up(q * q / (1 - q));
  for (Eigen::Index j = 0; j < n; ++j) {
    const double c = (T.col(j).array() / v.array()).maxCoeff() * slack;
    bound.col(j) += v * (c * rest * slack);
  }
  return {R, bound * slack};
}

template <class S>
struct Decomposition {
  Enclosed<S> U, s, V;                   ///< A = U diag(s) V' up to the radii of `residual`
  double residual = 0;                   ///< |A - U diag(s) V'| in the Frobenius norm
  double skew_left = 0, skew_right = 0;  ///< |I - U'U|, |I - V'V|

  /// |s_i - exact singular value|, by Weyl's and Ostrowski's bounds.
  double radius(double s_i) const {
    const double skew = skew_left + skew_right;
    return skew < 0.1 ? up(residual + s_i * skew, 8) + kTiny : kNothingKnown;
  }
};

/// A must not be empty. Only min(rows, cols) columns of U and V are of use to the residual.
/// The s are in the order of double, which may not be theirs where double takes them as equal.
template <class S>
Decomposition<S> decomposed(const Enclosed<S>& A) {
  const auto svd = Foundation<S>::full_svd(A.mid);
  const Eigen::Index k = std::min(A.rows(), A.cols());
  Decomposition<S> result{exactly<S>(svd.U), exactly<S>(svd.s), exactly<S>(svd.V), 0, 0, 0};
  const MatrixOf<S> U = svd.U.leftCols(k);
  const MatrixOf<S> V = svd.V.leftCols(k);
  const MatrixOf<S> s = svd.s.asDiagonal();
  const auto image =
      product(product(exactly<S>(U), exactly<S>(s)), exactly<S>(MatrixOf<S>(V.transpose())));
  const auto skew = [](const MatrixOf<S>& X) {
    const MatrixOf<S> turned = X.transpose();
    return norm_upward(magnitudes<S>(defect(product(exactly<S>(turned), exactly<S>(X)))));
  };
  result.residual = norm_upward(magnitudes<S>(difference(A, image)));
  result.skew_left = skew(U);
  result.skew_right = skew(V);
  return result;
}

/// The min(rows, cols) singular values, largest first, as a column. The i-th largest of A and of
/// U diag(s) V' differ by at most the norm of the residual (Weyl).
template <class S>
Enclosed<S> singular_values(const Enclosed<S>& A) {
  if (A.mid.size() == 0) return exactly<S>(MatrixOf<S>::Zero(0, 1));
  const auto parts = decomposed(A);
  Enclosed<S> out = parts.s;
  std::sort(out.mid.data(), out.mid.data() + out.mid.size(), std::greater<>());
  for (Eigen::Index i = 0; i < out.rows(); ++i) out.rad(i) = parts.radius(magnitude(out.mid(i)));
  return out;
}

/// The singular vectors U_k or V_k of the k largest singular values, near an exact orthonormal
/// basis of their subspace. With A = U diag(s) V' + E for orthonormal U, V the subspaces of A are
/// off by
///   sqrt(2) |E| / (s_k - s_(k+1) - |E|)
/// in the sines of their angles (Wedin 1972), bases by sqrt(2) times that.
template <class S>
Enclosed<S> leading_vectors(const Enclosed<S>& A, Eigen::Index k, bool left) {
  const auto parts = decomposed(A);
  const MatrixOf<S>& all = left ? parts.U.mid : parts.V.mid;
  const MatrixOf<S> Q = all.leftCols(k);
  const Eigen::Index count = parts.s.rows();
  const double largest = magnitude(S(parts.s.mid.maxCoeff()));
  const double least = below(S(parts.s.mid.topRows(k).minCoeff()));
  const double next = k < count ? magnitude(S(parts.s.mid.bottomRows(count - k).maxCoeff())) : 0;
  const double error = up(parts.radius(up(1.1 * largest)));
  const double gap = (least - next - error) * (1 - 0x1p-48);
  if (!(gap > 0)) return nothing_known<S>(Q);
  const double radius = up(2.01 * error / gap + (left ? parts.skew_left : parts.skew_right));
  return {Q, Matrix::Constant(Q.rows(), Q.cols(), radius)};
}

/// The basis of canonical.h of the subspace of M with the projector P. Nothing is known when a
/// pivot is not certain.
template <class S>
Enclosed<S> canonical_basis(canonical::Of of, const Enclosed<S>& P, Eigen::Index k,
                            const Enclosed<S>& M) {
  Enclosed<S> out = nothing_known<S>(MatrixOf<S>::Zero(P.rows(), k));
  const auto is_zero = [&](Eigen::Index i) {
    return (M.mid.row(i).array() == S(0)).all() && (M.rad.row(i).array() == 0).all();
  };
  const auto columns = canonical::projector(
      of, P.rows(), k, [&](auto i, auto j) { return P.ball(i, j); }, is_zero, Ball<S>{S(1), 0});
  const auto basis = canonical::basis(columns, k, Ball<S>{S(canonical::kLead), 0});
  if (!basis) return out;
  canonical::for_each_element(
      *basis, [&](auto i, auto j, const Ball<S>& x) { out.set(j * out.rows() + i, x); });
  return out;
}

/// Of the k first left singular vectors, 0 < k.
template <class S>
Enclosed<S> range_basis(const Enclosed<S>& A, Eigen::Index k) {
  const Enclosed<S> Q = leading_vectors(A, k, true);
  return canonical_basis<S>(canonical::Of::range, product(Q, transposed(Q)), k, A);
}

/// Of the k last right singular vectors, k < cols.
template <class S>
Enclosed<S> kernel_basis(const Enclosed<S>& A, Eigen::Index k) {
  const Enclosed<S> Q = leading_vectors(A, A.cols() - k, false);
  return canonical_basis<S>(canonical::Of::kernel, defect(product(Q, transposed(Q))), k,
                            transposed(A));
}

/// The degree m of the series for |X| <= 1/2: 2^-(m+1) / (m+1)! is below the unit roundoff. It is
/// summed in blocks of `block` terms (Paterson & Stockmeyer 1973); block divides m + 1.
template <class S>
struct Series {
  static constexpr int terms = std::is_same_v<S, double>         ? 16
                               : std::is_same_v<S, DoubleDouble> ? 28
                                                                 : 88;
  static constexpr int block = std::is_same_v<S, Decimal100> ? 8 : 4;
};

/// Whether i is made of j: a path in the pattern of A, or i = j. Outside of it e^A is 0.
inline Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> paths(const Matrix& sizes) {
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> reach = sizes.array() != 0;
  for (Eigen::Index k = 0; k < sizes.rows(); ++k)
    for (Eigen::Index i = 0; i < sizes.rows(); ++i)
      if (reach(i, k)) reach.row(i) = reach.row(i) || reach.row(k);
  for (Eigen::Index k = 0; k < sizes.rows(); ++k) reach(k, k) = true;
  return reach;
}

/// e^X for |X| <= 1/2 in the largest row sum: the series up to m, and for its rest
/// |X|^(m+1)/(m+1)! (1 + |X|/(m+2) + ...) <= 2^-(m+1)/(m+1)! * 1.1 wherever a path leads.
template <class S>
Enclosed<S> series(const Enclosed<S>& X) {
  constexpr int terms = Series<S>::terms, block = Series<S>::block;
  const Eigen::Index n = X.rows();
  std::vector<Enclosed<S>> powers = {exact_identity<S>(n), X};
  for (int k = 2; k <= block; ++k) powers.push_back(product(powers.back(), X));
  std::vector<Ball<S>> coefficients = {{S(1), 0}};
  for (int k = 1; k < terms; ++k) coefficients.push_back(coefficients.back() / Ball<S>{S(k), 0});
  Enclosed<S> result;
  for (int first = terms - block; first >= 0; first -= block) {
    Enclosed<S> part = exactly<S>(MatrixOf<S>::Zero(n, n));
    for (int k = block - 1; k >= 0; --k)
      part = sum(part, scaled(coefficients[static_cast<std::size_t>(first + k)],
                              powers[static_cast<std::size_t>(k)]));
    result = first == terms - block ? part : sum(part, product(powers.back(), result));
  }
  const double rest = std::exp2(-terms) / std::tgamma(terms + 1.0) * 1.2;
  const auto reach = paths(magnitudes<S>(X));
  for (Eigen::Index i = 0; i < result.mid.size(); ++i)
    if (reach(i)) result.rad(i) = up(result.rad(i) + rest);
  return result;
}

/// Element by element times a power of two; what underflows is bounded.
template <class S>
Ball<S> ball_times_power_of_two(const Ball<S>& x, int exponent) {
  if (x.is_zero() || exponent == 0) return x;
  const S mid = times_power_of_two(x.mid, exponent);
  double rad = times_power_of_two(x.rad, exponent);
  if (magnitude(mid) < kLeastNormal || rad < kLeastNormal)
    rad += x.rad == 0 && magnitude(mid) >= kLeastNormal ? 0 : kTiny;
  return {mid, rad};
}

template <class S>
Enclosed<S> enclosed_in_units(const Enclosed<S>& x, const std::vector<int>& exponents) {
  Enclosed<S> out;
  out.resize(x.rows(), x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      out.set(j * x.rows() + i,
              ball_times_power_of_two(x.ball(i, j), exponents[static_cast<std::size_t>(j)] -
                                                        exponents[static_cast<std::size_t>(i)]));
  return out;
}

/// Of numerics/balance.h. Elements that may be 0 do not count, unless they are large in the units
/// of the others.
template <class S>
std::vector<int> balance(const Enclosed<S>& A) {
  const Matrix sizes = magnitudes<S>(A), mids = magnitudes<S>(A.mid);
  const auto norm = [&](const std::vector<int>& units) {
    const auto scale = [](double x, int exponent) { return times_power_of_two(x, exponent); };
    return numerics::in_units(sizes, units, scale).rowwise().sum().maxCoeff();
  };
  const auto certain = numerics::balance((mids.array() > A.rad.array()).select(mids, 0.0));
  if (norm(certain) <= 1) return certain;
  const auto all = numerics::balance(sizes);
  return norm(certain) <= 2 * norm(all) ? certain : all;
}

/// e^A = D (e^X)^(2^k) D^-1 with X = D^-1 A D / 2^k, |X| <= 1/2 in the largest row sum, D balanced
/// units. The errors of the squarings are carried along by the products. Nothing is known when A is
/// so large that it has no value in double: k would be above 80.
template <class S>
Enclosed<S> exponential(const Enclosed<S>& A) {
  constexpr int kMostSquarings = 80;
  if (A.mid.size() == 0) return A;
  if (A.is_zero()) return exact_identity<S>(A.rows());
  std::vector<int> units = balance(A);
  const Enclosed<S> B = enclosed_in_units(A, units);
  const double norm = up(magnitudes<S>(B).rowwise().sum().maxCoeff(), 100);
  int squarings = 0;
  if (norm > 0.5) squarings = std::isfinite(norm) ? std::ilogb(norm) + 2 : kMostSquarings + 1;
  if (squarings > kMostSquarings) return nothing_known<S>(MatrixOf<S>(A.mid * S(0)));
  Enclosed<S> X;
  map_balls([&](const Ball<S>& x) { return ball_times_power_of_two(x, -squarings); }, B, X);
  Enclosed<S> result = series(X);
  for (int k = 0; k < squarings; ++k) result = product(result, result);
  for (int& unit : units) unit = -unit;
  return enclosed_in_units(result, units);
}

}  // namespace gainsmith::numbers::enclosed
