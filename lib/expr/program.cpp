#include "expr/program.h"

#include <algorithm>

namespace gainsmith::expr {

std::string to_string(Shape shape) {
  return std::to_string(shape.rows) + " x " + std::to_string(shape.cols);
}

std::string to_string(Op op) {
  switch (op) {
    case Op::constant:
      return "number";
    case Op::input:
      return "name";
    case Op::call:
      return "function";
    case Op::zeros:
      return "zeros";
    case Op::fill:
      return "ones";
    case Op::identity:
      return "multiple of I";
    case Op::add:
      return "sum";
    case Op::subtract:
      return "difference";
    case Op::negate:
      return "negative";
    case Op::multiply:
    case Op::scale:
      return "product";
    case Op::divide:
      return "quotient";
    case Op::power:
    case Op::scalar_power:
      return "power";
    case Op::transpose:
      return "transpose";
    case Op::blocks:
      return "block matrix";
    case Op::index:
      return "indexed part";
    case Op::exp:
      return "exp";
    case Op::log:
      return "log";
    case Op::sqrt:
      return "sqrt";
    case Op::sin:
      return "sin";
    case Op::cos:
      return "cos";
    case Op::tanh:
      return "tanh";
    case Op::abs:
      return "abs";
    case Op::sign:
      return "sign";
    case Op::minimum:
      return "min";
    case Op::maximum:
      return "max";
    case Op::where:
      return "where";
    case Op::trace:
      return "trace";
    case Op::norm:
      return "norm";
    case Op::inverse:
      return "inv";
    case Op::pseudo_inverse:
      return "pinv";
    case Op::matrix_exponential:
      return "expm";
    case Op::diagonal_matrix:
    case Op::diagonal_of:
      return "diag";
    case Op::singular_values:
      return "svd";
    case Op::range_basis:
      return "orth";
    case Op::kernel_basis:
      return "null";
  }
  return "?";
}

bool is_same(const Program& a, const Program& b) {
  const auto same_input = [](const Input& x, const Input& y) {
    return x.name == y.name && x.shape == y.shape;
  };
  const auto same_instruction = [](const Instruction& x, const Instruction& y) {
    return x.op == y.op && x.operands == y.operands && x.shape == y.shape &&
           x.attributes == y.attributes && x.text == y.text;
  };
  return a.result == b.result && std::ranges::equal(a.inputs, b.inputs, same_input) &&
         std::ranges::equal(a.functions, b.functions, same_input) &&
         std::ranges::equal(a.code, b.code, same_instruction);
}

int Program::input(const std::string& name) const {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace gainsmith::expr
