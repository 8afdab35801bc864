#include "support/sdp_dense.h"

#include "base/random.h"

namespace gainsmith::sdp::testing {
namespace {

class Digits {
 public:
  explicit Digits(std::uint64_t seed) : stream_(seed, 0) {}
  double number() { return 2 * stream_.uniform() - 1; }
  int below(int count) { return static_cast<int>(stream_.uniform() * count); }
  /// With all the digits of T.
  template <typename T>
  T full() {
    T value(0), step(1);
    for (int k = 0; k < (std::is_same_v<T, double> ? 1 : 8); ++k, step *= T(0x1p-50))
      value += step * T(number());
    return value;
  }

 private:
  RandomStream stream_;
};

/// Collects the entries of random matrices.
class Builder {
 public:
  Builder(std::vector<Block> blocks, int m, std::uint64_t seed) : random_(seed) {
    problem_.blocks = std::move(blocks);
    problem_.f.resize(static_cast<std::size_t>(m) + 1);
    for (int i = 0; i < m; ++i) {
      problem_.c.push_back(random_.number());
      problem_.c_rest.push_back(problem_.c.back() * random_.number() * 0x1p-54);
    }
  }
  int rows(int block) const { return problem_.blocks[static_cast<std::size_t>(block)].size; }
  int below(int count) { return random_.below(count); }

  void put(int i, int block, int row, int column) {
    const double value = std::exp2(random_.below(7)) * random_.number();
    problem_.f[static_cast<std::size_t>(i)].push_back({block, std::min(row, column),
                                                       std::max(row, column), value,
                                                       value * random_.number() * 0x1p-54});
  }
  void put_full(int i, int block) {
    for (int column = 0; column < rows(block); ++column)
      for (int row = 0; row <= column; ++row) put(i, block, row, column);
  }
  void put_diagonal(int i, int block) {
    for (int row = 0; row < rows(block); ++row) put(i, block, row, row);
  }
  /// The rows and columns first .. first + count - 1.
  void put_rows(int i, int block, int first, int count) {
    for (int column = 0; column < rows(block); ++column)
      for (int row = 0; row <= column; ++row)
        if ((row >= first && row < first + count) || (column >= first && column < first + count))
          put(i, block, row, column);
  }

  Problem problem_;

