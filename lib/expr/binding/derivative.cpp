// Forward differentiation of matrix programs by rules, one direction at a time:
//
//   (A + B)' = A' + B'              (A B)' = A' B + A B'          (a/b)' = (a' - (a/b) b')/b
//   inv(A)' = -inv(A) A' inv(A)     (x^k)' = k x^(k-1) x'         max(a, b)' = a' or b'
//   f(a, b)' = df/da a' + df/db b'  of functions of numbers (partial_derivative.h)
//
// Column k of a jacobian is the derivative in the direction of element k of the variable.
// Directions are unit matrices, so zeros are not computed with and products with 1 are left out.
#include "expr/binding/derivative.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/partial_derivative.h"
#include "expr/program/assembly.h"

namespace gainsmith::expr {

namespace {

/// The derivative of an instruction in one direction.
struct Slope {
  int at = -1;    ///< the instruction that computes it; -1: it is 0
  int unit = -1;  ///< the only element that is not 0, which is 1; -1: not known to be so

  bool is_zero() const { return at < 0; }
};

/// The derivatives of the instructions of one body in one direction.
class Direction {
 public:
  Direction(Assembly& assembly, const Program& body, const std::vector<int>& moved)
      : assembly_(assembly), body_(body), moved_(moved), slopes_(body.code.size()) {}

  /// Of the result, as a column, when the element `unit` of the first input moves; none without a
  /// rule.
  std::optional<int> column(int unit) {
    for (std::size_t at = 0; at < body_.code.size(); ++at) {
      const Instruction& instruction = body_.code[at];
      like_ = &instruction;
      if (instruction.op == Op::input) {
        if (instruction.attributes[0] == 0) slopes_[at] = unit_slope(instruction.shape, unit);
        continue;
      }
      bool moves = false;
      for (const int operand : instruction.operands)
        moves = moves || !slopes_[static_cast<std::size_t>(operand)].is_zero();
      if (!moves) continue;
      const auto found = slope(instruction, moved_[at]);
      if (!found) return std::nullopt;
      slopes_[at] = *found;
    }
    const Shape shape = body_.shape();
    const int result = filled(slopes_[static_cast<std::size_t>(body_.result)], shape);
    if (shape.cols == 1) return result;
    std::vector<int> columns;
    for (int j = 0; j < shape.cols; ++j)
      columns.push_back(apply(Op::index, {result}, {shape.rows, 1}, {0, shape.rows, j, j + 1}));
    return apply(Op::blocks, std::move(columns), {shape.size(), 1}, {1});
  }

 private:
  /// The derivative of one instruction by the rules above; none where there is no rule. `value`:
  /// the instruction itself in the program that is made.
  std::optional<Slope> slope(const Instruction& instruction, int value) {
    const auto x = [&](std::size_t k) {
      return moved_[static_cast<std::size_t>(instruction.operands[k])];
    };
    const auto d = [&](std::size_t k) {
      return slopes_[static_cast<std::size_t>(instruction.operands[k])];
    };
    const Shape shape = instruction.shape;
    switch (instruction.op) {
      case Op::index:
        if (d(0).unit >= 0) return part_of_unit(instruction, d(0).unit, assembly_.shape(x(0)).rows);
        [[fallthrough]];
      case Op::fill:
      case Op::identity:
      case Op::negate:
      case Op::transpose:
      case Op::trace:
      case Op::diagonal_matrix:
      case Op::diagonal_of:
        return Slope{apply(instruction.op, {d(0).at}, shape, instruction.attributes)};
      case Op::blocks: {
        std::vector<int> parts;
        for (std::size_t k = 0; k < instruction.operands.size(); ++k)
          parts.push_back(filled(d(k), assembly_.shape(x(k))));
        return Slope{apply(Op::blocks, std::move(parts), shape, instruction.attributes)};
      }
      case Op::add:
        return sum(d(0), d(1), shape);
      case Op::subtract:
        return difference(d(0), d(1), shape);
      case Op::multiply:
      case Op::scale:
      case Op::elementwise_product: {
        const Slope first = d(0).is_zero() ? d(0) : times(instruction.op, d(0), {x(1)}, shape);
        const Slope second = d(1).is_zero() ? d(1) : times(instruction.op, {x(0)}, d(1), shape);
        return sum(first, second, shape);
      }
      case Op::divide:
      case Op::elementwise_quotient: {
        const Op by = instruction.op == Op::divide ? Op::scale : Op::elementwise_product;
        const Slope less = d(1).is_zero() ? d(1) : times(by, d(1), {value}, shape);
        return Slope{apply(instruction.op, {difference(d(0), less, shape).at, x(1)}, shape)};
      }
      case Op::power:
        if (!shape.is_scalar()) return std::nullopt;
        return power(instruction, x(0), d(0));
      case Op::elementwise_power:
        return power(instruction, x(0), d(0));
      case Op::inverse: {
        const int turned = apply(Op::multiply, {d(0).at, value}, shape);
        return Slope{apply(Op::negate, {apply(Op::multiply, {value, turned}, shape)}, shape)};
      }
      case Op::minimum:
      case Op::maximum: {
        const int first = instruction.op == Op::maximum ? x(0) : x(1);
        const int second = instruction.op == Op::maximum ? x(1) : x(0);
        const int by = apply(Op::subtract, {second, first}, shape);
        return Slope{apply(Op::where, {by, filled(d(1), shape), filled(d(0), shape)}, shape, {1})};
      }
      default:
        return of_function(instruction);
    }
  }

