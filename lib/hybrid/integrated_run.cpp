#include "hybrid/integrated_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/number.h"
#include "hybrid/ball.h"

namespace gainsmith::hybrid {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
constexpr double kSharper = 1e-2;
constexpr double kNoTime = 1e-14;  ///< of the time so far: a flow that only rounding made
constexpr double kShorter = 0.25;  ///< longest step

/// Where A and B happen to agree, samples beside it and a margin speak for the error.
constexpr Index kBeside = 2;
constexpr double kMargin = 4;

/// A value that errs by its rounding, in turns up and down.
numbers::Matrix with_rounding(const Ball<double>& value, double up) {
  numbers::Matrix result(value.mid.rows(), value.mid.cols());
  for (Index e = 0; e < result.size(); ++e)
    result(e) = value.mid(e) + (e % 2 == 0 ? up : -up) * value.rad(e);
  return result;
}

bool is_within_range(const VectorXd& x) { return (x.array().abs() <= kLargestState).all(); }

}  // namespace

SharedFlows::SharedFlows(const System& system, const Scenario& scenario,
                         const Coordinates& coordinates, std::vector<Index> integrals)
    : coordinates_(&coordinates),
      constants_(in_double(coordinates.constants)),
      integrals_(std::move(integrals)),
      longest_(std::max(system.high, system.first_high)),
      start_(ClockedFlow::start_of(system, scenario.starts, coordinates, constants_, integrals_)) {}

const ClockedFlow* SharedFlows::to(double relative) {
  if (!start_) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto known = made_.find(relative);
  if (known != made_.end()) return known->second.get();
  std::unique_ptr<const ClockedFlow>& flow = made_[relative];
  try {
    flow = std::make_unique<ClockedFlow>(*coordinates_, constants_, *start_, integrals_, longest_,
                                         relative);
  } catch (const IntegrationError&) {
  }
  return flow.get();
}

IntegratedSimulator::IntegratedSimulator(const System& system, const Scenario& scenario,
                                         const Coordinates& coordinates, SharedFlows* shared)
    : system_(&system),
      scenario_(&scenario),
      coordinates_(&coordinates),
      shared_(shared),
      constants_(in_double(coordinates.constants)),
      starts_(scenario.starts, system),
      rate_(coordinates, constants_) {
  const StateLayout& layout = coordinates.layout;
  for (const auto& [name, value] : coordinates.constants)
    balls_.emplace(name, ball_of<double>(value));
  for (const Coordinate& one : coordinates.list) {
    begin_.emplace_back(one.start, system.layout, constants_);
    after_.push_back(one.jump ? std::make_unique<PointFunction>(*one.jump, layout, constants_)
                              : nullptr);
    begin_balls_.emplace_back(one.start, system.layout, balls_);
    after_balls_.push_back(
        one.jump ? std::make_unique<BallFunction<double>>(*one.jump, layout, balls_) : nullptr);
  }
  copies_.push_back(make_copy());
  copies_.push_back(make_copy());
}

IntegratedSimulator::Copy IntegratedSimulator::make_copy() {
  const auto moving = static_cast<Index>(rate_.elements().size());
  const VectorXd all = VectorXd::Zero(coordinates_->layout.size);
  return {all, all, VectorXd::Zero(moving),
          Integrator(moving, [this](double t, const VectorXd& x, VectorXd& slope) {
            rate_(*flow_start_, flow_timer_, t, x, slope);
          })};
}

VectorXd IntegratedSimulator::absolute(const VectorXd& x, double relative, double interval) {
  constexpr double kBelow = 1e-2;
  constexpr double kOfOthers = 1e-4;
  VectorXd sizes = VectorXd::Zero(x.size());
  double largest = 0;
  for (std::size_t i = 0; i < coordinates_->list.size(); ++i) {
    if (!rate_.is_integrated(i)) continue;
    const Slot& slot = coordinates_->layout.slots[i];
    const double size = x.segment(slot.offset, slot.shape.size()).lpNorm<Eigen::Infinity>();
    sizes.segment(slot.offset, slot.shape.size()).setConstant(size);
    largest = std::max(largest, size);
  }
  return (kBelow * relative *
          sizes.cwiseMax(kOfOthers * std::max(largest, reach(x, interval))))(rate_.elements())
      .cwiseMax(1e-250);
}

