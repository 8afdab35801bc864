// How far every inequality holds, recomputed in double from the matrices as they are written.
#pragma once

#include <string>
#include <vector>

#include "forall/plan.h"
#include "lmi/compile.h"
#include "model/gains.h"

namespace gainsmith::lmi {

/// A local minimum, over the domain of its `forall`, at which an inequality is short of what was
/// asked for.
struct Violation {
  std::size_t inequality = 0;  ///< its index in the method
  forall::Point point;
};

struct Margins {
  std::vector<model::Margin> margins;  ///< one for each comparison of each inequality
  std::vector<Violation> violations;   ///< of inequalities with variables
  /// What is not settled of inequalities that hold wherever they were looked at: "contraction:
  /// too many pieces near tau in [0.2, 0.25]". Empty when there is nothing.
  std::string open;
  /// Whether an inequality imposed by exchange was only searched between its points, because its
  /// functions have no known derivatives.
  bool searched = false;
};

/// How far every inequality holds. The smallest eigenvalue is taken over
///  - the vertices and points that were imposed, from the affine blocks, and
///  - the whole domain of `forall`, from the text itself evaluated over double (forall/worst.h),
/// so that a mistake in compiling the blocks shows up as a margin that does not hold. Where the
/// plan imposed points, what holds at all of them is then bounded between them (forall/between.h).
/// `scale` of a homogeneous problem is the coefficients' size times the largest |x_i|. A strict
/// inequality holds when its smallest eigenvalue is positive, another when it is above -1e-11 times
/// the largest element of a term x_i B_i.
Margins compute_margins(const Inequalities& inequalities, const Lmi& lmi, const forall::Plan& plan,
                        const std::vector<double>& scales, bool homogeneous, double required,
                        const std::vector<double>& x);

/// Whether an inequality holds at the written decimals with the margin that was asked for, up to
/// 1 % of it.
bool is_kept(const model::Margin& margin);

}  // namespace gainsmith::lmi
