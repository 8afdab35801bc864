#include "bounded/bounded_run.h"
#include "hybrid/trajectory.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "bounded/small_size.h"

namespace gainsmith::bounded {

using Eigen::Index;
using numbers::Matrix;
using numbers::MatrixOf;

template <class Scalar>
BoundedSimulator<Scalar>::BoundedSimulator(const SampledSystem& system,
                                           const hybrid::Scenario& scenario, const FlowSteps& steps,
                                           const BoundedSystem<Scalar>& bounded)
    : system_(&system), scenario_(&scenario), cutting_(&steps), bounded_(&bounded) {
  for (std::size_t i = 0; i < system.variable.size(); ++i) {
    const hybrid::StartRule& rule = *scenario.starts[system.variable[i]];
    if (rule.kind == model::StartKind::expression)
      first_.emplace_back(i, BallFunction<Scalar>(rule.program, system.layout, bounded.constants));
  }
  for (const Coordinate& coordinate : bounded.coordinates->list) {
    begin_.emplace_back(coordinate.start, system.layout, bounded.constants);
    after_.push_back(coordinate.jump
                         ? std::make_unique<BallFunction<Scalar>>(
                               *coordinate.jump, bounded.coordinates->layout, bounded.constants)
                         : nullptr);
  }
  const Index n = bounded.coordinates->layout.size;
  x_.resize(n);
  next_.resize(n);
  r_.resize(n);
  delta_.resize(n);
  size_.resize(n);
  E_.resize(n, n);
  E_sizes_.resize(n, n);
  J_.resize(n, n);
}

template <class Scalar>
void BoundedSimulator<Scalar>::append(double t, std::int64_t j, const Scalar& timer,
                                      double timer_bound) {
  track_.t.push_back(t);
  track_.j.push_back(j);
  track_.timer.push_back(timer);
  track_.timer_bound.push_back(timer_bound);
  track_.stacked.insert(track_.stacked.end(), x_.data(), x_.data() + x_.size());
  track_.bounds.insert(track_.bounds.end(), r_.data(), r_.data() + r_.size());
  for (Index i = 0; i < x_.size(); ++i)
    if (!(size_of(x_(i)) <= hybrid::kLargestState)) track_.termination = Termination::diverged;
}

template <class Scalar>
void BoundedSimulator<Scalar>::start(const Eigen::VectorXd& drawn) {
  const hybrid::StateLayout& layout = system_->layout;
  ColumnOf<Scalar> x = drawn.cast<Scalar>();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(layout.size);
  for (auto& [state, expression] : first_) {
    const Ball<Scalar>& value = expression(x, r, Scalar(0), 0);
    const hybrid::Slot& slot = layout.slots[state];
    for (Index e = 0; e < slot.shape.size(); ++e) {
      x(slot.offset + e) = value.mid(e);
      r(slot.offset + e) = value.rad(e);
    }
  }
  delta_.setZero();
  for (std::size_t i = 0; i < begin_.size(); ++i) {
    const hybrid::Slot& slot = bounded_->coordinates->layout.slots[i];
    const Ball<Scalar>& value = begin_[i](x, r, Scalar(0), 0);
    for (Index e = 0; e < slot.shape.size(); ++e) {
      x_(slot.offset + e) = value.mid(e);
      delta_(slot.offset + e) = value.rad(e);
    }
  }
  errors_.start(delta_);
  r_ = errors_.bounds();
}

template <class Scalar>
void BoundedSimulator<Scalar>::take_step(const Matrix& E, const Matrix& sizes) {
  x_.swap(next_);
  errors_.step(E, sizes, delta_);
  r_ = errors_.bounds();
}

template <class Scalar>
void BoundedSimulator<Scalar>::add_coarse_errors(const BoundedMap<Scalar>& map) {
  for (Index i = 0; i < x_.rows(); ++i) {
    if (map.unchanged[static_cast<std::size_t>(i)]) continue;
    delta_(i) += map.errors(i, x_.rows());
    for (Index k = 0; k < x_.rows(); ++k) delta_(i) += map.errors(i, k) * (size_(k) + r_(k));
  }
}

template <class Scalar>
void BoundedSimulator<Scalar>::step(const BoundedMap<Scalar>& map) {
  const Index size = x_.rows();
  with_size(size, [&](auto N) {
    const Index n = decltype(N)::value > 0 ? decltype(N)::value : size;
    const Scalar* e = map.linear.data();
    const double* s = map.sizes.data();
    Scalar* const next = next_.data();
    double* const delta = delta_.data();
    for (Index i = 0; i < n; ++i) {
      next[i] = map.constant.data()[i];
      delta[i] = map.constant_sizes.data()[i];
    }
    for (Index k = 0; k < n; ++k, e += n, s += n) {
      const Scalar x = x_.data()[k];
      size_.data()[k] = size_of(x);
      for (Index i = 0; i < n; ++i) {
        next[i] += e[i] * x;
        delta[i] += s[i] * size_of(x);
      }
    }
    for (Index i = 0; i < n; ++i) delta[i] *= map.gamma.data()[i];
  });
  if (map.coarse) add_coarse_errors(map);
  take_step(map.rounded, map.sizes);
}

template <class Scalar>
void BoundedSimulator<Scalar>::rest(double length) {
  const Series<Scalar>& series = bounded_->steps.rest;
  const double sigma = series.share(length);
  series.sum(sigma, added_);
  const Index size = x_.rows();
  with_size(size, [&](auto N) {
    const Index n = decltype(N)::value > 0 ? decltype(N)::value : size;
    const Scalar* const d = added_.data();
    const double* const error = series.errors.data();
    const double* const spread = series.errors_in_double.data();
    Scalar* const next = next_.data();
    double* const delta = delta_.data();
    double* const e = E_.data();
    for (Index i = 0; i < n; ++i) {
      next[i] = d[n * n + i];
      delta[i] = error[n * n + i];
    }
    for (Index k = 0; k < n; ++k)
      for (Index i = 0; i < n; ++i) {
        next[i] += d[k * n + i] * x_.data()[k];
        // Of x, and of the D in double that its error is stepped with.
        delta[i] += error[k * n + i] * size_of(x_.data()[k]) + spread[k * n + i] * r_.data()[k];
        e[k * n + i] = static_cast<double>(d[k * n + i]);
      }
    for (Index i = 0; i < n; ++i) {
      const bool still = !series.moves[static_cast<std::size_t>(i)];
      const double rounding = still ? 0 : 2 * unit_roundoff<Scalar>() * size_of(x_.data()[i]);
      delta[i] = sigma * delta[i] + rounding;
      next[i] += x_.data()[i];
      e[i * n + i] += 1;
    }
    for (Index k = 0; k < n * n; ++k) E_sizes_.data()[k] = std::abs(e[k]);
  });
  take_step(E_, E_sizes_);
}

template <class Scalar>
void BoundedSimulator<Scalar>::flow(double interval) {
  cuts_.clear();
  cutting_->cut(interval, cuts_);
  const double start = track_.t.back();
  const Scalar timer = track_.timer.back();
  const std::int64_t jumps = track_.j.back();
  double elapsed = 0;
  Scalar passed(0);
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    const bool last = i + 1 == cuts_.size();
    if (cuts_[i].level == FlowStep::kRest) {
      rest(cuts_[i].length);
    } else {
      step(bounded_->steps.maps[static_cast<std::size_t>(cuts_[i].level)]);
    }
    elapsed = last ? interval : elapsed + cuts_[i].length;
    passed = last ? Scalar(interval) : passed + Scalar(cuts_[i].length);
    track_.moves.push_back({false, cuts_[i]});
    if (i % kStepsOfBox == kStepsOfBox - 1) {
      errors_.gather();
      r_ = errors_.bounds();
    }
    const Scalar left = timer - passed;
    const double bound =
        left == Scalar(0) ? 0
                          : (static_cast<double>(i) + 2) * unit_roundoff<Scalar>() * size_of(timer);
    append(start + elapsed, jumps, left, bound);
    if (track_.termination != Termination::horizon) return;
  }
}

