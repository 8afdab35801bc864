#include "bounded/flow_rate.h"

namespace gainsmith::bounded {

using Eigen::Index;
using Eigen::VectorXd;

numbers::Values in_double(const numbers::ValuesOf<Decimal100>& values) {
  numbers::Values rounded;
  for (const auto& [name, value] : values)
    rounded[name] =
        value.unaryExpr([](const Decimal100& element) { return static_cast<double>(element); });
  return rounded;
}

FlowRate::FlowRate(const Coordinates& coordinates, const numbers::Values& constants)
    : clock_rates_(VectorXd::Zero(coordinates.layout.size)),
      point_(VectorXd::Zero(coordinates.layout.size)) {
  const hybrid::StateLayout& layout = coordinates.layout;
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const Coordinate& one = coordinates.list[i];
    const hybrid::Slot& slot = layout.slots[i];
    flow_.push_back(one.flow ? std::make_unique<hybrid::PointFunction>(*one.flow, layout, constants)
                             : nullptr);
    if (flow_.back() == nullptr) continue;
    if (one.rate_is_constant(layout)) {
      clock_rates_.segment(slot.offset, slot.shape.size()) = (*flow_.back())(point_, 0).reshaped();
      flow_.back().reset();
      continue;
    }
    for (Index e = 0; e < slot.shape.size(); ++e) elements_.push_back(slot.offset + e);
  }
}

void FlowRate::place(const VectorXd& start, double t, const VectorXd& moving, VectorXd& x) const {
  x = start + t * clock_rates_;
  x(elements_) = moving;
}

void FlowRate::operator()(const VectorXd& start, double timer, double t, const VectorXd& moving,
                          VectorXd& slope) {
  place(start, t, moving, point_);
  Index at = 0;
  for (const auto& entry : flow_) {
    if (entry == nullptr) continue;
    const numbers::Matrix& value = (*entry)(point_, timer - t);
    slope.segment(at, value.size()) = value.reshaped();
    at += value.size();
  }
}

}  // namespace gainsmith::bounded
