#include "numbers/scalar_trace.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "base/number.h"
#include "expr/number_type.h"

namespace gainsmith::numbers {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Shape;
using Nodes = std::vector<int>;

/// A derivative that has no formula here.
struct NoFormula {};

/// A product of matrices with more terms is a block.
constexpr int kMostTerms = 4096;

std::size_t at_of(Shape shape, int row, int column) {
  return static_cast<std::size_t>(column * shape.rows + row);
}

class Tracer {
 public:
  explicit Tracer(ScalarGraph& graph) : graph_(graph) {}

  TracedMatrix program(const expr::Program& program, const TracedInput& input) {
    std::vector<TracedMatrix> values;
    values.reserve(program.code.size());
    for (const Instruction& one : program.code) {
      if (one.op == Op::input) {
        values.push_back(input(program.inputs[static_cast<std::size_t>(one.attributes[0])]));
        continue;
      }
      std::vector<const TracedMatrix*> operands;
      for (const int operand : one.operands)
        operands.push_back(&values[static_cast<std::size_t>(operand)]);
      values.push_back(instruction(one, operands));
    }
    return std::move(values[static_cast<std::size_t>(program.result)]);
  }

 private:
  using Operands = std::vector<const TracedMatrix*>;

  TracedMatrix instruction(const Instruction& one, const Operands& operands) {
    TracedMatrix out{one.shape, {}};
    if (!value(one, operands, out)) return block(one, operands);
    std::size_t directions = 0;
    for (const TracedMatrix* operand : operands)
      directions = std::max(directions, operand->slopes.size());
    for (std::size_t d = 0; d < directions; ++d) out.slopes.push_back(slope(one, operands, d, out));
    return out;
  }

  int zero() { return graph_.constant(0); }
  int number(double value) { return graph_.constant(value); }
  Nodes zeros(Shape shape) { return Nodes(static_cast<std::size_t>(shape.size()), zero()); }

  TracedMatrix block(const Instruction& one, const Operands& operands) {
    ScalarGraph::Block made{one, {}, {}};
    for (const TracedMatrix* operand : operands) {
      if (operand->moves()) throw NoFormula();
      made.operands.push_back(operand->value);
      made.shapes.push_back(operand->shape);
    }
    return {one.shape, block_of(std::move(made))};
  }

  Nodes block_of(ScalarGraph::Block block) {
    const int first = graph_.block(block);
    Nodes nodes;
    for (int k = 0; k < block.instruction.shape.size(); ++k) nodes.push_back(first + k);
    return nodes;
  }

  // --- Values. False: there is no formula. ---

  bool value(const Instruction& one, const Operands& in, TracedMatrix& out) {
    const auto of = [&](std::size_t operand, std::size_t element) {
      return in[operand]->value[element];
    };
    const auto each = [&](const auto& made) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(one.shape.size()); ++k)
        out.value.push_back(made(k));
      return true;
    };
    switch (one.op) {
      case Op::constant: {
        const auto parsed =
            one.text == "pi" ? std::optional(std::numbers::pi) : parse_decimal(one.text);
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
        return each([&](std::size_t k) { return power(of(0, k), one.attributes[0]); });
      case Op::where: {
        const bool strict = one.attributes[0] != 0;
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
        auto result = matrix_power(in[0]->shape, in[0]->value, one.attributes[0]);
        if (!result) return false;
        out.value = std::move(*result);
        return true;
      }
      case Op::norm:
        return norm(*in[0], out);
      case Op::inverse:
        if (one.shape.size() > 1) {
          out.value = block_of({one, {in[0]->value}, {in[0]->shape}});
          return true;
        }
        return each([&](std::size_t k) { return graph_.divide(number(1), of(0, k)); });
      case Op::jacobian:
        return jacobian(one, in, out);
      default:
        break;
    }
    if (const auto op = elementwise(one.op)) {
      const bool two = one.operands.size() == 2;
      return each([&](std::size_t k) { return graph_.apply(*op, of(0, k), two ? of(1, k) : -1); });
    }
    return linear(
        one, in, [](const TracedMatrix& operand) -> const Nodes& { return operand.value; },
        out.value);
  }

