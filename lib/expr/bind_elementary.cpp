// Elementary functions that are made of others: so they have error bounds and derivatives wherever
// those have. The formulas keep their digits near 0, near the ends of a domain and far out:
//
//   tan x    sin x / cos x, with a pole where cos x is nothing but rounding
//   asin x   atan2(x, sqrt((1 - x)(1 + x)))          acos x   atan2(sqrt((1 - x)(1 + x)), x)
//   atan x   atan2(x, 1)                             log10 x  log x / log 10
//   sinh x   tanh x cosh x                           cosh x   (e^x + e^-x)/2
//   ceil x   -floor(-x)                              round x  sign x (floor 2|x| - floor |x|)
#include "expr/emitter.h"

namespace gainsmith::expr {

namespace {

/// sqrt((1 - x)(1 + x)).
int other_leg(const Emitter& make, int x, const std::string& function) {
  const int one = make.filled(make.number("1"), make.shape(x));
  const int square = make(Op::elementwise_product, {make.subtract(one, x), make.add(one, x)});
  return make(Op::sqrt, {square}, {}, function + " of a number outside of [-1, 1]");
}

int cosh_of(const Emitter& make, int x) {
  const int both = make.add(make(Op::exp, {x}), make(Op::exp, {make.negate(x)}));
  return make(Op::divide, {both, make.number("2")});
}

int round_of(const Emitter& make, int x) {
  const int size = make(Op::abs, {x});
  const int twice = make.scale(make.number("2"), size);
  const int whole = make.subtract(make(Op::floor, {twice}), make(Op::floor, {size}));
  return make(Op::elementwise_product, {make(Op::sign, {x}), whole});
}

}  // namespace

Bound Binder::elementary(const Expression& expression, const Node& node, Composed function) {
  const Emitter make(*this, expression, node);
  const int x = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  switch (function) {
    case Composed::tan:
      return {make(Op::elementwise_quotient, {make(Op::sin, {x}), make(Op::cos, {x})},
                   {kPoleWithinRounding}, "tan has a pole here, where cos is 0 to rounding")};
    case Composed::asin:
      return {make(Op::atan2, {x, other_leg(make, x, "asin")})};
    case Composed::acos:
      return {make(Op::atan2, {other_leg(make, x, "acos"), x})};
    case Composed::atan:
      return {make(Op::atan2, {x, make.filled(make.number("1"), make.shape(x))})};
    case Composed::sinh:
      return {make(Op::elementwise_product, {make(Op::tanh, {x}), cosh_of(make, x)})};
    case Composed::cosh:
      return {cosh_of(make, x)};
    case Composed::log10: {
      const int log = make(Op::log, {x}, {}, "log10 of a number that is not positive");
      return {make(Op::divide, {log, make(Op::log, {make.number("10")})})};
    }
    case Composed::ceil:
      return {make.negate(make(Op::floor, {make.negate(x)}))};
    case Composed::round:
      return {round_of(make, x)};
    default:
      fail(expression, node, "unknown function");
  }
}

}  // namespace gainsmith::expr
