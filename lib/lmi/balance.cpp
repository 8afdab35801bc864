#include "lmi/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "base/stop.h"
#include "numbers/matrix.h"

namespace gainsmith::lmi {

namespace {

/// One element: its unknown (0: constant), its two rows among all rows, log2 of its size.
struct Element {
  int unknown = 0;
  int first = 0;
  int second = 0;
  double log = 0;
  double weight = 1;
};

/// Logarithms of the units; rows that share them have one place.
struct Units {
  numbers::Vector rows;
  std::vector<double> unknowns;  ///< [0] is the constant's, 0

  double balanced(const Element& e) const {
    return e.log + rows[e.first] + rows[e.second] + unknowns[static_cast<std::size_t>(e.unknown)];
  }
};

/// The places of the rows of each block: the first of them.
std::vector<int> places_of(const std::vector<const Block*>& blocks, std::vector<double>& weights,
                           int& rows) {
  std::map<std::pair<std::string, int>, std::pair<int, int>> shared;  // first row, blocks
  std::vector<int> first;
  for (const Block* block : blocks) {
    const auto [found, fresh] = shared.try_emplace({block->name, block->size}, rows, 0);
    if (fresh) rows += block->size;
    ++found->second.second;
    first.push_back(found->second.first);
  }
  for (const Block* block : blocks)
    weights.push_back(1.0 / shared.at({block->name, block->size}).second);
  return first;
}

void add_elements(const Block& block, int first, double weight, std::vector<Element>& out) {
  constexpr double kLeast = 1e-290;  // units for less than this would not be doubles
  for (const auto& [i, matrix] : block.terms)
    for (int k = 0; k < matrix.outerSize(); ++k)
      for (Sparse::InnerIterator it(matrix, k); it; ++it)
        if (std::abs(it.value()) >= kLeast)
          out.push_back({i, first + static_cast<int>(it.row()), first + static_cast<int>(it.col()),
                         std::log2(std::abs(it.value())), weight});
}

/// The rows that nothing else determines. A change of all units that leaves every element as it is
/// satisfies  s_r + s_c = s_p + s_q  for the elements (r, c), (p, q) of one unknown and
/// s_r + s_c = 0 for those of the constant part. Each equation gives one row as a sum of whole
/// multiples of others wherever one of its factors is +-1, so that whole changes of the rows that
/// are left are whole changes of all. Equations without such a factor come last.
class FreeRows {
 public:
  /// Of the row `objective` (-1: none) it is twice the unit that may change by a whole number.
  FreeRows(const std::vector<Element>& elements, int rows, std::size_t unknowns, int objective)
      : solved_(static_cast<std::size_t>(rows)) {
    std::vector<Sum> first(unknowns);
    std::set<Sum> equations;
    std::unordered_set<std::size_t> seen;  // blocks of one inequality have the same elements
    for (const Element& e : elements) {
      check_stop();
      const auto n = static_cast<std::size_t>(rows);
      const auto [low, high] = std::minmax(e.first, e.second);
      if (!seen.insert((static_cast<std::size_t>(e.unknown) * n + static_cast<std::size_t>(low)) *
                           n +
                       static_cast<std::size_t>(high))
               .second)
        continue;
      Sum sum = {{e.first, 1}};
      if (e.second != objective) add({{e.second, 1}}, 1, sum);
      const auto i = static_cast<std::size_t>(e.unknown);
      if (i > 0 && first[i].empty())
        first[i] = std::move(sum);
      else if (add(first[i], -1, sum); !sum.empty())
        equations.insert(std::move(sum));
    }
    std::vector<Sum> later;
    for (const Sum& equation : equations)
      if (!solve(equation, true)) later.push_back(equation);
    for (const Sum& equation : later) solve(equation, false);
    for (int row = 0; row < rows; ++row)
      if (!solved_[static_cast<std::size_t>(row)]) list.push_back(row);
  }

  std::vector<int> list;

 private:
  /// Rows and their factors, by row; none of these is 0.
  using Sum = std::vector<std::pair<int, long>>;

  static void add(const Sum& other, long factor, Sum& sum) {
    Sum result;
    result.reserve(sum.size() + other.size());
    auto mine = sum.begin();
    for (const auto& [row, value] : other) {
      while (mine != sum.end() && mine->first < row) result.push_back(*mine++);
      long whole = factor * value;
      if (mine != sum.end() && mine->first == row) whole += (mine++)->second;
      if (whole != 0) result.emplace_back(row, whole);
    }
    result.insert(result.end(), mine, sum.end());
    sum = std::move(result);
  }

  static Sum::iterator find(Sum& sum, int row) {
    const auto place =
        std::lower_bound(sum.begin(), sum.end(), row,
                         [](const auto& term, int wanted) { return term.first < wanted; });
    return place != sum.end() && place->first == row ? place : sum.end();
  }

  /// Solves the equation for one of its rows; false when none has a factor +-1 and one is asked
  /// for.
  bool solve(const Sum& equation, bool whole) {
    check_stop();
    Sum sum;
    for (const auto& [row, factor] : equation) {
      const auto& known = solved_[static_cast<std::size_t>(row)];
      add(known ? *known : Sum{{row, 1}}, factor, sum);
    }
    if (sum.empty()) return true;
    long common = 0;
    for (const auto& [row, factor] : sum) common = std::gcd(common, factor);
    for (auto& [row, factor] : sum) factor /= common;
    auto pivot = std::find_if(sum.begin(), sum.end(),
                              [](const auto& term) { return std::abs(term.second) == 1; });
    if (pivot == sum.end() && whole) return false;
    if (pivot == sum.end()) pivot = sum.begin();
    const int row = pivot->first;
    const long sign = pivot->second > 0 ? -1 : 1;
    sum.erase(pivot);
    for (auto& [other, factor] : sum) factor *= sign;
    for (auto& known : solved_) {
      if (!known) continue;
      const auto place = find(*known, row);
      if (place == known->end()) continue;
      const long factor = place->second;
      known->erase(place);
      add(sum, factor, *known);
    }
    solved_[static_cast<std::size_t>(row)] = std::move(sum);
    return true;
  }

