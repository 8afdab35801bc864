// What the solver is about to take of memory, from sizes alone.
#pragma once

#include "sdp/core/data.h"

namespace gainsmith::sdp {

/// Bytes of the matrices of one run in T beside the Newton system: the point, the best one,
/// directions, factors.
template <typename T>
double bytes_of_iterates(const Data& data) {
  constexpr double kMatrices = 20;  // Ipm, Newton
  return kMatrices * static_cast<double>(data.layout.total) * sizeof(T);
}

/// Bytes of a dense Schur complement of m unknowns and of its factor.
template <typename T>
double bytes_of_dense_schur(int m) {
  return 2.0 * m * m * sizeof(T);
}

/// InputError when a method that takes `bytes` for m unknowns does not fit into the memory that
/// there is. Each method asks before it takes them.
void require_memory(int m, double bytes);

}  // namespace gainsmith::sdp
