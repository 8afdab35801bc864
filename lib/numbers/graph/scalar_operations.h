// Internal to numbers: the operations of scalar_ops.def over one number of any kind.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>

#include "numbers/graph/scalar_graph.h"
#include "numbers/types/scalar_functions.h"

namespace gainsmith::numbers {

template <class S>
class ScalarOperations {
 public:
  /// std::logic_error for input, constant, element and block.
  static S apply(ScalarOp op, const S& a, const S& b, const S& c) {
    switch (op) {
#define SCALAR_OP(op, operands, ...) \
  case ScalarOp::op:                 \
    return S(__VA_ARGS__);
#include "numbers/graph/scalar_ops.def"
      default:
        break;
    }
    throw std::logic_error("no operation on numbers");
  }

 private:
  // What the rows call by name.
  static S all(double x) { return S(x); }
#define GAINSMITH_FROM_CMATH(name, function) \
  static S name(const S& x) {                \
    using std::function;                     \
    return S(function(x));                   \
  }
  GAINSMITH_FROM_CMATH(abs_of, abs)
  GAINSMITH_FROM_CMATH(floor_of, floor)
  GAINSMITH_FROM_CMATH(exp_of, exp)
  GAINSMITH_FROM_CMATH(log_of, log)
  GAINSMITH_FROM_CMATH(sqrt_of, sqrt)
  GAINSMITH_FROM_CMATH(sine_of, sin)
  GAINSMITH_FROM_CMATH(cosine_of, cos)
  GAINSMITH_FROM_CMATH(tanh_of, tanh)
#undef GAINSMITH_FROM_CMATH
  static S power_of(const S& a, const S& b) {
    using std::pow;
    return S(pow(a, b));
  }
  static S rest_of(const S& a, const S& b) {
    return b == S(0) ? S(std::numeric_limits<S>::quiet_NaN()) : mod(a, b);
  }
  static S multiply_add(const S& a, const S& b, const S& c) { return S(S(a * b) + c); }
};

}  // namespace gainsmith::numbers
