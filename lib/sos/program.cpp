#include "sos/program.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/stop.h"
#include "numbers/dense/dense.h"

namespace gainsmith::sos {

namespace {

/// The largest degree in x.
int degree_of(const auto& polynomials) {
  int degree = 0;
  for (const Polynomial& p : polynomials) degree = std::max(degree, p.degree());
  return degree;
}

/// The degree of all terms, even: of M, of what was asked for, at least of each g_j and h_l.
int degree_of(const Statement& statement) {
  const int own = degree_of(statement.matrix.reshaped());
  const int asked = statement.degree ? std::max(*statement.degree, own) : own + statement.more;
  const int degree = std::max({asked, degree_of(statement.nonnegative), degree_of(statement.zero)});
  return degree + degree % 2;
}

/// Units of the variables of an inequality, and of itself, in which its numbers are near 1.
class Units {
 public:
  /// s_0, then s_i of each variable: see units_of().
  explicit Units(numbers::Vector exponents) : exponents_(std::move(exponents)) {}

  /// The largest term of a polynomial in these units, where the variables are near 1.
  double size_of(const Polynomial& p) const {
    double largest = 0;
    for (const auto& [term, c] : p.terms())
      largest =
          std::max(largest, std::abs(nearest_double(c)) * std::exp2(-exponent_of(term.monomial)));
    return largest;
  }
  /// For a monomial times a polynomial of that size: Q_ab m_a m_b g of a solution is of the size of
  /// p where Q_ab is of that of scale_a scale_b.
  double scale_of(const Monomial& monomial, double size) const {
    // Scales are from 2^-200 to 2^200, whatever the coefficients.
    constexpr double kMost = 200;
    const double exponent =
        exponent_of(monomial) + (exponents_(0) - (size > 0 ? std::log2(size) : 0)) / 2;
    return std::exp2(std::round(std::clamp(exponent, -kMost, kMost)));
  }

 private:
  /// sum_i e_i s_i: -log2 of the monomial where the variables are near 1 in these units.
  double exponent_of(const Monomial& monomial) const {
    double sum = 0;
    for (std::size_t i = 0; i < monomial.variables(); ++i)
      sum += monomial.exponent(i) * exponents_(static_cast<Eigen::Index>(i) + 1);
    return sum;
  }

  numbers::Vector exponents_;
};

/// Those of all inequalities, by least squares:
///   log2 |c_m| + w ~ s_0 + sum_i s_i e_i,
/// where w, the size of all unknowns, is 0 for coefficients of none.
std::vector<Units> units_of(const std::vector<Statement>& statements) {
  constexpr double kOfVariables = 1e-2, kOfSizes = 1e-6;  // for what no coefficient says
  std::vector<Eigen::Index> first = {1};                  // of each inequality; w is at 0
  for (const Statement& statement : statements)
    first.push_back(first.back() + 1 + static_cast<Eigen::Index>(variables_of(statement)));
  numbers::Matrix normal = kOfVariables * numbers::Matrix::Identity(first.back(), first.back());
  numbers::Vector right = numbers::Vector::Zero(first.back());
  normal(0, 0) = kOfSizes;
  for (std::size_t s = 0; s < statements.size(); ++s) {
    normal(first[s], first[s]) = kOfSizes;
    for (const Polynomial& p : statements[s].matrix.reshaped())
      for (const auto& [term, c] : p.terms()) {
        numbers::Vector row = numbers::Vector::Zero(first.back());
        row(0) = term.unknown == 0 ? 0 : -1;
        row(first[s]) = 1;
        for (std::size_t i = 0; i < term.monomial.variables(); ++i)
          row(first[s] + 1 + static_cast<Eigen::Index>(i)) = term.monomial.exponent(i);
        normal += row * row.transpose();
        right += std::log2(std::abs(nearest_double(c))) * row;
      }
  }
  const numbers::Vector exponents = numbers::Cholesky(normal).solve(right);
  std::vector<Units> units;
  for (std::size_t s = 0; s < statements.size(); ++s)
    units.emplace_back(exponents.segment(first[s], first[s + 1] - first[s]));
  return units;
}

/// Adds the unknowns of a statement.
void pose(Program& program, std::size_t at, const Units& units) {
  const Statement& statement = program.statements[at];
  const std::size_t n = variables_of(statement);
  const int degree = degree_of(statement);
  const auto rows = static_cast<int>(statement.matrix.rows());
  // Monomials; more are refused.
  constexpr double kMost = 20000;
  if (polynomial::count_of_monomials(n, degree) > kMost)
    throw std::length_error("too many monomials");
  const auto add = [&](std::size_t multiplier, const Polynomial& times) {
    Gram& gram = program.grams.emplace_back(Gram{at, multiplier, times, {}});
    const double size = units.size_of(times);
    const auto half = polynomial::monomials(n, 0, (degree - times.degree()) / 2);
    for (int r = 0; r < rows; ++r)
      for (const Monomial& m : half) {
        gram.basis.push_back({{{r, m}, Rational(1)}});
        gram.scale.push_back(units.scale_of(m, size));
      }
  };
  for (std::size_t j = 0; j < statement.nonnegative.size(); ++j)
    add(j + 1, statement.nonnegative[j]);
  add(0, Polynomial(1));
  for (std::size_t l = 0; l < statement.zero.size(); ++l) {
    const Polynomial& h = statement.zero[l];
    for (const Monomial& m : polynomial::monomials(n, 0, degree - h.degree()))
      for (int c = 0; c < rows; ++c)
        for (int r = 0; r <= c; ++r) program.free.push_back({at, l, h, r, c, m});
  }
}

}  // namespace

Columns::Columns(const Program& program)
    : unknowns_(program.unknowns),
      first_{program.unknowns + static_cast<int>(program.free.size())} {
  for (const Gram& gram : program.grams)
    first_.push_back(first_.back() + gram.size() * (gram.size() + 1) / 2);
}

Columns::Place Columns::place(int column) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), column);
  Place place;
  place.gram = static_cast<std::size_t>(after - first_.begin()) - 1;
  const int rest = column - first_[place.gram];
  place.column = static_cast<int>((std::sqrt(8.0 * rest + 1) - 1) / 2);
  place.row = rest - place.column * (place.column + 1) / 2;
  return place;
}

