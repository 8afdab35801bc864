#include "lmi/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/stop.h"
#include "lmi/balance_elements.h"
#include "lmi/free_rows.h"
#include "numbers/matrix.h"

namespace gainsmith::lmi {

namespace {

/// Logarithms of the units; rows that share them have one place.
struct Units {
  numbers::Vector rows;
  std::vector<double> unknowns;  ///< [0] is the constant's, 0

  double balanced(int unknown, const BalanceElements::Element& e) const {
    return e.log + rows[e.first] + rows[e.second] + unknowns[static_cast<std::size_t>(unknown)];
  }
};

/// The elimination goes along rows.
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What the elements of one unknown weigh.
struct Mean {
  double weight = 0;
  double logs = 0;
  std::vector<std::pair<int, double>> rows;  ///< those that they are in, with their weights
};

/// Subtracts  m m' / weight  from the normal equations for one unknown after the other, m being
/// the weights of its rows. Those with many rows are collected for one product.
class Elimination {
 public:
  explicit Elimination(RowMajor& normal) : normal_(normal), many_(normal.rows(), kMost) {}
  ~Elimination() { flush(); }
  Elimination(const Elimination&) = delete;
  Elimination& operator=(const Elimination&) = delete;

  void add(const Mean& mean) {
    constexpr Eigen::Index kFew = 8;  // so many times more rows than an unknown occurs in
    if (kFew * std::ssize(mean.rows) < normal_.rows()) {
      for (const auto& [a, wa] : mean.rows)
        for (const auto& [b, wb] : mean.rows) normal_(a, b) -= wa * wb / mean.weight;
      return;
    }
    if (count_ == kMost) flush();
    many_.col(count_).setZero();
    for (const auto& [a, wa] : mean.rows) many_(a, count_) = wa / std::sqrt(mean.weight);
    ++count_;
  }

 private:
  void flush() {
    const auto factors = many_.leftCols(count_);
    normal_.noalias() -= factors * factors.transpose();
    count_ = 0;
  }

