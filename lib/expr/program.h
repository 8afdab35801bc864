// An expression after names and shapes are known: a straight-line program over matrices, to be
// evaluated over any number type (see evaluate.h).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "expr/text.h"

namespace gainsmith::expr {

struct Shape {
  int rows = 1;
  int cols = 1;

  bool operator==(const Shape&) const = default;
  bool is_scalar() const { return rows == 1 && cols == 1; }
  bool is_square() const { return rows == cols; }
  int size() const { return rows * cols; }
};

/// "2 x 3".
std::string to_string(Shape shape);

/// Every operation of the machine. A and B are operands, s is a 1 x 1 operand.
enum class Op {
  constant,      ///< the decimal `text`, or "pi"
  input,         ///< inputs[attributes[0]]
  call,          ///< functions[attributes[0]] at s; replaced by link() before anything is computed
  zeros,         ///< a matrix of zeros
  fill,          ///< every element is s
  identity,      ///< s I
  add,           ///< A + B
  subtract,      ///< A - B
  negate,        ///< -A
  multiply,      ///< A B
  scale,         ///< s B
  divide,        ///< A / s
  power,         ///< A^k, k = attributes[0] >= 0
  scalar_power,  ///< s^t for 1 x 1 operands
  transpose,     ///< A'
  blocks,        ///< the operands laid out row by row, attributes[0] in a row
  index,  ///< rows attributes[0] .. attributes[1]-1, columns attributes[2] .. attributes[3]-1
  exp,
  log,
  sqrt,
  sin,
  cos,
  tanh,
  abs,
  sign,  ///< element by element
  minimum,
  maximum,  ///< element by element, of two
  where,  ///< element by element: D > 0 (or >= 0 when attributes[0] is 0) ? A : B, operands D, A, B
  trace,
  norm,  ///< largest singular value; the Euclidean length of a vector
  inverse,
  pseudo_inverse,  ///< Moore-Penrose
  matrix_exponential,
  diagonal_matrix,  ///< the diagonal matrix of a vector
  diagonal_of,      ///< the diagonal of a matrix, as a column
  singular_values,  ///< largest first, as a column
  range_basis,  ///< orthonormal columns that span the range of A; the rank is the shape's columns
  kernel_basis  ///< orthonormal columns that span the kernel of A
};

/// The name used in messages: "inv", "product", ...
std::string to_string(Op op);

struct Instruction {
  Op op = Op::constant;
  std::vector<int> operands;  ///< earlier instructions
  Shape shape;                ///< of the result
  std::array<int, 4> attributes{};
  std::string text;  ///< constant: the decimal as written; inverse: of what; call: as written
  std::shared_ptr<const Text> origin;
  std::size_t offset = 0;  ///< where in the origin it was written

  Place place() const { return origin ? origin->place(offset) : Place{}; }
};

struct Input {
  std::string name;
  Shape shape;
};

struct Program {
  std::vector<Instruction> code;
  std::vector<Input> inputs;
  std::vector<Input> functions;  ///< what is called, with the shape of its values
  int result = -1;               ///< the instruction whose value is the program's

  Shape shape() const { return code[static_cast<std::size_t>(result)].shape; }
  /// The position of an input, or -1.
  int input(const std::string& name) const;
  bool uses(const std::string& name) const { return input(name) >= 0; }
};

/// Whether two programs compute the same in the same way; places do not count.
bool is_same(const Program& a, const Program& b);

}  // namespace gainsmith::expr
