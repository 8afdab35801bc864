// Loops over a few rows, unrolled: with_size(n, f) calls f with n as a constant when it is at most
// 8, and with 0 otherwise. `const Index rows = N > 0 ? N : n` is then known to the compiler.
#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace gainsmith::bounded {

template <class F>
inline void with_size(Eigen::Index n, F f) {
  switch (n) {
    case 1:
      return f(std::integral_constant<int, 1>{});
    case 2:
      return f(std::integral_constant<int, 2>{});
    case 3:
      return f(std::integral_constant<int, 3>{});
    case 4:
      return f(std::integral_constant<int, 4>{});
    case 5:
      return f(std::integral_constant<int, 5>{});
    case 6:
      return f(std::integral_constant<int, 6>{});
    case 7:
      return f(std::integral_constant<int, 7>{});
    case 8:
      return f(std::integral_constant<int, 8>{});
    default:
      return f(std::integral_constant<int, 0>{});
  }
}

}  // namespace gainsmith::bounded
