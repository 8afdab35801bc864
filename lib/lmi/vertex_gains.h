// Unknown functions of tau with one matrix for each vertex of a box (linear-hybrid.md, section 4).
//
// The inequalities that use an unknown function Y(tau) are affine in scalar functions theta_k(tau)
// when Y is held fixed. The box of their ranges on [low, high] has vertices v_1 ... v_V, and its
// multilinear weights
//   alpha_i(tau) = prod_k (theta_k - low_k)/(high_k - low_k)    where v_i is at high_k,
//                         (high_k - theta_k)/(high_k - low_k)   where it is at low_k,
// are >= 0, sum to 1 and give theta(tau) = sum_i alpha_i(tau) v_i. With Y(tau) = sum_i alpha_i(tau)
// Y_i the inequality is
//   sum_ij alpha_i alpha_j M_ij > 0,    M_ij with Y = Y_i and theta = v_j,
// for which M_ii > 0 and M_ij + M_ji > 0, i < j, are enough. What is found is a sufficient
// condition that is weaker than that of constant gains on the same box, where Y_i = Y_1.
#pragma once

#include <vector>

#include "lmi/block.h"
#include "lmi/box.h"
#include "model/instance.h"

namespace gainsmith::lmi {

/// Whether the problem asks for these gains.
bool has_vertex_gains(const model::Instance& instance);

/// Whether a requirement uses an unknown function.
bool uses_functions(const model::Instance& instance, const model::Requirement& requirement);

/// The box of the functions of tau in all requirements that use an unknown function. InputError, at
/// the place of the requirement, when one has not exactly one variable over an interval, or another
/// interval than the first, calls a function with anything but its variable, or is not affine in
/// functions of tau; at that of the method's name when
/// there is no unknown function.
Box vertex_box(const model::Instance& instance);

/// The instance with one coefficient for each vertex of vertex_box in each unknown function, and
/// the weights in its text; the same instance when the problem does not ask for it.
model::Instance with_vertex_gains(model::Instance instance);

/// The blocks M_ii and (M_ij + M_ji)/2 of a requirement that uses unknown functions, for all
/// elements of its sets and vertices of its polytopes. `instance` comes from with_vertex_gains.
/// InputError for more than kMostVertices blocks and as for compile().
std::vector<Block> vertex_blocks(const model::Instance& instance,
                                 const model::Requirement& requirement, const Unknowns& unknowns,
                                 const Box& box);

}  // namespace gainsmith::lmi