  static std::optional<ScalarOp> elementwise(Op op) {
    switch (op) {
      case Op::minimum:
        return ScalarOp::minimum;
      case Op::maximum:
        return ScalarOp::maximum;
      case Op::real_power:
        return ScalarOp::power;
      case Op::mod:
        return ScalarOp::mod;
      case Op::atan2:
        return ScalarOp::angle;
      case Op::abs:
        return ScalarOp::abs;
      case Op::sign:
        return ScalarOp::sign;
      case Op::floor:
        return ScalarOp::floor;
      case Op::exp:
        return ScalarOp::exp;
      case Op::log:
        return ScalarOp::log;
      case Op::sqrt:
        return ScalarOp::sqrt;
      case Op::sin:
        return ScalarOp::sin;
      case Op::cos:
        return ScalarOp::cos;
      case Op::tanh:
        return ScalarOp::tanh;
      default:
        return std::nullopt;
    }
  }

  /// What is linear in all operands: so values and slopes are. `nodes`: of an operand; `scale` by
  /// a number that does not move is among them.
  template <class NodesOf>
  bool linear(const Instruction& one, const Operands& in, const NodesOf& nodes, Nodes& out) {
    const Shape shape = one.shape;
    const auto place = [&](const auto& made) {
      for (int column = 0; column < shape.cols; ++column)
        for (int row = 0; row < shape.rows; ++row) out.push_back(made(row, column));
      return true;
    };
    switch (one.op) {
      case Op::zeros:
        out = zeros(shape);
        return true;
      case Op::fill:
        return place([&](int, int) { return nodes(*in[0])[0]; });
      case Op::identity:
        return place(
            [&](int row, int column) { return row == column ? nodes(*in[0])[0] : zero(); });
      case Op::negate:
        for (const int node : nodes(*in[0])) out.push_back(graph_.negate(node));
        return true;
      case Op::scale:
        for (const int node : nodes(*in[1])) out.push_back(graph_.multiply(in[0]->value[0], node));
        return true;
      case Op::transpose:
        return place(
            [&](int row, int column) { return nodes(*in[0])[at_of(in[0]->shape, column, row)]; });
      case Op::index:
        return place([&](int row, int column) {
          return nodes(
              *in[0])[at_of(in[0]->shape, one.attributes[0] + row, one.attributes[2] + column)];
        });
      case Op::blocks:
        blocks(one, in, nodes, out);
        return true;
      case Op::trace: {
        int sum = zero();
        for (int k = 0; k < in[0]->shape.rows; ++k)
          sum = graph_.add(sum, nodes(*in[0])[at_of(in[0]->shape, k, k)]);
        out = {sum};
        return true;
      }
      case Op::diagonal_matrix:
        return place([&](int row, int column) {
          return row == column ? nodes(*in[0])[static_cast<std::size_t>(row)] : zero();
        });
      case Op::diagonal_of:
        return place([&](int row, int) { return nodes(*in[0])[at_of(in[0]->shape, row, row)]; });
      default:
        return false;
    }
  }

  template <class NodesOf>
  void blocks(const Instruction& one, const Operands& in, const NodesOf& nodes, Nodes& out) {
    out = zeros(one.shape);
    const auto columns = static_cast<std::size_t>(one.attributes[0]);
    int row = 0;
    for (std::size_t first = 0; first < in.size(); first += columns) {
      int column = 0;
      for (std::size_t j = first; j < first + columns; ++j) {
        const Shape part = in[j]->shape;
        for (int c = 0; c < part.cols; ++c)
          for (int r = 0; r < part.rows; ++r)
            out[at_of(one.shape, row + r, column + c)] = nodes(*in[j])[at_of(part, r, c)];
        column += part.cols;
      }
      row += in[first]->shape.rows;
    }
  }

