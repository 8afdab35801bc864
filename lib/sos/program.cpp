#include "sos/program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "base/stop.h"
#include "numbers/dense.h"

namespace gainsmith::sos {

namespace {

/// The variables of a statement, up to the last that occurs.
std::size_t variables_of(const Statement& statement) {
  std::size_t n = 0;
  for (const Polynomial& p : statement.matrix.reshaped()) n = std::max(n, p.variables());
  for (const auto* list : {&statement.nonnegative, &statement.zero})
    for (const Polynomial& p : *list) n = std::max(n, p.variables());
  return n;
}

constexpr int even_above(int degree) { return degree + degree % 2; }

/// The degree of all terms: of M, of what was asked for, at least of each g_j and h_l.
int degree_of(const Statement& statement) {
  int degree = 0;
  for (const Polynomial& p : statement.matrix.reshaped()) degree = std::max(degree, p.degree());
  degree = statement.degree ? std::max(*statement.degree, degree) : degree + statement.more;
  for (const auto* list : {&statement.nonnegative, &statement.zero})
    for (const Polynomial& p : *list) degree = std::max(degree, p.degree());
  return even_above(degree);
}

/// The least and the largest of some exponents, and of the degree.
class Extent {
 public:
  explicit Extent(std::size_t n) : least_(n + 1, kNone), most_(n + 1, -1) {}

  /// m^power.
  void add(const Monomial& m, int power = 1) {
    for (std::size_t i = 0; i + 1 < least_.size(); ++i) add(i, power * m.exponent(i));
    add(least_.size() - 1, power * m.degree());
  }
  void add_products(const Extent& other, const Polynomial& p, int power) {
    if (other.least_.back() == kNone) return;
    for (const auto& [term, c] : p.terms())
      for (std::size_t i = 0; i < least_.size(); ++i) {
        const int own = i + 1 < least_.size() ? term.monomial.exponent(i) : term.monomial.degree();
        add(i, own + power * other.least_[i]);
        add(i, own + power * other.most_[i]);
      }
  }
  /// Whether m^2 lies within.
  bool has_square(const Monomial& m) const {
    for (std::size_t i = 0; i < least_.size(); ++i) {
      const int e = 2 * (i + 1 < least_.size() ? m.exponent(i) : m.degree());
      if (e < least_[i] || e > most_[i]) return false;
    }
    return true;
  }

 private:
  static constexpr int kNone = std::numeric_limits<int>::max();

  void add(std::size_t i, int e) {
    least_[i] = std::min(least_[i], e);
    most_[i] = std::max(most_[i], e);
  }

  std::vector<int> least_, most_;
};

/// Units of the variables, and of the inequality, in which its numbers are near 1:
///   log2 |c_m| ~ s_0 + sum_i s_i e_i   of the coefficients without unknowns, by least squares.
class Units {
 public:
  Units(const Statement& statement, std::size_t n) {
    const auto size = static_cast<Eigen::Index>(n) + 1;
    constexpr double kNear0 = 1e-2;  // for what no coefficient says
    numbers::Matrix normal = kNear0 * numbers::Matrix::Identity(size, size);
    numbers::Vector right = numbers::Vector::Zero(size);
    for (const Polynomial& p : statement.matrix.reshaped())
      for (const auto& [term, c] : p.terms()) {
        if (term.unknown != 0) continue;
        numbers::Vector row = numbers::Vector::Zero(size);
        row(0) = 1;
        for (Eigen::Index i = 1; i < size; ++i)
          row(i) = term.monomial.exponent(static_cast<std::size_t>(i) - 1);
        normal += row * row.transpose();
        right += std::log2(std::abs(nearest_double(c))) * row;
      }
    exponents_ = numbers::Cholesky(normal).solve(right);
  }

  /// The largest term of a polynomial in these units, where the variables are near 1.
  double size_of(const Polynomial& p) const {
    double largest = 0;
    for (const auto& [term, c] : p.terms())
      largest =
          std::max(largest, std::abs(nearest_double(c)) * std::exp2(-exponent_of(term.monomial)));
    return largest;
  }
  /// For a monomial times a polynomial of that size.
  double scale_of(const Monomial& monomial, double size) const {
    constexpr double kMost = 200;
    const double exponent =
        exponent_of(monomial) + (exponents_(0) - (size > 0 ? std::log2(size) : 0)) / 2;
    return std::exp2(std::round(std::clamp(exponent, -kMost, kMost)));
  }

 private:
  double exponent_of(const Monomial& monomial) const {
    double sum = 0;
    for (std::size_t i = 0; i < monomial.variables(); ++i)
      sum += monomial.exponent(i) * exponents_(static_cast<Eigen::Index>(i) + 1);
    return sum;
  }

  numbers::Vector exponents_;
};

/// C(n + degree, n).
double count_of(std::size_t n, int degree) {
  double count = 1;
  for (std::size_t i = 1; i <= n; ++i)
    count *= (degree + static_cast<double>(i)) / static_cast<double>(i);
  return count;
}

class Posing {
 public:
  Posing(Program& program, std::size_t statement)
      : program_(program),
        at_(statement),
        statement_(program.statements[statement]),
        n_(variables_of(statement_)),
        degree_(degree_of(statement_)),
        units_(statement_, n_) {
    constexpr double kMost = 20000;
    if (count_of(n_, degree_) > kMost) throw std::length_error("too many monomials");
  }

