// interp1(x, y, q): linear interpolation over a table, constant outside of it.
//
//   y_1 + sum_k (y_{k+1} - y_k) min(max((q - x_k)/(x_{k+1} - x_k), 0), 1)
//
// min and max make the points of the table kinks that a simulation knows of.
#include <string>

#include "expr/emitter.h"

namespace gainsmith::expr {

namespace {

bool is_vector(Shape shape) { return shape.rows == 1 || shape.cols == 1; }

int as_column(const Emitter& make, int v) {
  return make.shape(v).cols == 1 ? v : make.transpose(v);
}

}  // namespace

/// The points x must rise, which is checked beforehand.
void Binder::require_rising(const Expression& expression, const Node& node, int steps) {
  const Emitter make(*this, expression, node);
  int least = make.element(steps, 0);
  for (int k = 1; k < shape(steps).rows; ++k)
    least = make(Op::minimum, {least, make.element(steps, k)});
  const Node& points = *node.children[0];
  if (!(scope_.known->number(known_program(expression, points, least, "the points x of interp1")) >
        0))
    fail(expression, points, "interp1: the points x must rise from each to the next");
}

Bound Binder::interpolated(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  std::vector<int> arguments;
  for (const NodePtr& child : node.children) {
    arguments.push_back(sized(expression, *child, bind(expression, *child)));
    if (!is_vector(shape(arguments.back())))
      fail(
          expression, *child,
          "interp1 takes columns or rows, not " + describe(expression, *child, {arguments.back()}));
  }
  const int x = as_column(make, arguments[0]);
  const int y = as_column(make, arguments[1]);
  const int q = arguments[2];
  const int count = shape(x).rows;
  if (count < 2 || shape(y).rows != count)
    fail(expression, node,
         "interp1 needs two points or more and as many values, not " + std::to_string(count) +
             " points and " + std::to_string(shape(y).rows) + " values");
  const int queries = shape(q).size();
  if (queries == 0) return {q};

  const int last = count - 1;
  const int steps = make.subtract(make.part(x, 1, count, 0, 1), make.part(x, 0, last, 0, 1));
  require_rising(expression, node, steps);
  const int rises = make.subtract(make.part(y, 1, count, 0, 1), make.part(y, 0, last, 0, 1));
  const Shape each{last, queries};
  const int one = make.number("1");
  // A column for each query.
  const auto spread = [&](int column) {
    return queries == 1 ? column : make.multiply(column, make.filled(one, {1, queries}));
  };
  const int row = shape(q).rows == 1 ? q : make.transpose(q);
  const int reached = make.subtract(make.multiply(make.filled(one, {last, 1}), row),
                                    spread(make.part(x, 0, last, 0, 1)));
  const int parts = make(Op::elementwise_quotient, {reached, spread(steps)});
  const int raised = make(Op::maximum, {parts, make.zeros(each)});
  const int weights = make(Op::minimum, {raised, make.filled(one, each)});
  const int values = make.add(make.filled(make.element(y, 0), {1, queries}),
                              make.multiply(make.transpose(rises), weights));
  return {shape(q).rows == 1 ? values : make.transpose(values)};
}

}  // namespace gainsmith::expr
