// Internal to io: scalars of a problem that its other data use.
#pragma once

#include "model/problem.h"

namespace gainsmith::io {

/// Declares the scalars under `data` that the method does not have, and that other data or
/// definitions of the problem read: "A: [[0, a], [1, 0]]" with "a: 2". They come before the data of
/// the method. InputError where the method has another meaning for such a name.
void declare_scalars(model::Problem& problem);

}  // namespace gainsmith::io
