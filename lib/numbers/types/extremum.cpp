#include "numbers/types/extremum.h"

#include <map>
#include <optional>

#include "numbers/dense/foundation.h"
#include "numbers/graph/stacked_functions.h"
#include "numbers/types/extremum_rules.h"
#include "numerics/box_search.h"

namespace gainsmith::numbers {

/// The body is a tape over the stacked names. Where that has no value, `plain` gives it or the
/// fault.
Vector extreme_point(const expr::Instruction& instruction, expr::Operands<Matrix> operands,
                     OverBox<double>& plain) {
  const auto variables = static_cast<std::size_t>(instruction.attributes[1]);
  std::map<std::string, Eigen::Index> places;
  Eigen::Index size = 0;
  for (std::size_t k = 0; k < variables; size += operands[2 * k++]->size())
    places[expr::variable_name(k)] = size;
  Values others;
  for (std::size_t k = 2 * variables; k < operands.size(); ++k)
    others[expr::other_name(k - 2 * variables)] = *operands[k];
  const auto place = [&](const std::string& name) {
    const auto found = places.find(name);
    return found == places.end() ? std::nullopt : std::optional(found->second);
  };
  StackedFunctions f({instruction.body.get()}, place, others, size);
  const double sign = instruction.attributes[0] != 0 ? 1 : -1;
  const auto value = [&](const Vector& x) {
    return sign * (f.run(x) ? f.element(0, 0) : plain.at(x));
  };
  return numerics::largest_over_box(value, plain.low, plain.high).point;
}

template Matrix extremum<double>(const expr::Instruction&, expr::Operands<Matrix>);

}  // namespace gainsmith::numbers
