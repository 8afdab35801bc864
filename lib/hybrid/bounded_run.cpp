#include "hybrid/bounded_run.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "numbers/degree.h"

namespace gainsmith::hybrid {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::MatrixOf;
using Wide = numbers::MatrixOf<Decimal100>;

constexpr double kLargest = 1e150;
/// Y_ is kept between its square roots' limits.
constexpr double kLeastScale = 1e-80;
constexpr double kMostScale = 1e80;

bool uses_any(const expr::Program& program, const std::set<std::string>& names) {
  return std::any_of(program.inputs.begin(), program.inputs.end(),
                     [&](const expr::Input& input) { return names.contains(input.name); });
}

/// The jump as an affine map; none when a coefficient depends on clocks or an entry is not affine.
std::optional<std::pair<Wide, Wide>> affine_jump(const Coordinates& coordinates) {
  const Index n = coordinates.layout.size;
  std::pair<Wide, Wide> map{Wide::Identity(n, n), Wide::Zero(n, 1)};
  const auto moves = [&](const std::string& name) { return coordinates.layout.moves(name); };
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const auto& jump = coordinates.list[i].jump;
    if (!jump) continue;
    const auto degrees = numbers::degrees(*jump, moves);
    if (degrees[static_cast<std::size_t>(jump->result)] == numbers::kNotAffine ||
        jump->uses(coordinates.layout.timer))
      return std::nullopt;
    const Slot& slot = coordinates.layout.slots[i];
    const Index rows = slot.shape.size();
    WideFunction value(*jump, coordinates.layout, coordinates.constants);
    Wide x = Wide::Zero(n, 1);
    map.second.middleRows(slot.offset, rows) = value(x).reshaped();
    for (Index j = 0; j < n; ++j) {
      x(j) = Decimal100(1);
      map.first.block(slot.offset, j, rows, 1) =
          value(x).reshaped() - map.second.middleRows(slot.offset, rows);
      x(j) = Decimal100(0);
    }
  }
  remove_noise(map.first, largest_of(map.first));
  remove_noise(map.second, std::max(largest_of(map.first), largest_of(map.second)));
  return map;
}

}  // namespace

template <class Scalar>
BallFunction<Scalar>::BallFunction(const expr::Program& program, const StateLayout& layout,
                                   const BallsOf<Scalar>& constants)
    : evaluator_(program) {
  for (const Slot& slot : layout.slots)
    if (program.uses(slot.name)) slots_.push_back(slot);
  for (const Slot& slot : slots_)
    moving_.push_back(exact_ball<Scalar>(Matrix::Zero(slot.shape.rows, slot.shape.cols)));
  moving_.push_back(exact_ball<Scalar>(Matrix::Zero(1, 1)));
  for (const expr::Input& input : program.inputs)
    if (const auto known = constants.find(input.name);
        known != constants.end() && !layout.moves(input.name))
      evaluator_.fix(input.name, known->second);
  for (std::size_t i = 0; i < slots_.size(); ++i) evaluator_.set(slots_[i].name, moving_[i]);
  evaluator_.set(layout.timer, moving_.back());
}

template <class Scalar>
const Ball<Scalar>& BallFunction<Scalar>::operator()(
    const Eigen::Ref<const ColumnOf<Scalar>>& x, const Eigen::Ref<const Eigen::VectorXd>& r,
    const Scalar& tau, double tau_bound) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    for (Index e = 0; e < slot.shape.size(); ++e) {
      moving_[i].mid(e) = x(slot.offset + e);
      moving_[i].rad(e) = r(slot.offset + e);
    }
  }
  moving_.back().mid(0) = tau;
  moving_.back().rad(0) = tau_bound;
  return evaluator_.run();
}

template <class Scalar>
BoundedSystem<Scalar>::BoundedSystem(const Coordinates& all, const ExactSteps& exact,
                                     const std::vector<Wide>& forms)
    : coordinates(&all), steps(all, exact, forms) {
  for (const auto& [name, value] : all.constants) constants.emplace(name, ball_of<Scalar>(value));
  if (const auto map = affine_jump(all)) jump = bounded_map<Scalar>(map->first, map->second, 0);
  std::set<std::string> turning;
  for (std::size_t i = 0; i < all.list.size(); ++i)
    if (!all.list[i].clock) turning.insert(all.layout.slots[i].name);
  const auto moves = [&](const std::string& name) { return turning.contains(name); };
  for (const Coordinate& coordinate : all.list) {
    bool linear = true;
    if (coordinate.jump && uses_any(*coordinate.jump, turning)) {
      const auto degrees = numbers::degrees(*coordinate.jump, moves);
      linear = degrees[static_cast<std::size_t>(coordinate.jump->result)] != numbers::kNotAffine;
    }
    linear_jump.push_back(linear);
  }
}

