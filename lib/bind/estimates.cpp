#include "bind/estimates.h"

namespace gainsmith::bind {

expr::Estimate estimate(const model::Design& design, const expr::Program& program) {
  return expr::estimate_of(program, [&](const std::string& input) {
    const auto found = design.estimates.find(input);
    return found == design.estimates.end() ? expr::Estimate::none : found->second;
  });
}

void note_estimate(model::Design& design, const std::string& name, const expr::Program& program) {
  const expr::Estimate found = estimate(design, program);
  if (found == expr::Estimate::none) return;
  design.estimates[name] = found;
}

/// A search gives a value at one point. It bounds the maximum from below, and a proof needs a bound
/// from above.
void refuse_estimate(const model::Design& design, const expr::Program& program,
                     const std::string& what) {
  if (const expr::Instruction* search = expr::search_in(program))
    throw InputError(search->place(),
                     what +
                         " is to be proved, and a maximum or minimum over a box is an estimate "
                         "that a search found: state a bound of it as a datum instead");
  for (const expr::Input& input : program.inputs)
    if (design.estimates.contains(input.name))
      throw InputError(program.code[static_cast<std::size_t>(program.result)].place(),
                       what + " is to be proved, and '" + input.name +
                           "' rests on an estimate, a maximum or minimum over a box: state a bound "
                           "of it as a datum instead");
}

}  // namespace gainsmith::bind