  int apply(Op op, std::vector<int> operands, Shape shape, Attributes attributes = {}) {
    return assembly_.add(
        {op, std::move(operands), shape, attributes, {}, like_->origin, like_->offset});
  }
  int number(const std::string& decimal) {
    return assembly_.add({Op::constant, {}, {1, 1}, {}, decimal, like_->origin, like_->offset});
  }
  /// A function of numbers, but for those that jump.
  std::optional<Slope> of_function(const Instruction& instruction) {
    if (!has_derivatives(instruction.op) || behaves(instruction.op, NumberFunction::jumps))
      return std::nullopt;
    has_moduli_ = has_moduli_ || instruction.op == Op::abs;
    std::vector<int> operands;
    for (const int operand : instruction.operands)
      operands.push_back(moved_[static_cast<std::size_t>(operand)]);
    Slope whole;
    for (std::size_t k = 0; k < operands.size(); ++k) {
      const Slope& part = slopes_[static_cast<std::size_t>(instruction.operands[k])];
      if (part.is_zero()) continue;
      const int factor = add_partial_derivative(assembly_, instruction, k, operands);
      whole = sum(whole, along(factor, part, instruction.shape), instruction.shape);
    }
    return whole;
  }
  int slope_of_modulus(int x) {
    const Instruction modulus = made(Op::abs, {x}, assembly_.shape(x), *like_);
    return add_partial_derivative(assembly_, modulus, 0, {x});
  }

  /// The matrix that is 1 in element `unit`, counted column by column, and 0 elsewhere.
  Slope unit_slope(Shape shape, int unit) {
    if (shape.is_scalar()) return {number("1"), 0};
    std::vector<int> elements;
    for (int row = 0; row < shape.rows; ++row)
      for (int column = 0; column < shape.cols; ++column)
        elements.push_back(number(column * shape.rows + row == unit ? "1" : "0"));
    return {apply(Op::blocks, std::move(elements), shape, {shape.cols}), unit};
  }
  /// A part of a unit matrix: another unit matrix, or 0.
  Slope part_of_unit(const Instruction& index, int unit, int rows) {
    const int row = unit % rows - index.attributes[0];
    const int column = unit / rows - index.attributes[2];
    const Shape shape = index.shape;
    if (row < 0 || row >= shape.rows || column < 0 || column >= shape.cols) return {};
    return unit_slope(shape, column * shape.rows + row);
  }

