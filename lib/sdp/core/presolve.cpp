#include "sdp/core/presolve.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/scalars.h"

namespace gainsmith::sdp {
namespace {

/// Disjoint sets of the rows of one block.
class Components {
 public:
  explicit Components(int n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  /// The smaller row stays the representative, so that components keep the order of their rows.
  void join(int i, int j) {
    i = find(i);
    j = find(j);
    parent_[at(std::max(i, j))] = std::min(i, j);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::vector<int> parent_;
};

/// Where a row of the original problem went: a working block (-1: linear part) and its row there.
struct Target {
  int block = -1;
  int row = -1;
};

/// The largest power of two that is <= value > 0, but for the rounding of the logarithm.
double power_of_two_below(double value) { return std::exp2(std::floor(std::log2(value))); }

/// Gives every row that occurs its place: components of one row go to the linear part.
std::vector<std::vector<Target>> place_rows(const Problem& problem, Recovery& recovery) {
  std::vector<Components> components;
  std::vector<std::vector<char>> occurs;
  for (const Block& block : problem.blocks) {
    components.emplace_back(block.size);
    occurs.emplace_back(static_cast<std::size_t>(block.size), 0);
  }
  for (const auto& list : problem.f)
    for (const Entry& e : list) {
      if (e.value == 0) continue;
      const auto b = static_cast<std::size_t>(e.block);
      // An entry joins its two rows: what is not joined can be split into blocks.
      occurs[b][static_cast<std::size_t>(e.row)] = occurs[b][static_cast<std::size_t>(e.column)] =
          1;
      components[b].join(e.row, e.column);
    }

  std::vector<std::vector<Target>> targets;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const int n = problem.blocks[b].size;
    std::vector<int> count(static_cast<std::size_t>(n), 0);
    for (int r = 0; r < n; ++r) ++count[static_cast<std::size_t>(components[b].find(r))];
    std::vector<int> block_of(static_cast<std::size_t>(n), -1);
    auto& target = targets.emplace_back(static_cast<std::size_t>(n));
    for (int r = 0; r < n; ++r) {
      if (!occurs[b][static_cast<std::size_t>(r)]) continue;
      const auto root = static_cast<std::size_t>(components[b].find(r));
      const Recovery::Row row{static_cast<int>(b), r};
      // A row that no entry joins with another is a scalar inequality.
      if (count[root] == 1) {
        target[static_cast<std::size_t>(r)] = {-1, static_cast<int>(recovery.linear.size())};
        recovery.linear.push_back(row);
        continue;
      }
      if (block_of[root] < 0) {
        block_of[root] = static_cast<int>(recovery.dense.size());
        recovery.dense.emplace_back();
      }
      auto& rows = recovery.dense[static_cast<std::size_t>(block_of[root])];
      target[static_cast<std::size_t>(r)] = {block_of[root], static_cast<int>(rows.size())};
      rows.push_back(row);
    }
  }
  return targets;
}

Layout layout_of(const Recovery& recovery) {
  std::vector<int> sizes;
  for (const auto& rows : recovery.dense) sizes.push_back(static_cast<int>(rows.size()));
  return Layout(std::move(sizes), static_cast<int>(recovery.linear.size()));
}

/// Where an entry belongs in the working problem.
struct Placed {
  int block = 0;  ///< -1: linear part
  Term term;
  const Entry* entry = nullptr;
};

/// Appends the entries of F_i, times a power of two, to the blocks they fall in, sorted by column
/// and row, equal places added up.
void append(const Problem& problem, int i, int constraint, double factor,
            const std::vector<std::vector<Target>>& targets, Data& data) {
  std::vector<Placed> placed;
  for (const Entry& e : problem.f[static_cast<std::size_t>(i)]) {
    if (e.value == 0) continue;
    const auto& target = targets[static_cast<std::size_t>(e.block)];
    const Target row = target[static_cast<std::size_t>(e.row)];
    const Target column = target[static_cast<std::size_t>(e.column)];
    placed.push_back({row.block, {row.row, column.row, e.value * factor, e.rest * factor}, &e});
  }
  const auto key = [](const Placed& p) { return std::tie(p.block, p.term.column, p.term.row); };
  const auto before = [&](const Placed& a, const Placed& b) { return key(a) < key(b); };
  if (!std::is_sorted(placed.begin(), placed.end(), before))
    std::stable_sort(placed.begin(), placed.end(), before);
  for (std::size_t k = 0; k < placed.size();) {
    const std::size_t from = k;
    const Placed& first = placed[k];
    DoubleDouble sum(first.term.value, first.term.rest);
    for (++k; k < placed.size() && key(placed[k]) == key(first); ++k)
      sum += DoubleDouble(placed[k].term.value, placed[k].term.rest);
    if (sum.hi() == 0) continue;
    BlockData& block =
        first.block < 0 ? data.linear : data.dense[static_cast<std::size_t>(first.block)];
    if (block.constraint.empty() || block.constraint.back() != constraint) {
      block.constraint.push_back(constraint);
      block.start.push_back(block.start.back());
    }
    block.terms.push_back({first.term.row, first.term.column, sum.hi(), sum.lo()});
    ++block.start.back();
    if (problem.finer.empty()) continue;
    Decimal100 wide(0);
    for (std::size_t at = from; at < k; ++at)
      wide += coefficient<Decimal100>(problem, *placed[at].entry) * factor;
    block.wide.push_back(wide);
  }
}

/// Blocks with a sparser common pattern than this, and of at least this size, keep it.
constexpr double kSparse = 0.2;
constexpr int kSparseSize = 24;

/// Sets BlockData::pattern_start and pattern_row where they are worth keeping.
void find_pattern(BlockData& block, int n) {
  if (n < kSparseSize) return;
  const auto size = static_cast<std::size_t>(n);
  std::vector<char> occurs(size * size, 0);
  const auto mark = [&](int row, int column) {
    occurs[static_cast<std::size_t>(row) + size * static_cast<std::size_t>(column)] = 1;
  };
  for (const Term& term : block.terms) {
    mark(term.row, term.column);
    mark(term.column, term.row);
  }
  for (int i = 0; i < n; ++i) mark(i, i);
  const auto count = static_cast<double>(std::count(occurs.begin(), occurs.end(), 1));
  if (count > kSparse * n * n) return;
  block.pattern_start.push_back(0);
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t i = 0; i < size; ++i)
      if (occurs[i + size * j]) block.pattern_row.push_back(static_cast<int>(i));
    block.pattern_start.push_back(static_cast<int>(block.pattern_row.size()));
  }
}

}  // namespace

