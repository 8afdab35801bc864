#include "hybrid/state_layout.h"

#include <algorithm>

namespace gainsmith::hybrid {

bool StateLayout::moves(const std::string& name) const {
  return name == timer || std::any_of(slots.begin(), slots.end(),
                                      [&](const Slot& slot) { return slot.name == name; });
}

StateLayout make_layout(const std::vector<model::Design::State>& states, const std::string& timer) {
  StateLayout layout;
  layout.timer = timer;
  for (const model::Design::State& state : states) {
    layout.slots.push_back({state.name, state.shape, layout.size});
    layout.size += state.shape.size();
  }
  return layout;
}

PointFunction::PointFunction(const expr::Program& program, const StateLayout& layout,
                             const numbers::Values& constants)
    : slots_(layout.slots), evaluator_(program) {
  for (const Slot& slot : slots_)
    moving_.push_back(numbers::Matrix::Zero(slot.shape.rows, slot.shape.cols));
  moving_.push_back(numbers::Matrix::Zero(1, 1));
  for (const expr::Input& input : program.inputs)
    if (const auto known = constants.find(input.name); known != constants.end())
      evaluator_.fix(input.name, known->second);
  for (std::size_t i = 0; i < slots_.size(); ++i) evaluator_.set(slots_[i].name, moving_[i]);
  evaluator_.set(layout.timer, moving_.back());
}

const numbers::Matrix& PointFunction::operator()(const Eigen::VectorXd& x, double tau) {
  for (std::size_t i = 0; i < slots_.size(); ++i)
    moving_[i].reshaped() = x.segment(slots_[i].offset, slots_[i].shape.size());
  moving_.back()(0, 0) = tau;
  return evaluator_.run();
}

}  // namespace gainsmith::hybrid
