#include <optional>
#include <string>
#include <utility>

#include "expr/binding/partial_derivative.h"
#include "numbers/graph/exponential_formula.h"
#include "numbers/graph/scalar_rules.h"
#include "numbers/types/shared_rules.h"

namespace gainsmith::numbers {

namespace {

using expr::Instruction;
using expr::Op;

class Slopes : public NodeRules {
 public:
  Slopes(ScalarGraph& graph, Derivative kind) : NodeRules(graph), kind_(kind) {}

  Nodes operator()(const Instruction& instruction, const TracedOperands& in, std::size_t d,
                   const TracedMatrix& out) {
    std::vector<Nodes> still(in.size());  // of what does not move
    std::vector<const Nodes*> slopes;
    for (std::size_t k = 0; k < in.size(); ++k) {
      if (!in[k]->moves()) still[k] = zeros(in[k]->shape);
      slopes.push_back(in[k]->moves() ? &in[k]->slopes[d] : &still[k]);
    }
    Nodes result;
    const auto each = [&](const auto& made) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(instruction.shape.size()); ++k)
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
    // The rate of a root at 0 has a rule of its own.
    if (expr::has_derivatives(instruction.op) &&
        !(instruction.op == Op::sqrt && kind_ == Derivative::rate))
      return each([&](std::size_t k) { return function_slope(instruction.op, in, slopes, k); });
    switch (instruction.op) {
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
        const bool by_number = instruction.op == Op::divide;
        return each([&](std::size_t k) {
          const std::size_t by = by_number ? 0 : k;
          const int top = graph_.subtract(moved(0, k), graph_.multiply(out.value[k], moved(1, by)));
          return graph_.is_zero(top) ? top : graph_.divide(top, value(1, by));
        });
      }
      case Op::multiply:
        return product_slope(*in[0], *slopes[0], *in[1], *slopes[1]);
      case Op::power:
        return power_slope(*in[0], *slopes[0], instruction.attributes[0]);
      case Op::elementwise_power: {
        const int exponent = instruction.attributes[0];
        if (exponent == 0) return zeros(instruction.shape);
        return along([&](std::size_t k) {
          return graph_.multiply(number(exponent), power(value(0, k), exponent - 1));
        });
      }
      case Op::sqrt:
        return along([&](std::size_t k) {
          return graph_.divide(number(1), graph_.multiply(number(2), divisor(out.value[k])));
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
        const bool strict = instruction.attributes[0] != 0;
        return each([&](std::size_t k) {
          return graph_.where(strict, value(0, k), moved(1, k), moved(2, k));
        });
      }
      case Op::inverse: {  // -R A' R
        const auto left = product(instruction.shape, out.value, instruction.shape, *slopes[0]);
        const auto all = left ? product(instruction.shape, *left, instruction.shape, out.value)
                              : std::optional<Nodes>();
        if (!all) throw NoFormula();
        return each([&](std::size_t k) { return graph_.negate((*all)[k]); });
      }
      case Op::matrix_exponential:
        return exponential_slope(instruction, *in[0], *slopes[0], out);
      case Op::norm: {
        int sum = zero();
        for (std::size_t k = 0; k < in[0]->value.size(); ++k)
          sum = graph_.add(sum, graph_.multiply(value(0, k), moved(0, k)));
        return {graph_.is_zero(sum) ? sum : graph_.divide(sum, divisor(out.value[0]))};
      }
      default:
        break;
    }
    if (!linear(instruction, in, slopes, result)) throw NoFormula();
    return result;
  }

 private:
  /// A root by which the derivative of its square is divided.
  int divisor(int root) {
    return kind_ == Derivative::rate ? graph_.where(true, root, root, number(1)) : root;
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
    TracedMatrix traced_matrix{in.shape, zeros(in.shape), {zeros(in.shape)}};
    for (int k = 0; k < in.shape.rows; ++k) traced_matrix.value[at(in.shape, k, k)] = number(1);
    const auto times = [&](const TracedMatrix& a, const TracedMatrix& b) {
      auto value = product(a.shape, a.value, b.shape, b.value);
      if (!value) throw NoFormula();
      return TracedMatrix{
          a.shape, std::move(*value), {product_slope(a, a.slopes[0], b, b.slopes[0])}};
    };
    const TracedMatrix base{in.shape, in.value, {moved}};
    return whole_power(traced_matrix, base, exponent, times).slopes[0];
  }

  /// The upper right of exp([X, dX; 0, X]).
  Nodes exponential_slope(const Instruction& instruction, const TracedMatrix& in,
                          const Nodes& moved, const TracedMatrix& out) {
    const int n = instruction.shape.rows;
    if (n == 1) return {graph_.multiply(out.value[0], moved[0])};
    const auto argument = as_multiple(in.value, n, graph_);
    const auto rate = as_multiple(moved, n, graph_);
    if (argument && rate && argument->factor == rate->factor) {  // ds/dt A e^(A s)
      auto slope = product(in.shape, traced(rate->factor, graph_).value, out.shape, out.value);
      if (!slope) throw NoFormula();
      for (int& node : *slope) node = graph_.multiply(rate->number, node);
      return std::move(*slope);
    }
    const expr::Shape both{2 * n, 2 * n};
    Nodes operand = zeros(both);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::size_t from = at(in.shape, i, j);
        operand[at(both, i, j)] = operand[at(both, n + i, n + j)] = in.value[from];
        operand[at(both, i, n + j)] = moved[from];
      }
    Instruction larger = instruction;
    larger.shape = both;
    const Nodes whole = block_of({larger, {operand}, {both}});
    Nodes result;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) result.push_back(whole[at(both, i, n + j)]);
    return result;
  }

  /// Of an element of a function of numbers.
  int function_slope(Op op, const TracedOperands& in, const std::vector<const Nodes*>& slopes,
                     std::size_t element) {
    const auto input = [&](const expr::Input& operand) -> TracedMatrix {
      return {operand.shape, {in[std::stoul(operand.name)]->value[element]}};
    };
    int sum = zero();
    for (std::size_t k = 0; k < in.size(); ++k) {
      const int moved = (*slopes[k])[element];
      if (graph_.is_zero(moved)) continue;
      const int factor = trace(expr::partial_derivative(op, k), input, graph_).value[0];
      sum = graph_.add(sum, graph_.multiply(factor, moved));
    }
    return sum;
  }

  Derivative kind_;
};

}  // namespace

Nodes slope(ScalarGraph& graph, const Instruction& instruction, const TracedOperands& in,
            std::size_t d, const TracedMatrix& out, Derivative kind) {
  return Slopes(graph, kind)(instruction, in, d, out);
}

}  // namespace gainsmith::numbers
