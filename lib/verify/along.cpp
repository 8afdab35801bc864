#include "verify/along.h"

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

Eigen::VectorXd integrate_steps(const hybrid::Arc& arc, const hybrid::FlowSteps& steps,
                                AlongFunction& integrand) {
  constexpr Index kNodes = hybrid::FlowSteps::kNodes;
  constexpr Index kBatch = numbers::Pack::kLanes / kNodes;
  const auto& positions = hybrid::FlowSteps::node_positions();
  const Eigen::Map<const Eigen::VectorXd> weights(hybrid::FlowSteps::node_weights().data(), kNodes);

  Eigen::VectorXd integrals = Eigen::VectorXd::Zero(static_cast<Index>(arc.moves.size()));
  numbers::Matrix states(arc.size, numbers::Pack::kLanes);
  Eigen::VectorXd timers(numbers::Pack::kLanes);
  std::vector<std::size_t> batch;  // the moves whose nodes wait in `states`
  const auto finish = [&] {
    const auto count = static_cast<Index>(batch.size()) * kNodes;
    if (count == 0) return;
    const numbers::Matrix values = integrand(states.leftCols(count), timers.head(count));
    for (std::size_t i = 0; i < batch.size(); ++i)
      integrals(static_cast<Index>(batch[i])) =
          arc.moves[batch[i]].step.length *
          values.row(0).segment(static_cast<Index>(i) * kNodes, kNodes).dot(weights);
    batch.clear();
  };
  for (std::size_t k = 0; k < arc.moves.size(); ++k) {
    if (arc.moves[k].jump) continue;
    const hybrid::FlowStep& step = arc.moves[k].step;
    const Index at = static_cast<Index>(batch.size()) * kNodes;
    steps.nodes(step, arc.state(k), states.middleCols(at, kNodes));
    for (Index i = 0; i < kNodes; ++i)
      timers(at + i) = arc.timer[k] - positions[static_cast<std::size_t>(i)] * step.length;
    batch.push_back(k);
    if (static_cast<Index>(batch.size()) == kBatch) finish();
  }
  finish();
  return integrals;
}

}  // namespace gainsmith::verify
