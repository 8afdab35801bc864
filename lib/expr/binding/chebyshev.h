// Internal to expr and model: Chebyshev polynomials on an interval, as instructions.
//
//   T_k(x),  x = (2 s - low - high) / (high - low),   |T_k| <= 1 for s in [low, high]
//
//   T_0 = 1, T_1 = x, T_{k+1} = 2 x T_k - T_{k-1}
//   dT_k/ds = 2 k / (high - low) U_{k-1}(x),   U_0 = 1, U_1 = 2 x, U_{k+1} = 2 x U_k - U_{k-1}
//
// Recurrences keep their digits there: the error of T_k is some k^2 roundings.
#pragma once

#include <string>
#include <utility>

#include "expr/program/operations.h"

namespace gainsmith::expr {

/// `number(decimal)` and `apply(op, operands)` give the index of a 1 x 1 instruction.
template <class Number, class Apply>
class Chebyshev {
 public:
  Chebyshev(Number number, Apply apply, int s, int low, int high)
      : number_(std::move(number)),
        apply_(std::move(apply)),
        width_(apply_(Op::subtract, {high, low})) {
    const int twice = apply_(Op::multiply, {number_("2"), s});
    x_ = apply_(Op::divide, {apply_(Op::subtract, {twice, apply_(Op::add, {low, high})}), width_});
    twice_x_ = apply_(Op::multiply, {number_("2"), x_});
  }

  /// T_k, k >= 0.
  int value(int k) { return recurrence(k, x_); }

  /// dT_k/ds, k >= 1.
  int derivative(int k) {
    const int factor = apply_(Op::divide, {number_(std::to_string(2 * k)), width_});
    return apply_(Op::multiply, {factor, recurrence(k - 1, twice_x_)});
  }

 private:
  /// a_0 = 1, a_1 = first, a_{i+1} = 2 x a_i - a_{i-1}; a_k.
  int recurrence(int k, int first) {
    int before = number_("1");
    if (k == 0) return before;
    int last = first;
    for (int i = 1; i < k; ++i) {
      const int next = apply_(Op::subtract, {apply_(Op::multiply, {twice_x_, last}), before});
      before = last;
      last = next;
    }
    return last;
  }

  Number number_;
  Apply apply_;
  int width_;
  int x_ = -1;
  int twice_x_ = -1;
};

}  // namespace gainsmith::expr
