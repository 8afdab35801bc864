// Unknown functions of tau with one matrix for each vertex of a box (Tran, Bernard and Sanfelice).
//
// The inequalities that use an unknown function Y(tau) are affine in scalar functions theta_k(tau)
// when Y is held fixed. The box of their ranges on [low, high] has vertices v_1 ... v_V, and with
// its weights alpha_i(tau) (forall/box.h) and Y(tau) = sum_i alpha_i(tau) Y_i the inequality is
//   sum_ij alpha_i alpha_j M_ij > 0,    M_ij with Y = Y_i and theta = v_j,
// for which M_ii > 0 and M_ij + M_ji > 0, i < j, are enough. What is found is a sufficient
// condition that is weaker than that of constant gains on the same box, where Y_i = Y_1.
#pragma once

#include <vector>

#include "forall/box.h"
#include "lmi/block.h"
#include "lmi/inequalities.h"

namespace gainsmith::lmi {

/// The box of the functions of tau in all inequalities over an interval that call an unknown
/// function; those over sets alone take its values. InputError, at the place of the inequality,
/// when one has several variables over intervals, or none has one, or it is another than the first,
/// calls a function with anything but its variable, or is not affine in functions of tau; at that
/// of the method's name when there is no unknown function.
forall::Box vertex_box(const model::Instance& instance);

/// The blocks M_ii and (M_ij + M_ji)/2 of an inequality that calls unknown functions, for all
/// elements of its sets and vertices of its polytopes. InputError for more than kMostVertices
/// blocks and as for compile().
std::vector<Block> vertex_blocks(const Inequalities& inequalities, const Statement& statement);

}  // namespace gainsmith::lmi