/// How far the rates at x lead in the time of the flow.
double IntegratedSimulator::reach(const VectorXd& x, double interval) {
  double largest = 0;
  VectorXd slope(static_cast<Index>(rate_.elements().size()));
  for (const double part : {0.0, 0.5, 1.0}) {
    try {
      rate_(x, flow_timer_, part * interval, x(rate_.elements()), slope);
    } catch (const InputError&) {
      continue;  // the integration says so where it matters
    }
    if (slope.size() > 0 && slope.allFinite())
      largest = std::max(largest, interval * slope.lpNorm<Eigen::Infinity>());
  }
  return largest;
}

void IntegratedSimulator::append(double t, std::int64_t j, double timer, double timer_bound) {
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
VectorXd IntegratedSimulator::difference() const {
  VectorXd result = (copies_[0].x - copies_[1].x).cwiseAbs();
  for (const Slot& slot : coordinates_->layout.slots) {
    auto part = result.segment(slot.offset, slot.shape.size());
    if (part.size() > 0) part.setConstant(part.maxCoeff());
  }
  return result;
}

/// Of the samples since the last jump, once all are there.
void IntegratedSimulator::set_bounds() {
  const std::size_t last = track_.samples() - 1;
  const Eigen::Map<numbers::Matrix> bounds(track_.bounds.data(), track_.size,
                                           static_cast<Index>(track_.samples()));
  const numbers::Matrix own = bounds.rightCols(static_cast<Index>(last - flow_first_ + 1));
  for (std::size_t k = flow_first_; k <= last; ++k) {
    const auto at = static_cast<Index>(k - flow_first_);
    const Index from = std::max<Index>(at - kBeside, 0);
    const Index to = std::min<Index>(at + kBeside, own.cols() - 1);
    Eigen::Map<VectorXd>(track_.bounds.data() + static_cast<Index>(k) * track_.size, track_.size) =
        kMargin * own.middleCols(from, to - from + 1).rowwise().maxCoeff() +
        8 * kUnit * track_.state(k).cwiseAbs();
  }
}

void IntegratedSimulator::begin(std::uint64_t run, RandomStream& random) {
  const VectorXd drawn = starts_(run, random);
  for (std::size_t i = 0; i < begin_.size(); ++i) {
    const Slot& slot = coordinates_->layout.slots[i];
    copies_[1].x.segment(slot.offset, slot.shape.size()) = begin_[i](drawn, 0).reshaped();
    copies_[0].x.segment(slot.offset, slot.shape.size()) =
        with_rounding(begin_balls_[i](drawn, VectorXd::Zero(drawn.size()), 0, 0), rounding_)
            .reshaped();
  }
  for (Copy& copy : copies_) copy.integrator.reset();
}

/// Both copies to the time t of the flow, or to their end.
void IntegratedSimulator::advance(double t) {
  constexpr double kSame = 1e-6;
  std::vector<IntegrationError> ends;
  for (Copy& copy : copies_) {
    flow_start_ = &copy.start;
    if (copy.shared != nullptr) {
      (*copy.shared)(copy.start, t, copy.x);
      copy.moving = copy.x(rate_.elements());
      rate_.place(copy.start, t, copy.moving, copy.x);
      continue;
    }
    try {
      copy.integrator.advance(t, copy.moving);
      rate_.place(copy.start, t, copy.moving, copy.x);
    } catch (const IntegrationError& error) {
      ends.push_back(error);
    }
  }
  if (ends.empty()) return;
  const bool certain = ends.size() == 2 && ends[0].escaped && ends[1].escaped &&
                       std::abs(ends[0].t - ends[1].t) <= kSame * t;
  track_.termination = certain ? Termination::undefined : Termination::lost;
  track_.message =
      std::string(ends.back().what()) + ", " + brief(ends.back().t) + " after the last jump";
}

void IntegratedSimulator::flow(double interval, double relative) {
  const double start = track_.t.back();
  const std::int64_t jumps = track_.j.back();
  flow_timer_ = track_.timer.back();
  double accuracy = relative;
  double longest = interval / kPieces;
  for (Copy& copy : copies_) {
    copy.start = copy.x;
    copy.shared = shared_ != nullptr ? shared_->to(accuracy) : nullptr;
    flow_start_ = &copy.start;
    if (copy.shared == nullptr && interval > kNoTime * start)
      copy.integrator.start(0, copy.x(rate_.elements()), interval, accuracy,
                            absolute(copy.x, accuracy, interval), longest);
    accuracy *= kSharper;
    longest *= kShorter;
  }
  if (interval > 0 && interval <= kNoTime * start) {
    track_.moves.push_back({false, {FlowStep::kRest, interval}});
    append(start + interval, jumps, flow_timer_ - interval, kUnit * flow_timer_);
    return set_bounds();
  }
  for (int piece = 1; piece <= kPieces && interval > 0; ++piece) {
    const double t = piece == kPieces ? interval : interval * piece / kPieces;
    advance(t);
    if (track_.termination != Termination::horizon) break;
    track_.moves.push_back({false, {FlowStep::kRest, interval / kPieces}});
    const double left = flow_timer_ - t;
    append(start + t, jumps, left, left == 0 ? 0 : 4 * kUnit * flow_timer_);
    if (track_.termination != Termination::horizon) break;
  }
  set_bounds();
}

void IntegratedSimulator::jump(VectorXd& x) {
  VectorXd after = x;
  for (std::size_t i = 0; i < after_.size(); ++i) {
    if (after_[i] == nullptr) continue;
    const Slot& slot = coordinates_->layout.slots[i];
    after.segment(slot.offset, slot.shape.size()) = (*after_[i])(x, 0).reshaped();
  }
  x = after;
}

void IntegratedSimulator::jump_with_rounding(VectorXd& x) {
  VectorXd after = x;
  const VectorXd exact = VectorXd::Zero(x.size());
  for (std::size_t i = 0; i < after_balls_.size(); ++i) {
    if (after_balls_[i] == nullptr) continue;
    const Slot& slot = coordinates_->layout.slots[i];
    after.segment(slot.offset, slot.shape.size()) =
        with_rounding((*after_balls_[i])(x, exact, 0, 0), rounding_).reshaped();
  }
  x = after;
}

void IntegratedSimulator::lose(const std::string& why) {
  track_.termination = Termination::lost;
  track_.message = why;
}

void IntegratedSimulator::jump(double reset_value) {
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

const Track<double>& IntegratedSimulator::run(std::uint64_t seed, std::uint64_t run,
                                              double relative, Rounding rounding) {
  track_.clear();
  track_.size = coordinates_->layout.size;
  track_.accuracy = relative;
  rounding_ = rounding == Rounding::up ? 2 : -2;
  flow_first_ = 0;
  RandomStream random(seed, run);
  const Law& law = scenario_->laws[run % scenario_->laws.size()];
  try {
    begin(run, random);
    append(0, 0, first_timer(*system_, *scenario_, random), 0);
    for (std::size_t jumps = 0;; ++jumps) {
      const double left = scenario_->horizon - track_.t.back();
      const bool jumps_again = expires(track_.timer.back(), track_.t.back(), scenario_->horizon);
      flow(jumps_again ? track_.timer.back() : left, relative);
      if (track_.termination != Termination::horizon || !jumps_again) return track_;
      if (track_.j.back() >= scenario_->jump_limit) {
        track_.termination = Termination::jump_limit;
        return track_;
      }
      jump(law.reset_value(jumps, track_.t.back(), random));
      if (track_.termination != Termination::horizon || track_.t.back() >= scenario_->horizon) {
        set_bounds();
        return track_;
      }
    }
  } catch (const InputError& error) {
    track_.message = error.what();
  }
  track_.termination = Termination::undefined;
  return track_;
}

}  // namespace gainsmith::hybrid