double frobenius_norm(const std::vector<Entry>& list) {
  double largest = 0, sum = 0;
  for (const Entry& e : list) largest = std::max(largest, std::abs(e.value));
  if (largest == 0) return 0;
  for (const Entry& e : list) {
    const double scaled = e.value / largest;
    sum += (e.row == e.column ? 1 : 2) * scaled * scaled;
  }
  return largest * std::sqrt(sum);
}

Presolved presolve(const Problem& problem) {
  Presolved result;
  Recovery& recovery = result.recovery;
  Data& data = result.data;
  const auto targets = place_rows(problem, recovery);
  data.layout = layout_of(recovery);
  data.dense.resize(recovery.dense.size());

  // gamma_f and s_i bring the norms of F_0 and F_i to [1, 2), gamma_c the largest |s_i c_i|.
  const double norm_f0 = frobenius_norm(problem.f[0]);
  if (norm_f0 > 0) recovery.gamma_f = power_of_two_below(norm_f0);
  append(problem, 0, 0, 1 / recovery.gamma_f, targets, data);
  double largest_c = 0, largest_norm = norm_f0, largest_ratio = 0;
  for (int i = 0; i < problem.m(); ++i) {
    const auto& list = problem.f[static_cast<std::size_t>(i) + 1];
    const double c = problem.c[static_cast<std::size_t>(i)];
    const double norm_fi = frobenius_norm(list);
    if (norm_fi == 0) {
      if (c != 0) result.free_descent = i;
      continue;
    }
    const double s = 1 / power_of_two_below(norm_fi);
    recovery.constraint.push_back(i);
    largest_norm = std::max(largest_norm, norm_fi);
    largest_ratio = std::max(largest_ratio, (1 + std::abs(c)) / (1 + norm_fi));
    recovery.s.push_back(s);
    data.c.push_back(s * c);
    data.c_rest.push_back(problem.c_rest.empty() ? 0
                                                 : s * problem.c_rest[static_cast<std::size_t>(i)]);
    largest_c = std::max(largest_c, std::abs(s * c));
    append(problem, i + 1, static_cast<int>(recovery.s.size()), s, targets, data);
  }
  for (std::size_t b = 0; b < data.dense.size(); ++b)
    find_pattern(data.dense[b], data.layout.size[b]);
  if (largest_c > 0) recovery.gamma_c = power_of_two_below(largest_c);
  for (double& c : data.c) c /= recovery.gamma_c;
  for (double& c : data.c_rest) c /= recovery.gamma_c;
  const double n = data.layout.order();
  result.far_X = std::max(1.0, std::sqrt(n) * (1 + largest_norm) / recovery.gamma_f);
  result.far_Y = std::max(1.0, n * largest_ratio / recovery.gamma_c);
  return result;
}

