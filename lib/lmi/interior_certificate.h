// The certificate that is deepest inside of the cone. The multipliers of the largest margin
// (formulation.h) may be nearly singular where others are not: those of a bounded real lemma have
// the singular values of a Gramian. Those of
//   maximise t,   Y_k >= t I,   sum_k tr Y_k = 1,   sum_k <B_ki, Y_k> = 0,   i = 1..m
// are as far from that as any. As a program in x it is
//   minimise s,   B_k(x) + s I >= 0,   sum_k tr B_k(x) + N s >= 1
// whose multipliers are Y_k - t I and t. With t > 0 there is an exact certificate.
#pragma once

#include "lmi/formulation.h"

namespace gainsmith::lmi {

/// Of an interior formulation of the first round.
sdp::Problem interior_certificate_program(const Formulation& interior);

/// The Y_k of its solution in place of Y_k - t I.
void add_depth(sdp::Solution& solution);

}  // namespace gainsmith::lmi
