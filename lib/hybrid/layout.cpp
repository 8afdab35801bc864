#include "hybrid/layout.h"

#include <algorithm>

namespace gainsmith::hybrid {

bool Layout::moves(const std::string& name) const {
  return name == timer || std::any_of(slots.begin(), slots.end(),
                                      [&](const Slot& slot) { return slot.name == name; });
}

Layout make_layout(const std::vector<std::pair<std::string, expr::Shape>>& states,
                   const std::string& timer) {
  Layout layout;
  layout.timer = timer;
  for (const auto& [name, shape] : states) {
    layout.slots.push_back({name, shape, layout.size});
    layout.size += shape.size();
  }
  return layout;
}

std::vector<std::string> missing_values(const expr::Program& program, const Layout& layout,
                                        const numbers::Values& constants) {
  std::vector<std::string> missing;
  for (const expr::Input& input : program.inputs)
    if (!layout.moves(input.name) && !constants.contains(input.name)) missing.push_back(input.name);
  return missing;
}

PointFunction::PointFunction(const expr::Program& program, const Layout& layout,
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