template <class Scalar>
BoundedSimulator<Scalar>::BoundedSimulator(const System& system, const Scenario& scenario,
                                           const FlowSteps& steps,
                                           const BoundedSystem<Scalar>& bounded)
    : system_(&system),
      scenario_(&scenario),
      cutting_(&steps),
      bounded_(&bounded),
      starts_(scenario.starts, system),
      rules_(&scenario.starts) {
  for (const StartRule& rule : scenario.starts)
    if (rule.kind == model::StartKind::expression)
      first_.emplace_back(rule.program, system.layout, bounded.constants);
  for (const Coordinate& coordinate : bounded.coordinates->list) {
    begin_.emplace_back(coordinate.start, system.layout, bounded.constants);
    after_.push_back(coordinate.jump ? std::make_unique<BallFunction<Scalar>>(
                                           *coordinate.jump, bounded.coordinates->layout,
                                           bounded.constants)
                                     : nullptr);
  }
  const Index n = bounded.coordinates->layout.size;
  x_.resize(n);
  next_.resize(n);
  r_.resize(n);
  delta_.resize(n);
  Y_.resize(n, n);
  product_.resize(n, n);
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
    if (!(size_of(x_(i)) <= kLargest)) track_.termination = Termination::diverged;
}

template <class Scalar>
void BoundedSimulator<Scalar>::start(std::uint64_t run, RandomStream& random) {
  const StateLayout& layout = system_->layout;
  const Eigen::VectorXd drawn = starts_(run, random);
  ColumnOf<Scalar> x = drawn.cast<Scalar>();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(layout.size);
  std::size_t expression = 0;
  for (std::size_t i = 0; i < rules_->size(); ++i) {
    if ((*rules_)[i].kind != model::StartKind::expression) continue;
    const Ball<Scalar>& value = first_[expression++](x, r, Scalar(0), 0);
    const Slot& slot = layout.slots[i];
    for (Index e = 0; e < slot.shape.size(); ++e) {
      x(slot.offset + e) = value.mid(e);
      r(slot.offset + e) = value.rad(e);
    }
  }
  delta_.setZero();
  for (std::size_t i = 0; i < begin_.size(); ++i) {
    const Slot& slot = bounded_->coordinates->layout.slots[i];
    const Ball<Scalar>& value = begin_[i](x, r, Scalar(0), 0);
    for (Index e = 0; e < slot.shape.size(); ++e) {
      x_(slot.offset + e) = value.mid(e);
      delta_(slot.offset + e) = value.rad(e);
    }
  }
  Y_.setZero();
  scale_ = 1;
  steps_ = 0;
  propagate(Y_, Y_, 0);
}

template <class Scalar>
void BoundedSimulator<Scalar>::propagate(const Matrix& E, const Matrix& sizes, double slack) {
  const Index n = Y_.rows();
  if (n == 0) return;
  const bool known = Y_.diagonal().maxCoeff() > 0;
  const double inject = delta_.maxCoeff();
  if (known) {
    const double eps = 4 * (static_cast<double>(n) + 2) * unit_roundoff<double>() + slack;
    spread_.noalias() = sizes.lazyProduct(Y_.diagonal().cwiseSqrt());
    product_.noalias() = E.lazyProduct(Y_);
    Y_.noalias() = product_.lazyProduct(E.transpose());
    Y_.diagonal().array() += static_cast<double>(n) * eps * spread_.array().square();
  }
  if (inject > 0) {
    if (!known) scale_ = inject;
    Y_.diagonal().array() += static_cast<double>(n) * (delta_.array() / scale_).square();
    steps_ += 1;
  }
  if (known || inject > 0) {
    const double largest = std::sqrt(Y_.diagonal().maxCoeff());
    if (largest > kMostScale || (largest < kLeastScale && largest > 0)) {
      Y_ /= largest * largest;
      scale_ *= largest;
    }
  }
  r_ = Y_.diagonal().cwiseMax(0).cwiseSqrt() * (std::sqrt(steps_) * scale_ * kBoundSlack);
}

template <class Scalar>
void BoundedSimulator<Scalar>::step(const BoundedMap<Scalar>& map) {
  const Index n = x_.rows();
  next_ = map.constant;
  next_.noalias() += map.linear.lazyProduct(x_);
  const double gamma = (static_cast<double>(n) + 4) * unit_roundoff<Scalar>();
  double sum = 1;
  for (Index i = 0; i < n; ++i) sum += size_of(x_(i));
  for (Index i = 0; i < n; ++i) {
    if (map.unchanged[static_cast<std::size_t>(i)]) {
      next_(i) = x_(i);
      delta_(i) = 0;
      continue;
    }
    double absolute = map.constant_sizes(i);
    for (Index k = 0; k < n; ++k) absolute += map.sizes(i, k) * size_of(x_(k));
    delta_(i) = absolute > 0 ? gamma * absolute + map.error * sum : 0;
  }
  x_.swap(next_);
  propagate(map.rounded, map.sizes, 0);
}

