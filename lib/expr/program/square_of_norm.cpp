#include "expr/program/square_of_norm.h"

#include <vector>

namespace gainsmith::expr {

/// The last instruction norm(v) becomes v'; one more is the product v'v, of a row v v'.
std::optional<Program> square_of_norm(const Program& program) {
  const auto last = static_cast<std::size_t>(program.result);
  const Instruction& root = program.code[last];
  if (root.op != Op::norm || last + 1 != program.code.size()) return std::nullopt;
  const int of = root.operands.front();
  const Shape shape = program.code[static_cast<std::size_t>(of)].shape;
  if (shape.rows != 1 && shape.cols != 1) return std::nullopt;
  Program square = program;
  Instruction turned = root;
  turned.op = Op::transpose;
  turned.shape = {shape.cols, shape.rows};
  Instruction product = root;
  product.op = Op::multiply;
  const int at = static_cast<int>(last);
  product.operands = shape.cols == 1 ? std::vector<int>{at, of} : std::vector<int>{of, at};
  square.code[last] = turned;
  square.code.push_back(product);
  square.result = at + 1;
  return square;
}

}  // namespace gainsmith::expr
