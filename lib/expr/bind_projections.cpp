// project_polytope, project_ellipsoid and project_affine: x says the size of the others, so that a
// multiple of I may stand for P and Q, and 0 for x0 and b.
#include "expr/binder.h"

namespace gainsmith::expr {

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

}  // namespace gainsmith::expr
