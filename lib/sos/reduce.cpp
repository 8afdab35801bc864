#include "sos/reduce.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/stop.h"

namespace gainsmith::sos {

namespace {

/// Passes over all equations until one pass learns nothing.
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
        if (const std::string why = contradiction_of(equation); !why.empty())
          return Contradiction{equation.key, why, told_[equation.key]};
        if (!learn(equation)) continue;
        equation = {equation.key, {}, 0};
        goes_on = true;
      }
    }
    remove_dead();
    return contradiction_of_strict();
  }

 private:
  bool is_dead(std::size_t gram, int row) const {
    return dead_[gram][static_cast<std::size_t>(row)];
  }

  /// Removes elements of rows that are 0, and puts in the values of u and t that are known.
  void drop_known(Equation& equation) {
    std::erase_if(equation.terms, [&](const auto& term) {
      if (columns_.is_element(term.first)) {
        const Columns::Place place = columns_.place(term.first);
        return is_dead(place.gram, place.row) || is_dead(place.gram, place.column);
      }
      const auto value = fixed_.find(term.first);
      if (value == fixed_.end()) return false;
      equation.value -= term.second * value->second.first;
      if (term.first < columns_.unknowns())
        told_[equation.key].try_emplace(term.first, value->second.second);
      return true;
    });
  }

  /// Whether all terms are squares times factors of one sign.
  bool has_squares_alone(const Equation& equation) const {
    return std::ranges::all_of(equation.terms, [&](const auto& term) {
      if (!columns_.is_element(term.first)) return false;
      const Columns::Place place = columns_.place(term.first);
      return place.row == place.column &&
             term.second.sign() == equation.terms.begin()->second.sign();
    });
  }

  /// Empty where something may satisfy the equation.
  std::string contradiction_of(const Equation& equation) const {
    if (equation.value == 0 || !has_squares_alone(equation)) return "";
    if (equation.terms.empty()) return "has to be 0 and is " + equation.value.str();
    const Rational value = equation.value * equation.terms.begin()->second.sign();
    return value > 0
               ? ""
               : "is " + value.str() + " where squares alone contribute, and these are not below 0";
  }

  /// Whether the equation tells all of its unknowns.
  bool learn(const Equation& equation) {
    if (equation.value == 0 && has_squares_alone(equation)) {
      for (const auto& [column, c] : equation.terms) {
        const Columns::Place place = columns_.place(column);
        dead_[place.gram][static_cast<std::size_t>(place.row)] = true;
      }
      return true;
    }
    const auto& [first, coefficient] = *equation.terms.begin();
    if (equation.terms.size() != 1 || columns_.is_element(first)) return false;
    fixed_.try_emplace(first, equation.value / coefficient, equation.key);
    return true;
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
      for (int r = 0; r < statement.matrix.rows(); ++r)
        if (std::ranges::none_of(gram.basis, [&](const BasisPolynomial& basis) {
              return basis.front().first == Element{r, {}};
            }))
          return Contradiction{{gram.statement, r, r, {}},
                               "leaves no square of a constant, which '>' needs; write '>='"};
    }
    return std::nullopt;
  }

  Program& program_;
  const Columns columns_;
  std::vector<Equation> equations_;
  std::vector<std::vector<bool>> dead_;            ///< rows of each Gram matrix
  std::map<int, std::pair<Rational, Key>> fixed_;  ///< by column, and what told it
  std::map<Key, std::map<int, Key>> told_;         ///< of equations: the unknowns put into them
};

}  // namespace

std::optional<Contradiction> reduce(Program& program) { return Reduction(program).run(); }

void Pivot::put_into(Equation& other) const {
  const auto at = other.terms.find(column);
  if (at == other.terms.end()) return;
  const Rational factor = at->second / equation.terms.at(column);
  for (const auto& [k, c] : equation.terms) other.terms[k] -= factor * c;
  std::erase_if(other.terms, [](const auto& term) { return term.second == 0; });
  other.value -= factor * equation.value;
  for (const auto& [row, c] : equation.from) other.from[row] -= factor * c;
}

std::optional<Equation> Eliminated::without_free(Equation sum) const {
  for (const Pivot& pivot : pivots) pivot.put_into(sum);
  for (const int column : left)
    if (sum.terms.contains(column)) return std::nullopt;
  return sum;
}

// Gauss's elimination of the columns of u and t in fractions. What is left are equations of
// elements of Gram matrices, the form that the solver takes.
Eliminated eliminate(const Program& program, std::vector<Equation> equations) {
  const Columns columns(program);
  Eliminated result;
  for (std::size_t at = 0; at < equations.size(); ++at) equations[at].from = {{at, 1}};
  for (int column = 0; column < columns.frees(); ++column) {
    check_stop();
    std::vector<Equation*> users;  // columns before are gone
    for (Equation& equation : equations)
      if (!equation.terms.empty() && equation.terms.begin()->first == column)
        users.push_back(&equation);
    if (users.empty()) {
      result.left.push_back(column);
      continue;
    }
    // Of those where its coefficient is large, one of u and t alone if there is one, the shortest.
    const auto rank = [&](const Equation* equation) {
      const auto& terms = equation->terms;
      Rational largest = 0;
      for (const auto& [k, c] : terms) largest = std::max<Rational>(largest, abs(c));
      return std::tuple(abs(terms.begin()->second) * 10 < largest,
                        columns.is_element(terms.rbegin()->first), terms.size());
    };
    Equation& best = **std::ranges::min_element(users, {}, rank);
    result.pivots.push_back({column, std::exchange(best, {})});
    for (Equation* user : users) result.pivots.back().put_into(*user);
  }
  for (Equation& equation : equations) {
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