template <class Scalar>
void BoundedSimulator<Scalar>::linear_entry(std::size_t coordinate) {
  const Coordinates& all = *bounded_->coordinates;
  const hybrid::Slot& slot = all.layout.slots[coordinate];
  BallFunction<Scalar>& value = *after_[coordinate];
  const expr::Program& program = *all.list[coordinate].jump;
  ColumnOf<Scalar> at = x_;
  Eigen::VectorXd spread = r_;
  for (std::size_t i = 0; i < all.list.size(); ++i)
    if (!all.list[i].clock)
      for (Index e = 0; e < all.layout.slots[i].shape.size(); ++e) {
        at(all.layout.slots[i].offset + e) = Scalar(0);
        spread(all.layout.slots[i].offset + e) = 0;
      }
  const Ball<Scalar> zero = value(at, spread, Scalar(0), 0);
  const Index rows = slot.shape.size();
  const double gamma = (static_cast<double>(x_.rows()) + 4) * unit_roundoff<Scalar>();
  Eigen::VectorXd sizes(rows);
  for (Index i = 0; i < rows; ++i) {
    next_(slot.offset + i) = zero.mid(i);
    delta_(slot.offset + i) = zero.rad(i);
    sizes(i) = size_of(zero.mid(i));
  }
  for (std::size_t k = 0; k < all.list.size(); ++k) {
    const hybrid::Slot& from = all.layout.slots[k];
    if (all.list[k].clock || !program.uses(from.name)) continue;
    for (Index e = 0; e < from.shape.size(); ++e) {
      const Index j = from.offset + e;
      at(j) = Scalar(1);
      const Ball<Scalar>& one = value(at, spread, Scalar(0), 0);
      at(j) = Scalar(0);
      const double reach = size_of(x_(j)) + r_(j);
      for (Index i = 0; i < rows; ++i) {
        const Index row = slot.offset + i;
        const Scalar coefficient = one.mid(i) - zero.mid(i);
        const double error =
            one.rad(i) + zero.rad(i) +
            (zero.mid(i) == Scalar(0) ? 0 : unit_roundoff<Scalar>() * size_of(coefficient));
        J_(row, j) = coefficient;
        next_(row) += coefficient * x_(j);
        delta_(row) += error * reach;
        sizes(i) += size_of(coefficient) * size_of(x_(j));
      }
    }
  }
  delta_.segment(slot.offset, rows) += gamma * sizes;
}