  std::optional<Nodes> product(Shape left, const Nodes& a, Shape right, const Nodes& b) {
    int terms = 0;
    for (int row = 0; row < left.rows; ++row)
      for (int k = 0; k < left.cols; ++k) {
        if (graph_.is_zero(a[at_of(left, row, k)])) continue;
        for (int column = 0; column < right.cols; ++column)
          terms += graph_.is_zero(b[at_of(right, k, column)]) ? 0 : 1;
      }
    if (terms > kMostTerms) return std::nullopt;
    Nodes result;
    for (int column = 0; column < right.cols; ++column)
      for (int row = 0; row < left.rows; ++row) {
        int sum = zero();
        for (int k = 0; k < left.cols; ++k)
          sum =
              graph_.add(sum, graph_.multiply(a[at_of(left, row, k)], b[at_of(right, k, column)]));
        result.push_back(sum);
      }
    return result;
  }

  std::optional<Nodes> matrix_power(Shape shape, Nodes square, int exponent) {
    Nodes result = zeros(shape);
    for (int k = 0; k < shape.rows; ++k) result[at_of(shape, k, k)] = number(1);
    for (; exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) {
        auto next = product(shape, result, shape, square);
        if (!next) return std::nullopt;
        result = std::move(*next);
      }
      if (exponent == 1) break;
      auto next = product(shape, square, shape, square);
      if (!next) return std::nullopt;
      square = std::move(*next);
    }
    return result;
  }

  int power(int square, int exponent) {
    int result = number(1);
    for (; exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) result = graph_.multiply(result, square);
      if (exponent > 1) square = graph_.multiply(square, square);
    }
    return result;
  }

  bool norm(const TracedMatrix& in, TracedMatrix& out) {
    const Shape shape = in.shape;
    if (shape.size() > 0 && shape.rows != 1 && shape.cols != 1) return false;
    if (shape.size() == 1) {
      out.value = {graph_.apply(ScalarOp::abs, in.value[0])};
      return true;
    }
    int sum = zero();
    for (const int node : in.value) sum = graph_.add(sum, graph_.multiply(node, node));
    out.value = {graph_.apply(ScalarOp::sqrt, sum)};
    return true;
  }

  /// Rows are the elements of the body's value, columns those of the first operand.
  bool jacobian(const Instruction& one, const Operands& in, TracedMatrix& out) {
    if (std::any_of(in.begin(), in.end(), [](const auto* operand) { return operand->moves(); }))
      throw NoFormula();
    const auto& inputs = one.body->inputs;
    const auto input = [&](const expr::Input& named) {
      const auto k = static_cast<std::size_t>(one.body->input(named.name));
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
    try {
      const TracedMatrix result = program(*one.body, input);
      for (std::size_t d = 0; d < in[0]->value.size(); ++d) {
        const Nodes column = result.moves() ? result.slopes[d] : zeros(result.shape);
        out.value.insert(out.value.end(), column.begin(), column.end());
      }
    } catch (const NoFormula&) {
      graph_.return_to(before);
      out.value.clear();
      return false;
    }
    return true;
  }

  // --- Slopes, of what has a formula for its value. ---

  Nodes slope(const Instruction& one, const Operands& in, std::size_t d, const TracedMatrix& out) {
    const Nodes none;
    std::vector<Nodes> still(in.size());  // of what does not move
    std::vector<const Nodes*> slopes;
    for (std::size_t k = 0; k < in.size(); ++k) {
      if (!in[k]->moves()) still[k] = zeros(in[k]->shape);
      slopes.push_back(in[k]->moves() ? &in[k]->slopes[d] : &still[k]);
    }
    Nodes result;
    const auto each = [&](const auto& made) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(one.shape.size()); ++k)
        result.push_back(made(k));
      return result;
    };
    const auto value = [&](std::size_t operand, std::size_t k) { return in[operand]->value[k]; };
    const auto moved = [&](std::size_t operand, std::size_t k) { return (*slopes[operand])[k]; };
    /// factor times the slope of the first operand
    const auto along = [&](const auto& factor) {
      return each([&](std::size_t k) {
        return graph_.is_zero(moved(0, k)) ? zero() : graph_.multiply(factor(k), moved(0, k));
      });
    };
    switch (one.op) {
      case Op::add:
        return each([&](std::size_t k) { return graph_.add(moved(0, k), moved(1, k)); });
      case Op::subtract:
        return each([&](std::size_t k) { return graph_.subtract(moved(0, k), moved(1, k)); });
      case Op::elementwise_product:
        return each([&](std::size_t k) {
          return graph_.add(graph_.multiply(value(1, k), moved(0, k)),
                            graph_.multiply(value(0, k), moved(1, k)));
        });
      case Op::scale:
        return each([&](std::size_t k) {
          return graph_.add(graph_.multiply(value(0, 0), moved(1, k)),
                            graph_.multiply(value(1, k), moved(0, 0)));
        });
      case Op::divide:
      case Op::elementwise_quotient: {
        const bool by_number = one.op == Op::divide;
        return each([&](std::size_t k) {
          const std::size_t by = by_number ? 0 : k;
          const int top = graph_.subtract(moved(0, k), graph_.multiply(out.value[k], moved(1, by)));
          return graph_.is_zero(top) ? top : graph_.divide(top, value(1, by));
        });
      }
      case Op::multiply:
        return product_slope(*in[0], *slopes[0], *in[1], *slopes[1]);
      case Op::power:
        return power_slope(*in[0], *slopes[0], one.attributes[0]);
      case Op::elementwise_power: {
        const int exponent = one.attributes[0];
        if (exponent == 0) return zeros(one.shape);
        return along([&](std::size_t k) {
          return graph_.multiply(number(exponent), power(value(0, k), exponent - 1));
        });
      }
      case Op::real_power:
        return each([&](std::size_t k) { return real_power_slope(in, slopes, k, out.value[k]); });
      case Op::exp:
        return along([&](std::size_t k) { return out.value[k]; });
      case Op::log:
        return along([&](std::size_t k) { return graph_.divide(number(1), value(0, k)); });
      case Op::sqrt:
        return along([&](std::size_t k) {
          return graph_.divide(number(1), graph_.multiply(number(2), out.value[k]));
        });
      case Op::sin:
        return along([&](std::size_t k) { return graph_.apply(ScalarOp::cos, value(0, k)); });
      case Op::cos:
        return along(
            [&](std::size_t k) { return graph_.negate(graph_.apply(ScalarOp::sin, value(0, k))); });
      case Op::tanh:
        return along([&](std::size_t k) {
          return graph_.subtract(number(1), graph_.multiply(out.value[k], out.value[k]));
        });
      case Op::abs:
        return each([&](std::size_t k) {
          return graph_.where(false, value(0, k), moved(0, k), graph_.negate(moved(0, k)));
        });
      case Op::sign:
      case Op::floor:
        return zeros(one.shape);
      case Op::mod:
        return each([&](std::size_t k) {
          const int turns = graph_.apply(
              ScalarOp::floor,
              graph_.add(graph_.divide(graph_.subtract(value(0, k), out.value[k]), value(1, k)),
                         number(0.5)));
          return graph_.subtract(moved(0, k), graph_.multiply(turns, moved(1, k)));
        });
      case Op::atan2:
        return each([&](std::size_t k) {
          const int y = value(0, k), x = value(1, k);
          const int top =
              graph_.subtract(graph_.multiply(x, moved(0, k)), graph_.multiply(y, moved(1, k)));
          const int squares = graph_.add(graph_.multiply(x, x), graph_.multiply(y, y));
          return graph_.is_zero(top) ? top : graph_.divide(top, squares);
        });
      case Op::minimum:
        return each([&](std::size_t k) {
          return graph_.where(true, graph_.subtract(value(0, k), value(1, k)), moved(1, k),
                              moved(0, k));
        });
      case Op::maximum:
        return each([&](std::size_t k) {
          return graph_.where(true, graph_.subtract(value(1, k), value(0, k)), moved(1, k),
                              moved(0, k));
        });
      case Op::where: {
        const bool strict = one.attributes[0] != 0;
        return each([&](std::size_t k) {
          return graph_.where(strict, value(0, k), moved(1, k), moved(2, k));
        });
      }
      case Op::inverse: {  // -R A' R
        const auto left = product(one.shape, out.value, one.shape, *slopes[0]);
        const auto all =
            left ? product(one.shape, *left, one.shape, out.value) : std::optional<Nodes>();
        if (!all) throw NoFormula();
        return each([&](std::size_t k) { return graph_.negate((*all)[k]); });
      }
      case Op::norm: {
        int sum = zero();
        for (std::size_t k = 0; k < in[0]->value.size(); ++k)
          sum = graph_.add(sum, graph_.multiply(value(0, k), moved(0, k)));
        return {graph_.is_zero(sum) ? sum : graph_.divide(sum, out.value[0])};
      }
      default:
        break;
    }
    const auto of = [&](const TracedMatrix& operand) -> const Nodes& {
      const auto at =
          static_cast<std::size_t>(std::find(in.begin(), in.end(), &operand) - in.begin());
      return *slopes[at];
    };
    if (!linear(one, in, of, result)) throw NoFormula();
    return result;
  }

  Nodes product_slope(const TracedMatrix& a, const Nodes& da, const TracedMatrix& b,
                      const Nodes& db) {
    auto left = product(a.shape, da, b.shape, b.value);
    const auto right = product(a.shape, a.value, b.shape, db);
    if (!left || !right) throw NoFormula();
    for (std::size_t k = 0; k < left->size(); ++k) (*left)[k] = graph_.add((*left)[k], (*right)[k]);
    return std::move(*left);
  }

  Nodes power_slope(const TracedMatrix& in, const Nodes& moved, int exponent) {
    TracedMatrix square{in.shape, in.value, {moved}};
    TracedMatrix result{in.shape, zeros(in.shape), {zeros(in.shape)}};
    for (int k = 0; k < in.shape.rows; ++k) result.value[at_of(in.shape, k, k)] = number(1);
    const auto times = [&](const TracedMatrix& a, const TracedMatrix& b) {
      auto value = product(a.shape, a.value, b.shape, b.value);
      if (!value) throw NoFormula();
      return TracedMatrix{
          a.shape, std::move(*value), {product_slope(a, a.slopes[0], b, b.slopes[0])}};
    };
    for (; exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) result = times(result, square);
      if (exponent > 1) square = times(square, square);
    }
    return result.slopes[0];
  }

  /// b a^(b - 1) da + a^b log(a) db.
  int real_power_slope(const Operands& in, const std::vector<const Nodes*>& slopes, std::size_t k,
                       int out) {
    const int a = in[0]->value[k], b = in[1]->value[k];
    int sum = zero();
    if (const int da = (*slopes[0])[k]; !graph_.is_zero(da) && !graph_.is_zero(b)) {
      const int lower = graph_.apply(ScalarOp::power, a, graph_.subtract(b, number(1)));
      sum = graph_.multiply(graph_.multiply(b, lower), da);
    }
    if (const int db = (*slopes[1])[k]; !graph_.is_zero(db))
      sum = graph_.add(sum,
                       graph_.multiply(graph_.multiply(out, graph_.apply(ScalarOp::log, a)), db));
    return sum;
  }

  ScalarGraph& graph_;
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
