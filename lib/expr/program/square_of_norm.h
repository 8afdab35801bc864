// Norms by their squares, which are smooth where the norm is 0.
#pragma once

#include <optional>

#include "expr/program/program.h"

namespace gainsmith::expr {

/// v'v of a program norm(v), v a column or a row; none for any other.
std::optional<Program> square_of_norm(const Program& program);

}  // namespace gainsmith::expr
