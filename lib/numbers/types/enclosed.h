// Matrices with a bound of the error of each element, and their arithmetic.
//
// The middle is of the scalar S, the radii are doubles rounded upward, both of the same shape. An
// infinite radius says that nothing is known of an element.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/eigen_scalars.h"
#include "numbers/matrix.h"
#include "numbers/types/ball.h"

namespace gainsmith::numbers {

/// |true - mid| <= rad element by element (ball.h). `mid` is finite.
template <class S>
struct Enclosed {
  MatrixOf<S> mid;
  Matrix rad;

  Eigen::Index rows() const { return mid.rows(); }
  Eigen::Index cols() const { return mid.cols(); }
  Ball<S> ball(Eigen::Index i, Eigen::Index j) const { return {mid(i, j), rad(i, j)}; }
  Ball<S> ball(Eigen::Index i) const { return {mid(i), rad(i)}; }
  void set(Eigen::Index i, const Ball<S>& value) {
    mid(i) = value.mid;
    rad(i) = value.rad;
  }
  void resize(Eigen::Index rows, Eigen::Index cols) {
    mid.resize(rows, cols);
    rad.resize(rows, cols);
  }
  bool is_exact() const { return (rad.array() == 0).all(); }
  bool is_zero() const { return is_exact() && (mid.array() == S(0)).all(); }
  /// A radius is finite everywhere.
  bool is_known() const { return is_finite(rad); }
};

/// Radius 0.
template <class S>
Enclosed<S> exactly(const MatrixOf<S>& matrix) {
  return {matrix, Matrix::Zero(matrix.rows(), matrix.cols())};
}
template <class S>
Enclosed<S> exact_number(const S& value) {
  return exactly<S>(MatrixOf<S>::Constant(1, 1, value));
}
template <class S>
Enclosed<S> exact_identity(Eigen::Index n) {
  return exactly<S>(MatrixOf<S>::Identity(n, n));
}
/// Nothing is known of `matrix`; what is not finite in it becomes 0.
template <class S>
Enclosed<S> nothing_known(const MatrixOf<S>& matrix) {
  using std::isfinite;
  return {matrix.unaryExpr([](const S& x) { return isfinite(x) ? x : S(0); }),
          Matrix::Constant(matrix.rows(), matrix.cols(), kNothingKnown)};
}

/// Not below |mid|, and not below any |true|.
template <class S>
Matrix magnitudes(const MatrixOf<S>& mid) {
  return mid.unaryExpr([](const S& x) { return magnitude(x); });
}
template <class S>
Matrix magnitudes(const Enclosed<S>& x) {
  return (magnitudes<S>(x.mid) + x.rad) * up(1);
}

/// A product of matrices with elements >= 0, n x k and k x m, rounded upward: by (k + 6) 2^-52 of
/// it, and by k times the least double where something may underflow.
inline Matrix product_upward(const Matrix& a, const Matrix& b) {
  const auto k = static_cast<double>(a.cols());
  Matrix product = a.lazyProduct(b);
  const double slack = up(1, k + 4);
  for (double& x : product.reshaped())
    x = bound_or_nothing(x * slack + (x < kLeastNormal && x != 0 ? k * kTiny : 0));
  return product;
}

/// f(ball), or f(ball of x, ball of y), for each element. `out` may be an operand.
template <class S, class Function>
void map_balls(const Function& function, const Enclosed<S>& x, Enclosed<S>& out) {
  out.resize(x.rows(), x.cols());
  for (Eigen::Index i = 0; i < x.mid.size(); ++i) out.set(i, function(x.ball(i)));
}
template <class S, class Function>
void map_balls(const Function& function, const Enclosed<S>& x, const Enclosed<S>& y,
               Enclosed<S>& out) {
  out.resize(x.rows(), x.cols());
  for (Eigen::Index i = 0; i < x.mid.size(); ++i) out.set(i, function(x.ball(i), y.ball(i)));
}

template <class S>
Enclosed<S> sum(const Enclosed<S>& x, const Enclosed<S>& y) {
  Enclosed<S> out;
  map_balls([](const Ball<S>& a, const Ball<S>& b) { return a + b; }, x, y, out);
  return out;
}
template <class S>
Enclosed<S> difference(const Enclosed<S>& x, const Enclosed<S>& y) {
  Enclosed<S> out;
  map_balls([](const Ball<S>& a, const Ball<S>& b) { return a - b; }, x, y, out);
  return out;
}
template <class S>
Enclosed<S> negative(const Enclosed<S>& x) {
  return {-x.mid, x.rad};
}
template <class S>
Enclosed<S> scaled(const Ball<S>& factor, const Enclosed<S>& x) {
  Enclosed<S> out;
  map_balls([&](const Ball<S>& a) { return factor * a; }, x, out);
  return out;
}
template <class S>
Enclosed<S> quotient(const Enclosed<S>& x, const Ball<S>& by) {
  Enclosed<S> out;
  map_balls([&](const Ball<S>& a) { return a / by; }, x, out);
  return out;
}
template <class S>
Enclosed<S> transposed(const Enclosed<S>& x) {
  return {x.mid.transpose(), x.rad.transpose()};
}

namespace enclosed {

/// Whether products with x are exact where they do not underflow: a power of two, of a binary S.
template <class S>
bool scales_exactly(const S& x) {
  int exponent = 0;
  const auto rounded = static_cast<double>(x);
  return std::abs(std::frexp(rounded, &exponent)) == 0.5 && x == S(rounded);
}

/// For each row the relative error of a sum of as many products as it has elements: 0 for a row
/// that picks one element in other units. `element(i, j)` are those of the matrix, or of its
/// transpose.
template <class S, class Element>
void row_roundoff(Eigen::Index rows, Eigen::Index cols, const Element& element, double* roundoff) {
  for (Eigen::Index i = 0; i < rows; ++i) {
    int count = 0;
    bool picks = true;
    for (Eigen::Index j = 0; j < cols; ++j) {
      const Ball<S> x = element(i, j);
      if (x.is_zero()) continue;
      ++count;
      picks = picks && x.is_exact() && scales_exactly(x.mid);
    }
    roundoff[i] = count == 0 || (count == 1 && picks) ? 0 : (count + 2) * unit_roundoff<S>();
  }
}

/// The least of `count` numbers other than 0; infinite when there is none.
inline double least_of(const double* sizes, Eigen::Index count) {
  double least = kNothingKnown;
  for (Eigen::Index k = 0; k < count; ++k)
    if (sizes[k] != 0 && sizes[k] < least) least = sizes[k];
  return least;
}

/// Numbers that multiply() works with, in one place that stays: small products do not allocate.
class ProductRoom {
 public:
  ProductRoom(Eigen::Index rows, Eigen::Index inner, Eigen::Index cols) {
    static thread_local std::vector<double> room;
    const Eigen::Index size = (rows + cols) * inner + 2 * rows + cols;
    if (static_cast<Eigen::Index>(room.size()) < size) room.resize(static_cast<std::size_t>(size));
    left = room.data();
    right = left + rows * inner;
    along = right + inner * cols;
    down = along + rows;
    sums = down + cols;
  }

