// interp1(x, y, q): linear interpolation over a table, constant outside of it.
//
//   y_1 + s_1 (p - x_1) + sum_k (s_k - s_{k-1}) max(p - x_k, 0),   p = min(max(q, x_1), x_n),
//   s_k = (y_{k+1} - y_k)/(x_{k+1} - x_k),   k from 2 to n - 1
//
// min and max make the points of the table kinks that a simulation knows of. There is one for each
// point, so that beside a point a proof sees the slopes of its two pieces and no others.
#include <string>

#include "expr/binding/emitter.h"

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

/// x and y: n points, n >= 2; q: m queries, a row or a column, whose shape the result has.
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
  const int slopes = make(Op::elementwise_quotient, {rises, steps});
  const int one = make.number("1");
  const int row = shape(q).rows == 1 ? q : make.transpose(q);
  const auto everywhere = [&](int number) { return make.filled(number, {1, queries}); };
  const int lowest = everywhere(make.element(x, 0));
  const int inside =
      make(Op::minimum, {make(Op::maximum, {row, lowest}), everywhere(make.element(x, last))});
  int values = make.add(everywhere(make.element(y, 0)),
                        make(Op::scale, {make.element(slopes, 0), make.subtract(inside, lowest)}));
  if (last > 1) {
    const int bends =
        make.subtract(make.part(slopes, 1, last, 0, 1), make.part(slopes, 0, last - 1, 0, 1));
    // A column for each query.
    const int points = make.part(x, 1, last, 0, 1);
    const int beyond =
        make.subtract(make.multiply(make.filled(one, {last - 1, 1}), inside),
                      queries == 1 ? points : make.multiply(points, everywhere(one)));
    const int reached = make(Op::maximum, {beyond, make.zeros({last - 1, queries})});
    values = make.add(values, make.multiply(make.transpose(bends), reached));
  }
  return {shape(q).rows == 1 ? values : make.transpose(values)};
}

}  // namespace gainsmith::expr
