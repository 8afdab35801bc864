#include "numbers/graph/scalar_trace.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "base/number.h"
#include "expr/program/number_type.h"
#include "numbers/graph/affine_flow_map.h"
#include "numbers/graph/block_slope.h"
#include "numbers/graph/exponential_formula.h"
#include "numbers/graph/scalar_rules.h"

namespace gainsmith::numbers {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Shape;

class Tracer : public NodeRules {
 public:
  using NodeRules::NodeRules;

  TracedMatrix program(const expr::Program& program, const TracedInput& input) {
    std::vector<TracedMatrix> values;
    values.reserve(program.code.size());
    for (const Instruction& one : program.code) {
      if (one.op == Op::input) {
        values.push_back(input(program.input_of(one)));
        continue;
      }
      TracedOperands operands;
      for (const int operand : one.operands)
        operands.push_back(&values[static_cast<std::size_t>(operand)]);
      values.push_back(instruction(one, operands));
    }
    return std::move(values[static_cast<std::size_t>(program.result)]);
  }

 private:
  TracedMatrix instruction(const Instruction& instruction, const TracedOperands& operands) {
    if (instruction.op == Op::norm && !is_line(operands[0]->shape))
      return largest(instruction, operands);
    if (instruction.op == Op::flow_map)
      if (auto exact = exact_flow(instruction, operands)) return std::move(*exact);
    TracedMatrix out{instruction.shape, {}};
    if (!value(instruction, operands, out)) return block(instruction, operands);
    for (std::size_t d = 0; d < directions_of(operands); ++d)
      out.slopes.push_back(slope(graph_, instruction, operands, d, out, kind_));
    return out;
  }

  static bool is_line(Shape shape) {
    return shape.size() == 0 || shape.rows == 1 || shape.cols == 1;
  }

  static std::size_t directions_of(const TracedOperands& operands) {
    std::size_t directions = 0;
    for (const TracedMatrix* operand : operands)
      directions = std::max(directions, operand->slopes.size());
    return directions;
  }

  TracedMatrix block(const Instruction& instruction, const TracedOperands& operands) {
    const std::size_t directions = directions_of(operands);
    if (directions > 0 && kind_ == Derivative::jacobian && instruction.op == Op::flow_map)
      return moving_flow(instruction, operands, directions);
    if (directions > 0 && (kind_ == Derivative::jacobian || !has_block_slope(instruction.op)))
      throw NoFormula();
    ScalarGraph::Block made{instruction, {}, {}};
    for (const TracedMatrix* operand : operands) {
      made.operands.push_back(operand->value);
      made.shapes.push_back(operand->shape);
    }
    TracedMatrix out{instruction.shape, block_of(made)};
    for (std::size_t d = 0; d < directions; ++d) {
      ScalarGraph::Block moved = made;
      moved.is_slope = true;
      for (const TracedMatrix* operand : operands) {
        moved.operands.push_back(operand->moves() ? operand->slopes[d] : zeros(operand->shape));
        moved.shapes.push_back(operand->shape);
      }
      out.slopes.push_back(block_of(moved));
    }
    return out;
  }

  /// A flow map with its slopes.
  TracedMatrix moving_flow(const Instruction& one, const TracedOperands& operands,
                           std::size_t directions) {
    ScalarGraph::Block made{one, {}, {}};
    made.is_slope = true;
    made.instruction.shape = {one.shape.size(), 1 + static_cast<int>(directions)};
    for (const TracedMatrix* operand : operands) {
      made.operands.push_back(operand->value);
      made.shapes.push_back(operand->shape);
    }
    for (const TracedMatrix* operand : operands) {
      Nodes& slopes = made.operands.emplace_back();
      for (const Nodes& slope : operand->slopes)
        slopes.insert(slopes.end(), slope.begin(), slope.end());
      made.shapes.push_back({operand->shape.size(), static_cast<int>(operand->slopes.size())});
    }
    const Nodes all = block_of(made);
    const auto part = [&](std::size_t k) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(k) * one.shape.size();
      return Nodes(first, first + one.shape.size());
    };
    TracedMatrix out{one.shape, part(0)};
    for (std::size_t d = 1; d <= directions; ++d) out.slopes.push_back(part(d));
    return out;
  }

  /// Of a flow map along an affine rate.
  std::optional<TracedMatrix> exact_flow(const Instruction& instruction,
                                         const TracedOperands& operands) {
    const auto exact = affine_flow_map(instruction);
    if (!exact) return std::nullopt;
    const ScalarGraph::Mark before = graph_.mark();
    try {
      return program(*exact, [&](const expr::Input& operand) {
        return *operands[static_cast<std::size_t>(std::stoi(operand.name))];
      });
    } catch (const NoFormula&) {
      graph_.return_to(before);
      return std::nullopt;
    }
  }

  /// The norm of a matrix: its first singular value.
  TracedMatrix largest(const Instruction& norm, const TracedOperands& operands) {
    Instruction values = norm;
    values.op = Op::singular_values;
    const Shape shape = operands[0]->shape;
    values.shape = {std::min(shape.rows, shape.cols), 1};
    TracedMatrix out = instruction(values, operands);
    out.shape = norm.shape;
    out.value.resize(1);
    for (Nodes& slope : out.slopes) slope.resize(1);
    return out;
  }