template <class Scalar>
void BoundedSimulator<Scalar>::ball_entry(std::size_t coordinate) {
  const hybrid::Slot& slot = bounded_->coordinates->layout.slots[coordinate];
  const Ball<Scalar>& value = (*after_[coordinate])(x_, r_, Scalar(0), 0);
  for (Index e = 0; e < slot.shape.size(); ++e) {
    next_(slot.offset + e) = value.mid(e);
    delta_(slot.offset + e) = value.rad(e) * kBoundSlack;
  }
}

template <class Scalar>
void BoundedSimulator<Scalar>::jump(double reset_value) {
  if (bounded_->jump) {
    step(*bounded_->jump);
  } else {
    const Coordinates& all = *bounded_->coordinates;
    next_ = x_;
    delta_.setZero();
    J_.setIdentity();
    try {
      for (std::size_t i = 0; i < all.list.size(); ++i) {
        if (after_[i] == nullptr) continue;
        const hybrid::Slot& slot = all.layout.slots[i];
        J_.middleRows(slot.offset, slot.shape.size()).setConstant(Scalar(0));
        if (bounded_->linear_jump[i] && !all.list[i].clock) {
          linear_entry(i);
        } else {
          ball_entry(i);
        }
      }
    } catch (const InputError& error) {
      track_.termination = Termination::undefined;
      track_.message = error.what();
      return;
    }
    J_rounded_ = J_.unaryExpr([](const Scalar& value) { return static_cast<double>(value); });
    J_sizes_ = J_rounded_.cwiseAbs();
    take_step(J_rounded_, J_sizes_);
  }
  errors_.gather();
  r_ = errors_.bounds();
  track_.moves.push_back({true, {}});
  append(track_.t.back(), track_.j.back() + 1, Scalar(reset_value), 0);
}

template <class Scalar>
const Track<Scalar>& BoundedSimulator<Scalar>::run(std::uint64_t seed, std::uint64_t run) {
  SampledDraws draws(*system_, *scenario_, seed, run);
  track_.clear();
  track_.size = x_.rows();
  start(draws.start());
  append(0, 0, Scalar(draws.length()), 0);
  flow_and_jump(
      draws, scenario_->horizon, track_, [&](double interval) { flow(interval); },
      [&](double length) { jump(length); });
  return track_;
}

template class BoundedSimulator<double>;
template class BoundedSimulator<DoubleDouble>;

}  // namespace gainsmith::bounded
