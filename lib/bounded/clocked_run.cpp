#include "bounded/clocked_run.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "bounded/ball.h"
#include "hybrid/trajectory.h"
#include "ode/integrator.h"
#include "ode/tolerances.h"

namespace gainsmith::bounded {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A value that errs by its rounding, in turns up and down.
numbers::Matrix with_rounding(const Ball<double>& value, double up) {
  numbers::Matrix result(value.mid.rows(), value.mid.cols());
  for (Index e = 0; e < result.size(); ++e)
    result(e) = value.mid(e) + (e % 2 == 0 ? up : -up) * value.rad(e);
  return result;
}

bool is_within_range(const VectorXd& x) { return (x.array().abs() <= hybrid::kLargestState).all(); }

}  // namespace

ClockedFlows::ClockedFlows(const SampledSystem& system, const hybrid::Scenario& scenario,
                           const Coordinates& coordinates, std::vector<Index> integrals)
    : coordinates_(&coordinates),
      constants_(in_double(coordinates.constants)),
      integrals_(std::move(integrals)),
      longest_(system.longest),
      start_(ClockedFlow::start_of(system, scenario, coordinates, constants_, integrals_)) {}

const ClockedFlow* ClockedFlows::to(double relative, double step) {
  if (!start_) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto known = made_.find({relative, step});
  if (known != made_.end()) return known->second.get();
  std::unique_ptr<const ClockedFlow>& flow = made_[{relative, step}];
  try {
    flow = std::make_unique<ClockedFlow>(*coordinates_, constants_, *start_, integrals_, longest_,
                                         relative, step);
  } catch (const ode::IntegrationError&) {
  }
  return flow.get();
}

ClockedSimulator::ClockedSimulator(const SampledSystem& system, const hybrid::Scenario& scenario,
                                   const Coordinates& coordinates, ClockedFlows& flows)
    : system_(&system),
      scenario_(&scenario),
      coordinates_(&coordinates),
      flows_(&flows),
      constants_(in_double(coordinates.constants)),
      rate_(coordinates, constants_) {
  const hybrid::StateLayout& layout = coordinates.layout;
  for (const auto& [name, value] : coordinates.constants)
    balls_.emplace(name, ball_of<double>(value));
  for (const Coordinate& one : coordinates.list) {
    begin_.emplace_back(one.start, system.layout, constants_);
    after_.push_back(one.jump
                         ? std::make_unique<hybrid::PointFunction>(*one.jump, layout, constants_)
                         : nullptr);
    begin_balls_.emplace_back(one.start, system.layout, balls_);
    after_balls_.push_back(
        one.jump ? std::make_unique<BallFunction<double>>(*one.jump, layout, balls_) : nullptr);
  }
  for (Copy& copy : copies_) copy.x = copy.start = VectorXd::Zero(layout.size);
}

void ClockedSimulator::append(double t, std::int64_t j, double timer, double timer_bound) {
  const VectorXd& x = copies_[1].x;
  track_.t.push_back(t);
  track_.j.push_back(j);
  track_.timer.push_back(timer);
  track_.timer_bound.push_back(timer_bound);
  const VectorXd bound = difference();
  track_.stacked.insert(track_.stacked.end(), x.data(), x.data() + x.size());
  track_.bounds.insert(track_.bounds.end(), bound.data(), bound.data() + bound.size());
  if (!is_within_range(x)) track_.termination = Termination::diverged;
}

/// The largest |A - B| of each state.
VectorXd ClockedSimulator::difference() const {
  VectorXd result = (copies_[0].x - copies_[1].x).cwiseAbs();
  for (const hybrid::Slot& slot : coordinates_->layout.slots) {
    auto part = result.segment(slot.offset, slot.shape.size());
    if (part.size() > 0) part.setConstant(part.maxCoeff());
  }
  return result;
}

/// Of the samples since the last jump, once all are there.
void ClockedSimulator::set_bounds() {
  const std::size_t last = track_.samples() - 1;
  const Eigen::Map<numbers::Matrix> bounds(track_.bounds.data(), track_.size,
                                           static_cast<Index>(track_.samples()));
  const numbers::Matrix own = bounds.rightCols(static_cast<Index>(last - flow_first_ + 1));
  for (std::size_t k = flow_first_; k <= last; ++k) {
    const auto at = static_cast<Index>(k - flow_first_);
    const Index from = std::max<Index>(at - kSamplesBeside, 0);
    const Index to = std::min<Index>(at + kSamplesBeside, own.cols() - 1);
    Eigen::Map<VectorXd>(track_.bounds.data() + static_cast<Index>(k) * track_.size, track_.size) =
        kErrorOfDifference * own.middleCols(from, to - from + 1).rowwise().maxCoeff() +
        8 * unit_roundoff<double>() * track_.state(k).cwiseAbs();
  }
}

