// Operators and functions that work on the elements of matrices.
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/emitter.h"

namespace gainsmith::expr {

namespace {

std::string elementwise_name(NodeKind kind) {
  if (kind == NodeKind::elementwise_multiply) return "product";
  return kind == NodeKind::elementwise_divide ? "quotient" : "power";
}

}  // namespace

/// A number counts for each element of the other side.
std::pair<int, int> Binder::fitted(const Expression& expression, const Node& node, Bound a,
                                   Bound b) {
  const Node& left = *node.children[0];
  const Node& right = *node.children[1];
  const auto is_number = [&](Bound value) { return shape(value.at).is_scalar(); };
  const Shape common = shape(is_number(a) ? b.at : a.at);
  const auto fits = [&](Bound value) {
    return value.identity ? common.is_square() : is_number(value) || shape(value.at) == common;
  };
  if (!fits(a) || !fits(b))
    fail(expression, node,
         "the elementwise " + elementwise_name(node.kind) + " of " + describe(expression, left, a) +
             " and " + describe(expression, right, b) +
             ": the shapes must be equal, or one side a number");
  return {same_shape(expression, left, a, common), same_shape(expression, right, b, common)};
}

Bound Binder::elementwise(const Expression& expression, const Node& node) {
  const Bound a = bind(expression, *node.children[0]);
  const Bound b = bind(expression, *node.children[1]);
  const bool product = node.kind == NodeKind::elementwise_multiply;
  const auto is_number = [&](Bound value) {
    return !value.identity && shape(value.at).is_scalar();
  };
  // What a number does to all elements alike, it does to the matrix.
  if (product && (is_number(a) || is_number(b))) return multiply(expression, node, a, b);
  if (!product && is_number(b)) return divide(expression, node, a, b);
  if (a.identity && b.identity) sized(expression, *node.children[0], a);
  const auto [left, right] = fitted(expression, node, a, b);
  return {emit(expression, node, product ? Op::elementwise_product : Op::elementwise_quotient,
               {left, right}, shape(left))};
}

/// A whole exponent is a power by products; a negative one is 1 over it. Other exponents are real
/// powers.
Bound Binder::elementwise_power(const Expression& expression, const Node& node) {
  const Node& exponent_node = *node.children[1];
  const int base = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  const Shape from = shape(base);
  const auto whole = whole_number(expression, exponent_node);
  if (whole && from.is_scalar()) return power(expression, node);
  if (whole == 1) return {base};
  if (whole) {
    const int at = emit(expression, node, Op::elementwise_power, {base}, from, {std::abs(*whole)});
    if (*whole >= 0) return {at};
    const int ones = emit(expression, node, Op::fill, {number(expression, node, "1")}, from);
    return {emit(expression, node, Op::elementwise_quotient, {ones, at}, from)};
  }
  const int exponent = sized(expression, exponent_node, bind(expression, exponent_node));
  const auto [left, right] = fitted(expression, node, {base}, {exponent});
  return {emit(expression, node, Op::real_power, {left, right}, shape(left))};
}

/// Halves that overlap are compared until one element is left.
Bound Binder::extreme_element(const Expression& expression, const Node& node, Op op) {
  const Node& argument = *node.children[0];
  int at = sized(expression, argument, bind(expression, argument));
  const bool row = shape(at).rows == 1;
  if (!row && shape(at).cols != 1)
    fail(expression, argument,
         node.text + " of one argument is the " + (op == Op::maximum ? "largest" : "smallest") +
             " element of a vector, not of " + describe(expression, argument, {at}) + "; with " +
             node.text + "(A, B) it is taken element by element");
  if (shape(at).size() == 0) fail(expression, argument, node.text + " of an empty vector");
  while (shape(at).size() > 1) {
    const int size = shape(at).size();
    const int half = (size + 1) / 2;
    const auto part = [&](int first) {
      const Shape shape = row ? Shape{1, half} : Shape{half, 1};
      return emit(
          expression, node, Op::index, {at}, shape,
          row ? Attributes{0, 1, first, first + half} : Attributes{first, first + half, 0, 1});
    };
    const int low = part(0);
    at = emit(expression, node, op, {low, part(size - half)}, shape(low));
  }
  return {at};
}

/// [0, -v3, v2; v3, 0, -v1; -v2, v1, 0]
Bound Binder::skew(const Expression& expression, const Node& node) {
  const Node& argument = *node.children[0];
  const int v = sized(expression, argument, bind(expression, argument));
  const Shape from = shape(v);
  if (from.size() != 3 || (from.rows != 1 && from.cols != 1))
    fail(expression, argument,
         "skew needs a vector of 3 elements, not " + describe(expression, argument, {v}));
  const auto element = [&](int i) {
    return emit(expression, node, Op::index, {v}, {},
                from.cols == 1 ? Attributes{i, i + 1, 0, 1} : Attributes{0, 1, i, i + 1});
  };
  const auto negative = [&](int i) { return emit(expression, node, Op::negate, {element(i)}, {}); };
  const int zero = emit(expression, node, Op::zeros, {}, {});
  std::vector<int> entries = {zero,        negative(2), element(1), element(2), zero,
                              negative(0), negative(1), element(0), zero};
  return {assemble(expression, node, std::move(entries), 3, {1, 1, 1}, {1, 1, 1})};
}

/// sin x / cos x, with a pole where cos x is nothing but rounding.
Bound Binder::tangent(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const int x = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  return {make(Op::elementwise_quotient, {make(Op::sin, {x}), make(Op::cos, {x})},
               {kPoleWithinRounding}, "tan has a pole here, where cos is 0 to rounding")};
}

}  // namespace gainsmith::expr
