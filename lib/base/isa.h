// What this machine can run.
#pragma once

#include <cmath>
#include <string>

namespace gainsmith {

/// Does this machine have the instructions of "v2", "v3" or "v4" (x86-64-v2, ...)? v2 is taken for
/// granted.
bool has_isa(const std::string& name);

/// The best that this machine has, or that GAINSMITH_ISA names. InputError for another name, and
/// for one that the machine has not.
const std::string& isa();

/// a b + c, rounded once. std::fma is a call where not every machine has the instruction.
extern const bool has_fused_multiply_add;
inline double fused_multiply_add(double a, double b, double c) {
#if defined(__x86_64__) && !defined(__FMA__)
  if (has_fused_multiply_add) {
    asm("vfmadd231sd %2, %1, %0" : "+x"(c) : "x"(a), "x"(b));
    return c;
  }
#endif
  return std::fma(a, b, c);
}

}  // namespace gainsmith
