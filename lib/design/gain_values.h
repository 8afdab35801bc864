// The gains of a point: formulas in its unknowns, such as L = inv(P)*Y, with their values.
#pragma once

#include "lmi/inequalities.h"
#include "model/gains.h"

namespace gainsmith::design {

/// The value of a gain's formula in 100 digits, rounded once: inverses in it amplify what double
/// would round in between. In double where 100 digits have no value of it.
numbers::Matrix gain_value(const expr::Program& formula, const numbers::Values& values);

/// Evaluates every gain of the method whose formula needs nothing but `values` and puts it into
/// `gains`: a matrix into `gains.gains`; a function of a scalar into `gains.gain_functions`, with
/// its coefficients when it is a polynomial, or into `gains.gains` when it is constant.
void add_gain_values(const lmi::Inequalities& inequalities, const numbers::Values& values,
                     model::Gains& gains);

/// The largest singular value of the gains whose formulas have values, in the measure of the
/// largest bound where the gains have bounds of their own; of functions of a variable at 65
/// equidistant points of each interval that a `forall` gives a variable of that name. Infinite when
/// one cannot be evaluated.
double largest_gain(const lmi::Inequalities& inequalities, const numbers::Values& values);

/// Evaluates what the method asks to be shown and what has a value, into `gains.report`. What
/// cannot be evaluated at these gains goes into `gains.not_computed`. Says which of all that is
/// there are estimates.
void add_report(const model::Instance& instance, model::Gains& gains);

}  // namespace gainsmith::design