  static constexpr Eigen::Index kMost = 64;
  RowMajor& normal_;
  numbers::Matrix many_;
  Eigen::Index count_ = 0;
};

/// Adds the elements of unknown i to the normal equations, and returns what they weigh.
Mean add_elements(const BalanceElements& elements, int i, std::vector<double>& of_row,
                  RowMajor& normal, numbers::Vector& right) {
  Mean mean;
  const auto add = [&](int a, int b, double weight, double log) {
    normal(a, a) += weight;
    normal(a, b) += weight;
    right[a] -= weight * log;
    double& own = of_row[static_cast<std::size_t>(a)];
    if (own == 0) mean.rows.emplace_back(a, 0.0);
    own += weight;
  };
  elements.for_each(i, [&](const BalanceElements::Element& e, double weight) {
    add(e.first, e.second, weight, e.log);
    add(e.second, e.first, weight, e.log);
    mean.weight += weight;
    mean.logs += weight * e.log;
  });
  std::sort(mean.rows.begin(), mean.rows.end());
  for (auto& [row, weight] : mean.rows)
    weight = std::exchange(of_row[static_cast<std::size_t>(row)], 0.0);
  return mean;
}

/// Solves the equations in place: Gaussian elimination in order, for they are positive definite.
numbers::Vector solved(RowMajor normal, numbers::Vector right) {
  const Eigen::Index rows = right.size();
  for (Eigen::Index p = 0; p < rows; ++p)
    for (Eigen::Index q = p + 1; q < rows; ++q) {
      const double factor = normal(q, p) / normal(p, p);
      if (factor == 0) continue;
      normal.row(q).tail(rows - p) -= factor * normal.row(p).tail(rows - p);
      right[q] -= factor * right[p];
    }
  numbers::Vector result = numbers::Vector::Zero(rows);
  for (Eigen::Index p = rows - 1; p >= 0; --p)
    result[p] =
        (right[p] - normal.row(p).tail(rows - p - 1).dot(result.tail(rows - p - 1))) / normal(p, p);
  return result;
}

/// The normal equations over the rows; the unknowns are eliminated: given the rows, log2 d_i is
/// minus the mean of its elements.
Units fit(const BalanceElements& elements) {
  const int rows = elements.rows();
  RowMajor normal = RowMajor::Zero(rows, rows);
  numbers::Vector right = numbers::Vector::Zero(rows);
  std::vector<double> of_row(static_cast<std::size_t>(rows), 0.0);
  std::vector<Mean> means;
  {
    Elimination elimination(normal);
    for (int i = 0; i <= elements.unknowns(); ++i) {
      check_stop();
      const Mean& mean = means.emplace_back(add_elements(elements, i, of_row, normal, right));
      if (i == 0 || mean.weight == 0) continue;
      elimination.add(mean);
      for (const auto& [a, wa] : mean.rows) right[a] += wa * mean.logs / mean.weight;
    }
  }
  for (const int row : free_rows(elements)) {
    normal.row(row).setZero();
    normal.col(row).setZero();
    normal(row, row) = 1;
    right[row] = 0;
  }
  Units units{solved(std::move(normal), std::move(right)), std::vector<double>(means.size(), 0.0)};
  for (std::size_t i = 1; i < means.size(); ++i) {
    if (means[i].weight == 0) continue;
    double sum = means[i].logs;
    for (const auto& [a, w] : means[i].rows) sum += w * units.rows[a];
    units.unknowns[i] = -sum / means[i].weight;
  }
  return units;
}

/// Without the elements below `least` in these units; none when there are no such elements.
std::optional<BalanceElements> without_small(const BalanceElements& elements, const Units& units,
                                             double least) {
  const double small = std::log2(least);
  const double none = -std::numeric_limits<double>::infinity();
  std::vector<double> of_row(static_cast<std::size_t>(units.rows.size()), none);
  std::vector<double> of_unknown(units.unknowns.size(), none);
  bool some = false;
  for (int i = 0; i <= elements.unknowns(); ++i)
    elements.for_each(i, [&](const BalanceElements::Element& e, double) {
      const double size = units.balanced(i, e);
      some |= size < small;
      for (const int row : {e.first, e.second}) {
        double& largest = of_row[static_cast<std::size_t>(row)];
        largest = std::max(largest, size);
      }
      double& largest = of_unknown[static_cast<std::size_t>(i)];
      largest = std::max(largest, size);
    });
  if (!some) return std::nullopt;
  BalanceElements kept = elements.with([&](int i, const BalanceElements::Element& e) {
    const double size = units.balanced(i, e);
    return size >= small || size >= of_unknown[static_cast<std::size_t>(i)] ||
           size >= of_row[static_cast<std::size_t>(e.first)] ||
           size >= of_row[static_cast<std::size_t>(e.second)];
  });
  if (kept.size() == elements.size()) return std::nullopt;
  return kept;
}

int rounded(double exponent) { return static_cast<int>(std::floor(exponent + 0.5137)); }

}  // namespace

double Balance::factor(std::size_t block, int r, int c, int unknown) const {
  const std::vector<int>& exponents = rows[block];
  return std::ldexp(1.0, exponents[static_cast<std::size_t>(r)] +
                             exponents[static_cast<std::size_t>(c)] +
                             (unknown == 0 ? 0 : unknowns[static_cast<std::size_t>(unknown) - 1]));
}

double Balance::unit(int unknown) const {
  return std::ldexp(1.0, unknowns[static_cast<std::size_t>(unknown) - 1]);
}

double Balance::row(std::size_t block, int r) const {
  return std::ldexp(1.0, rows[block][static_cast<std::size_t>(r)]);
}

Balance balance(const std::vector<const Block*>& blocks, int unknowns,
                const std::vector<double>& objective) {
  const BalanceElements elements(blocks, unknowns, objective);
  Units units = fit(elements);
  constexpr double kNoise = 1e-8, kSmall = 1e-3;
  std::optional<BalanceElements> kept = without_small(elements, units, kNoise);
  if (kept) units = fit(*kept);
  if (const auto large = without_small(kept ? *kept : elements, units, kSmall)) units = fit(*large);
  Balance result;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::vector<int>& of_block = result.rows.emplace_back();
    for (int r = 0; r < blocks[k]->size; ++r)
      of_block.push_back(rounded(units.rows[elements.first_row(k) + r]));
  }
  for (int i = 1; i <= unknowns; ++i)
    result.unknowns.push_back(rounded(units.unknowns[static_cast<std::size_t>(i)]));
  return result;
}

}  // namespace gainsmith::lmi
