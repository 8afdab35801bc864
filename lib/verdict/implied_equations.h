// Unknowns whose equation those of others imply.
//
// Where sum over i of d_i B_ki = 0 exactly in all blocks, d_j != 0, r_j = sum_k <B_kj, Y_k> is 0
// with the other r_i: the test of a certificate (exactness.h), which wants independent B_i, leaves
// x_j out. Such d are found in double. They are shown by the text with the unknown matrices in the
// direction d: a sum that cancels before it meets a matrix that is only known in digits, as
// (Y*C + K*D)*expm(A*tau) does, has no element at all.
#pragma once

#include <vector>

#include "lmi/compile.h"
#include "lmi/formulation.h"
#include "verdict/exact.h"

namespace gainsmith::verdict {

/// Takes the terms of those unknowns from the blocks, which are those of `formulation`.
template <class S>
void drop_implied(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                  const lmi::Formulation& formulation, std::vector<ExactBlock<S>>& blocks);

}  // namespace gainsmith::verdict
