// From texts to a design.
#pragma once

#include <memory>

#include "model/instance.h"
#include "model/problem.h"

namespace gainsmith::bind {

/// Binds everything that the problem and its method say, once, and gives the data their values.
/// InputError, with the place, for the first that does not fit: a datum that is missing, has the
/// wrong shape or is not symmetric where it must be, an assumption that fails, unknown names,
/// shapes that do not fit, values of the campaign outside of their ranges. A scalar that is
/// searched and has neither value nor default is set to the end of its range from which the search
/// goes: the high one of `smallest`, otherwise the low one.
model::Instance bind(std::shared_ptr<const model::Problem> problem,
                     const model::Overrides& overrides = {});
model::Instance bind(const model::Problem& problem, const model::Overrides& overrides = {});

/// InputError, with its place, for an unknown that no inequality reads: any value would do. Binding
/// itself takes it, so that designs may be changed.
void refuse_free_unknowns(const model::Design& design);

}  // namespace gainsmith::bind
