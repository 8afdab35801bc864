// Values that rest on a search over a box, maximum(f, x in [a, b]): they are labelled where they
// are shown, and nothing that is proved may read them.
#include <string>

#include "bind/binding.h"

namespace gainsmith::bind {

expr::Estimate Binding::estimate(const expr::Program& program) const {
  return expr::estimate_of(program, [&](const std::string& input) {
    const auto found = design_->estimates.find(input);
    return found == design_->estimates.end() ? expr::Estimate::none : found->second;
  });
}

void Binding::note_estimate(const std::string& name, const expr::Program& program) {
  const expr::Estimate found = estimate(program);
  if (found == expr::Estimate::none) return;
  design_->estimates[name] = found;
}

void Binding::refuse_estimate(const expr::Program& program, const std::string& what) const {
  if (const expr::Instruction* search = expr::search_in(program))
    throw InputError(search->place(),
                     what +
                         " is to be proved, and a maximum or minimum over a box is an estimate "
                         "that a search found: state a bound of it as a datum instead");
  for (const expr::Input& input : program.inputs)
    if (design_->estimates.contains(input.name))
      throw InputError(program.code[static_cast<std::size_t>(program.result)].place(),
                       what + " is to be proved, and '" + input.name +
                           "' rests on an estimate, a maximum or minimum over a box: state a bound "
                           "of it as a datum instead");
}

}  // namespace gainsmith::bind
