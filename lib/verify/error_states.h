// The same runs with errors of observers as states.
//
//   d = a - b in place of b,   d' = f_a - f_b,   d+ = a+ - b+,   b = a - d elsewhere
//
// for states a, b whose difference occurs in a claim. It is done where d moves by itself: where a
// drops out of d' and of all d+ (linear/differences.h). Then rounding of a, which may grow, is no
// error of d.
//
// Differences that do not move by themselves are dropped one by one, and the rest is tried again.
// No differences are made of modes, symmetric states, frozen components, loops or several maps at
// one event, nor of an a whose jumps may be lost.
#pragma once

#include <optional>
#include <vector>

#include "model/run_texts.h"

namespace gainsmith::verify {

/// None without such a difference in `functions`, those of the claims. b keeps its place; its name
/// is that of the difference. Starts are drawn as they were; then d is a - b. Signals are left out.
std::optional<model::RunTexts> with_error_states(const model::RunTexts& texts,
                                                 const std::vector<expr::Program>& functions);

}  // namespace gainsmith::verify
