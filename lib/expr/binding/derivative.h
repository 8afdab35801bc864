// Derivatives as programs.
#pragma once

#include "expr/program/program.h"

namespace gainsmith::expr {

/// The program with each jacobian replaced by the formulas of its columns, by the rules of calculus
/// for matrices: (A B)' = A' B + A B', inv(A)' = -inv(A) A' inv(A), sin(x)' = cos(x) x'. A number
/// type with bounds then detects what a column does not depend on, and may differentiate it again.
/// A jacobian stays where its body moves through an operation without such a rule: jumps, kinks
/// but those of |x|, min and max, decompositions, expm.
Program with_derivatives(const Program& program);

}  // namespace gainsmith::expr
