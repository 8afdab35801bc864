// Internal to bind: values that rest on a search over a box, maximum(f, x in [a, b]). They are
// labelled where they are shown, and nothing that is proved may read them: a value at one point
// bounds a maximum from below only.
#pragma once

#include <string>

#include "model/design.h"

namespace gainsmith::bind {

/// What a program's value is, with the estimates that names of the design have.
expr::Estimate estimate(const model::Design& design, const expr::Program& program);

/// The name has the value of the program from now on.
void note_estimate(model::Design& design, const std::string& name, const expr::Program& program);

/// InputError when the program rests on one; `what` is to be proved.
void refuse_estimate(const model::Design& design, const expr::Program& program,
                     const std::string& what);

}  // namespace gainsmith::bind
