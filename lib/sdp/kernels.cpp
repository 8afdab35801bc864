#include "sdp/kernels.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "sdp/pairs.h"
#include "sdp/scalars.h"

namespace gainsmith::sdp {
namespace {

using Index = Eigen::Index;
using Strided = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using ConstStrided = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

ConstStrided map(const View<const double>& v) {
  return {v.data, v.rows, v.columns, Eigen::OuterStride<>(v.stride)};
}
Strided map(const View<double>& v) {
  return {v.data, v.rows, v.columns, Eigen::OuterStride<>(v.stride)};
}

template <typename T>
View<const T> constant(const View<T>& v) {
  return {v.data, v.rows, v.columns, v.stride};
}

// ---- double-double product -------------------------------------------------------------------

/// The halves of a matrix apart, rows padded to whole registers, for the vector unit; and for each
/// row a power of two above its norm.
struct Halves {
  std::vector<double> high, low, bound;
  Index stride = 0;

  void take(const View<const DoubleDouble>& a) {
    stride = (a.rows + kLanes - 1) / kLanes * kLanes;
    const auto size = static_cast<std::size_t>(stride * a.columns);
    if (high.size() < size) {
      high.resize(size);
      low.resize(size);
    }
    bound.assign(static_cast<std::size_t>(stride), 0);
    for (Index k = 0; k < a.columns; ++k)
      for (Index i = 0; i < stride; ++i) {
        const DoubleDouble value = i < a.rows ? a(i, k) : DoubleDouble(0);
        high[static_cast<std::size_t>(i + stride * k)] = value.hi();
        low[static_cast<std::size_t>(i + stride * k)] = value.lo();
        bound[static_cast<std::size_t>(i)] += value.hi() * value.hi();
      }
    for (double& square : bound) square = power_above(std::sqrt(square));
  }
};

/// The columns j .. j + count - 1 of C, to kLanes rows at a time.
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
  for (Index i = 0; i < c.rows; i += kLanes) {
    BiasedSums<count> sums(a.bound.data() + i, bound);
    const double* high = a.high.data() + i;
    const double* low = a.low.data() + i;
    for (Index k = 0; k < inner; ++k, high += a.stride, low += a.stride)
      sums.add(high, low, &b(k, j), b.stride);
    for (std::size_t q = 0; q < count; ++q)
      for (Index r = 0; r < kLanes && i + r < c.rows; ++r) {
        const DoubleDouble sum = sums.value(q, static_cast<std::size_t>(r));
        DoubleDouble& entry = c(i + r, j + static_cast<Index>(q));
        entry = update == Update::assign ? sum : entry - sum;
      }
  }
}

void multiply_pairs(const View<const DoubleDouble>& a, const View<const DoubleDouble>& b,
                    const View<DoubleDouble>& c, Update update) {
  static thread_local Halves halves;
  halves.take(a);
  Index j = 0;
  for (; j + 6 <= c.columns; j += 6) multiply_columns<6>(halves, a.columns, b, c, j, update);
  for (; j + 3 <= c.columns; j += 3) multiply_columns<3>(halves, a.columns, b, c, j, update);
  for (; j < c.columns; ++j) multiply_columns<1>(halves, a.columns, b, c, j, update);
}

template <typename T>
void multiply_plain(const View<const T>& a, const View<const T>& b, const View<T>& c,
                    Update update) {
  for (Index j = 0; j < c.columns; ++j) {
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

// ---- Cholesky, blocked on multiply -------------------------------------------------------------

/// Columns of a panel, and of the panels that it is factored by.
constexpr Index kPanel = 32, kInnerPanel = 8;

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

//   [ L11        ]   columns k .. k+w: the panel, factored by itself
//   [ L21   A22  ]   A22 -= L21 L21', lower triangle, by block columns
//   A may have more rows than columns: then they are a panel of a larger matrix.
template <typename T>
bool cholesky_blocked(const View<T>& a, Index width) {
  Matrix<T> transposed;
  for (Index k = 0; k < a.columns; k += width) {
    const Index w = std::min(width, a.columns - k);
    const View<T> panel = a.part(k, k, a.rows - k, w);
    if (!(width > kInnerPanel ? cholesky_blocked(panel, kInnerPanel) : cholesky_plain(panel)))
      return false;
    const Index rest = a.columns - k - w;
    if (rest == 0) break;
    transposed.resize(w, rest);
    for (Index j = 0; j < rest; ++j)
      for (Index p = 0; p < w; ++p) transposed(p, j) = a(k + w + j, k + p);
    for (Index j = 0; j < rest; j += width) {
      const Index wj = std::min(width, rest - j);
      multiply(constant(a.part(k + w + j, k, a.rows - k - w - j, w)),
               View<const T>(transposed.data() + w * j, w, wj, w),
               a.part(k + w + j, k + w + j, a.rows - k - w - j, wj), Update::subtract);
    }
  }
  return true;
}

}  // namespace

template <typename T>
void multiply(const View<const T>& a, const View<const T>& b, const View<T>& c, Update update) {
  if constexpr (std::is_same_v<T, double>) {
    if (update == Update::assign)
      map(c).noalias() = map(a) * map(b);
    else
      map(c).noalias() -= map(a) * map(b);
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
void multiply_transposed(const View<const T>& a, const View<const T>& a_transposed,
                         const View<T>& c) {
  if constexpr (std::is_same_v<T, double>) {
    auto result = map(c);
    result.setZero();
    result.template selfadjointView<Eigen::Lower>().rankUpdate(map(a_transposed));
    result.template triangularView<Eigen::StrictlyUpper>() = result.transpose();
  } else {
    multiply(a_transposed, a, c);
    // Rounding must not make a difference between the two: a wider arithmetic would see it.
    for (Index j = 0; j < c.columns; ++j)
      for (Index i = 0; i < j; ++i) c(i, j) = c(j, i);
  }
}

template <typename T>
bool cholesky(const View<T>& a) {
  if constexpr (std::is_same_v<T, double>) {
    Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> in_place(map(a));
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>> llt(in_place);
    return llt.info() == Eigen::Success;
  } else {
    return cholesky_blocked(a, kPanel);
  }
}

template <typename T>
void invert_lower(const View<const T>& l, const View<T>& result) {
  if constexpr (std::is_same_v<T, double>) {
    auto inverse = map(result);
    inverse.setIdentity();
    const ConstStrided lower = map(l);
    lower.triangularView<Eigen::Lower>().solveInPlace(inverse);
  } else {
    for (Index j = 0; j < l.columns; ++j) {
      for (Index i = 0; i < l.rows; ++i) result(i, j) = T(i == j ? 1 : 0);
      for (Index k = j; k < l.rows; ++k) {
        const T value = result(k, j) / l(k, k);
        result(k, j) = value;
        for (Index i = k + 1; i < l.rows; ++i) result(i, j) -= l(i, k) * value;
      }
    }
  }
}

template <typename T>
void solve_factored(const View<const T>& l, Vector<T>& x) {
  if constexpr (std::is_same_v<T, double>) {
    const ConstStrided lower = map(l);
    lower.triangularView<Eigen::Lower>().solveInPlace(x);
    lower.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  } else if constexpr (std::is_same_v<T, DoubleDouble>) {
    solve_factored_pairs(l, x);
  } else {
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
  template bool cholesky<T>(const View<T>&);                                                     \
  template void invert_lower<T>(const View<const T>&, const View<T>&);                           \
  template void solve_factored<T>(const View<const T>&, Vector<T>&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
