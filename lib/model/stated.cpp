#include "model/stated.h"

#include <algorithm>

namespace gainsmith::model {

std::optional<numbers::Matrix> Stated::value(const expr::Program& program) const {
  // Without a design there are no gains to call.
  const bool known = std::all_of(
      program.functions.begin(), program.functions.end(), [&](const expr::Input& called) {
        return bodies.contains(called.name) || expr::is_derivative(called.name);
      });
  if (!known) return std::nullopt;
  const expr::Program linked = bodies.link(program);
  if (!has_values(linked, values)) return std::nullopt;
  return numbers::evaluate(linked, values);
}

}  // namespace gainsmith::model
