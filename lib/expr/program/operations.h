// The operations of the machine. operations.def is their table, with the functions and operators of
// the language.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "expr/program/shape.h"

namespace gainsmith::expr {

/// Every operation of the machine.
/// In the order of the table.
enum class Op {
#define RESOLVED(op, ...) op,
#define OPERATION(op, ...) op,
#define FUNCTION(op, ...) op,
#include "expr/operations.def"
};

/// Whether it is one of these.
constexpr bool is_one_of(Op op, std::initializer_list<Op> list) {
  return std::find(list.begin(), list.end(), op) != list.end();
}

/// Whether its value is that of a problem: a projection, a search, a flow, an equation. Number
/// types with bounds have none.
constexpr bool is_without_bounds(Op op) {
  using enum Op;
  return is_one_of(op, {project_polytope, project_ellipsoid, project_affine, project_convex,
                        flow_map, extremum, eigenvalues, continuous_riccati, discrete_riccati});
}

/// A function of numbers: a row NUMBERS of the table.
struct NumberFunction {
  /// Flags.
  enum Behaviour : unsigned {
    smooth = 0,  ///< but for kinks
    jumps = 1,
    waves = 2  ///< it may turn or bend between points at which it is known
  };
  Op op;
  std::string_view parameters;  ///< "y, x"
  unsigned behaviour;
  std::array<std::string_view, 2> derivatives{};  ///< by each parameter; of a choice empty
};

/// In the order of the table.
inline constexpr auto kNumberFunctions = [] {
  using enum NumberFunction::Behaviour;
  return std::to_array<NumberFunction>({
#define NUMBERS(op, parameters, behaviour, ...) {Op::op, parameters, behaviour, {__VA_ARGS__}},
#include "expr/operations.def"
  });
}();

/// nullptr: it is none.
constexpr const NumberFunction* number_function(Op op) {
  const auto* const found = std::ranges::find(kNumberFunctions, op, &NumberFunction::op);
  return found == kNumberFunctions.end() ? nullptr : found;
}

/// Whether it has derivatives by formulas of its own.
constexpr bool has_derivatives(Op op) {
  const NumberFunction* const function = number_function(op);
  return function != nullptr && !function->derivatives[0].empty();
}

/// Whether a function of numbers has all of these flags.
constexpr bool behaves(Op op, unsigned flags) {
  const NumberFunction* const function = number_function(op);
  return function != nullptr && (function->behaviour & flags) == flags;
}

/// Whether it is no polynomial in its operands, and no choice between them.
constexpr bool is_function(Op op) {
  using enum Op;
  return number_function(op) != nullptr || is_without_bounds(op) ||
         is_one_of(op, {inverse, pseudo_inverse, matrix_exponential, norm, singular_values,
                        range_basis, kernel_basis, complement_basis, determinant});
}

/// What the operands must be, and the shape of the result. A, B are operands of any shape, s
/// a 1 x 1 one, M a square one; r x c is the shape of A.
enum class ShapeRule {
  given,             ///< no operand -> any shape
  given_of_number,   ///< s -> any shape
  square_of_number,  ///< s -> any square shape
  number,            ///< none or A -> 1 x 1
  number_of_square,  ///< M -> 1 x 1
  numbers,           ///< s, t -> 1 x 1
  elementwise,       ///< A, B, ... of one shape -> that shape
  scaled,            ///< s, A -> r x c
  quotient,          ///< A, s -> r x c
  product,           ///< r x k, k x c -> r x c
  square,            ///< M -> its shape
  transposed,        ///< A -> c x r
  layout,            ///< blocks, attributes[0] in a row -> the sums of their heights and widths
  part,              ///< A -> (attributes[1] - attributes[0]) x (attributes[3] - attributes[2])
  diagonal_matrix,   ///< A with r = 1 or c = 1 -> rc x rc
  diagonal_of,       ///< M -> r x 1
  singular_values,   ///< A -> min(r, c) x 1
  eigenvalues,       ///< M -> r x 2
  riccati,           ///< n x n, n x m, n x n, m x m, n x m -> n x n
  range_basis,       ///< A -> r x k, k <= min(r, c) given
  kernel_basis,      ///< A -> c x k, c - min(r, c) <= k <= c given
  nearest_to_rows,   ///< n x 1, n x n, m x n, m x 1 -> n x 1
  nearest_to_form,   ///< n x 1, n x n, n x 1, n x n, s -> n x 1
  nearest_of_body,   ///< n x 1, n x n, A, ... -> n x 1
  complement_basis,  ///< A -> r x k, c + k <= r given
  jacobian,          ///< A, B, ... -> any number of rows x rc
  flow_map           ///< A, s, ... -> r x c
};

/// Whole numbers of an instruction, such as the rows and columns of a part; their meaning is at the
/// rows of the table.
using Attributes = std::array<int, 4>;

/// attributes[0] of an elementwise quotient by what is nothing but rounding where it should be 0: a
/// real number divides by nothing of a few units in the last place of 1.
inline constexpr int kPoleWithinRounding = 1;

/// One row of the table.
/// What the machine knows of an operation; its meaning is in the rules of the number types.
struct Operation {
  Op op;
  std::string_view identifier;  ///< as in Op
  int operands;                 ///< -1: any number
  ShapeRule rule;
  std::string_view name;     ///< in messages: "inv", "product", ...
  std::string_view example;  ///< empty when the operation is resolved before evaluation
  std::string_view value;    ///< of the example, as an expression
};

/// The table, in the order of Op.
std::span<const Operation> operations();
const Operation& operation(Op op);

/// The name used in messages.
std::string to_string(Op op);

/// The shape of the result; none when the number of the operands or their shapes are not as the
/// rule says. `wanted` is the result's shape where the operands leave it open.
std::optional<Shape> result_shape(Op op, std::span<const Shape> operands,
                                  const Attributes& attributes = {}, Shape wanted = {});

}  // namespace gainsmith::expr
