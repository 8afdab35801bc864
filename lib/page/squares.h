// Inequalities as sums of squares, in mathematics.
#pragma once

#include <string>

#include "model/gains.h"
#include "page/notation.h"

namespace gainsmith::page {

/// Of each inequality M >= 0 of a gain file "M = z'Qz + g_1 z_1'Q_1 z_1 + ... + h_1 t_1", with the
/// polynomials z and t and the matrices Q; nothing without any. Fractions are shown to six digits.
std::string squares(const model::Gains& gains, const Notation& notation);

/// The unknown functions with the values of their coefficients: "V(x) = 0.5 x_1^2 + ...".
std::string unknown_functions(const model::Gains& gains, const Notation& notation);

}  // namespace gainsmith::page
