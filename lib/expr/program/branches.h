// What a program branches on. Where none of these differences comes to 0 it is smooth.
//
//   where(D, A, B), sign(D)          D                           a jump
//   floor(A), mod(A, B)              sin(pi A), sin(pi A/B)      a jump
//   atan2(y, x)                      y                           a jump
//   abs(D), norm(D) of a number      D                           a kink
//   max(A, B), min(A, B)             A - B                       a kink
//
// In the body of a jacobian a kink is a jump.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "expr/program/program.h"

namespace gainsmith::expr {

/// A difference, of any shape, each of whose elements marks a branch where it is 0.
struct Branch {
  Program difference;
  bool jumps = false;  ///< otherwise a kink
  bool waves = false;  ///< a sine
};

/// Of a program without calls and the bodies in it, what depends on inputs that move: each
/// difference once, after those that it is made of.
std::vector<Branch> branches_of(const Program& program,
                                const std::function<bool(const std::string&)>& moves);

}  // namespace gainsmith::expr
