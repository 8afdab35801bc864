#include "numbers/graph/affine_flow_map.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/derivative.h"
#include "expr/program/assembly.h"
#include "numbers/types/degree.h"

namespace gainsmith::numbers {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Program;
using expr::Shape;

/// The name of the state among the inputs of a rate.
constexpr const char* kState = "the variable";

bool is_affine(const Program& rate) {
  const auto degree = degrees(rate, [](const std::string& name) { return name == kState; });
  return degree[static_cast<std::size_t>(rate.result)] < kNotAffine;
}

/// Puts the program together. A is the jacobian of the rate at 0 and b its value there, which are
/// all of an affine rate.
class Exponential {
 public:
  explicit Exponential(const Instruction& of) : of_(of), rate_(*of.body), n_(of.shape.rows) {}

  Program take() {
    const int x = input(0, of_.shape);
    const int d = input(1, {});
    const int origin = add(Op::zeros, {}, of_.shape);
    const std::vector<int> others = inputs_of_rate(origin);
    const bool moves = rate_.uses(kState);  // and then it is the first input
    const int A =
        moves ? add(Op::jacobian, others, {n_, n_}, {}, of_.body) : add(Op::zeros, {}, {n_, n_});
    const int b = rate_at(others);
    const int one = assembly_.add({Op::constant, {}, {}, {}, "1", of_.origin, of_.offset});
    const int identity = add(Op::identity, {one}, {n_, n_});
    const int rest = add(Op::zeros, {}, {n_, 2 * n_});
    const int top = add(Op::blocks, {A, identity}, {n_, 2 * n_}, {2});
    const int whole = add(Op::blocks, {top, rest}, {2 * n_, 2 * n_}, {1});
    const int moved = add(Op::matrix_exponential, {add(Op::scale, {d, whole}, {2 * n_, 2 * n_})},
                          {2 * n_, 2 * n_});
    const int E = add(Op::index, {moved}, {n_, 2 * n_}, {0, n_, 0, 2 * n_});
    const int from = add(Op::blocks, {x, b}, {2 * n_, 1}, {1});
    return expr::with_derivatives(assembly_.extract(add(Op::multiply, {E, from}, of_.shape)));
  }

 private:
  int add(Op op, std::vector<int> operands, Shape shape, expr::Attributes attributes = {},
          std::shared_ptr<const Program> body = nullptr) {
    return assembly_.add(
        {op, std::move(operands), shape, attributes, {}, of_.origin, of_.offset, std::move(body)});
  }
  int input(std::size_t operand, Shape shape) {
    return assembly_.add_input(std::to_string(operand), shape, of_);
  }
  /// Instructions of the inputs of the rate, in their order, with `state` for the state.
  std::vector<int> inputs_of_rate(int state) {
    std::vector<int> inputs;
    for (const expr::Input& input : rate_.inputs) {
      const std::string operand = input.name.substr(input.name.find_last_of(' ') + 1);
      inputs.push_back(input.name == kState ? state
                                            : assembly_.add_input(operand, input.shape, of_));
    }
    return inputs;
  }
  /// The rate with these instructions for its inputs.
  int rate_at(const std::vector<int>& inputs) {
    return assembly_.add_program(rate_, [&](const Instruction& instruction, const Instruction&) {
      return instruction.op == Op::input
                 ? std::optional(inputs[static_cast<std::size_t>(instruction.attributes[0])])
                 : std::nullopt;
    });
  }

  const Instruction& of_;
  const Program& rate_;
  int n_;
  expr::Assembly assembly_;
};

}  // namespace

std::optional<Program> affine_flow_map(const Instruction& flow_map) {
  const bool is_timed = flow_map.attributes[0] == 1;
  if (is_timed || flow_map.shape.cols != 1 || !is_affine(*flow_map.body)) return std::nullopt;
  return Exponential(flow_map).take();
}

}  // namespace gainsmith::numbers
