// project_polytope, project_ellipsoid and project_affine: x says the size of the others, so that a
// multiple of I may be given for P and Q, and 0 for x0 and b. project_convex: the set as a program
// of its own in x.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

/// argmin over z of (z - x)'P(z - x): polytopes {A z <= b}, affine sets {A z = b}, and ellipsoids
/// {(z - x0)'Q(z - x0) <= level}. x: n x 1, P and Q: n x n, A: m x n, b: m x 1.
Bound Binder::projection(const Expression& expression, const Node& node, const Function& function,
                         Op op) {
  const auto argument = [&](std::size_t i) -> const Node& { return *node.children[i]; };
  const auto shaped = [&](std::size_t i, Shape wanted) {
    return materialise(expression, argument(i), bind(expression, argument(i)), wanted);
  };
  const std::string name(function.name);
  const int x = sized(expression, argument(0), bind(expression, argument(0)));
  const Shape point = shape(x);
  if (point.cols != 1)
    fail(expression, argument(0),
         name + " needs a column x, not " + describe(expression, argument(0), {x}));
  const Shape square{point.rows, point.rows};
  std::vector<int> operands{x, shaped(1, square)};
  if (operation(op).rule == ShapeRule::nearest_to_form) {
    operands.push_back(shaped(2, point));
    operands.push_back(shaped(3, square));
    operands.push_back(shaped(4, {}));
    return {emit(expression, node, op, operands, point)};
  }
  const Bound bound = bind(expression, argument(2));
  const int A = bound.identity ? materialise(expression, argument(2), bound, square) : bound.at;
  if (shape(A).cols != point.rows)
    fail(expression, argument(2),
         name + " needs a matrix A with " + std::to_string(point.rows) +
             " columns, as many as x has rows, not " + describe(expression, argument(2), {A}));
  operands.push_back(A);
  operands.push_back(shaped(3, {shape(A).rows, 1}));
  return {emit(expression, node, op, operands, point)};
}

/// The same over {c(z) <= 0}, c a column of functions that the body computes.
Bound Binder::convex_projection(const Expression& expression, const Node& node) {
  const Node& metric = *node.children[1];
  const Node& functions = *node.children[2];
  const auto [value, variable, at] = varied(expression, node, 2, 0, false);
  const Shape point = shape(at);
  if (point.cols != 1)
    fail(expression, *node.children[0],
         node.text + " needs a column x, not " + describe(expression, *node.children[0], {at}));
  if (shape(value).cols != 1)
    fail(expression, functions,
         node.text + " needs a column c, an element for each function, not " +
             describe(expression, functions, {value}));
  const int P = materialise(expression, metric, bind(expression, metric), {point.rows, point.rows});
  const Body body = body_of(value, {{variable, "the variable"}}, 2);
  if (!body.call.empty())
    fail(expression, node,
         "'" + body.call + "' is a call of an unknown or a gain, onto which nothing is projected");
  std::vector<int> operands{at, P};
  operands.insert(operands.end(), body.outside.begin(), body.outside.end());
  auto program = std::make_shared<const Program>(body.assembly.extract(body.result));
  return {emit(expression, node, Op::project_convex, std::move(operands), point, {}, {},
               std::move(program))};
}

}  // namespace gainsmith::expr
