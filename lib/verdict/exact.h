// Blocks from the decimals of the file, in as many digits as are asked for: what a certificate is
// checked on. Nothing in them went through double; a point of an interval is the decimals that are
// printed of it, so that a kink at 0.3 is met.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "lmi/assembler.h"
#include "lmi/balance.h"
#include "lmi/inequalities.h"
#include "numbers/types/enclosure.h"
#include "verdict/exact_form.h"

namespace gainsmith::verdict {

/// B_ki with bounds of their errors, in the units of a balance: i = 0 is the constant part, and
/// unknowns that do not occur in it have no entry. Both triangles are there, element for element
/// the same.
template <class S>
struct ExactBlock {
  int size = 0;  ///< the rows that are kept
  std::vector<std::pair<int, ExactElements<S>>> terms;
};

/// B_ki as a dense matrix.
/// size x size, midpoints and radii.
template <class S>
numbers::Enclosed<S> dense(const ExactElements<S>& elements, int size);

/// Evaluates the inequality of a block with `where` as an exact affine form. EvaluationError when
/// an operation has no result there. A block without `where`, which is no point of the domain, has
/// the coefficients that it has in double.
/// S is DoubleDouble (31 digits) or Decimal100. Holds the inequalities by reference: they outlive
/// it.
template <class S>
class ExactBlocks {
 public:
  ExactBlocks(const lmi::Inequalities& of, const lmi::Balance& balance);

  /// The rows `kept` of a block; `at` is its place in the balance.
  ExactBlock<S> block(const lmi::Block& block, std::size_t at, const std::vector<int>& kept) const;
  /// Whether the same rows of sum_i d_i B_i are 0 without rounding; d_1 is first.
  bool vanishes(const lmi::Block& block, const std::vector<int>& kept,
                const std::vector<double>& d) const;
  /// c_0 ... c_m of the objective, which there is.
  std::vector<numbers::Ball<S>> objective() const;

 private:
  ExactBlock<S> as_solved(const lmi::Block& block, std::size_t at,
                          const std::vector<int>& kept) const;
  using Form = std::function<ExactForm<S>(const lmi::Unknown&)>;
  std::vector<std::pair<int, ExactElements<S>>> terms(const expr::Program& program,
                                                      const numbers::EnclosedValues<S>& values,
                                                      const Form& form = exact_unknown<S>) const;
  numbers::EnclosedValues<S> values_at(const lmi::Block& block) const;

  const lmi::Inequalities& of_;
  const lmi::Balance balance_;
  numbers::EnclosedValues<S> values_;  ///< of data and parameters
};

/// Its coefficients, in 31 digits or in all of them.
template <class S>
lmi::BalancedBlock rounded(const ExactBlock<S>& block);

}  // namespace gainsmith::verdict