 private:
  Digits random_;
};

Problem one_block(int n, int m, std::uint64_t seed) {
  Builder b({{n, false}}, m, seed);
  for (int i = 0; i <= m; ++i) b.put_full(i, 0);
  return b.problem_;
}

Problem diagonal(int n, int m, std::uint64_t seed) {
  Builder b({{n, true}}, m, seed);
  for (int i = 0; i <= m; ++i) b.put_diagonal(i, 0);
  return b.problem_;
}

Problem ones(std::uint64_t seed) {
  Builder b({{1, false}, {1, false}, {1, true}, {1, false}}, 3, seed);
  for (int i = 0; i <= 3; ++i)
    for (int block = 0; block < 4; ++block)
      if (i == 0 || (i + block) % 3 != 0) b.put(i, block, 0, 0);
  return b.problem_;
}

/// F_i is empty in block b where (i + b) % 3 = 2; the last row of the second block never occurs.
Problem several(std::uint64_t seed) {
  Builder b({{4, false}, {3, true}, {1, false}, {5, false}, {2, false}}, 6, seed);
  for (int i = 0; i <= 6; ++i)
    for (int block = 0; block < 5; ++block) {
      if ((i + block) % 3 == 2) continue;
      if (block == 1) {
        b.put(i, 1, 0, 0);
        b.put(i, 1, 1, 1);
      } else {
        b.put_full(i, block);
      }
    }
  return b.problem_;
}

/// A few entries in each F_i, on a path that keeps the block connected; the common pattern is
/// sparse.
Problem few_entries(std::uint64_t seed) {
  constexpr int n = 40, m = 14;
  Builder b({{n, false}}, m, seed);
  for (int row = 0; row < n; ++row) b.put(0, 0, row, row);
  for (int row = 0; row + 1 < n; ++row) b.put(1 + row % m, 0, row, row + 1);
  for (int i = 1; i <= m; ++i) b.put(i, 0, 2 * i, 2 * i);
  return b.problem_;
}

/// Full F_0, F_1 and F_2, some rows in the others.
Problem few_rows(std::uint64_t seed) {
  constexpr int n = 34, m = 9;
  Builder b({{n, false}}, m, seed);
  for (int i = 0; i <= 2; ++i) b.put_full(i, 0);
  for (int i = 3; i <= m; ++i) b.put_rows(i, 0, 3 * i, i % 3 + 1);
  return b.problem_;
}

/// F_i in the blocks i and i - 1 and one entry of the linear part: B has few entries.
Problem chain(std::uint64_t seed) {
  constexpr int m = 110;
  std::vector<Block> blocks(m, Block{2, false});
  blocks.push_back({m, true});
  Builder b(std::move(blocks), m, seed);
  for (int block = 0; block < m; ++block) b.put_full(0, block);
  for (int i = 1; i <= m; ++i) {
    b.put_full(i, i - 1);
    if (i > 1) b.put(i, i - 2, 0, 1);
    b.put(i, m, i - 1, i - 1);
  }
  return b.problem_;
}

template <typename T>
Matrix<T> random_matrix(Digits& random, Eigen::Index n) {
  Matrix<T> a(n, n);
  for (T& value : a.reshaped()) value = random.full<T>();
  return a;
}

template <typename T>
Full<T> scaled(const T& factor, Full<T> m) {
  for (Matrix<T>& block : m) block *= factor;
  return m;
}

template <typename T>
T number(double value, double rest) {
  return std::is_same_v<T, double> ? T(value) : T(T(value) + T(rest));
}

}  // namespace

std::vector<NamedProblem> random_problems(std::uint64_t seed) {
  return {{"one dense block", one_block(5, 4, seed)},
          {"diagonal block", diagonal(6, 3, seed)},
          {"blocks of size one", ones(seed)},
          {"several blocks, some empty", several(seed)},
          {"few entries", few_entries(seed)},
          {"few rows", few_rows(seed)},
          {"chain", chain(seed)}};
}

template <typename T>
void fill_positive(std::uint64_t seed, Blocks<T>& matrix) {
  Digits random(seed);
  for (int b = 0; b < matrix.layout().blocks(); ++b) {
    auto block = matrix.dense(b);
    const auto a = random_matrix<T>(random, block.rows());
    const Matrix<T> square = a.lazyProduct(a.transpose());
    block =
        Matrix<T>::Identity(block.rows(), block.rows()) + T(0.5) * (square + square.transpose());
  }
  for (T& value : matrix.linear()) {
    const T a = random.full<T>();
    value = T(1) + a * a;
  }
}

// Without the entries outside of the pattern, and with a diagonal that dominates the others.
template <typename T>
void fill_positive(std::uint64_t seed, const Data& data, Blocks<T>& matrix) {
  fill_positive(seed, matrix);
  for (std::size_t b = 0; b < data.dense.size(); ++b) {
    const BlockData& block = data.dense[b];
    if (!block.sparse()) continue;
    auto target = matrix.dense(static_cast<int>(b));
    const Matrix<T> before = target;
    target.setZero();
    for (Eigen::Index j = 0; j < target.cols(); ++j) {
      const auto column = static_cast<std::size_t>(j);
      T sum(1);
      for (int p = block.pattern_start[column]; p < block.pattern_start[column + 1]; ++p) {
        const int i = block.pattern_row[static_cast<std::size_t>(p)];
        target(i, j) = before(i, j);
        sum += before(i, j) < T(0) ? T(-before(i, j)) : before(i, j);
      }
      target(j, j) = sum;
    }
  }
}

template <typename T>
void fill_symmetric(std::uint64_t seed, Blocks<T>& matrix) {
  Digits random(seed);
  for (int b = 0; b < matrix.layout().blocks(); ++b) {
    auto block = matrix.dense(b);
    const auto a = random_matrix<T>(random, block.rows());
    block = a + a.transpose();
  }
  for (T& value : matrix.linear()) value = random.full<T>();
}

template <typename T>
void fill(std::uint64_t seed, Vector<T>& v) {
  Digits random(seed);
  for (T& value : v) value = random.full<T>();
}

template <typename T>
Full<T> full(const Blocks<T>& matrix) {
  Full<T> result;
  for (int b = 0; b < matrix.layout().blocks(); ++b) result.emplace_back(matrix.dense(b));
  for (const T& value : matrix.linear()) result.push_back(Matrix<T>::Constant(1, 1, value));
  return result;
}

template <typename T>
Full<T> plus(const Full<T>& a, const T& factor, const Full<T>& b) {
  Full<T> result = a;
  for (std::size_t k = 0; k < a.size(); ++k) result[k] += factor * b[k];
  return result;
}

template <typename T>
Full<T> times(const Full<T>& a, const Full<T>& b) {
  Full<T> result;
  for (std::size_t k = 0; k < a.size(); ++k) result.push_back(a[k].lazyProduct(b[k]));
  return result;
}

template <typename T>
Full<T> symmetric_part(const Full<T>& m) {
  Full<T> result;
  for (const Matrix<T>& block : m) result.push_back(T(0.5) * (block + block.transpose()));
  return result;
}

template <typename T>
T trace_of_product(const Full<T>& a, const Full<T>& b) {
  T sum(0);
  for (std::size_t k = 0; k < a.size(); ++k)
    for (Eigen::Index j = 0; j < a[k].cols(); ++j)
      for (Eigen::Index i = 0; i < a[k].rows(); ++i) sum += a[k](i, j) * b[k](j, i);
  return sum;
}

template <typename T>
Full<T> inverse(const Full<T>& m) {
  Full<T> result;
  for (Matrix<T> a : m) {
    const Eigen::Index n = a.rows();
    Matrix<T> x = Matrix<T>::Identity(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const T pivot = a(k, k);
      a.row(k) /= pivot;
      x.row(k) /= pivot;
      for (Eigen::Index i = 0; i < n; ++i) {
        const T factor = a(i, k);
        if (i == k || factor == T(0)) continue;
        a.row(i) -= factor * a.row(k);
        x.row(i) -= factor * x.row(k);
      }
    }
    result.push_back(x);
  }
  return result;
}

template <typename T>
double largest(const Full<T>& m) {
  double result = 0;
  for (const Matrix<T>& block : m)
    for (const T& value : block.reshaped())
      result = std::max(result, std::abs(static_cast<double>(value)));
  return result;
}

template <typename T>
double largest(const Vector<T>& v) {
  return largest(Full<T>{v});
}

template <typename T>
template <typename Visit>
void Dense<T>::visit(const BlockData& block, const Visit& at) {
  for (std::size_t k = 0; k < block.constraint.size(); ++k)
    for (std::size_t t = block.start[k]; t < block.start[k + 1]; ++t)
      at(f[static_cast<std::size_t>(block.constraint[k])], block.terms[t],
         number<T>(block.terms[t].value, block.terms[t].rest));
}

template <typename T>
Dense<T>::Dense(const Data& data) : c(data.m()) {
  Full<T> zero;
  for (const int n : data.layout.size) zero.push_back(Matrix<T>::Zero(n, n));
  for (int k = 0; k < data.layout.linear; ++k) zero.push_back(Matrix<T>::Zero(1, 1));
  f.assign(static_cast<std::size_t>(data.m()) + 1, zero);
  for (std::size_t b = 0; b < data.dense.size(); ++b)
    visit(data.dense[b], [&](Full<T>& fi, const Term& term, const T& value) {
      fi[b](term.row, term.column) = fi[b](term.column, term.row) = value;
    });
  visit(data.linear, [&](Full<T>& fi, const Term& term, const T& value) {
    fi[data.dense.size() + static_cast<std::size_t>(term.row)](0, 0) = value;
  });
  for (int i = 0; i < data.m(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    c[i] = number<T>(data.c[at], data.c_rest[at]);
  }
}

template <typename T>
Full<T> Dense<T>::combine(const Vector<T>& x, const T& tau) const {
  Full<T> sum = scaled(T(-tau), f[0]);
  for (int i = 0; i < m(); ++i) sum = plus(sum, T(x[i]), f[static_cast<std::size_t>(i) + 1]);
  return sum;
}

template <typename T>
Vector<T> Dense<T>::products(const Full<T>& s) const {
  Vector<T> result(m());
  for (int i = 0; i < m(); ++i) result[i] = trace_of_product(f[static_cast<std::size_t>(i) + 1], s);
  return result;
}

#define GAINSMITH_INSTANTIATE(T)                                          \
  template struct Dense<T>;                                               \
  template Full<T> full(const Blocks<T>&);                                \
  template Full<T> plus(const Full<T>&, const T&, const Full<T>&);        \
  template Full<T> times(const Full<T>&, const Full<T>&);                 \
  template Full<T> symmetric_part(const Full<T>&);                        \
  template T trace_of_product(const Full<T>&, const Full<T>&);            \
  template Full<T> inverse(const Full<T>&);                               \
  template double largest(const Full<T>&);                                \
  template double largest(const Vector<T>&);                              \
  template void fill_positive<T>(std::uint64_t, Blocks<T>&);              \
  template void fill_positive<T>(std::uint64_t, const Data&, Blocks<T>&); \
  template void fill_symmetric<T>(std::uint64_t, Blocks<T>&);             \
  template void fill<T>(std::uint64_t, Vector<T>&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp::testing
