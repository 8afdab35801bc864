// The check that is a yes: an inequality at the unknowns as they are printed, for all values of its
// variables, with the errors of the arithmetic and of the decimals (forall/proof.h). In double,
// then in 31 and 100 digits where that does not decide. What is singular at the decimals is decided
// in fractions, where its text has them (numbers/types/rational.h) and it is affine in each
// variable over an interval: then the ends decide.
//
// Where no decimals satisfy the equations, as of 3*x == 1, a solution near them in fractions is
// checked in their place.
#pragma once

#include <optional>
#include <vector>

#include "forall/proof.h"
#include "lmi/inequalities.h"
#include "numbers/types/rational.h"

namespace gainsmith::verdict {

/// Data and parameters of an instance from the decimals of the file, searched scalars from those
/// that are printed.
template <class S>
numbers::EnclosedValues<S> enclosed_values(const model::Instance& instance);

/// The value of the text printed(value).
template <class S>
numbers::Enclosed<S> enclosed_decimal(double value);

class PrintedCheck {
 public:
  /// `x`: the unknowns; `most_pieces`: of one check (forall::ProofOptions); `solution`: the
  /// unknowns that are checked in the place of the decimals of x.
  PrintedCheck(const lmi::Inequalities& of, const std::vector<double>& x,
               std::size_t most_pieces = forall::ProofOptions{}.most_pieces,
               const std::vector<Rational>* solution = nullptr);

  /// One comparison of one inequality. What has no value somewhere is open.
  /// Throws nothing for what cannot be evaluated: the status is `open` with the reason.
  forall::DomainProof check(std::size_t inequality, std::size_t comparison);

 private:
  /// The unknowns that are checked.
  numbers::RationalValues unknowns() const;
  /// Whether B > 0 (B >= 0) at each element, vertex and end of the domain, in fractions; none where
  /// it has none, or where they do not decide.
  std::optional<bool> check_in_fractions(const lmi::Statement& statement,
                                         std::size_t comparison) const;
  /// The check in S; `known` keeps the values for the next inequality.
  template <class S>
  forall::DomainProof check_in(const lmi::Statement& statement, std::size_t comparison,
                               std::optional<numbers::EnclosedValues<S>>& known);

  const lmi::Inequalities& of_;
  const std::vector<double>& x_;
  std::size_t most_pieces_;
  const std::vector<Rational>* solution_;
  std::optional<numbers::EnclosedValues<double>> in_double_;
  std::optional<numbers::EnclosedValues<DoubleDouble>> in_31_;
  std::optional<numbers::EnclosedValues<Decimal100>> in_100_;
};

}  // namespace gainsmith::verdict
