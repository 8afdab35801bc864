#include "sdp/schur/kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include "base/scalars.h"
#include "base/stop.h"
#include "sdp/core/work.h"
#include "sdp/schur/pairs.h"
#include "sdp/schur/product.h"

namespace gainsmith::sdp {
namespace {

using Index = Eigen::Index;
template <typename T>
using Strided = Eigen::Map<Matrix<T>, 0, Eigen::OuterStride<>>;
template <typename T>
using ConstStrided = Eigen::Map<const Matrix<T>, 0, Eigen::OuterStride<>>;

template <typename T>
ConstStrided<T> map(const View<const T>& v) {
  return {v.data, v.rows, v.columns, Eigen::OuterStride<>(v.stride)};
}
template <typename T>
Strided<T> map(const View<T>& v) {
  return {v.data, v.rows, v.columns, Eigen::OuterStride<>(v.stride)};
}

// ---- double-double product -------------------------------------------------------------------

/// The halves of a matrix apart, in panels of kWidth rows (zeros below the last one), for the
/// vector unit; and for each row a power of two above its norm.
struct Halves {
  std::vector<double> high, low, bound;

  void take(const View<const DoubleDouble>& a) {
    const Index panels = (a.rows + kWidth - 1) / kWidth;
    const auto rows = static_cast<std::size_t>(panels * kWidth);
    const std::size_t size = rows * static_cast<std::size_t>(a.columns);
    if (high.size() < size) {
      high.resize(size);
      low.resize(size);
    }
    bound.resize(rows);
    for (Index p = 0; p < panels; ++p) take_panel(a, p);
  }

