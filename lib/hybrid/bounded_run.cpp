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
const Ball<Scalar>& BallFunction<Scalar>::operator()(const Eigen::Ref<const ColumnOf<Scalar>>& x,
                                                     const Eigen::Ref<const Eigen::VectorXd>& r,
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
  G_.resize(n, n);
  Z_.resize(n, n);
  norm_.resize(n);
  root_.resize(n);
  product_.resize(n, n);
  E_.resize(n, n);
  E_sizes_.resize(n, n);
  for (ColumnOf<Scalar>* column : {&term_, &other_term_}) column->resize(n);
  for (Eigen::VectorXd* column : {&size_, &other_size_}) column->resize(n);
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
  G_.setZero();
  Z_.setZero();
  norm_.setZero();
  scale_ = 1;
  steps_ = 0;
  propagate(G_, G_, 0);
}

template <class Scalar>
void BoundedSimulator<Scalar>::rescale(double largest) {
  if (!(largest > 0) || (largest <= kMostScale && largest >= kLeastScale)) return;
  G_ /= largest;
  Z_ /= largest * largest;
  scale_ *= largest;
}

template <class Scalar>
void BoundedSimulator<Scalar>::propagate(const Matrix& E, const Matrix& sizes, double slack) {
  const Index n = x_.rows();
  const double eps = 4 * (static_cast<double>(n) + 2) * unit_roundoff<double>() + slack;
  const double* const e = E.data();
  const double* const s = sizes.data();
  double* const p = product_.data();
  double* const g = G_.data();
  double* const z = Z_.data();
  bool known = false;
  for (Index i = 0; i < n; ++i) {
    root_(i) = std::sqrt(z[i * n + i]);
    known = known || norm_(i) > 0 || root_(i) > 0;
  }
  if (known) {
    // G <- E G;  Z <- E Z E';  what the rounding of both adds to the diagonal of Z.
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += e[k * n + i] * g[j * n + k];
        p[j * n + i] = sum;
      }
    G_.swap(product_);
    double* const q = product_.data();
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += e[k * n + i] * z[j * n + k];
        q[j * n + i] = sum;
      }
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i <= j; ++i) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += q[k * n + i] * e[k * n + j];
        z[j * n + i] = z[i * n + j] = sum;
      }
    for (Index i = 0; i < n; ++i) {
      double from_G = 0;
      double from_Z = 0;
      for (Index k = 0; k < n; ++k) {
        from_G += s[k * n + i] * norm_(k);
        from_Z += s[k * n + i] * root_(k);
      }
      z[i * n + i] +=
          static_cast<double>(n) * (eps * eps * from_G * from_G + eps * from_Z * from_Z);
    }
    steps_ += 1;
  }
  const double inject = n > 0 ? delta_.maxCoeff() : 0;
  if (inject > 0) {
    if (!known) scale_ = inject;
    for (Index i = 0; i < n; ++i) {
      const double d = delta_(i) / scale_;
      z[i * n + i] += static_cast<double>(n) * d * d;
    }
    steps_ += 1;
  }
  set_bounds();
}

template <class Scalar>
void BoundedSimulator<Scalar>::set_bounds() {
  const Index n = x_.rows();
  const double factor = std::sqrt(steps_) * scale_ * kBoundSlack;
  const double* const g = G_.data();
  double largest = 0;
  for (Index i = 0; i < n; ++i) {
    double square = 0;
    for (Index k = 0; k < n; ++k) square += g[k * n + i] * g[k * n + i];
    norm_(i) = std::sqrt(square);
    const double sum = std::sqrt(square + std::max(Z_(i, i), 0.0));
    r_(i) = factor * sum;
    largest = std::max(largest, sum);
  }
  if (largest > kMostScale || (largest < kLeastScale && largest > 0)) {
    rescale(largest);
    set_bounds();
  }
}

template <class Scalar>
void BoundedSimulator<Scalar>::gather() {
  // [G, sqrt(n diag Z)] = (Q R)' has the same c' Y c as R'.
  const Index n = x_.rows();
  if (n == 0) return;
  stacked_.resize(2 * n, n);
  stacked_.topRows(n) = G_.transpose();
  stacked_.bottomRows(n).setZero();
  for (Index i = 0; i < n; ++i)
    stacked_(n + i, i) = std::sqrt(static_cast<double>(n) * std::max(Z_(i, i), 0.0));
  factored_.compute(stacked_);
  G_.setZero();
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i <= j; ++i) G_(j, i) = factored_.matrixQR()(i, j);
  Z_.setZero();
  for (Index i = 0; i < n; ++i) {
    const double norm = G_.row(i).norm();
    const double rounding = 100 * static_cast<double>(n * n) * unit_roundoff<double>() * norm;
    Z_(i, i) = static_cast<double>(n) * rounding * rounding;
  }
  steps_ += 1;
  set_bounds();
}