template <class Scalar>
void BoundedSimulator<Scalar>::rest(double length) {
  const StepMaps<Scalar>& flow = bounded_->steps;
  const Index n = x_.rows();
  const double q = flow.norm * length;
  ColumnOf<Scalar> term = x_;
  Eigen::VectorXd sizes = sizes_of(x_).col(0);
  const Eigen::VectorXd before = sizes;
  Eigen::VectorXd size = sizes;
  next_ = x_;
  double weight = 1;
  int degree = 0;
  const double least = unit_roundoff<Scalar>() * 1e-10;
  while (n > 0 && (degree < 2 || weight > least) && degree < 60) {
    ++degree;
    const double share = length / degree;
    term = (flow.linear.lazyProduct(term)).eval();
    size = flow.sizes.lazyProduct(size).eval();
    if (degree == 1) {
      term += flow.constant;
      size += flow.constant_sizes;
    }
    term *= Scalar(length) / Scalar(degree);
    size *= share;
    next_ += term;
    sizes += size;
    weight *= q / degree;
  }
  const double gamma = (static_cast<double>(n + degree) + 4) * unit_roundoff<Scalar>();
  const double tail = 2 * weight * (before.size() > 0 ? before.maxCoeff() + 1 : 0);
  Matrix E = Matrix::Identity(n, n);
  for (int k = std::min(degree, 24); k >= 1; --k)
    E = (Matrix::Identity(n, n) + flow.rounded.lazyProduct(E) * (length / k)).eval();
  for (Index i = 0; i < n; ++i) {
    const bool still = flow.sizes.row(i).isZero(0) && flow.constant_sizes(i) == 0;
    delta_(i) = still || sizes(i) == 0 ? 0 : gamma * sizes(i) + tail;
  }
  x_.swap(next_);
  product_ = E.cwiseAbs();
  const Matrix magnitudes = product_;
  propagate(E, magnitudes, 100 * unit_roundoff<double>());
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
    const Scalar left = timer - passed;
    const double bound = left == Scalar(0) ? 0
                                           : (static_cast<double>(i) + 2) *
                                                 unit_roundoff<Scalar>() * size_of(timer);
    append(start + elapsed, jumps, left, bound);
    if (track_.termination != Termination::horizon) return;
  }
}

template <class Scalar>
void BoundedSimulator<Scalar>::linear_entry(std::size_t coordinate) {
  const Coordinates& all = *bounded_->coordinates;
  const Slot& slot = all.layout.slots[coordinate];
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
  const double gamma =
      (static_cast<double>(x_.rows()) + 4) * unit_roundoff<Scalar>();
  Eigen::VectorXd sizes(rows);
  for (Index i = 0; i < rows; ++i) {
    next_(slot.offset + i) = zero.mid(i);
    delta_(slot.offset + i) = zero.rad(i);
    sizes(i) = size_of(zero.mid(i));
  }
  for (std::size_t k = 0; k < all.list.size(); ++k) {
    const Slot& from = all.layout.slots[k];
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
  const Slot& slot = bounded_->coordinates->layout.slots[coordinate];
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
        const Slot& slot = all.layout.slots[i];
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
    x_.swap(next_);
    J_rounded_ = J_.unaryExpr([](const Scalar& value) { return static_cast<double>(value); });
    J_sizes_ = J_rounded_.cwiseAbs();
    propagate(J_rounded_, J_sizes_, 0);
  }
  track_.moves.push_back({true, {}});
  append(track_.t.back(), track_.j.back() + 1, Scalar(reset_value), 0);
}

template <class Scalar>
const Track<Scalar>& BoundedSimulator<Scalar>::run(std::uint64_t seed, std::uint64_t run) {
  RandomStream random(seed, run);
  const Law& law = scenario_->laws[run % scenario_->laws.size()];
  track_ = {};
  track_.size = x_.rows();
  start(run, random);
  const double first = scenario_->first.value_or(system_->first_low);
  const double spread = scenario_->first ? 0 : system_->first_high - system_->first_low;
  append(0, 0, Scalar(scenario_->first ? first : first + spread * random.uniform()), 0);
  for (std::size_t jumps = 0;; ++jumps) {
    const double left = scenario_->horizon - track_.t.back();
    const double timer = static_cast<double>(track_.timer.back());
    const bool expires = timer <= left;
    flow(expires ? timer : left);
    if (track_.termination != Termination::horizon || !expires) return track_;
    if (track_.j.back() >= scenario_->jump_limit) {
      track_.termination = Termination::jump_limit;
      return track_;
    }
    jump(law.reset_value(jumps, track_.t.back(), random));
    if (track_.termination != Termination::horizon || track_.t.back() >= scenario_->horizon)
      return track_;
  }
}

template class BallFunction<double>;
template class BallFunction<DoubleDouble>;
template struct BoundedSystem<double>;
template struct BoundedSystem<DoubleDouble>;
template class BoundedSimulator<double>;
template class BoundedSimulator<DoubleDouble>;

}  // namespace gainsmith::hybrid
