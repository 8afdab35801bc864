// Inequalities between polynomials as sums of squares (Parrilo 2003; Putinar 1993).
//
//   M(x; u) >= 0  for all x with g_j(x) >= 0, h_l(x) = 0,   M symmetric, q x q, affine in u,
//
// holds where there are Gram matrices Q_j >= 0 and polynomials t_l, any, with
//   v'M(x; u)v = z_0'Q_0 z_0 + sum_j g_j(x) z_j'Q_j z_j + sum_l h_l(x) t_l,
// the z_j being vectors of monomials in x, times elements of v. The two sides are equal coefficient
// by coefficient: each monomial gives an equation that is linear in u, the Q_j and the t_l. An
// inequality without variables has z_0 = v and Q_0 = M.
//
// A yes of this room is such an identity in fractions with Q_j > 0. A no is an equation that
// nothing satisfies, or multipliers of the equations in fractions. The solver's numbers are guesses
// for both, and nothing rests on them. A no excludes sums of squares of these degrees alone; the
// inequality may hold.
//   program                  statements, Gram matrices, the equations
//   reduce                   what the equations say without a solver
//   solve                    the semidefinite program, and back
//   identity, conditions     from a point in floating point to an identity in fractions
//   face                     the face on which singular Gram matrices lie
//   moments                  multipliers that exclude solutions, or bound an objective
//   decide                   the order of all these
//   counterexample           points at which an inequality is false
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polynomial/polynomial_numbers.h"

namespace gainsmith::sos {

using polynomial::Monomial;
using polynomial::Polynomial;

/// M(x; u) >= 0, or > 0, on the set of x with g_j(x) >= 0 and h_l(x) = 0.
struct Statement {
  std::string name;                       ///< of the comparison
  polynomial::PolynomialMatrix matrix;    ///< M
  bool strict = false;                    ///< Q_0 > 0, with the constants in z_0: M >= c I, c > 0
  std::vector<Polynomial> nonnegative{};  ///< g_j, without unknowns
  std::vector<Polynomial> zero{};         ///< h_l, without unknowns
  std::optional<int> degree{};            ///< of all terms in x; none: of M, or what g_j need
  int more = 0;                           ///< added to it
};

/// v_row times a monomial in x.
struct Element {
  int row = 0;
  Monomial monomial;

  auto operator<=>(const Element&) const = default;
};

/// sum of c times elements; of the first program one element.
using BasisPolynomial = std::vector<std::pair<Element, Rational>>;

/// times(x) z'Qz.
struct Gram {
  std::size_t statement = 0;
  std::size_t multiplier = 0;  ///< j; 0 of the main one, where `times` is 1
  Polynomial times;
  std::vector<BasisPolynomial> basis;  ///< z
  /// Powers of two, one for each row: in solutions Q_ab is of the size of scale_a scale_b.
  std::vector<double> scale{};

  int size() const { return static_cast<int>(basis.size()); }
};

/// An unknown coefficient of t_l: times(x) m(x) v_row v_column.
struct FreeTerm {
  std::size_t statement = 0;
  std::size_t equation = 0;  ///< l
  Polynomial times;
  int row = 0;
  int column = 0;
  Monomial monomial;
};

/// The unknowns of the identities of all statements: u, the t_l and the Q_j.
struct Program {
  std::vector<Statement> statements;
  int unknowns = 0;  ///< the number of u
  std::vector<Gram> grams;
  std::vector<FreeTerm> free;  ///< the coefficients of all t_l
};

/// The coefficient of m(x) v_row v_column, row <= column, of a statement.
struct Key {
  std::size_t statement = 0;
  int row = 0;
  int column = 0;
  Monomial monomial;

  auto operator<=>(const Key&) const = default;
};

/// Numbers the unknowns of a program: u, then the coefficients of t, then the elements of the upper
/// triangles of the Gram matrices, column by column.
class Columns {
 public:
  explicit Columns(const Program& program);

  /// The column of u_k, k from 1.
  int unknown(int k) const { return k - 1; }
  /// The column of coefficient k of Program::free, from 0.
  int free(std::size_t k) const { return unknowns_ + static_cast<int>(k); }
  /// row <= column.
  int element(std::size_t gram, int row, int column) const {
    return first_[gram] + column * (column + 1) / 2 + row;
  }
  bool is_element(int column) const { return column >= first_.front(); }
  int unknowns() const { return unknowns_; }
  int frees() const { return first_.front(); }  ///< u and t
  int size() const { return first_.back(); }
  struct Place {
    std::size_t gram = 0;
    int row = 0;
    int column = 0;
  };
  /// Of the column of an element.
  Place place(int column) const;

 private:
  int unknowns_;
  std::vector<int> first_;  ///< the first element of each Gram matrix, with an end
};

/// sum of terms[column] times unknown = value.
struct Equation {
  Key key;
  std::map<int, Rational> terms;
  Rational value = 0;
  /// Of a combination of equations: the factor of each.
  std::map<std::size_t, Rational> from{};
};

/// The variables of a statement, up to the last that occurs.
std::size_t variables_of(const Statement& statement);

/// With full bases: all monomials of half the degree. reduce() leaves those of half the Newton
/// polytope. InputError's text for more than 20,000 monomials is left to the caller: it throws
/// std::length_error.
Program pose(std::vector<Statement> statements, int unknowns);

/// One for each monomial, in the order of keys.
std::vector<Equation> equations_of(const Program& program);

}  // namespace gainsmith::sos
