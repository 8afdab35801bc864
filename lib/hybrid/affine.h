// Which maps are affine in the state, found from the text of the program and not from samples of
// it.
#pragma once

#include <functional>
#include <string>

#include "expr/program/program.h"

namespace gainsmith::hybrid {

/// The first instruction whose value is not known to be affine in the inputs that move; nullptr
/// when the whole program is affine. The rules are in numbers/types/degree.h.
const expr::Instruction* first_not_affine(const expr::Program& program,
                                          const std::function<bool(const std::string&)>& moves);

}  // namespace gainsmith::hybrid
