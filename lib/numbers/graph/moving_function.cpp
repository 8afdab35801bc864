#include "numbers/graph/moving_function.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "expr/program/assembly.h"

namespace gainsmith::numbers {

namespace {

/// The derivative of a program by its input number `by`, elements x elements of that input.
expr::Program derivative(const expr::Program& of, std::size_t by) {
  const expr::Instruction& like = of.code[static_cast<std::size_t>(of.result)];
  const expr::Shape shape{of.shape().size(), of.inputs[by].shape.size()};
  auto body = std::make_shared<expr::Program>(of);
  const auto at = body->inputs.begin() + static_cast<std::ptrdiff_t>(by);
  std::rotate(body->inputs.begin(), at, at + 1);  // a jacobian is by the first input
  for (expr::Instruction& instruction : body->code) {
    int& input = instruction.attributes[0];
    const int last = static_cast<int>(by);
    if (instruction.op == expr::Op::input && input <= last) input = input == last ? 0 : input + 1;
  }
  expr::Assembly assembly;
  std::vector<int> operands;
  for (const expr::Input& input : body->inputs)
    operands.push_back(assembly.add_input(input.name, input.shape, like));
  return assembly.extract(assembly.add({expr::Op::jacobian,
                                        std::move(operands),
                                        shape,
                                        {},
                                        {},
                                        like.origin,
                                        like.offset,
                                        std::move(body)}));
}

}  // namespace

MovingFunction::MovingFunction(const expr::Program& program, const PlaceOfInput& place,
                               const std::function<bool(const std::string&)>& moves,
                               Eigen::Index size) {
  std::vector<const expr::Program*> programs = {&program};
  for (std::size_t k = 0; k < program.inputs.size(); ++k) {
    const std::string& name = program.inputs[k].name;
    if (!moves(name)) continue;
    places_.push_back(*place(name));
    programs.push_back(&derivatives_.emplace_back(derivative(program, k)));
  }
  functions_.emplace(std::move(programs), place, none_, size);
}

void MovingFunction::go_to(const Eigen::VectorXd& point) {
  point_ = &point;
  is_known_ = functions_->run(point);
}

void MovingFunction::add_slope(double factor, const Matrix& moves, Eigen::Ref<Matrix> to) {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Matrix& by = of(k + 1);
    to += factor * by.lazyProduct(moves.middleRows(places_[k], by.cols()));
  }
}

}  // namespace gainsmith::numbers