  /// False: there is no formula.
  bool value(const Instruction& instruction, const TracedOperands& in, TracedMatrix& out) {
    const auto of = [&](std::size_t operand, std::size_t element) {
      return in[operand]->value[element];
    };
    const auto each = [&](const auto& made) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(instruction.shape.size()); ++k)
        out.value.push_back(made(k));
      return true;
    };
    switch (instruction.op) {
      case Op::constant: {
        const auto parsed = instruction.text == "pi" ? std::optional(std::numbers::pi)
                                                     : parse_decimal(instruction.text);
        if (!parsed) return false;
        out.value = {number(*parsed)};
        return true;
      }
      case Op::add:
        return each([&](std::size_t k) { return graph_.add(of(0, k), of(1, k)); });
      case Op::subtract:
        return each([&](std::size_t k) { return graph_.subtract(of(0, k), of(1, k)); });
      case Op::divide:
        return each([&](std::size_t k) { return graph_.divide(of(0, k), of(1, 0)); });
      case Op::elementwise_product:
        return each([&](std::size_t k) { return graph_.multiply(of(0, k), of(1, k)); });
      case Op::elementwise_quotient:
        return each([&](std::size_t k) { return graph_.divide(of(0, k), of(1, k)); });
      case Op::elementwise_power:
        return each([&](std::size_t k) { return power(of(0, k), instruction.attributes[0]); });
      case Op::where: {
        const bool strict = instruction.attributes[0] != 0;
        return each(
            [&](std::size_t k) { return graph_.where(strict, of(0, k), of(1, k), of(2, k)); });
      }
      case Op::multiply: {
        auto result = product(in[0]->shape, in[0]->value, in[1]->shape, in[1]->value);
        if (!result) return false;
        out.value = std::move(*result);
        return true;
      }
      case Op::power: {
        auto result = matrix_power(in[0]->shape, in[0]->value, instruction.attributes[0]);
        if (!result) return false;
        out.value = std::move(*result);
        return true;
      }
      case Op::norm:
        norm(*in[0], out);
        return true;
      case Op::inverse:
        if (instruction.shape.size() == 1)
          return each([&](std::size_t k) { return graph_.divide(number(1), of(0, k)); });
        out.value = block_of({instruction, {in[0]->value}, {in[0]->shape}});
        return true;
      case Op::matrix_exponential:
        if (instruction.shape.size() == 1)
          return each([&](std::size_t k) { return graph_.apply(ScalarOp::exp, of(0, k)); });
        out.value = exponential(instruction, *in[0]);
        return true;
      case Op::jacobian:
        return jacobian(instruction, in, out);
      default:
        break;
    }
    if (const auto op = elementwise(instruction.op)) {
      const bool two = instruction.operands.size() == 2;
      return each([&](std::size_t k) { return graph_.apply(*op, of(0, k), two ? of(1, k) : -1); });
    }
    std::vector<const Nodes*> nodes;
    for (const TracedMatrix* operand : in) nodes.push_back(&operand->value);
    return linear(instruction, in, nodes, out.value);
  }

  static std::optional<ScalarOp> elementwise(Op op) {
    switch (op) {
#define NUMBERS(op, ...) \
  case Op::op:           \
    return ScalarOp::op;
#include "expr/operations.def"
      default:
        return std::nullopt;
    }
  }

  /// Of a column or a row.
  void norm(const TracedMatrix& in, TracedMatrix& out) {
    if (in.shape.size() == 1) {
      out.value = {graph_.apply(ScalarOp::abs, in.value[0])};
      return;
    }
    int sum = zero();
    for (const int node : in.value) sum = graph_.add(sum, graph_.multiply(node, node));
    out.value = {graph_.apply(ScalarOp::sqrt, sum)};
  }

  Nodes exponential(const Instruction& instruction, const TracedMatrix& in) {
    std::optional<Nodes> nodes;
    if (const auto argument = as_multiple(in.value, instruction.shape.rows, graph_))
      nodes = exponential_nodes(*argument, graph_);
    return nodes ? std::move(*nodes) : block_of({instruction, {in.value}, {in.shape}});
  }

  /// Rows are the elements of the body's value, columns those of the first operand.
  bool jacobian(const Instruction& instruction, const TracedOperands& in, TracedMatrix& out) {
    if (std::any_of(in.begin(), in.end(), [](const auto* operand) { return operand->moves(); }))
      throw NoFormula();
    const auto& inputs = instruction.body->inputs;
    const auto input = [&](const expr::Input& named) {
      const auto k = static_cast<std::size_t>(instruction.body->input(named.name));
      TracedMatrix given = *in[k];
      if (k > 0) return given;
      const std::size_t size = given.value.size();
      for (std::size_t d = 0; d < size; ++d) {
        given.slopes.push_back(zeros(given.shape));
        given.slopes.back()[d] = number(1);
      }
      return given;
    };
    if (inputs.size() != in.size()) return false;
    const ScalarGraph::Mark before = graph_.mark();
    const Derivative kind = std::exchange(kind_, Derivative::jacobian);
    bool has_formula = true;
    try {
      const TracedMatrix result = program(*instruction.body, input);
      for (std::size_t d = 0; d < in[0]->value.size(); ++d) {
        const Nodes column = result.moves() ? result.slopes[d] : zeros(result.shape);
        out.value.insert(out.value.end(), column.begin(), column.end());
      }
    } catch (const NoFormula&) {
      graph_.return_to(before);
      out.value.clear();
      has_formula = false;
    }
    kind_ = kind;
    return has_formula;
  }

  Derivative kind_ = Derivative::rate;
};

}  // namespace

TracedMatrix trace(const expr::Program& program, const TracedInput& input, ScalarGraph& graph) {
  return Tracer(graph).program(program, input);
}

TracedMatrix traced(const Matrix& value, ScalarGraph& graph) {
  TracedMatrix result{shape_of(value), {}};
  for (Eigen::Index k = 0; k < value.size(); ++k) result.value.push_back(graph.constant(value(k)));
  return result;
}

}  // namespace gainsmith::numbers
