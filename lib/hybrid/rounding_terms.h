// The sizes of the terms that texts are sums of: what their evaluation may round.
#pragma once

#include <optional>

#include "expr/program/program.h"

namespace gainsmith::hybrid {

/// The sizes of the terms that a text is the sum of, element by element: sums, products and
/// matrices of the absolute values of their parts. 0 where nothing is computed, since a value is
/// chosen or arranged; none where that is so of all.
std::optional<expr::Program> rounding_terms(const expr::Program& program);

/// The sum of the absolute values of the terms of a program, those of products with sums multiplied
/// out: its rounding is that of its terms. A form of a sum, (x - z)'*P*(x - z), is a term: its
/// rounding is small where it is.
expr::Program absolute_terms(expr::Program program);

/// The same of a text whose sign matters: those of abs(u), sin(u), tanh(u) and, but for a factor,
/// atan2(u, v) are those of their arguments.
expr::Program terms_of_sign(expr::Program program);

}  // namespace gainsmith::hybrid
