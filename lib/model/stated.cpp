#include "model/stated.h"

namespace gainsmith::model {

std::optional<numbers::Matrix> Stated::value(const expr::Program& program) const {
  const expr::Program linked = bodies.link(program);
  if (!has_values(linked, values)) return std::nullopt;
  return numbers::evaluate(linked, values);
}

}  // namespace gainsmith::model
