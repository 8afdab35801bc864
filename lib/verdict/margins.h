// How far every inequality holds, recomputed in double from the matrices as they are written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/rational.h"
#include "forall/plan.h"
#include "forall/proof.h"
#include "lmi/balance.h"
#include "lmi/compile.h"
#include "model/gains.h"

namespace gainsmith::verdict {

/// A local minimum, over the domain of its `forall`, at which an inequality does not hold.
struct Violation {
  std::size_t inequality = 0;  ///< its index in the method
  forall::Point point;
  bool certain = false;  ///< shown by the check of the printed decimals, not by the search
};

struct Margins {
  std::vector<model::Margin> margins;  ///< one for each comparison of each inequality
  std::vector<Violation> violations;   ///< of inequalities with variables
  /// What is not settled of inequalities that hold wherever they were checked: "contraction:
  /// too many pieces near tau in [0.2, 0.25]". Empty when there is nothing.
  std::string open;
  /// What holds, holds at a solution within this of the decimals of x, element by element; none: at
  /// the decimals themselves.
  std::optional<double> solution_within;
};

/// How closely a point is checked.
struct CheckOptions {
  /// Without it the check of the printed decimals comes first, and where it shows that an
  /// inequality holds its minima are not sought: its margin is then that of the imposed points.
  bool describe = true;
  std::size_t most_pieces = forall::ProofOptions{}.most_pieces;  ///< of one check
  const std::vector<Rational>* solution = nullptr;               ///< printed_check.h
};

/// How far every inequality holds at x, as its unit-free margin (correlation.h), taken over
///  - the vertices and points that were imposed, from the affine blocks, and
///  - the local minima over the whole domain of `forall`, from the text itself evaluated over
///    double (forall/worst.h, in the rows' units of `balance`),
/// so that a mistake in compiling the blocks shows up as a margin that does not hold. Where none of
/// these is certainly negative, the inequality is checked at the printed decimals of x, or at the
/// solution near them (printed_check.h): it holds when that shows it.
Margins compute_margins(const lmi::Inequalities& inequalities, const lmi::Lmi& lmi,
                        const lmi::Balance& balance, double wished, const std::vector<double>& x,
                        const CheckOptions& options = {});

/// Whether all margins hold, and nothing is open.
bool all_hold(const Margins& margins);

}  // namespace gainsmith::verdict