  double *left, *right;  ///< sizes of the factors' elements, column by column
  double *along, *down;  ///< relative errors of rows and columns
  double* sums;          ///< of a column
};

}  // namespace enclosed

/// out = x y, x n x l, y l x m, with the radius
///   |X| rad_y + rad_x (|Y| + rad_y) + gamma_k |X| |Y|,   gamma_k = (k + 2) u,
/// where |fl(X Y) - X Y| <= gamma_k |X| |Y| and k counts the products that are not 0 by themselves
/// (Higham, Accuracy and Stability of Numerical Algorithms, 3.5). `out` is neither factor.
template <class S>
void multiply(const Enclosed<S>& x, const Enclosed<S>& y, Enclosed<S>& out) {
  const Eigen::Index rows = x.rows(), inner = x.cols(), cols = y.cols();
  out.resize(rows, cols);
  if (x.mid.size() == 1 && y.mid.size() == 1) return out.set(0, x.ball(0) * y.ball(0));
  const enclosed::ProductRoom room(rows, inner, cols);
  const auto size_of = [](const S& element) { return magnitude(element); };
  std::transform(x.mid.data(), x.mid.data() + x.mid.size(), room.left, size_of);
  std::transform(y.mid.data(), y.mid.data() + y.mid.size(), room.right, size_of);
  enclosed::row_roundoff<S>(
      rows, inner, [&](auto i, auto j) { return x.ball(i, j); }, room.along);
  enclosed::row_roundoff<S>(
      cols, inner, [&](auto j, auto i) { return y.ball(i, j); }, room.down);
  out.mid.setZero();
  out.rad.setZero();
  for (Eigen::Index j = 0; j < cols; ++j) {
    std::fill_n(room.sums, rows, 0.0);
    for (Eigen::Index k = 0; k < inner; ++k) {
      const S by = y.mid(k, j);
      const double size = room.right[k + j * inner], rad = y.rad(k, j), reach = size + rad;
      if (reach == 0) continue;
      const double* const left = room.left + k * rows;
      for (Eigen::Index i = 0; i < rows; ++i) {
        out.mid(i, j) += x.mid(i, k) * by;
        room.sums[i] += left[i] * size;
        out.rad(i, j) += left[i] * rad + x.rad(i, k) * reach;
      }
    }
    for (Eigen::Index i = 0; i < rows; ++i)
      out.rad(i, j) += room.sums[i] * std::min(room.along[i], room.down[j]);
  }
  const auto k = static_cast<double>(inner);
  const auto least = [](const double* sizes, const Matrix& radii) {
    return std::min(enclosed::least_of(sizes, radii.size()),
                    enclosed::least_of(radii.data(), radii.size()));
  };
  // The product of the least elements, or radii, that are not 0 decides.
  const bool may_underflow =
      least(room.left, x.rad) * least(room.right, y.rad) < kLeastNormal / unit_roundoff<S>();
  // What has only products that are 0 by themselves stays so.
  const auto has_product = [&](Eigen::Index i, Eigen::Index j) {
    for (Eigen::Index l = 0; l < inner; ++l)
      if (!x.ball(i, l).is_zero() && !y.ball(l, j).is_zero()) return true;
    return false;
  };
  const double slack = up(1, 2 * k + 8);
  for (Eigen::Index j = 0; j < cols; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) {
      double& r = out.rad(i, j);
      const bool tiny = r != 0 || (may_underflow && has_product(i, j));
      r = bound_or_nothing(r * slack + (tiny ? (k + 1) * kTiny : 0));
    }
}

template <class S>
Enclosed<S> product(const Enclosed<S>& x, const Enclosed<S>& y) {
  Enclosed<S> out;
  multiply(x, y, out);
  return out;
}

/// (X + X') / 2; an element that equals its mirror image keeps its ball.
template <class S>
Enclosed<S> symmetric_part(const Enclosed<S>& x) {
  Enclosed<S> out = x;
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i) {
      if (x.mid(i, j) == x.mid(j, i) && x.rad(i, j) == x.rad(j, i)) continue;
      const Ball<S> twice = x.ball(i, j) + x.ball(j, i);
      const S mid = twice.mid / S(2);
      out.mid(i, j) = out.mid(j, i) = mid;
      out.rad(i, j) = out.rad(j, i) = twice.rad / 2 + kTiny;
    }
  return out;
}

/// The same in another scalar, with the rounding of the middle in the radius.
template <class To, class From>
Enclosed<To> converted(const Enclosed<From>& x) {
  if constexpr (std::is_same_v<To, From>) {
    return x;
  } else {
    Enclosed<To> out;
    out.resize(x.rows(), x.cols());
    for (Eigen::Index i = 0; i < x.mid.size(); ++i) {
      const To mid = as<To>(x.mid(i));
      const double lost = as<From>(mid) == x.mid(i) ? 0 : up(magnitude(mid) * 0x1p-52) + kTiny;
      out.set(i, {mid, up(x.rad(i) + lost)});
    }
    return out;
  }
}

}  // namespace gainsmith::numbers