  void add() {
    const auto rows = static_cast<int>(statement_.matrix.rows());
    std::vector<Extent> extents;
    for (int r = 0; r < rows; ++r) extents.push_back(own_extent(r));
    add_multipliers(rows, extents);
    add_free_terms(rows, extents);
    Gram main{at_, 0, Polynomial(1), {}};
    const std::vector<Monomial> all = polynomial::monomials(n_, 0, degree_ / 2);
    for (int r = 0; r < rows; ++r)
      for (const Monomial& m : all)
        if (extents[static_cast<std::size_t>(r)].has_square(m))
          main.basis.push_back({{{r, m}, Rational(1)}});
    add(std::move(main));
  }

 private:
  void add(Gram gram) {
    const double size = units_.size_of(gram.times);
    for (const BasisPolynomial& basis : gram.basis)
      gram.scale.push_back(units_.scale_of(basis.front().first.monomial, size));
    program_.grams.push_back(std::move(gram));
  }

  Extent own_extent(int row) const {
    Extent extent(n_);
    for (const auto& [term, c] : statement_.matrix(row, row).terms()) extent.add(term.monomial);
    return extent;
  }

  void add_multipliers(int rows, std::vector<Extent>& extents) {
    for (std::size_t j = 0; j < statement_.nonnegative.size(); ++j) {
      const Polynomial& g = statement_.nonnegative[j];
      Gram gram{at_, j + 1, g, {}};
      Extent squares(n_);
      for (const Monomial& m : polynomial::monomials(n_, 0, (degree_ - g.degree()) / 2)) {
        squares.add(m);
        for (int r = 0; r < rows; ++r) gram.basis.push_back({{{r, m}, Rational(1)}});
      }
      for (Extent& extent : extents) extent.add_products(squares, g, 2);
      add(std::move(gram));
    }
  }

  void add_free_terms(int rows, std::vector<Extent>& extents) {
    for (std::size_t l = 0; l < statement_.zero.size(); ++l) {
      const Polynomial& h = statement_.zero[l];
      Extent all(n_);
      for (const Monomial& m : polynomial::monomials(n_, 0, degree_ - h.degree())) {
        all.add(m);
        for (int c = 0; c < rows; ++c)
          for (int r = 0; r <= c; ++r) program_.free.push_back({at_, l, h, r, c, m});
      }
      for (Extent& extent : extents) extent.add_products(all, h, 1);
    }
  }

  Program& program_;
  std::size_t at_;
  const Statement& statement_;
  std::size_t n_;
  int degree_;
  Units units_;
};

/// The equations by their keys.
class Assembly {
 public:
  explicit Assembly(const Program& program) : program_(program), columns_(program) {}

  std::vector<Equation> take() {
    for (std::size_t s = 0; s < program_.statements.size(); ++s) add_statement(s);
    for (std::size_t g = 0; g < program_.grams.size(); ++g) add_gram(g);
    for (std::size_t k = 0; k < program_.free.size(); ++k) {
      const FreeTerm& free = program_.free[k];
      for (const auto& [term, c] : free.times.terms())
        add({free.statement, free.row, free.column, free.monomial * term.monomial},
            columns_.free(k), c);
    }
    std::vector<Equation> result;
    for (auto& [key, equation] : equations_) {
      equation.key = key;
      result.push_back(std::move(equation));
    }
    return result;
  }

 private:
  void add(const Key& key, int column, const Rational& coefficient) {
    Rational& sum = equations_[key].terms[column];
    sum += coefficient;
  }

  void add_statement(std::size_t s) {
    const polynomial::PolynomialMatrix& M = program_.statements[s].matrix;
    for (int c = 0; c < M.cols(); ++c)
      for (int r = 0; r <= c; ++r)
        for (const auto& [term, coefficient] : M(r, c).terms()) {
          const Rational value = coefficient * (r == c ? 1 : 2);
          const Key key{s, r, c, term.monomial};
          if (term.unknown == 0)
            equations_[key].value += value;
          else
            add(key, columns_.unknown(term.unknown), Rational(-value));
        }
  }

  void add_gram(std::size_t g) {
    const Gram& gram = program_.grams[g];
    for (int b = 0; b < gram.size(); ++b) {
      check_stop();
      for (int a = 0; a <= b; ++a) add_element(g, a, b);
    }
  }

  void add_element(std::size_t g, int a, int b) {
    const Gram& gram = program_.grams[g];
    const int column = columns_.element(g, a, b);
    for (const auto& [left, c] : gram.basis[static_cast<std::size_t>(a)])
      for (const auto& [right, d] : gram.basis[static_cast<std::size_t>(b)]) {
        const Rational weight = c * d * (a == b ? 1 : 2);
        const Monomial both = left.monomial * right.monomial;
        const auto [low, high] = std::minmax(left.row, right.row);
        for (const auto& [term, t] : gram.times.terms())
          add({gram.statement, low, high, both * term.monomial}, column, Rational(weight * t));
      }
  }

  const Program& program_;
  const Columns columns_;
  std::map<Key, Equation> equations_;
};

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
  int rest = column - first_[place.gram];
  while (rest > place.column) rest -= ++place.column;
  place.row = rest;
  return place;
}

Program pose(std::vector<Statement> statements, int unknowns) {
  Program program{std::move(statements), unknowns, {}, {}};
  for (std::size_t s = 0; s < program.statements.size(); ++s) Posing(program, s).add();
  return program;
}

std::vector<Equation> equations_of(const Program& program) {
  std::vector<Equation> equations = Assembly(program).take();
  for (Equation& equation : equations)
    std::erase_if(equation.terms, [](const auto& term) { return term.second == 0; });
  return equations;
}

}  // namespace gainsmith::sos
