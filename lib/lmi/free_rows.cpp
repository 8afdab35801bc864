#include "lmi/free_rows.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/stop.h"

namespace gainsmith::lmi {

namespace {

using Element = BalanceElements::Element;

/// Rows and their factors, by row; none of these is 0.
using Sum = std::vector<std::pair<int, long>>;

/// sum += factor other, a merge of two sorted lists.
void add(const Sum& other, long factor, Sum& sum) {
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

Sum::iterator find(Sum& sum, int row) {
  const auto place =
      std::lower_bound(sum.begin(), sum.end(), row,
                       [](const auto& term, int wanted) { return term.first < wanted; });
  return place != sum.end() && place->first == row ? place : sum.end();
}

/// Up to four rows with factors between -2 and 2, in an order like that of Sum: 0 is no row.
using RowKey = std::array<std::uint32_t, 4>;
constexpr std::uint32_t kFactorBits = 4;
constexpr int kFactorZero = 3;

Sum sum_at(const RowKey& key) {
  Sum sum;
  for (const std::uint32_t part : key)
    if (part != 0)
      sum.emplace_back(static_cast<int>(part >> kFactorBits) - 1,
                       static_cast<long>(part & ((1U << kFactorBits) - 1)) - kFactorZero);
  return sum;
}

/// The equation between an element and the first one of its unknown (none: of the constant part).
class Equation {
 public:
  Equation(const Element& e, const Element* first, int objective) {
    add_element(e, 1, objective);
    if (first != nullptr) add_element(*first, -1, objective);
  }

  RowKey key() const {
    RowKey key{};
    for (std::size_t k = 0, out = 0; k < size_; ++k)
      if (terms_[k].second != 0)
        key[out++] = (static_cast<std::uint32_t>(terms_[k].first + 1) << kFactorBits) |
                     static_cast<std::uint32_t>(terms_[k].second + kFactorZero);
    return key;
  }

 private:
  void add_element(const Element& e, int factor, int objective) {
    add_row(e.first, factor);
    if (e.second != objective) add_row(e.second, factor);
  }
  void add_row(int row, int factor) {
    std::size_t k = 0;
    while (k < size_ && terms_[k].first < row) ++k;
    if (k < size_ && terms_[k].first == row) {
      terms_[k].second += factor;
      return;
    }
    for (std::size_t j = size_++; j > k; --j) terms_[j] = terms_[j - 1];
    terms_[k] = {row, factor};
  }

  std::array<std::pair<int, int>, 4> terms_{};
  std::size_t size_ = 0;
};

/// Calls visit(element, first) for the elements that state an equation, until it says false.
template <class Visit>
void for_each_equation(const BalanceElements& elements, int from, Visit visit) {
  for (int i = from; i <= elements.unknowns(); ++i) {
    check_stop();
    const Element* begin = elements.begin_of(i);
    const Element* end = elements.end_of(i);
    if (begin == end) continue;
    const Element* first = i == 0 ? nullptr : begin;
    for (const Element* e = i == 0 ? begin : begin + 1; e != end; ++e)
      if (!visit(*e, first, i)) return;
  }
}

/// What is solved so far: Gauss and Jordan's elimination over whole numbers, each solved row as a
/// sum of free ones.
class Solved {
 public:
  explicit Solved(int rows) : sums_(static_cast<std::size_t>(rows)), users_(sums_.size()) {
    for (std::size_t row = 0; row < sums_.size(); ++row) values_.push_back(value_of_free(row));
  }

  /// Solves the equation for one of its rows; false when none has a factor +-1 and one is asked
  /// for.
  bool solve(const Sum& equation, bool whole) {
    check_stop();
    Sum sum;
    for (const auto& [row, factor] : equation) {
      const auto& known = sums_[static_cast<std::size_t>(row)];
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
    for (const std::size_t user : std::exchange(users_[static_cast<std::size_t>(row)], {})) {
      Sum& known = *sums_[user];
      const auto place = find(known, row);
      if (place == known.end()) continue;
      const long factor = place->second;
      known.erase(place);
      add(sum, factor, known);
      take_value(user, sum);
    }
    sums_[static_cast<std::size_t>(row)] = sum;
    take_value(static_cast<std::size_t>(row), sum);
    return true;
  }

  /// Whether an equation follows from those that are solved: the values satisfy it, which are
  /// random up to these. By chance that happens once in 2^64.
  bool follows(const Element& e, const Element* first, int objective) const {
    return value(e, objective) == (first == nullptr ? 0 : value(*first, objective));
  }
  bool follows(const RowKey& key) const {
    std::uint64_t sum = 0;
    for (const auto& [row, factor] : sum_at(key))
      sum += static_cast<std::uint64_t>(factor) * values_[static_cast<std::size_t>(row)];
    return sum == 0;
  }

  std::vector<int> free() const {
    std::vector<int> list;
    for (std::size_t row = 0; row < sums_.size(); ++row)
      if (!sums_[row]) list.push_back(static_cast<int>(row));
    return list;
  }

 private:
  /// A fixed number that looks random (SplitMix64).
  static std::uint64_t value_of_free(std::size_t row) {
    std::uint64_t z = (row + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  /// Of a row whose sum has got these terms.
  void take_value(std::size_t row, const Sum& terms) {
    for (const auto& term : terms) users_[static_cast<std::size_t>(term.first)].push_back(row);
    values_[row] = 0;
    for (const auto& [other, factor] : *sums_[row])
      values_[row] +=
          static_cast<std::uint64_t>(factor) * value_of_free(static_cast<std::size_t>(other));
  }

  std::uint64_t value(const Element& e, int objective) const {
    return values_[static_cast<std::size_t>(e.first)] +
           (e.second == objective ? 0 : values_[static_cast<std::size_t>(e.second)]);
  }

  std::vector<std::optional<Sum>> sums_;         ///< by row
  std::vector<std::vector<std::size_t>> users_;  ///< of each row: whose sums may have it
  std::vector<std::uint64_t> values_;            ///< by row, whole numbers modulo 2^64
};

/// The equations whose first row is in [low, high) and that do not follow, in their order.
std::vector<RowKey> equations_from(const BalanceElements& elements, const Solved& solved, int low,
                                   int high) {
  const auto limit = static_cast<std::uint32_t>(high + 1) << kFactorBits;
  const auto least = static_cast<std::uint32_t>(low + 1) << kFactorBits;
  std::vector<RowKey> keys;
  const int objective = elements.objective();
  for_each_equation(elements, 0, [&](const Element& e, const Element* first, int) {
    const int lowest = first == nullptr
                           ? std::min(e.first, e.second)
                           : std::min({e.first, e.second, first->first, first->second});
    if (lowest >= high || solved.follows(e, first, objective)) return true;
    const RowKey key = Equation(e, first, objective).key();
    if (least <= key[0] && key[0] < limit) keys.push_back(key);
    return true;
  });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// The free rows from few equations: those whose first row is in [0, 1), [1, 3), [3, 7), ... until
/// all others follow. None when an equation has no factor +-1.
std::optional<std::vector<int>> free_rows_early(const BalanceElements& elements) {
  Solved solved(elements.rows());
  int open = 0;  // the first unknown of which not every equation follows
  for (int low = 0, high = 1; low < elements.rows(); low = std::exchange(high, 2 * high + 1)) {
    for (const RowKey& key : equations_from(elements, solved, low, high))
      if (!solved.follows(key) && !solved.solve(sum_at(key), true)) return std::nullopt;
    bool all = true;
    for_each_equation(elements, open, [&](const Element& e, const Element* first, int i) {
      open = i;
      return all = solved.follows(e, first, elements.objective());
    });
    if (all) break;
  }
  return solved.free();
}

}  // namespace

std::vector<int> free_rows_of_all(const BalanceElements& elements) {
  std::set<Sum> equations;
  for_each_equation(elements, 0, [&](const Element& e, const Element* first, int) {
    if (Sum sum = sum_at(Equation(e, first, elements.objective()).key()); !sum.empty())
      equations.insert(std::move(sum));
    return true;
  });
  Solved solved(elements.rows());
  std::vector<Sum> later;
  for (const Sum& equation : equations)
    if (!solved.solve(equation, true)) later.push_back(equation);
  for (const Sum& equation : later) solved.solve(equation, false);
  return solved.free();
}

std::vector<int> free_rows(const BalanceElements& elements) {
  auto early = free_rows_early(elements);
  return early ? std::move(*early) : free_rows_of_all(elements);
}

}  // namespace gainsmith::lmi
