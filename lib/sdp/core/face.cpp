#include "sdp/core/face.h"

#include <algorithm>
#include <cmath>

#include "sdp/core/exposure.h"
#include "sdp/core/report.h"

namespace gainsmith::sdp {
namespace {

/// An entry that counts as none, beside the largest.
constexpr double kNoise = 1e-11;
/// Rounding of I in Y, and the factor from one t to the next.
constexpr double kRidge = 1e-26;
constexpr double kLiftFactor = 16;
constexpr int kLiftTries = 14;

/// The numbers of N' F N in one block, both triangles, of which few are not zero.
class Accumulator {
 public:
  void resize(int n) {
    n_ = static_cast<std::size_t>(n);
    values_.assign(n_ * n_, DoubleDouble(0));
  }
  void add(int i, int j, const DoubleDouble& value) {
    const std::size_t at = static_cast<std::size_t>(i) + n_ * static_cast<std::size_t>(j);
    if (values_[at].hi() == 0) touched_.push_back(at);
    values_[at] += value;
  }
  /// Appends what is not below `least` to `list`, and forgets it.
  void take(double least, int block, std::vector<Entry>& list) {
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const std::size_t at : touched_) {
      const DoubleDouble value = values_[at];
      values_[at] = DoubleDouble(0);
      const auto row = static_cast<int>(at % n_), column = static_cast<int>(at / n_);
      if (row > column || std::abs(value.hi()) < least) continue;
      list.push_back({block, row, column, value.hi(), value.lo(), 0});
    }
    touched_.clear();
  }

 private:
  std::size_t n_ = 0;
  std::vector<DoubleDouble> values_;
  std::vector<std::size_t> touched_;
};

/// Number `at` with what it was rounded by, where that is known.
template <typename Packed>
DoubleDouble both(const Packed& value, const Packed& rest, std::size_t at) {
  return rest.empty() ? DoubleDouble(value[at]) : DoubleDouble(value[at], rest[at]);
}

}  // namespace

std::optional<Face> find_face(const Problem& problem, const Presolved& presolved,
                              const Iterate<double>& point) {
  const Recovery& recovery = presolved.recovery;
  Exposure exposure(presolved.data);
  if (!exposure.find(point)) return std::nullopt;
  Face face;
  face.direction.assign(problem.c.size(), DoubleDouble(0));
  for (std::size_t i = 0; i < recovery.constraint.size(); ++i)
    face.direction[static_cast<std::size_t>(recovery.constraint[i])] =
        exposure.direction()[static_cast<Eigen::Index>(i)] * recovery.s[i];

  // Rows of N by row of Y: what is not eliminated is a unit vector.
  std::vector<std::vector<char>> eliminated;
  for (const Block& block : problem.blocks)
    eliminated.emplace_back(static_cast<std::size_t>(block.size), 0);
  const auto eliminate = [&](const Recovery::Row& row) {
    eliminated[static_cast<std::size_t>(row.block)][static_cast<std::size_t>(row.row)] = 1;
  };
  for (std::size_t b = 0; b < recovery.dense.size(); ++b)
    for (const Eigen::Index i : exposure.kernel(b).eliminated)
      eliminate(recovery.dense[b][static_cast<std::size_t>(i)]);
  for (std::size_t k = 0; k < recovery.linear.size(); ++k)
    if (exposure.on(static_cast<Eigen::Index>(k))) eliminate(recovery.linear[k]);
  // Kept rows become rows of Z in their order; blocks without any are zero.
  int number = 0;
  for (const auto& rows : eliminated) {
    Face::Rows& block = face.blocks.emplace_back();
    block.parts.resize(rows.size());
    block.kept.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) block.kept[i] = rows[i] ? 0 : 1;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (block.kept[i]) block.parts[i].push_back({block.size++, 1});
    if (block.size > 0) block.number = number++;
  }
  for (std::size_t b = 0; b < recovery.dense.size(); ++b) {
    // An eliminated row is y_P = weights y_kept.
    const Kernel& kernel = exposure.kernel(b);
    const auto& rows = recovery.dense[b];
    auto& parts = face.blocks[static_cast<std::size_t>(rows.front().block)].parts;
    const auto at = [&](const std::vector<Eigen::Index>& list, Eigen::Index k) {
      const auto place = static_cast<std::size_t>(list[static_cast<std::size_t>(k)]);
      return static_cast<std::size_t>(rows[place].row);
    };
    for (Eigen::Index k = 0; k < kernel.weights.rows(); ++k)
      for (Eigen::Index j = 0; j < kernel.weights.cols(); ++j)
        if (kernel.weights(k, j) != 0)
          parts[at(kernel.eliminated, k)].push_back(
              {parts[at(kernel.kept, j)].front().row, kernel.weights(k, j)});
  }
  return face;
}

Problem restrict_to(const Face& face, const Problem& problem) {
  Problem restricted;
  std::vector<Accumulator> sums(problem.blocks.size());
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Face::Rows& rows = face.blocks[b];
    if (rows.number < 0) continue;
    restricted.blocks.push_back({rows.size, problem.blocks[b].diagonal});
    sums[b].resize(rows.size);
  }
  restricted.c = problem.c;
  restricted.c_rest = problem.c_rest;
  for (std::size_t i = 0; i < problem.f.size(); ++i) {
    double largest = 0;
    for (const Entry& e : problem.f[i]) {
      largest = std::max(largest, std::abs(e.value));
      const auto b = static_cast<std::size_t>(e.block);
      const DoubleDouble value(e.value, e.rest);
      for (const Face::Part& p : face.blocks[b].parts[static_cast<std::size_t>(e.row)])
        for (const Face::Part& q : face.blocks[b].parts[static_cast<std::size_t>(e.column)]) {
          // (N'F N)_pq += N_ip F_ij N_jq, and the mirror place of (i, j).
          const DoubleDouble product = value * p.weight * q.weight;
          sums[b].add(p.row, q.row, product);
          if (e.row != e.column) sums[b].add(q.row, p.row, product);
        }
    }
    auto& list = restricted.f.emplace_back();
    for (std::size_t b = 0; b < sums.size(); ++b)
      if (face.blocks[b].number >= 0) sums[b].take(kNoise * largest, face.blocks[b].number, list);
    if (i == 0 || !list.empty()) continue;
    restricted.c[i - 1] = 0;
    if (!restricted.c_rest.empty()) restricted.c_rest[i - 1] = 0;
  }
  return restricted;
}

