#include "simulate/function_31.h"

#include <stdexcept>

namespace gainsmith::simulate {

Function31::Function31(const expr::Program& program, const hybrid::System& system,
                       const Constants31& constants)
    : evaluator_(program) {
  std::vector<std::size_t> moving;
  for (std::size_t k = 0; k < program.inputs.size(); ++k) {
    const expr::Input& input = program.inputs[k];
    if (const auto slot = system.slot(input.name)) {
      inputs_.push_back(
          {system.layout.slots[*slot].offset, Matrix31::Zero(input.shape.rows, input.shape.cols)});
      moving.push_back(k);
    } else if (const auto known = constants.find(input.name); known != constants.end()) {
      evaluator_.fix(input.name, known->second);
    } else {
      throw std::logic_error("no value for the input " + input.name);
    }
  }
  for (std::size_t k = 0; k < moving.size(); ++k) evaluator_.set(moving[k], inputs_[k].value);
}

const Matrix31& Function31::operator()(const Values31& values) {
  for (Input& input : inputs_)
    input.value.reshaped() = values.segment(input.offset, input.value.size());
  return evaluator_.run();
}

}  // namespace gainsmith::simulate