  int filled(const Slope& slope, Shape shape) {
    return slope.is_zero() ? apply(Op::zeros, {}, shape) : slope.at;
  }
  Slope sum(const Slope& a, const Slope& b, Shape shape) {
    if (a.is_zero() || b.is_zero()) return a.is_zero() ? b : a;
    return {apply(Op::add, {a.at, b.at}, shape)};
  }
  Slope difference(const Slope& a, const Slope& b, Shape shape) {
    if (b.is_zero()) return a;
    return {a.is_zero() ? apply(Op::negate, {b.at}, shape)
                        : apply(Op::subtract, {a.at, b.at}, shape)};
  }
  /// A product, one factor of which may be the number 1.
  Slope times(Op op, const Slope& a, const Slope& b, Shape shape) {
    const auto is_one = [&](const Slope& s) {
      return s.unit == 0 && assembly_.shape(s.at).is_scalar();
    };
    if (is_one(a)) return {b.at};
    if (is_one(b) && op != Op::scale) return {a.at};
    if (const int even = without_sign(op, a.at, b.at); even >= 0) return {even};
    return {apply(op, {a.at, b.at}, shape)};
  }
  /// |x|' x = |x| in a product of numbers or element by element: the slope of |x| x does not jump.
  /// -1: there is none.
  int without_sign(Op op, int a, int b) {
    const Shape shape = assembly_.shape(a);
    if (!has_moduli_ || shape != assembly_.shape(b)) return -1;
    if (op != Op::elementwise_product && !shape.is_scalar()) return -1;
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
      const int sign = slope_of_modulus(other);
      if (const int even = replaced(one, sign, apply(Op::abs, {other}, shape)); even >= 0)
        return even;
      if (assembly_[other].op != Op::where) continue;
      const int x = assembly_[other].operands[0];
      if (other != slope_of_modulus(x)) continue;
      if (const int even = replaced(one, x, apply(Op::abs, {x}, shape)); even >= 0) return even;
    }
    return -1;
  }
  /// A product with one of its factors replaced; -1: it is none of them.
  int replaced(int product, int factor, int by) {
    if (product == factor) return by;
    const Instruction instruction = assembly_[product];
    const bool multiplies = instruction.op == Op::negate ||
                            instruction.op == Op::elementwise_product ||
                            (instruction.shape.is_scalar() &&
                             (instruction.op == Op::multiply || instruction.op == Op::scale));
    if (!multiplies) return -1;
    for (std::size_t k = 0; k < instruction.operands.size(); ++k) {
      if (assembly_.shape(instruction.operands[k]) != instruction.shape) continue;
      const int part = replaced(instruction.operands[k], factor, by);
      if (part < 0) continue;
      std::vector<int> operands = instruction.operands;
      operands[k] = part;
      return apply(instruction.op, std::move(operands), instruction.shape);
    }
    return -1;
  }
  /// factor .* slope.
  Slope along(int factor, const Slope& slope, Shape shape) {
    return times(Op::elementwise_product, {factor}, slope, shape);
  }
  /// k x^(k - 1) x', element by element.
  Slope power(const Instruction& instruction, int x, const Slope& slope) {
    const int exponent = instruction.attributes[0];
    if (exponent == 0) return {};
    if (exponent == 1) return slope;
    const int lower =
        exponent == 2 ? x : apply(instruction.op, {x}, instruction.shape, {exponent - 1});
    const int factor =
        apply(Op::scale, {number(std::to_string(exponent)), lower}, instruction.shape);
    return along(factor, slope, instruction.shape);
  }

  Assembly& assembly_;
  const Program& body_;
  const std::vector<int>& moved_;  ///< the instructions of the body
  const Instruction* like_ = nullptr;
  std::vector<Slope> slopes_;
  bool has_moduli_ = false;  ///< of the derivative of |x|
};

std::vector<int> add_instructions(Assembly& assembly, const Program& program,
                                  const std::vector<int>& inputs);

/// None without rules for all operations.
/// The columns of one jacobian beside each other, over operands in place of the inputs of its body.
std::optional<int> add_columns(Assembly& assembly, const Instruction& jacobian,
                               const std::vector<int>& operands) {
  const Program& body = *jacobian.body;
  const std::vector<int> moved = add_instructions(assembly, body, operands);
  std::vector<int> columns;
  for (int unit = 0; unit < jacobian.shape.cols; ++unit) {
    const auto column = Direction(assembly, body, moved).column(unit);
    if (!column) return std::nullopt;
    columns.push_back(*column);
  }
  if (columns.size() == 1) return columns.front();
  const int count = static_cast<int>(columns.size());
  return assembly.add(made(Op::blocks, std::move(columns), jacobian.shape, jacobian, {count}));
}

/// The instructions of a program, jacobians replaced. `inputs`: what replaces its inputs; none:
/// they stay inputs.
std::vector<int> add_instructions(Assembly& assembly, const Program& program,
                                  const std::vector<int>& inputs) {
  const auto replace = [&](const Instruction& instruction,
                           const Instruction& copy) -> std::optional<int> {
    if (instruction.op == Op::input && !inputs.empty())
      return inputs[static_cast<std::size_t>(instruction.attributes[0])];
    if (instruction.op != Op::jacobian || instruction.shape.size() == 0) return std::nullopt;
    return add_columns(assembly, instruction, copy.operands);
  };
  return assembly.add_all(program, replace);
}

}  // namespace

Program with_derivatives(const Program& program) {
  bool any = false;
  for (const Instruction& instruction : program.code) any = any || instruction.op == Op::jacobian;
  if (!any) return program;
  Assembly assembly;
  const auto moved = add_instructions(assembly, program, {});
  return assembly.extract(moved[static_cast<std::size_t>(program.result)]);
}

}  // namespace gainsmith::expr
