// From texts to a design.
//
// A method states unknowns, matrix inequalities, gains, dynamics and claims as texts; a problem
// gives it data. Binding resolves all names, finds all dimensions from the data, and compiles every
// text to a program (expr/program/program.h). The result is a model::Design: an optimisation
// problem in unknown matrices, formulas of gains, and a hybrid system to simulate.
//
//   data.h, function_data.h, polynomials.h   dimensions, data, parameters, unknowns
//   families.h, observer_families.h          what is stated once for all members of a family
//   inequalities.h, convex.h                 inequalities, objective, convex functions of unknowns
//   gains.h, stated.h, exact_values.h        gains, gain files, values in 100 digits
//   dynamics_binding.h, simulation.h         plant, observers, events, signals
//   claims.h, campaign.h, search.h           what runs are asked, how they are made, searches
//   instance.h                               the same design with other values
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
/// `overrides`: scalars by name, in place of what the problem gives. The instance shares the
/// problem.
model::Instance bind(std::shared_ptr<const model::Problem> problem,
                     const model::Overrides& overrides = {});
model::Instance bind(const model::Problem& problem, const model::Overrides& overrides = {});

/// InputError, with its place, for an unknown that no inequality reads: any value would do. Binding
/// itself takes it, so that designs may be changed.
void refuse_free_unknowns(const model::Design& design);

}  // namespace gainsmith::bind