// x_i = gamma_f s_i x'_i, X = gamma_f X', Y = gamma_c Y'; places without a working row are 0.
template <typename Out, typename T>
Point<Out> restore(const Problem& problem, const Presolved& presolved, const Vector<T>& x,
                   const Blocks<T>& X, const Blocks<T>& Y, const T& scale) {
  const Recovery& r = presolved.recovery;
  Point<Out> point;
  point.x.assign(problem.c.size(), Out(0));
  for (std::size_t i = 0; i < r.constraint.size(); ++i)
    point.x[static_cast<std::size_t>(r.constraint[i])] =
        as<Out>(T(T(x[static_cast<Eigen::Index>(i)] / scale) * (r.gamma_f * r.s[i])));
  for (const Block& block : problem.blocks) {
    const auto n = static_cast<std::size_t>(block.size);
    point.X.emplace_back(block.diagonal ? n : n * n, Out(0));
    point.Y.emplace_back(block.diagonal ? n : n * n, Out(0));
  }
  const auto set = [&](const Recovery::Row& row, const Recovery::Row& column, const T& vx,
                       const T& vy) {
    const auto b = static_cast<std::size_t>(row.block);
    const Block& block = problem.blocks[b];
    const auto at =
        static_cast<std::size_t>(block.diagonal ? row.row : row.row + block.size * column.row);
    point.X[b][at] = as<Out>(T(T(vx / scale) * r.gamma_f));
    point.Y[b][at] = as<Out>(T(T(vy / scale) * r.gamma_c));
  };
  for (std::size_t b = 0; b < r.dense.size(); ++b) {
    const auto& rows = r.dense[b];
    const auto block_X = X.dense(static_cast<int>(b));
    const auto block_Y = Y.dense(static_cast<int>(b));
    for (std::size_t j = 0; j < rows.size(); ++j)
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto p = static_cast<Eigen::Index>(i), q = static_cast<Eigen::Index>(j);
        set(rows[i], rows[j], block_X(p, q), block_Y(p, q));
      }
  }
  for (std::size_t k = 0; k < r.linear.size(); ++k) {
    const auto p = static_cast<Eigen::Index>(k);
    set(r.linear[k], r.linear[k], X.linear()[p], Y.linear()[p]);
  }
  return point;
}

template <typename T>
void reduce(const Problem& problem, const Presolved& presolved, const Point<T>& point, Vector<T>& x,
            Blocks<T>& X, Blocks<T>& Y) {
  const Recovery& r = presolved.recovery;
  for (std::size_t i = 0; i < r.constraint.size(); ++i)
    x[static_cast<Eigen::Index>(i)] =
        point.x[static_cast<std::size_t>(r.constraint[i])] / T(r.gamma_f * r.s[i]);
  const auto set = [&](const Recovery::Row& row, const Recovery::Row& column, T& vx, T& vy) {
    const auto b = static_cast<std::size_t>(row.block);
    const Block& block = problem.blocks[b];
    const auto at =
        static_cast<std::size_t>(block.diagonal ? row.row : row.row + block.size * column.row);
    vx = point.X[b][at] / T(r.gamma_f);
    vy = point.Y[b][at] / T(r.gamma_c);
  };
  for (std::size_t b = 0; b < r.dense.size(); ++b) {
    const auto& rows = r.dense[b];
    auto block_X = X.dense(static_cast<int>(b)), block_Y = Y.dense(static_cast<int>(b));
    for (std::size_t j = 0; j < rows.size(); ++j)
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto p = static_cast<Eigen::Index>(i), q = static_cast<Eigen::Index>(j);
        set(rows[i], rows[j], block_X(p, q), block_Y(p, q));
      }
  }
  auto linear_X = X.linear(), linear_Y = Y.linear();
  for (std::size_t k = 0; k < r.linear.size(); ++k) {
    const auto p = static_cast<Eigen::Index>(k);
    set(r.linear[k], r.linear[k], linear_X[p], linear_Y[p]);
  }
}

template void reduce<double>(const Problem&, const Presolved&, const Point<double>&,
                             Vector<double>&, Blocks<double>&, Blocks<double>&);
template void reduce<DoubleDouble>(const Problem&, const Presolved&, const Point<DoubleDouble>&,
                                   Vector<DoubleDouble>&, Blocks<DoubleDouble>&,
                                   Blocks<DoubleDouble>&);

#define GAINSMITH_INSTANTIATE(Out, T)                                                     \
  template Point<Out> restore<Out, T>(const Problem&, const Presolved&, const Vector<T>&, \
                                      const Blocks<T>&, const Blocks<T>&, const T&);
GAINSMITH_INSTANTIATE(double, double)
GAINSMITH_INSTANTIATE(DoubleDouble, DoubleDouble)
GAINSMITH_INSTANTIATE(Decimal100, Decimal100)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
