#include "design/sos_statements.h"

#include <algorithm>

#include "base/number.h"
#include "verdict/rational_blocks.h"

namespace gainsmith::design {

using polynomial::Monomial;
using polynomial::Polynomial;
using polynomial::PolynomialMatrix;
using polynomial::PolynomialValues;
using polynomial::Term;

bool has_sums_of_squares(const model::Design& design) {
  return std::ranges::any_of(design.inequalities,
                             [](const auto& inequality) { return inequality.sos.has_value(); });
}

namespace {

/// An unknown as a matrix of polynomials of degree 0: its scalars, each a term of its own.
PolynomialMatrix unknown_matrix(const lmi::Unknown& unknown) {
  PolynomialMatrix result(unknown.shape.rows, unknown.shape.cols);
  for (int k = 0; k < unknown.count; ++k)
    for (const auto& [row, column] : unknown.places(k))
      result(row, column) = Polynomial(Term{{}, unknown.first + k});
  return result;
}

int degree_of(const PolynomialMatrix& M) {
  int degree = 0;
  for (const Polynomial& p : M.reshaped()) degree = std::max(degree, p.degree());
  return degree;
}

/// What the variables of one inequality are, at one element of each set.
struct Domain {
  PolynomialValues values;
  std::vector<std::string> names;
  std::vector<Polynomial> within;  ///< (x - low) (high - x) of intervals
  std::string label;               ///< "k = 2"; empty without sets
};

class Statements {
 public:
  explicit Statements(const lmi::Inequalities& of)
      : of_(of), rationals_(verdict::rational_values(of.instance)) {
    for (const auto& [name, value] : rationals_)
      values_[name] = polynomial::polynomial_matrix(value);
    for (const lmi::Unknown& unknown : of.unknowns.list())
      values_[unknown.name] = unknown_matrix(unknown);
    for (int i = 1; i <= of.unknowns.size(); ++i)
      result_.unknowns.push_back(of.unknowns.scalar_name(i));
  }

  SosStatements take() {
    for (std::size_t k = 0; k < of_.statements.size(); ++k) add(k);
    if (const auto& objective = of_.design().objective)
      result_.objective = value(of_.bodies.link(objective->program), values_)(0, 0);
    return std::move(result_);
  }

 private:
  PolynomialMatrix value(const expr::Program& program, const PolynomialValues& values) const {
    return polynomial_value(program, values, result_.unknowns);
  }

  Rational number(const model::Formula& formula) const {
    return numbers::rational_value(formula.program, rationals_)(0, 0);
  }

  /// Each domain with the next variable.
  std::vector<Domain> with(const model::Design::Variable& variable, Domain domain) const {
    const auto next = [&] {
      domain.names.push_back(variable.name);
      return Polynomial(Term{Monomial(domain.names.size() - 1), 0});
    };
    switch (variable.over) {
      case model::Over::reals: {
        const int n = variable.shape.rows;
        PolynomialMatrix x(n, 1);
        for (int k = 0; k < n; ++k) {
          x(k) = next();
          if (n > 1) domain.names.back() += "(" + std::to_string(k + 1) + ")";
        }
        domain.values[variable.name] = x;
        return {domain};
      }
      case model::Over::interval: {
        // x in [low, high] is (x - low) (high - x) >= 0.
        const Polynomial x = next();
        domain.values[variable.name] = PolynomialMatrix::Constant(1, 1, x);
        domain.within.push_back((x - Polynomial(number(variable.points[0]))) *
                                (Polynomial(number(variable.points[1])) - x));
        return {domain};
      }
      case model::Over::set: {
        std::vector<Domain> result;
        for (const model::Formula& point : variable.points) {
          Domain one = domain;
          const auto element = numbers::rational_value(point.program, rationals_);
          one.values[variable.name] = polynomial::polynomial_matrix(element);
          const std::string text =
              element.size() == 1 ? brief(nearest_double(element(0, 0))) : point.text;
          one.label += (one.label.empty() ? "" : ", ") + variable.name + " = " + text;
          result.push_back(std::move(one));
        }
        return result;
      }
      case model::Over::polytope:
        break;
    }
    throw InputError(variable.place,
                     "sums of squares take no polytope: write the vertices as a set, "
                     "{A1, A2}, of what is affine in " +
                         variable.name);
  }

