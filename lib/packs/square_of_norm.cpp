#include "packs/square_of_norm.h"

#include <utility>
#include <vector>

namespace gainsmith::packs {

std::optional<expr::Program> square_of_norm(const expr::Program& program) {
  const auto last = static_cast<std::size_t>(program.result);
  const expr::Instruction& root = program.code[last];
  if (root.op != expr::Op::norm || last + 1 != program.code.size()) return std::nullopt;
  const int of = root.operands.front();
  const expr::Shape shape = program.code[static_cast<std::size_t>(of)].shape;
  if (shape.rows != 1 && shape.cols != 1) return std::nullopt;
  expr::Program square = program;
  expr::Instruction turned = root;
  turned.op = expr::Op::transpose;
  turned.shape = {shape.cols, shape.rows};
  expr::Instruction product = root;
  product.op = expr::Op::multiply;
  const int at = static_cast<int>(last);
  product.operands = shape.cols == 1 ? std::vector<int>{at, of} : std::vector<int>{of, at};
  square.code[last] = turned;
  square.code.push_back(product);
  square.result = at + 1;
  return square;
}

}  // namespace gainsmith::packs