 private:
  void take_panel(const View<const DoubleDouble>& a, Index p) {
    const Index first = p * kWidth, count = std::min<Index>(kWidth, a.rows - first);
    double* to_high = high.data() + first * a.columns;
    double* to_low = low.data() + first * a.columns;
    Register squares = {};
    for (Index k = 0; k < a.columns; ++k, to_high += kWidth, to_low += kWidth) {
      Register upper, lower;
      if (count == kWidth) {
        split_pairs(&a(first, k), upper, lower);
      } else {
        std::array<DoubleDouble, kWidth> part{};
        std::copy_n(&a(first, k), count, part.begin());
        split_pairs(part.data(), upper, lower);
      }
      std::memcpy(to_high, &upper, sizeof upper);
      std::memcpy(to_low, &lower, sizeof lower);
      squares += upper * upper;
    }
    for (int r = 0; r < kWidth; ++r)
      bound[static_cast<std::size_t>(first + r)] = power_above(std::sqrt(squares[r]));
  }
};

/// The columns j .. j + count - 1 of C, to kWidth rows at a time.
template <std::size_t count>
void multiply_columns(const Halves& a, Index inner, const View<const DoubleDouble>& b,
                      const View<DoubleDouble>& c, Index j, Update update) {
  std::array<double, count> bound{};
  for (std::size_t q = 0; q < count; ++q) {
    for (Index k = 0; k < inner; ++k) {
      const double value = b(k, j + static_cast<Index>(q)).hi();
      bound[q] += value * value;
    }
    bound[q] = power_above(std::sqrt(bound[q]));
  }
  for (Index i = 0; i < c.rows; i += kWidth) {
    BiasedSums<count> sums(a.bound.data() + i, bound);
    const double* high = a.high.data() + i * inner;
    const double* low = a.low.data() + i * inner;
    for (Index k = 0; k < inner; ++k, high += kWidth, low += kWidth)
      sums.add(high, low, &b(k, j), b.stride);
      // Unrolled, or the sums are not kept in registers.
#pragma GCC unroll 8
    for (std::size_t q = 0; q < count; ++q) {
      DoubleDouble* const entries = &c(i, j + static_cast<Index>(q));
      if (c.rows - i >= kWidth) {
        sums.store(q, update == Update::subtract, entries);
      } else {
        std::array<DoubleDouble, kWidth> part;
        std::copy_n(entries, c.rows - i, part.begin());
        sums.store(q, update == Update::subtract, part.data());
        std::copy_n(part.begin(), c.rows - i, entries);
      }
    }
  }
}

void multiply_pairs(const View<const DoubleDouble>& a, const View<const DoubleDouble>& b,
                    const View<DoubleDouble>& c, Update update) {
  static thread_local Halves halves;
  halves.take(a);
  // As many columns as leave registers for the factors, of 16.
  constexpr int kColumns = 4;
  Index j = 0;
  for (; j + kColumns <= c.columns; j += kColumns)
    multiply_columns<kColumns>(halves, a.columns, b, c, j, update);
  for (; j + kColumns / 2 <= c.columns; j += kColumns / 2)
    multiply_columns<kColumns / 2>(halves, a.columns, b, c, j, update);
  for (; j < c.columns; ++j) multiply_columns<1>(halves, a.columns, b, c, j, update);
}

/// Each column of C as a sum of columns of A, for 100 digits.
template <typename T>
void multiply_plain(const View<const T>& a, const View<const T>& b, const View<T>& c,
                    Update update) {
  for (Index j = 0; j < c.columns; ++j) {
    spend_on<T>(static_cast<double>(c.rows * a.columns));
    if (update == Update::assign)
      for (Index i = 0; i < c.rows; ++i) c(i, j) = T(0);
    for (Index k = 0; k < a.columns; ++k) {
      const T factor = update == Update::assign ? b(k, j) : T(-b(k, j));
      for (Index i = 0; i < c.rows; ++i) c(i, j) += a(i, k) * factor;
    }
  }
}

/// sum of a_i b_i, first <= i < last, in four chains that do not wait for each other.
template <typename T>
T dot(const T* a, const T* b, Index first, Index last) {
  std::array<T, 4> sums = {T(0), T(0), T(0), T(0)};
  Index i = first;
  for (; i + 4 <= last; i += 4)
    for (Index q = 0; q < 4; ++q) sums[static_cast<std::size_t>(q)] += a[i + q] * b[i + q];
  for (; i < last; ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// x := L^-T L^-1 x with x in halves, so that the columns run at vector speed.
void solve_factored_pairs(const View<const DoubleDouble>& l, Vector<DoubleDouble>& x) {
  static thread_local std::vector<double> high, low;
  const auto m = static_cast<std::size_t>(l.rows);
  high.resize(m);
  low.resize(m);
  for (std::size_t i = 0; i < m; ++i) {
    high[i] = x[static_cast<Index>(i)].hi();
    low[i] = x[static_cast<Index>(i)].lo();
  }
  for (std::size_t k = 0; k < m; ++k) {
    const DoubleDouble* const column = l.data + l.stride * static_cast<Index>(k);
    const DoubleDouble value = (DoubleDouble(high[k]) + DoubleDouble(low[k])) / column[k];
    x[static_cast<Index>(k)] = value;
    for (std::size_t i = k + 1; i < m; ++i)
      add_product(high[i], low[i], column[i].hi(), column[i].lo(), -value.hi(), -value.lo());
  }
  for (std::size_t k = m; k-- > 0;) {
    const DoubleDouble* const column = l.data + l.stride * static_cast<Index>(k);
    const auto at = static_cast<Index>(k);
    x[at] = (x[at] - inner_product(column + k + 1, x.data() + k + 1, m - k - 1)) / column[k];
  }
}

// ---- Cholesky and inverse, blocked on products
// ---------------------------------------------------

/// Columns of a panel, and of the panels that it is factored by; and those of the panels of a large
/// matrix, which would come from memory too often otherwise.
constexpr Index kPanel = 32, kInnerPanel = 8, kOuterPanel = 128;
/// Columns of a large matrix.
constexpr Index kLarge = 512;

/// By rows k of L X = I: row k of X is divided by L_kk, and each row i below loses L_ik X_k.
template <typename T>
void invert_lower_plain(const View<const T>& l, const View<T>& result) {
  for (Index k = 0; k < l.rows; ++k) {
    const T root = T(1) / l(k, k);
    result(k, k) = T(1);
    for (Index j = 0; j <= k; ++j) {
      const T value = result(k, j) * root;
      result(k, j) = value;
      for (Index i = k + 1; i < l.rows; ++i) result(i, j) -= l(i, k) * value;
    }
  }
}

/// Column j loses L_jp L(:, p), p < j, and is divided by the root of its pivot. False when a pivot
/// is not positive.
template <typename T>
bool cholesky_plain(const View<T>& a) {
  using std::sqrt;
  for (Index j = 0; j < a.columns; ++j) {
    for (Index p = 0; p < j; ++p) {
      const T factor = a(j, p);
      for (Index i = j; i < a.rows; ++i) a(i, j) -= a(i, p) * factor;
    }
    if (!(a(j, j) > T(0))) return false;
    const T root = T(1) / sqrt(a(j, j));
    for (Index i = j; i < a.rows; ++i) a(i, j) *= root;
  }
  return true;
}

/// The panels that one of `width` columns is factored by.
Index narrower(Index width) {
  if (width > kPanel) return kPanel;
  return width > kInnerPanel ? kInnerPanel : 1;
}

/// Such a part of L21 changes nothing: sparse factors skip it.
template <typename T>
bool is_zero(const View<T>& a) {
  for (Index j = 0; j < a.columns; ++j)
    for (Index i = 0; i < a.rows; ++i)
      if (a(i, j) != T(0)) return false;
  return true;
}

//   [ L11        ]   columns k .. k+w: the panel, factored by itself
//   [ L21   A22  ]   A22 -= L21 L21', lower triangle, by block columns where L21 has rows
//   A may have more rows than columns: then they are a panel of a larger matrix.
template <typename T>
bool cholesky_blocked(const View<T>& a, Index width) {
  for (Index k = 0; k < a.columns; k += width) {
    const Index w = std::min(width, a.columns - k);
    const View<T> panel = a.part(k, k, a.rows - k, w);
    if (std::is_same_v<T, double> && width > kInnerPanel)
      spend_on<T>(static_cast<double>(w * (a.columns - k)) * static_cast<double>(a.rows - k) / 2);
    const Index inner = narrower(width);
    if (!(inner > 1 ? cholesky_blocked(panel, inner) : cholesky_plain(panel))) return false;
    for (Index j = k + w; j < a.columns; j += width) {
      check_stop();
      const Index wj = std::min(width, a.columns - j);
      const View<T> rows = a.part(j, k, wj, w);
      if (is_zero(rows)) continue;
      multiply_outer(constant(a.part(j, k, a.rows - j, w)), constant(rows),
                     a.part(j, j, a.rows - j, wj), Update::subtract);
    }
  }
  return true;
}

// By block rows K of L X = I:  X_K = L_KK^-1 B_K,  where B, I at first, loses L_.K X_K in the rows
// below once X_K is known. The result is zero to begin with.
template <typename T>
void invert_lower_blocked(const View<const T>& l, const View<T>& result, Index width) {
  static thread_local Matrix<T> copied(kPanel, kPanel);
  const Index n = l.rows;
  for (Index k = 0; k < n; k += width) {
    const Index w = std::min(width, n - k);
    const View<T> corner = result.part(k, k, w, w);
    if (width > kInnerPanel)
      invert_lower_blocked(l.part(k, k, w, w), corner, kInnerPanel);
    else
      invert_lower_plain(l.part(k, k, w, w), corner);
    for (Index j = 0; j < k; j += width) {
      const View<T> block = result.part(k, j, w, width), copy(copied.data(), w, width, kPanel);
      map(copy) = map(block);
      multiply(constant(corner), constant(copy), block);
    }
    multiply(l.part(k + w, k, n - k - w, w), constant(result.part(k, 0, w, k + w)),
             result.part(k + w, 0, n - k - w, k + w), Update::subtract);
  }
}

}  // namespace

template <typename T>
void multiply(const View<const T>& a, const View<const T>& b, const View<T>& c, Update update) {
  if constexpr (std::is_same_v<T, DoubleDouble>)
    spend_on<T>(static_cast<double>(c.rows * c.columns) * static_cast<double>(b.rows));
  if constexpr (std::is_same_v<T, double>) {
    multiply_doubles(a, b, c, update);
  } else if constexpr (std::is_same_v<T, DoubleDouble>) {
    multiply_pairs(a, b, c, update);
  } else {
    multiply_plain(a, b, c, update);
  }
}

template <typename T>
void multiply_sparse(const View<const T>& a, const View<const T>& s, const std::vector<int>& start,
                     const std::vector<int>& rows, const View<T>& c) {
  using Column = Eigen::Map<Vector<T>>;
  using ConstColumn = Eigen::Map<const Vector<T>>;
  for (Index j = 0; j < c.columns; ++j) {
    Column target(c.data + c.stride * j, c.rows);
    target.setZero();
    const auto at = static_cast<std::size_t>(j);
    for (int p = start[at]; p < start[at + 1]; ++p) {
      const int k = rows[static_cast<std::size_t>(p)];
      target += ConstColumn(a.data + a.stride * k, a.rows) * s(k, j);
    }
  }
}

template <typename T>
void multiply_outer(const View<const T>& a, const View<const T>& b, const View<T>& c,
                    Update update) {
  if constexpr (std::is_same_v<T, double>) {
    multiply_outer_doubles(a, b, c, update);
  } else {
    // B' is copied, so that one kernel does for both products; in double B is read as it lies.
    static thread_local Matrix<T> transposed;
    if (transposed.size() < b.rows * b.columns) transposed.resize(b.columns, b.rows);
    const View<T> copy(transposed.data(), b.columns, b.rows, b.columns);
    for (Index j = 0; j < b.rows; ++j)
      for (Index p = 0; p < b.columns; ++p) copy(p, j) = b(j, p);
    multiply(a, constant(copy), c, update);
  }
}

// By block columns, without the zeros.
template <typename T>
void multiply_upper(const View<const T>& a, const View<const T>& u, const View<T>& c) {
  for (Index j = 0; j < c.columns; j += kPanel) {
    const Index w = std::min(kPanel, c.columns - j);
    multiply(a.part(0, 0, a.rows, j + w), u.part(0, j, j + w, w), c.part(0, j, c.rows, w));
  }
}

// By block columns: L has zeros above its diagonal block.
template <typename T>
void multiply_lower(const View<const T>& a, const View<const T>& l, const View<T>& c) {
  const Index n = c.columns;
  for (Index j = 0; j < n; j += kPanel) {
    const Index w = std::min(kPanel, n - j);
    multiply(a.part(0, j, a.rows, n - j), l.part(j, j, n - j, w), c.part(0, j, c.rows, w));
  }
}

// By block rows: A' has zeros to the left of its diagonal block.
template <typename T>
void multiply_transposed(const View<const T>& a, const View<const T>& a_transposed,
                         const View<T>& c) {
  const Index n = c.rows;
  for (Index k = 0; k < n; k += kPanel) {
    const Index w = std::min(kPanel, n - k);
    multiply(a_transposed.part(k, k, w, n - k), a.part(k, 0, n - k, k + w), c.part(k, 0, w, k + w));
  }
  // Rounding must not make a difference between the two: a wider arithmetic would detect it.
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < j; ++i) c(i, j) = c(j, i);
}

template <typename T>
bool cholesky(const View<T>& a) {
  return cholesky_blocked(a, a.columns > kLarge ? kOuterPanel : kPanel);
}

template <typename T>
void invert_lower(const View<const T>& l, const View<T>& result) {
  map(result).setZero();
  invert_lower_blocked(l, result, kPanel);
}

template <typename T>
void solve_factored(const View<const T>& l, Vector<T>& x) {
  if constexpr (std::is_same_v<T, double>) {
    const ConstStrided<double> lower = map(l);
    lower.triangularView<Eigen::Lower>().solveInPlace(x);
    lower.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  } else if constexpr (std::is_same_v<T, DoubleDouble>) {
    solve_factored_pairs(l, x);
  } else {
    // Forward by columns, backward by inner products: both read L along its columns.
    for (Index k = 0; k < l.rows; ++k) {
      x[k] /= l(k, k);
      for (Index i = k + 1; i < l.rows; ++i) x[i] -= l(i, k) * x[k];
    }
    for (Index k = l.rows - 1; k >= 0; --k)
      x[k] = (x[k] - dot(&l(0, k), x.data(), k + 1, l.rows)) / l(k, k);
  }
}

#define GAINSMITH_INSTANTIATE(T)                                                                 \
  template void multiply<T>(const View<const T>&, const View<const T>&, const View<T>&, Update); \
  template void multiply_sparse<T>(const View<const T>&, const View<const T>&,                   \
                                   const std::vector<int>&, const std::vector<int>&,             \
                                   const View<T>&);                                              \
  template void multiply_transposed<T>(const View<const T>&, const View<const T>&,               \
                                       const View<T>&);                                          \
  template void multiply_outer<T>(const View<const T>&, const View<const T>&, const View<T>&,    \
                                  Update);                                                       \
  template void multiply_upper<T>(const View<const T>&, const View<const T>&, const View<T>&);   \
  template void multiply_lower<T>(const View<const T>&, const View<const T>&, const View<T>&);   \
  template bool cholesky<T>(const View<T>&);                                                     \
  template void invert_lower<T>(const View<const T>&, const View<T>&);                           \
  template void solve_factored<T>(const View<const T>&, Vector<T>&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