  /// Every combination of the elements of sets is a domain of its own.
  void add(std::size_t at) {
    const lmi::Statement& statement = of_.statements[at];
    std::vector<Domain> domains = {{values_, {}, {}, ""}};
    for (const model::Design::Variable& variable : statement.stated->domain) {
      std::vector<Domain> next;
      for (const Domain& domain : domains)
        for (Domain& one : with(variable, domain)) next.push_back(std::move(one));
      domains = std::move(next);
    }
    for (const Domain& domain : domains)
      for (std::size_t k = 0; k < statement.differences.size(); ++k)
        add(at, statement.stated->comparisons[k], statement.differences[k], domain);
  }

  void add(std::size_t at, const model::Design::Comparison& comparison,
           const expr::Program& difference, const Domain& domain) {
    const model::Design::Inequality& inequality = *of_.statements[at].stated;
    sos::Statement statement;
    statement.name = comparison.name + (domain.label.empty() ? "" : " at " + domain.label);
    statement.strict = comparison.strict;
    statement.matrix = value(difference, domain.values);
    const PolynomialMatrix& M = statement.matrix;
    if (M.rows() == 0)
      throw InputError(inequality.that_place, "'" + comparison.name + "' has no rows");
    if (M != PolynomialMatrix(M.transpose()))
      throw InputError(inequality.that_place, "the sides of '" + comparison.name +
                                                  "' differ by a matrix that is not symmetric");
    if (inequality.sos) {
      for (const auto& where : inequality.sos->where) add_where(where, domain, statement);
      if (inequality.sos->degree && inequality.sos->adds_degree)
        statement.more = *inequality.sos->degree;
      else
        statement.degree = inequality.sos->degree;
      if (const int own = degree_of(M); statement.degree && *statement.degree < own)
        throw InputError(inequality.place,
                         "the degree of '" + comparison.name + "' is " + std::to_string(own) +
                             ", and 'degree: " + std::to_string(*statement.degree) +
                             "' is that of all its terms: give at least " + std::to_string(own));
    }
    statement.nonnegative.insert(statement.nonnegative.end(), domain.within.begin(),
                                 domain.within.end());
    add_parts(at, std::move(statement), domain);
  }

  /// Of a diagonal matrix its elements one by one.
  void add_parts(std::size_t at, sos::Statement statement, const Domain& domain) {
    const PolynomialMatrix M = statement.matrix;
    // A diagonal matrix is a sum of squares exactly when each of its elements is one.
    const bool is_diagonal = M.rows() > 1 && M == PolynomialMatrix(M.diagonal().asDiagonal());
    const Eigen::Index parts = is_diagonal ? M.rows() : 1;
    for (Eigen::Index k = 0; k < parts; ++k) {
      sos::Statement part = statement;
      if (is_diagonal) {
        part.matrix = PolynomialMatrix::Constant(1, 1, M(k, k));
        part.name += "(" + std::to_string(k + 1) + ")";
      }
      result_.statements.push_back(std::move(part));
      result_.inequalities.push_back(at);
      result_.variables.push_back(domain.names);
    }
  }

  /// The elements of a column one by one; of an equation D == 0 those of D, above the diagonal of
  /// [0, D; D', 0].
  void add_where(const model::Design::Inequality::Where& where, const Domain& domain,
                 sos::Statement& statement) const {
    const PolynomialMatrix M = value(of_.bodies.link(where.difference), domain.values);
    for (Eigen::Index c = 0; c < M.cols(); ++c)
      for (Eigen::Index r = 0; r <= c; ++r) {
        const Polynomial& p = M(r, c);
        if (p.terms().empty()) continue;
        if (!where.equation && r != c)
          throw InputError(where.place,
                           "'where' compares polynomials, or columns of them element by element, "
                           "not matrices");
        (where.equation ? statement.zero : statement.nonnegative).push_back(p);
      }
  }

  const lmi::Inequalities& of_;
  const numbers::RationalValues rationals_;
  PolynomialValues values_;
  SosStatements result_;
};

}  // namespace

bool hold_at_zero(const SosStatements& stated) {
  const std::vector<Rational> zeros(stated.unknowns.size());
  return std::ranges::none_of(stated.statements, [&](const sos::Statement& statement) {
    return statement.strict ||
           std::ranges::any_of(statement.matrix.reshaped(), [&](const Polynomial& p) {
             return with_unknowns(p, zeros) != Polynomial();
           });
  });
}

SosStatements sos_statements(const lmi::Inequalities& of) {
  if (const auto& quotient = of.design().quotient)
    throw InputError(
        quotient->place,
        "minimize: " + quotient->text +
            " beside sums of squares: name a scalar l, require M <= l*N and search it");
  return Statements(of).take();
}

}  // namespace gainsmith::design