std::size_t variables_of(const Statement& statement) {
  std::size_t n = 0;
  for (const Polynomial& p : statement.matrix.reshaped()) n = std::max(n, p.variables());
  for (const auto* list : {&statement.nonnegative, &statement.zero})
    for (const Polynomial& p : *list) n = std::max(n, p.variables());
  return n;
}

Program pose(std::vector<Statement> statements, int unknowns) {
  Program program{std::move(statements), unknowns, {}, {}};
  const std::vector<Units> units = units_of(program.statements);
  for (std::size_t s = 0; s < program.statements.size(); ++s) pose(program, s, units[s]);
  return program;
}

std::vector<Equation> equations_of(const Program& program) {
  const Columns columns(program);
  std::map<Key, Equation> sums;
  for (std::size_t s = 0; s < program.statements.size(); ++s) {
    const polynomial::PolynomialMatrix& M = program.statements[s].matrix;
    for (int c = 0; c < M.cols(); ++c)
      for (int r = 0; r <= c; ++r)
        for (const auto& [term, coefficient] : M(r, c).terms()) {
          // Of v'Mv: v_r v_c, r < c, has M_rc and M_cr. Terms in u go to the left side.
          const Rational value = coefficient * (r == c ? 1 : 2);
          Equation& sum = sums[{s, r, c, term.monomial}];
          if (term.unknown == 0)
            sum.value += value;
          else
            sum.terms[columns.unknown(term.unknown)] -= value;
        }
  }
  // z'Qz = sum_a Q_aa z_a^2 + 2 sum_{a<b} Q_ab z_a z_b, times g.
  for (std::size_t g = 0; g < program.grams.size(); ++g) {
    const Gram& gram = program.grams[g];
    for (int b = 0; b < gram.size(); ++b) {
      check_stop();
      for (int a = 0; a <= b; ++a)
        for (const auto& [left, c] : gram.basis[static_cast<std::size_t>(a)])
          for (const auto& [right, d] : gram.basis[static_cast<std::size_t>(b)]) {
            const Rational weight = c * d * (a == b ? 1 : 2);
            const Monomial both = left.monomial * right.monomial;
            const auto [low, high] = std::minmax(left.row, right.row);
            for (const auto& [term, t] : gram.times.terms())
              sums[{gram.statement, low, high, both * term.monomial}]
                  .terms[columns.element(g, a, b)] += weight * t;
          }
    }
  }
  for (std::size_t k = 0; k < program.free.size(); ++k) {
    const FreeTerm& free = program.free[k];
    for (const auto& [term, c] : free.times.terms())
      sums[{free.statement, free.row, free.column, free.monomial * term.monomial}]
          .terms[columns.free(k)] += c;
  }
  std::vector<Equation> result;
  for (auto& [key, sum] : sums) {
    std::erase_if(sum.terms, [](const auto& term) { return term.second == 0; });
    sum.key = key;
    result.push_back(std::move(sum));
  }
  return result;
}

}  // namespace gainsmith::sos
