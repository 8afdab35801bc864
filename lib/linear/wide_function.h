// Functions of the coordinates in 100 digits, and the affine maps that they are.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "hybrid/state_layout.h"
#include "numbers/types/real.h"

namespace gainsmith::linear {

/// A program of constants, coordinates and the timer in 100 digits.
class WideFunction {
 public:
  WideFunction(const expr::Program& program, const hybrid::StateLayout& layout,
               const numbers::ValuesOf<Decimal100>& constants);
  WideFunction(WideFunction&&) = default;
  WideFunction& operator=(WideFunction&&) = default;
  /// The value at x, layout.size x 1, and tau; valid until the next call.
  const numbers::MatrixOf<Decimal100>& operator()(const numbers::MatrixOf<Decimal100>& x,
                                                  const Decimal100& tau = Decimal100(0));

 private:
  std::vector<hybrid::Slot> slots_;
  std::vector<numbers::MatrixOf<Decimal100>> moving_;
  expr::Evaluator<numbers::Real<Decimal100>> evaluator_;
};

/// max |a_ij|; 0 of an empty matrix.
Decimal100 largest_of(const numbers::MatrixOf<Decimal100>& matrix);
/// Sets what is below 1e-80 of `largest` to 0.
void remove_noise(numbers::MatrixOf<Decimal100>& matrix, const Decimal100& largest);

/// x -> linear x + constant, n x n and n x 1.
struct WideMap {
  numbers::MatrixOf<Decimal100> linear;
  numbers::MatrixOf<Decimal100> constant;

  /// The rows of a slot from its entry, which is affine in the coordinates:
  /// constant = f(0), column j of linear = f(e_j) - f(0).
  void set_rows(const hybrid::Slot& slot, WideFunction& entry);
  /// Sets what is below 1e-80 of the largest coefficient to 0.
  void remove_noise();
};

}  // namespace gainsmith::linear