  std::vector<std::optional<Sum>> solved_;  ///< by row
};

/// Weights by row.
class RowWeights {
 public:
  void add(int row, double weight) {
    const auto place =
        std::lower_bound(list_.begin(), list_.end(), row,
                         [](const auto& term, int wanted) { return term.first < wanted; });
    if (place != list_.end() && place->first == row)
      place->second += weight;
    else
      list_.insert(place, {row, weight});
  }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

 private:
  std::vector<std::pair<int, double>> list_;
};

/// The normal equations over the rows; the unknowns are eliminated: given the rows, log2 d_i is
/// minus the mean of its elements.
Units fit(const std::vector<Element>& elements, int rows, int unknowns, int objective) {
  // The elimination goes along rows.
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor normal = RowMajor::Zero(rows, rows);
  numbers::Vector right = numbers::Vector::Zero(rows);
  const auto count = static_cast<std::size_t>(unknowns) + 1;
  std::vector<double> weight(count, 0.0), logs(count, 0.0);
  std::vector<RowWeights> mean(count);
  for (const Element& e : elements) {
    const auto i = static_cast<std::size_t>(e.unknown);
    for (const auto& [a, b] : {std::pair(e.first, e.second), std::pair(e.second, e.first)}) {
      normal(a, a) += e.weight;
      normal(a, b) += e.weight;
      right[a] -= e.weight * e.log;
      mean[i].add(a, e.weight);
    }
    weight[i] += e.weight;
    logs[i] += e.weight * e.log;
  }
  for (std::size_t i = 1; i < count; ++i)
    for (const auto& [a, wa] : mean[i]) {
      check_stop();
      for (const auto& [b, wb] : mean[i]) normal(a, b) -= wa * wb / weight[i];
      right[a] += wa * logs[i] / weight[i];
    }
  for (const int row : FreeRows(elements, rows, count, objective).list) {
    normal.row(row).setZero();
    normal.col(row).setZero();
    normal(row, row) = 1;
    right[row] = 0;
  }
  // Gaussian elimination in order: what is left is positive definite.
  for (int p = 0; p < rows; ++p)
    for (int q = p + 1; q < rows; ++q) {
      const double factor = normal(q, p) / normal(p, p);
      if (factor == 0) continue;
      normal.row(q).tail(rows - p) -= factor * normal.row(p).tail(rows - p);
      right[q] -= factor * right[p];
    }
  Units units{numbers::Vector::Zero(rows), std::vector<double>(count, 0.0)};
  for (int p = rows - 1; p >= 0; --p)
    units.rows[p] =
        (right[p] - normal.row(p).tail(rows - p - 1).dot(units.rows.tail(rows - p - 1))) /
        normal(p, p);
  for (std::size_t i = 1; i < count; ++i) {
    if (weight[i] == 0) continue;
    double sum = logs[i];
    for (const auto& [a, w] : mean[i]) sum += w * units.rows[a];
    units.unknowns[i] = -sum / weight[i];
  }
  return units;
}

/// Without the elements that are small in these units.
std::vector<Element> without_small(const std::vector<Element>& elements, const Units& units) {
  const double small = std::log2(1e-8);
  const double none = -std::numeric_limits<double>::infinity();
  std::vector<double> of_row(static_cast<std::size_t>(units.rows.size()), none);
  std::vector<double> of_unknown(units.unknowns.size(), none);
  for (const Element& e : elements) {
    const double size = units.balanced(e);
    for (const int row : {e.first, e.second})
      of_row[static_cast<std::size_t>(row)] = std::max(of_row[static_cast<std::size_t>(row)], size);
    double& largest = of_unknown[static_cast<std::size_t>(e.unknown)];
    largest = std::max(largest, size);
  }
  std::vector<Element> kept;
  for (const Element& e : elements) {
    const double size = units.balanced(e);
    if (size >= small || size >= of_unknown[static_cast<std::size_t>(e.unknown)] ||
        size >= of_row[static_cast<std::size_t>(e.first)] ||
        size >= of_row[static_cast<std::size_t>(e.second)])
      kept.push_back(e);
  }
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
  int rows = 0;
  std::vector<double> weights;
  const std::vector<int> first = places_of(blocks, weights, rows);
  std::vector<Element> elements;
  for (std::size_t k = 0; k < blocks.size(); ++k)
    add_elements(*blocks[k], first[k], weights[k], elements);
  // Its unit, log2 s_c, enters with both rows: half of it is what is fitted.
  if (!objective.empty()) {
    for (std::size_t i = 0; i < objective.size(); ++i)
      if (objective[i] != 0)
        elements.push_back(
            {static_cast<int>(i) + 1, rows, rows, std::log2(std::abs(objective[i])), 1});
    ++rows;
  }
  const int last = objective.empty() ? -1 : rows - 1;
  Units units = fit(elements, rows, unknowns, last);
  if (const auto kept = without_small(elements, units); kept.size() < elements.size())
    units = fit(kept, rows, unknowns, last);
  Balance result;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::vector<int>& of_block = result.rows.emplace_back();
    for (int r = 0; r < blocks[k]->size; ++r) of_block.push_back(rounded(units.rows[first[k] + r]));
  }
  for (int i = 1; i <= unknowns; ++i)
    result.unknowns.push_back(rounded(units.unknowns[static_cast<std::size_t>(i)]));
  return result;
}

}  // namespace gainsmith::lmi
