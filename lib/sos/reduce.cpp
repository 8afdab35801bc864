#include "sos/reduce.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/stop.h"

namespace gainsmith::sos {

namespace {

class Reduction {
 public:
  explicit Reduction(Program& program)
      : program_(program), columns_(program), equations_(equations_of(program)) {
    for (const Gram& gram : program.grams) dead_.emplace_back(gram.basis.size(), false);
  }

  std::optional<Contradiction> run() {
    bool goes_on = true;
    while (goes_on) {
      goes_on = false;
      for (Equation& equation : equations_) {
        check_stop();
        if (equation.terms.empty() && equation.value == 0) continue;
        drop_known(equation);
        const Told told = tell(equation);
        if (told == Told::contradiction) return Contradiction{equation.key, why_};
        if (told == Told::nothing) continue;
        equation = {equation.key, {}, 0};
        goes_on = true;
      }
    }
    remove_dead();
    return contradiction_of_strict();
  }

 private:
  enum class Told { nothing, something, contradiction };

  bool is_dead(std::size_t gram, int row) const {
    return dead_[gram][static_cast<std::size_t>(row)];
  }

  void drop_known(Equation& equation) const {
    for (auto at = equation.terms.begin(); at != equation.terms.end();) {
      bool is_known = false;
      if (columns_.is_element(at->first)) {
        const Columns::Place place = columns_.place(at->first);
        is_known = is_dead(place.gram, place.row) || is_dead(place.gram, place.column);
      } else if (const auto value = fixed_.find(at->first); value != fixed_.end()) {
        equation.value -= at->second * value->second;
        is_known = true;
      }
      at = is_known ? equation.terms.erase(at) : std::next(at);
    }
  }

  Told tell(const Equation& equation) {
    if (equation.terms.empty()) {
      if (equation.value == 0) return Told::something;
      why_ = "has to be 0 and is " + equation.value.str();
      return Told::contradiction;
    }
    const auto& [first, coefficient] = *equation.terms.begin();
    if (equation.terms.size() == 1 && !columns_.is_element(first)) {
      fixed_[first] = equation.value / coefficient;
      return Told::something;
    }
    const int sign = coefficient.sign();
    for (const auto& [column, c] : equation.terms) {
      if (!columns_.is_element(column) || c.sign() != sign) return Told::nothing;
      const Columns::Place place = columns_.place(column);
      if (place.row != place.column) return Told::nothing;
    }
    if (equation.value.sign() * sign > 0) return Told::nothing;
    if (equation.value.sign() != 0) {
      why_ = "is " + Rational(equation.value * sign).str() +
             " where squares alone contribute, and these are not below 0";
      return Told::contradiction;
    }
    for (const auto& [column, c] : equation.terms) {
      const Columns::Place place = columns_.place(column);
      dead_[place.gram][static_cast<std::size_t>(place.row)] = true;
    }
    return Told::something;
  }

  void remove_dead() {
    for (std::size_t g = 0; g < program_.grams.size(); ++g) {
      Gram& gram = program_.grams[g];
      std::size_t kept = 0;
      for (std::size_t a = 0; a < dead_[g].size(); ++a) {
        if (dead_[g][a]) continue;
        if (kept != a) gram.basis[kept] = std::move(gram.basis[a]);
        gram.scale[kept++] = gram.scale[a];
      }
      gram.basis.resize(kept);
      gram.scale.resize(kept);
    }
  }

  /// A strict inequality needs all constants among its squares.
  std::optional<Contradiction> contradiction_of_strict() const {
    for (const Gram& gram : program_.grams) {
      const Statement& statement = program_.statements[gram.statement];
      if (gram.multiplier != 0 || !statement.strict) continue;
      std::set<Element> elements;
      for (const BasisPolynomial& basis : gram.basis) elements.insert(basis.front().first);
      for (int r = 0; r < statement.matrix.rows(); ++r)
        if (!elements.contains({r, {}}))
          return Contradiction{{gram.statement, r, r, {}},
                               "leaves no square of a constant, which '>' needs; write '>='"};
    }
    return std::nullopt;
  }

