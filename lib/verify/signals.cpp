#include "verify/signals.h"

#include <algorithm>

namespace gainsmith::verify {

using Eigen::Index;

namespace {

/// values: elements x count; the last point fills the lanes that are left.
void fill(numbers::Pack& pack, const Eigen::Ref<const numbers::Matrix>& values) {
  const Index count = values.cols();
  pack.lanes.topRows(count) = values.transpose().array();
  if (count < numbers::Pack::kLanes)
    pack.lanes.bottomRows(numbers::Pack::kLanes - count) =
        pack.lanes.row(count - 1).replicate(numbers::Pack::kLanes - count, 1);
}

}  // namespace

AlongFunction::AlongFunction(const expr::Program& program, const hybrid::System& system)
    : uses_timer_(program.uses(system.layout.timer)),
      evaluator_(program),
      elements_(program.shape().size()) {
  constants_.reserve(program.inputs.size());
  for (const expr::Input& input : program.inputs) {
    const auto known = system.constants.find(input.name);
    if (known == system.constants.end()) continue;
    constants_.push_back(numbers::constant_pack(known->second));
    evaluator_.fix(input.name, constants_.back());
  }
  const auto moving = [](expr::Shape shape) {
    return numbers::Pack{false,
                         shape.rows,
                         shape.cols,
                         {},
                         Eigen::ArrayXXd::Zero(numbers::Pack::kLanes, shape.size())};
  };
  for (const hybrid::Slot& slot : system.layout.slots)
    if (program.uses(slot.name)) slots_.push_back(slot);
  for (const hybrid::Slot& slot : slots_) moving_.push_back(moving(slot.shape));
  moving_.push_back(moving({1, 1}));
  for (std::size_t i = 0; i < slots_.size(); ++i) evaluator_.set(slots_[i].name, moving_[i]);
  evaluator_.set(system.layout.timer, moving_.back());
}

numbers::Matrix AlongFunction::operator()(const Eigen::Ref<const numbers::Matrix>& states,
                                          const Eigen::Ref<const Eigen::VectorXd>& timers) {
  numbers::Matrix values(elements_, timers.size());
  for (Index first = 0; first < timers.size(); first += numbers::Pack::kLanes) {
    const Index count = std::min<Index>(numbers::Pack::kLanes, timers.size() - first);
    for (std::size_t i = 0; i < slots_.size(); ++i)
      fill(moving_[i], states.block(slots_[i].offset, first, slots_[i].shape.size(), count));
    if (uses_timer_) fill(moving_.back(), timers.segment(first, count).transpose());
    const numbers::Pack& result = evaluator_.run();
    if (result.same) {
      values.middleCols(first, count) = result.matrix.reshaped().replicate(1, count);
    } else {
      values.middleCols(first, count) = result.lanes.topRows(count).matrix().transpose();
    }
  }
  return values;
}

}  // namespace gainsmith::verify
