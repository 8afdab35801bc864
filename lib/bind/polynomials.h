// Unknowns that are polynomials in the elements of columns:
//   V: {shape: scalar, of: {x: 3}, degree: [2, 4]}
// Its coefficients are unknowns, V_2_0_0 that of x(1)^2, and V(x) is their sum times monomials.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// InputError for degrees that are no whole numbers in order, and for more than 5,000 terms.
/// V(x) = sum_a V_a x^a over all exponents a with least <= |a| <= degree. `like`: shape, degree and
/// place of each coefficient. V becomes a definition of the design.
void add_polynomial(Binding& binding, const model::UnknownDeclaration& unknown,
                    const model::Design::Unknown& like);

}  // namespace gainsmith::bind