template <class Scalar>
void BoundedSimulator<Scalar>::step(const BoundedMap<Scalar>& map) {
  const Index n = x_.rows();
  const double gamma = (static_cast<double>(n) + 4) * unit_roundoff<Scalar>();
  const Scalar* const e = map.linear.data();
  const double* const s = map.sizes.data();
  for (Index k = 0; k < n; ++k) root_(k) = size_of(x_(k));
  for (Index i = 0; i < n; ++i) {
    if (map.unchanged[static_cast<std::size_t>(i)]) {
      next_(i) = x_(i);
      delta_(i) = 0;
      continue;
    }
    Scalar value = map.constant(i);
    double absolute = map.constant_sizes(i);
    double reach = absolute > 0 ? 1 : 0;  // the error of E keeps its pattern
    for (Index k = 0; k < n; ++k) {
      value += e[k * n + i] * x_(k);
      absolute += s[k * n + i] * root_(k);
      if (s[k * n + i] > 0) reach += root_(k);
    }
    next_(i) = value;
    delta_(i) = gamma * absolute + map.error * reach;
  }
  x_.swap(next_);
  propagate(map.rounded, map.sizes, 0);
}

template <class Scalar>
int BoundedSimulator<Scalar>::taylor_sum(double length) {
  // next_ = sum of (M length)^k x / k!; root_ = the same of the sizes.
  const StepMaps<Scalar>& flow = bounded_->steps;
  const Index n = x_.rows();
  const double least = unit_roundoff<Scalar>() * 1e-4;
  const Scalar* const m = flow.linear.data();
  const double* const s = flow.sizes.data();
  term_ = next_ = x_;
  for (Index i = 0; i < n; ++i) size_(i) = root_(i) = size_of(x_(i));
  int degree = 0;
  for (tail_ = 1; degree < 2 || (tail_ > least && degree < 60); ++degree) {
    const double share = length / (degree + 1);
    const Scalar factor = Scalar(length) / Scalar(degree + 1);
    for (Index i = 0; i < n; ++i) {
      Scalar value = degree == 0 ? flow.constant(i) : Scalar(0);
      double size = degree == 0 ? flow.constant_sizes(i) : 0;
      for (Index k = 0; k < n; ++k) {
        value += m[k * n + i] * term_(k);
        size += s[k * n + i] * size_(k);
      }
      other_term_(i) = value * factor;
      other_size_(i) = size * share;
    }
    term_.swap(other_term_);
    size_.swap(other_size_);
    for (Index i = 0; i < n; ++i) {
      next_(i) += term_(i);
      root_(i) += size_(i);
    }
    tail_ *= flow.norm * share;
  }
  return degree;
}

template <class Scalar>
double BoundedSimulator<Scalar>::taylor_map(double length) {
  // E = I + M length (I + M length/2 (I + ...)), in double.
  constexpr int kDegree = 10;
  const Index n = x_.rows();
  const double* const m = bounded_->steps.rounded.data();
  E_.setIdentity();
  double left = 1;
  for (int k = kDegree; k >= 1; --k) {
    const double share = length / k;
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        double sum = 0;
        for (Index l = 0; l < n; ++l) sum += m[l * n + i] * E_(l, j);
        product_(i, j) = sum * share + (i == j ? 1 : 0);
      }
    E_.swap(product_);
    left *= bounded_->steps.norm * length / k;
  }
  E_sizes_ = E_.cwiseAbs();
  return left * bounded_->steps.norm * length + 100 * unit_roundoff<double>();
}

template <class Scalar>
void BoundedSimulator<Scalar>::rest(double length) {
  const StepMaps<Scalar>& flow = bounded_->steps;
  const Index n = x_.rows();
  const int degree = taylor_sum(length);
  const double slack = taylor_map(length);
  const double gamma = (static_cast<double>(n + degree) + 4) * unit_roundoff<Scalar>();
  for (Index i = 0; i < n; ++i) {
    bool still = flow.constant_sizes(i) == 0;
    double reach = still ? 0 : length;
    for (Index k = 0; k < n; ++k) {
      if (flow.sizes(i, k) != 0) still = false;
      if (E_(i, k) != 0) reach += size_of(x_(k)) + flow.constant_sizes(k) * length;
    }
    delta_(i) = still ? 0 : gamma * root_(i) + 2 * tail_ * reach;
  }
  x_.swap(next_);
  propagate(E_, E_sizes_, slack);
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
  const double gamma = (static_cast<double>(x_.rows()) + 4) * unit_roundoff<Scalar>();
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
  gather();
  track_.moves.push_back({true, {}});
  append(track_.t.back(), track_.j.back() + 1, Scalar(reset_value), 0);
}

template <class Scalar>
const Track<Scalar>& BoundedSimulator<Scalar>::run(std::uint64_t seed, std::uint64_t run) {
  RandomStream random(seed, run);
  const Law& law = scenario_->laws[run % scenario_->laws.size()];
  track_.clear();
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