void ClockedSimulator::begin(const VectorXd& drawn) {
  for (std::size_t i = 0; i < begin_.size(); ++i) {
    const hybrid::Slot& slot = coordinates_->layout.slots[i];
    copies_[1].x.segment(slot.offset, slot.shape.size()) = begin_[i](drawn, 0).reshaped();
    copies_[0].x.segment(slot.offset, slot.shape.size()) =
        with_rounding(begin_balls_[i](drawn, VectorXd::Zero(drawn.size()), 0, 0), rounding_)
            .reshaped();
  }
}

/// Both copies to the time t of the flow.
void ClockedSimulator::advance(double t) {
  for (Copy& copy : copies_) {
    (*copy.flow)(copy.start, t, copy.x);
    const VectorXd moving = copy.x(rate_.elements());
    rate_.place(copy.start, t, moving, copy.x);
  }
}

void ClockedSimulator::flow(double interval) {
  const double start = track_.t.back();
  const double timer = track_.timer.back();
  const std::int64_t jumps = track_.j.back();
  for (Copy& copy : copies_) copy.start = copy.x;
  for (int piece = 1; piece <= kPartsOfFlow && interval > 0; ++piece) {
    const double t = piece == kPartsOfFlow ? interval : interval * piece / kPartsOfFlow;
    advance(t);
    track_.moves.push_back({false, {FlowStep::kRest, interval / kPartsOfFlow}});
    const double left = timer - t;
    append(start + t, jumps, left, left == 0 ? 0 : 4 * unit_roundoff<double>() * timer);
    if (track_.termination != Termination::horizon) break;
  }
  set_bounds();
}

void ClockedSimulator::jump(VectorXd& x) {
  VectorXd after = x;
  for (std::size_t i = 0; i < after_.size(); ++i) {
    if (after_[i] == nullptr) continue;
    const hybrid::Slot& slot = coordinates_->layout.slots[i];
    after.segment(slot.offset, slot.shape.size()) = (*after_[i])(x, 0).reshaped();
  }
  x = after;
}

void ClockedSimulator::jump_with_rounding(VectorXd& x) {
  VectorXd after = x;
  const VectorXd exact = VectorXd::Zero(x.size());
  for (std::size_t i = 0; i < after_balls_.size(); ++i) {
    if (after_balls_[i] == nullptr) continue;
    const hybrid::Slot& slot = coordinates_->layout.slots[i];
    after.segment(slot.offset, slot.shape.size()) =
        with_rounding((*after_balls_[i])(x, exact, 0, 0), rounding_).reshaped();
  }
  x = after;
}

void ClockedSimulator::lose(const std::string& why) {
  track_.termination = Termination::lost;
  track_.message = why;
}

void ClockedSimulator::jump(double reset_value) {
  jump(copies_[1].x);
  try {
    jump_with_rounding(copies_[0].x);
  } catch (const InputError& error) {
    // The value hangs on rounding.
    return lose(error.what());
  }
  if (!copies_[0].x.allFinite() && copies_[1].x.allFinite())
    return lose("the rounding of a jump leaves nothing known");
  track_.moves.push_back({true, {}});
  flow_first_ = track_.samples();
  append(track_.t.back(), track_.j.back() + 1, reset_value, 0);
}

const Track<double>& ClockedSimulator::run(std::uint64_t seed, std::uint64_t run, double relative,
                                           Rounding rounding) {
  track_.clear();
  track_.size = coordinates_->layout.size;
  track_.accuracy = relative;
  rounding_ = rounding == Rounding::up ? 2 : -2;
  flow_first_ = 0;
  copies_[0].flow = flows_->to(relative);
  copies_[1].flow = flows_->to(kSharper * relative, ode::kShorter);
  SampledDraws draws(*system_, *scenario_, seed, run);
  try {
    begin(draws.start());
    append(0, 0, draws.length(), 0);
    if (copies_[0].flow == nullptr || copies_[1].flow == nullptr) {
      lose("the flow cannot be integrated so accurately");
      return track_;
    }
    const bool ends_with_jump = flow_and_jump(
        draws, scenario_->horizon, track_, [&](double interval) { flow(interval); },
        [&](double length) { jump(length); });
    if (ends_with_jump) set_bounds();
    return track_;
  } catch (const InputError& error) {
    track_.message = error.what();
  }
  track_.termination = Termination::undefined;
  return track_;
}

}  // namespace gainsmith::bounded
