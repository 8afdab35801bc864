// Internal to io: values that the command line puts in the place of the problem's.
#pragma once

#include <vector>

#include "io/sources.h"
#include "model/problem.h"

namespace gainsmith::io {

/// Each setting is a datum, a parameter, a definition of `let` (of the problem, or of a method that
/// is in it), or `gain_bound` or `margin` of `synthesis`, with a value as a problem file spells
/// it; a text with ';' is a formula, which the file would have to quote. Notes them in the problem.
/// InputError for an unknown name, with the nearest one, for an element of a matrix ("A(1,2)"), for
/// a name that is set twice, and with the place in a value ("--set T2:1:3").
void set_values(const std::vector<model::Setting>& settings, Sources& sources,
                model::Problem& problem);

}  // namespace gainsmith::io
