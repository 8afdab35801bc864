// Texts that may be all but constant and then rise and fall within little time, as exp(-((t - 5)/w)^2)
// does: a step of an integration may pass over what they do.
#pragma once

#include <functional>
#include <string>

#include "expr/program/program.h"

namespace gainsmith::hybrid {

/// Whether a text has such a part, as a function of clocks: an exponential, a hyperbolic tangent or a
/// quotient whose argument or denominator is not affine in them, or two hyperbolic tangents, whose
/// difference is a pulse. Waves of one frequency are none.
bool has_pulses(const expr::Program& program,
                const std::function<bool(const std::string&)>& is_clock);

}  // namespace gainsmith::hybrid