Iterate<double> restrict_to(const Face& face, const Problem& problem, const Point<double>& point,
                            const Problem& program, const Presolved& presolved) {
  Point<double> on_face;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Face::Rows& rows = face.blocks[b];
    if (rows.number < 0) continue;
    const bool diagonal = problem.blocks[b].diagonal;
    const std::size_t n = rows.parts.size(), size = static_cast<std::size_t>(rows.size);
    auto& x = on_face.X.emplace_back(diagonal ? size : size * size, 0);
    auto& y = on_face.Y.emplace_back(diagonal ? size : size * size, 0);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = diagonal ? j : 0; i < (diagonal ? j + 1 : n); ++i)
        for (const Face::Part& p : rows.parts[i])
          for (const Face::Part& q : rows.parts[j]) {
            const std::size_t to = static_cast<std::size_t>(p.row) +
                                   (diagonal ? 0 : size * static_cast<std::size_t>(q.row));
            const std::size_t from = diagonal ? i : i + n * j;
            // N'X N; Z is Y at the kept rows, where N is the identity.
            x[to] += p.weight * q.weight * point.X[b][from];
            if (rows.kept[i] && rows.kept[j]) y[to] = point.Y[b][from];
          }
  }
  // x - (d'x / d'd) d
  double along = 0, square = 0;
  for (std::size_t i = 0; i < point.x.size(); ++i) {
    const double d = face.direction[i].hi();
    along += d * point.x[i];
    square += d * d;
  }
  for (std::size_t i = 0; i < point.x.size(); ++i)
    on_face.x.push_back(point.x[i] - along / square * face.direction[i].hi());
  Iterate<double> result(presolved.data);
  reduce(program, presolved, on_face, result.x, result.X, result.Y);
  return result;
}

std::optional<Point<DoubleDouble>> lift(const Face& face, const Problem& problem,
                                        const Solution& solution, double tolerance) {
  Point<DoubleDouble> point;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const Face::Rows& rows = face.blocks[b];
    const auto n = static_cast<std::size_t>(block.size), size = static_cast<std::size_t>(rows.size);
    auto& y = point.Y.emplace_back(block.diagonal ? n : n * n, DoubleDouble(0));
    if (rows.number < 0) continue;
    const auto number = static_cast<std::size_t>(rows.number);
    const std::vector<double>& z = solution.Y.values[number];
    const std::vector<double> none;
    const auto& rest = solution.rest.Y.values.empty() ? none : solution.rest.Y.values[number];
    DoubleDouble largest(0);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = block.diagonal ? j : 0; i <= j; ++i) {
        DoubleDouble sum(0);
        for (const Face::Part& p : rows.parts[i])
          for (const Face::Part& q : rows.parts[j])
            sum += both(z, rest,
                        static_cast<std::size_t>(p.row) +
                            (block.diagonal ? 0 : size * static_cast<std::size_t>(q.row))) *
                   (p.weight * q.weight);
        if (i == j) largest = std::max(largest, sum);
        if (block.diagonal)
          y[i] = sum;
        else
          y[i + n * j] = y[j + n * i] = sum;
      }
    // Y has the rank of Z: a rounding of I gives it a Cholesky factor.
    if (size < n && !block.diagonal)
      for (std::size_t i = 0; i < n; ++i) y[i * (n + 1)] += kRidge * largest;
  }
  double largest = 0, rows = 0;
  for (const Entry& e : problem.f[0]) largest = std::max(largest, std::abs(e.value));
  for (const Block& block : problem.blocks) rows += block.size;
  // ||s I||_F = tolerance (1 + max|F_0|), the unit of error 3 of Solution::dimacs.
  const double shift = tolerance * (1 + largest) / std::sqrt(rows);
  const std::vector<DoubleDouble> start = [&] {
    std::vector<DoubleDouble> x;
    for (std::size_t i = 0; i < solution.x.size(); ++i)
      x.push_back(both(solution.x, solution.rest.x, i));
    return x;
  }();
  double t = 0;
  // t = 0, then from the largest element of X on.
  for (int step = 0; step < kLiftTries; ++step) {
    point.x = start;
    for (std::size_t i = 0; i < start.size(); ++i) point.x[i] += face.direction[i] * t;
    point.X = slack(problem, point.x);
    for (std::size_t b = 0; b < point.X.size(); ++b) {
      const Block& block = problem.blocks[b];
      const auto n = static_cast<std::size_t>(block.size);
      for (std::size_t i = 0; i < n; ++i) point.X[b][block.diagonal ? i : i * (n + 1)] += shift;
    }
    if (in_cone(problem, point.X)) return point;
    if (t > 0) {
      t *= kLiftFactor;
      continue;
    }
    for (const auto& block : point.X)
      for (const DoubleDouble& v : block) t = std::max(t, std::abs(v.hi()));
  }
  return std::nullopt;
}

}  // namespace gainsmith::sdp