  Program& program_;
  const Columns columns_;
  std::vector<Equation> equations_;
  std::vector<std::vector<bool>> dead_;  ///< rows of each Gram matrix
  std::map<int, Rational> fixed_;
  std::string why_;
};

}  // namespace

std::optional<Contradiction> reduce(Program& program) { return Reduction(program).run(); }

namespace {

/// equation -= its coefficient of the column times what the pivot says of that column.
void substitute(const Eliminated::Pivot& pivot, Equation& equation) {
  const auto at = equation.terms.find(pivot.column);
  if (at == equation.terms.end()) return;
  const Rational factor = at->second / pivot.equation.terms.at(pivot.column);
  for (const auto& [column, c] : pivot.equation.terms) {
    const auto [term, is_new] = equation.terms.try_emplace(column, Rational(0));
    term->second -= factor * c;
    if (term->second == 0) equation.terms.erase(term);
  }
  equation.value -= factor * pivot.equation.value;
  for (const auto& [row, c] : pivot.equation.from) equation.from[row] -= factor * c;
}

}  // namespace

std::optional<Equation> Eliminated::without_free(Equation sum) const {
  for (const Pivot& pivot : pivots) substitute(pivot, sum);
  for (const int column : left)
    if (sum.terms.contains(column)) return std::nullopt;
  return sum;
}

Eliminated eliminate(const Program& program, std::vector<Equation> equations) {
  const Columns columns(program);
  Eliminated result;
  for (std::size_t at = 0; at < equations.size(); ++at) equations[at].from = {{at, 1}};
  std::vector<bool> used(equations.size(), false);
  std::vector<std::set<std::size_t>> users(static_cast<std::size_t>(columns.frees()));
  const auto note = [&](std::size_t row) {
    for (const auto& [column, c] : equations[row].terms) {
      if (columns.is_element(column)) break;
      users[static_cast<std::size_t>(column)].insert(row);
    }
  };
  for (std::size_t row = 0; row < equations.size(); ++row) note(row);
  const auto has_elements = [&](std::size_t row) {
    const auto& terms = equations[row].terms;
    return !terms.empty() && columns.is_element(terms.rbegin()->first);
  };
  const auto take = [&](int column, std::size_t row) {
    used[row] = true;
    result.pivots.push_back({column, equations[row]});
    const auto rows = users[static_cast<std::size_t>(column)];
    for (const std::size_t other : rows) {
      if (used[other]) continue;
      check_stop();
      substitute(result.pivots.back(), equations[other]);
      note(other);
    }
  };
  // First the equations that no Gram matrix is in: they hold of u and t alone.
  for (std::size_t row = 0; row < equations.size(); ++row)
    if (!used[row] && !equations[row].terms.empty() && !has_elements(row))
      take(equations[row].terms.rbegin()->first, row);
  std::vector<bool> is_done(static_cast<std::size_t>(columns.frees()), false);
  for (const Eliminated::Pivot& pivot : result.pivots)
    is_done[static_cast<std::size_t>(pivot.column)] = true;
  for (int column = 0; column < columns.frees(); ++column) {
    if (is_done[static_cast<std::size_t>(column)]) continue;
    std::optional<std::size_t> best;
    Rational largest = 0;
    const auto size_in = [&](std::size_t row) -> Rational {
      const auto at = equations[row].terms.find(column);
      return used[row] || at == equations[row].terms.end() ? Rational(0)
                                                           : Rational(abs(at->second));
    };
    const auto& rows = users[static_cast<std::size_t>(column)];
    for (const std::size_t row : rows) largest = std::max(largest, size_in(row));
    for (const std::size_t row : rows) {
      const Rational size = size_in(row);
      if (size == 0 || size * 10 < largest) continue;
      if (!best || equations[row].terms.size() < equations[*best].terms.size()) best = row;
    }
    if (best)
      take(column, *best);
    else
      result.left.push_back(column);
  }
  for (std::size_t row = 0; row < equations.size(); ++row) {
    if (used[row]) continue;
    Equation& equation = equations[row];
    if (!equation.terms.empty()) {
      result.equations.push_back(std::move(equation));
    } else if (equation.value != 0) {
      result.contradiction = {equation.key, "has to be 0 and is " + equation.value.str()};
      return result;
    }
  }
  return result;
}

}  // namespace gainsmith::sos
