#include "sdp/presolve.h"

#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "sdp/scalars.h"

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

double power_of_two_below(double value) { return std::exp2(std::floor(std::log2(value))); }

void fail(std::size_t i, const std::string& what) {
  throw std::invalid_argument("sdp: F_" + std::to_string(i) + ": " + what);
}

void validate_entry(const Problem& problem, std::size_t i, const Entry& e) {
  if (e.block < 0 || e.block >= static_cast<int>(problem.blocks.size()))
    fail(i, "block " + std::to_string(e.block) + " does not exist");
  const Block& block = problem.blocks[static_cast<std::size_t>(e.block)];
  if (e.row < 0 || e.column >= block.size) fail(i, "an index is outside of its block");
  if (e.row > e.column) fail(i, "an entry is below the diagonal");
  if (block.diagonal && e.row != e.column) fail(i, "a diagonal block has an off-diagonal entry");
  if (!std::isfinite(e.value)) fail(i, "an entry is not finite");
}

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
      const Recovery::Row row{static_cast<int>(b), r, 1.0};
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

/// Appends the entries of one F_i to the blocks they fall in, sorted, equal places added up.
void append(const std::vector<Entry>& list, int constraint, double factor,
            const std::vector<std::vector<Target>>& targets, Data& data) {
  std::map<std::pair<int, std::pair<int, int>>, double> sums;  // block, (column, row)
  for (const Entry& e : list) {
    if (e.value == 0) continue;
    const auto& place = targets[static_cast<std::size_t>(e.block)];
    const Target row = place[static_cast<std::size_t>(e.row)];
    const Target column = place[static_cast<std::size_t>(e.column)];
    sums[{row.block, {column.row, row.row}}] += e.value * factor;
  }
  for (const auto& [place, value] : sums) {
    if (value == 0) continue;
    BlockData& block =
        place.first < 0 ? data.linear : data.dense[static_cast<std::size_t>(place.first)];
    if (block.constraint.empty() || block.constraint.back() != constraint) {
      block.constraint.push_back(constraint);
      block.start.push_back(block.start.back());
    }
    block.terms.push_back({place.second.second, place.second.first, value});
    ++block.start.back();
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

void validate(const Problem& problem) {
  if (problem.f.size() != problem.c.size() + 1)
    throw std::invalid_argument("sdp: " + std::to_string(problem.c.size()) + " costs need " +
                                std::to_string(problem.c.size() + 1) + " matrices, not " +
                                std::to_string(problem.f.size()));
  for (const double c : problem.c)
    if (!std::isfinite(c)) throw std::invalid_argument("sdp: a cost is not finite");
  for (const Block& block : problem.blocks)
    if (block.size < 1) throw std::invalid_argument("sdp: a block has no rows");
  for (std::size_t i = 0; i < problem.f.size(); ++i)
    for (const Entry& e : problem.f[i]) validate_entry(problem, i, e);
}

Presolved presolve(const Problem& problem) {
  Presolved result;
  Recovery& recovery = result.recovery;
  Data& data = result.data;
  const auto targets = place_rows(problem, recovery);
  data.layout = layout_of(recovery);
  data.dense.resize(recovery.dense.size());

  const double norm_f0 = frobenius_norm(problem.f[0]);
  if (norm_f0 > 0) recovery.gamma_f = power_of_two_below(norm_f0);
  append(problem.f[0], 0, 1 / recovery.gamma_f, targets, data);
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
    largest_c = std::max(largest_c, std::abs(s * c));
    append(list, static_cast<int>(recovery.s.size()), s, targets, data);
  }
  if (largest_c > 0) recovery.gamma_c = power_of_two_below(largest_c);
  for (double& c : data.c) c /= recovery.gamma_c;
  const double n = data.layout.order();
  result.far_X = std::max(1.0, std::sqrt(n) * (1 + largest_norm) / recovery.gamma_f);
  result.far_Y = std::max(1.0, n * largest_ratio / recovery.gamma_c);
  return result;
}

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
    const double d = row.d * column.d;
    point.X[b][at] = as<Out>(T(T(vx / scale) * (r.gamma_f / d)));
    point.Y[b][at] = as<Out>(T(T(vy / scale) * (r.gamma_c * d)));
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

#define GAINSMITH_INSTANTIATE(Out, T)                                                     \
  template Point<Out> restore<Out, T>(const Problem&, const Presolved&, const Vector<T>&, \
                                      const Blocks<T>&, const Blocks<T>&, const T&);
GAINSMITH_INSTANTIATE(double, double)
GAINSMITH_INSTANTIATE(DoubleDouble, DoubleDouble)
GAINSMITH_INSTANTIATE(DoubleDouble, Decimal100)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
