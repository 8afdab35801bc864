#include "expr/program/operations.h"

#include <algorithm>

namespace gainsmith::expr {

namespace {

#define RESOLVED(op, operands, rule, name) \
  Operation{Op::op, #op, operands, ShapeRule::rule, name, "", ""},
#define OPERATION(op, operands, rule, name, example, value) \
  Operation{Op::op, #op, operands, ShapeRule::rule, name, example, value},
#define FUNCTION(op, operands, rule, name, usage, meaning, example, value) \
  Operation{Op::op, #op, operands, ShapeRule::rule, name, example, value},
constexpr std::array kOperations = {
#include "expr/operations.def"
};

/// The shape, or none where the operands do not fit.
std::optional<Shape> when(bool holds, Shape shape) {
  return holds ? std::optional(shape) : std::nullopt;
}

/// Blocks in rows of `columns`: those of a row are equally high, those of a column equally wide.
std::optional<Shape> layout_shape(std::span<const Shape> blocks, int columns) {
  const auto count = static_cast<std::size_t>(std::max(columns, 0));
  if (count == 0 || blocks.empty() || blocks.size() % count != 0) return std::nullopt;
  Shape total{0, 0};
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Shape first_of_row = blocks[k - k % count];
    const Shape first_of_column = blocks[k % count];
    if (blocks[k].rows != first_of_row.rows || blocks[k].cols != first_of_column.cols)
      return std::nullopt;
    if (k % count == 0) total.rows += blocks[k].rows;
    if (k < count) total.cols += blocks[k].cols;
  }
  return total;
}

/// Rows at[0] ... at[1] - 1 and columns at[2] ... at[3] - 1 of a matrix; they may be empty.
std::optional<Shape> part_shape(Shape from, const Attributes& at) {
  const bool inside = 0 <= at[0] && at[0] <= at[1] && at[1] <= from.rows && 0 <= at[2] &&
                      at[2] <= at[3] && at[3] <= from.cols;
  return when(inside, {at[1] - at[0], at[3] - at[2]});
}

/// Of projections: x, the metric, and the rows A, b of a polytope, or the center, matrix and level
/// of a quadratic form.
std::optional<Shape> nearest_shape(ShapeRule rule, std::span<const Shape> operands) {
  const Shape point{operands[0].rows, 1}, square{point.rows, point.rows};
  const Shape rows{operands[2].rows, point.rows}, right{rows.rows, 1};
  const std::array<Shape, 4> of_rows{point, square, rows, right};
  const std::array<Shape, 5> of_form{point, square, point, square, Shape{}};
  return when(rule == ShapeRule::nearest_to_rows ? std::ranges::equal(operands, of_rows)
                                                 : std::ranges::equal(operands, of_form),
              point);
}

}  // namespace

std::span<const Operation> operations() { return kOperations; }

const Operation& operation(Op op) { return kOperations[static_cast<std::size_t>(op)]; }

std::string to_string(Op op) { return std::string(operation(op).name); }

std::string to_string(Shape shape) {
  return std::to_string(shape.rows) + " x " + std::to_string(shape.cols);
}

/// One case a rule, in the order of ShapeRule.
std::optional<Shape> result_shape(Op op, std::span<const Shape> operands,
                                  const Attributes& attributes, Shape wanted) {
  const int count = operation(op).operands;
  if (count >= 0 && static_cast<std::size_t>(count) != operands.size()) return std::nullopt;
  const Shape a = operands.empty() ? Shape{} : operands[0];
  const Shape b = operands.size() < 2 ? Shape{} : operands[1];
  const int least = std::min(a.rows, a.cols);
  switch (operation(op).rule) {
    case ShapeRule::given:
      return wanted;
    case ShapeRule::given_of_number:
      return when(a.is_scalar(), wanted);
    case ShapeRule::square_of_number:
      return when(a.is_scalar() && wanted.is_square(), wanted);
    case ShapeRule::number:
      return Shape{};
    case ShapeRule::number_of_square:
      return when(a.is_square(), {});
    case ShapeRule::numbers:
      return when(std::ranges::all_of(operands, &Shape::is_scalar), {});
    case ShapeRule::elementwise:
      return when(std::ranges::all_of(operands, [&](Shape other) { return other == a; }), a);
    case ShapeRule::scaled:
      return when(a.is_scalar(), b);
    case ShapeRule::quotient:
      return when(b.is_scalar(), a);
    case ShapeRule::product:
      return when(a.cols == b.rows, {a.rows, b.cols});
    case ShapeRule::square:
      return when(a.is_square(), a);
    case ShapeRule::transposed:
      return Shape{a.cols, a.rows};
    case ShapeRule::layout:
      return layout_shape(operands, attributes[0]);
    case ShapeRule::part:
      return part_shape(a, attributes);
    case ShapeRule::diagonal_matrix:
      return when(a.rows == 1 || a.cols == 1, {a.size(), a.size()});
    case ShapeRule::diagonal_of:
      return when(a.is_square(), {a.rows, 1});
    case ShapeRule::singular_values:
      return Shape{least, 1};
    case ShapeRule::eigenvalues:
      return when(a.is_square(), {a.rows, 2});
    case ShapeRule::riccati: {
      const Shape weight{b.cols, b.cols};
      return when(a.is_square() && std::ranges::equal(operands, std::array{a, b, a, weight, b}) &&
                      b.rows == a.rows,
                  a);
    }
    case ShapeRule::range_basis:
      return when(wanted.cols <= least, {a.rows, wanted.cols});
    case ShapeRule::kernel_basis:
      return when(a.cols - least <= wanted.cols && wanted.cols <= a.cols, {a.cols, wanted.cols});
    case ShapeRule::nearest_to_rows:
    case ShapeRule::nearest_to_form:
      return nearest_shape(operation(op).rule, operands);
    case ShapeRule::nearest_of_body:
      return when(operands.size() >= 2 && a.cols == 1 && b == Shape{a.rows, a.rows}, a);
    case ShapeRule::complement_basis:
      return when(a.cols + wanted.cols <= a.rows, {a.rows, wanted.cols});
    case ShapeRule::jacobian:
      return when(!operands.empty() && wanted.cols == a.size(), wanted);
    case ShapeRule::flow_map:
      return when(operands.size() >= 2 && b.is_scalar(), a);
  }
  return std::nullopt;
}

}  // namespace gainsmith::expr
