// The steps of State31 along flows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/unit_roundoff.h"
#include "ode/gauss_stages.h"
#include "simulate/run_end.h"
#include "simulate/state_31.h"
#include "simulate/tolerances.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::VectorXd;
using VariableKind = model::Dynamics::VariableKind;

namespace {

constexpr int kStages = 16;
/// Relative: iterations in double may end there.
constexpr double kSolvedInDouble = 1e-13;
constexpr double kNone = std::numeric_limits<double>::infinity();

const ode::GaussStages<DoubleDouble>& gauss() {
  static const ode::GaussStages<DoubleDouble> stages(kStages);
  return stages;
}

}  // namespace

void State31::begin_flow(VectorField& field, const VectorXd& values) {
  adopt(values);
  field_ = &field;
  VectorXd integrated = VectorXd::Zero(x_.size());
  field.spread(VectorXd::Ones(field.size()), integrated);
  is_integrated_.clear();
  for (const Index element : moving_) is_integrated_.push_back(integrated(element) == 1);
  for (Rate& rate : rates_) rate.rests = field.is_frozen(rate.variable);
}

void State31::rates(const Values31& x, Values31& rate) {
  rate.setZero(x.size());
  for (Rate& one : rates_) {
    if (one.rests) continue;
    const hybrid::Slot& slot = system_->layout.slots[one.variable];
    rate.segment(slot.offset, slot.shape.size()) = one.value(x).reshaped();
  }
  for (const Clock& clock : clocks_)
    rate(clock.element) = clock.kind == VariableKind::left ? -1 : 1;
}

/// The stages in double, by iteration, and the derivatives of the rates at them; false: it does not
/// converge.
bool State31::solve_in_double() {
  static const numbers::Matrix A = gauss().A.cast<double>();
  const VectorXd y = field_->gathered(rounded(x_));
  const VectorXd of_sizes = field_->gathered(sizes_);
  const double t = t_.hi(), h = length_.hi();
  VectorXd rate(y.size()), moved_rate(y.size());
  field_->rate(t, y, rate);
  numbers::Matrix F = rate.replicate(1, kStages);
  double last = kNone;
  constexpr int kMostSweeps = 60;
  for (int k = 0; k < kMostSweeps; ++k) {
    const numbers::Matrix moves = h * F * A.transpose();
    double change = 0;
    for (int i = 0; i < kStages; ++i) {
      field_->rate(t + gauss().c(i).hi() * h, y + moves.col(i), rate);
      const VectorXd size = of_sizes.cwiseMax(std::abs(h) * rate.cwiseAbs());
      for (Index e = 0; e < y.size(); ++e)
        if (const double by = std::abs(h * (rate(e) - F(e, i))); !(by == 0))
          change = std::fmax(change, by / size(e));
      F.col(i) = rate;
    }
    if (!(change < kNone)) return false;
    if (change <= kUnitRoundoff || (change <= kSolvedInDouble && change > 0.5 * last)) break;
    if (k > 4 && change > 0.8 * last) return false;
    last = change;
  }
  slopes_.assign(kStages, numbers::Matrix(y.size(), y.size()));
  const numbers::Matrix moves = h * F * A.transpose();
  for (int i = 0; i < kStages; ++i) {
    VectorXd at = y + moves.col(i);
    field_->rate(t + gauss().c(i).hi() * h, at, rate);
    for (Index e = 0; e < y.size(); ++e) {
      const double own = at(e);
      at(e) += std::sqrt(kUnitRoundoff) * std::max(std::abs(own), std::abs(moves(e, i)));
      if (at(e) == own) at(e) += std::sqrt(kUnitRoundoff);
      field_->rate(t + gauss().c(i).hi() * h, at, moved_rate);
      slopes_[static_cast<std::size_t>(i)].col(e) = (moved_rate - rate) / (at(e) - own);
      at(e) = own;
    }
    VectorXd all = rounded(x_);
    field_->spread(F.col(i), all);
    for (std::size_t k = 0; k < moving_.size(); ++k)
      if (is_integrated_[k]) stages_(static_cast<Index>(k), i) = all(moving_[k]);
  }
  return true;
}

/// By how much of what moves the rates at the stages differ from the stages; `residual`: by how much.
double State31::residual(Matrix31& residual) {
  const Matrix31 moves = length_ * stages_.lazyProduct(gauss().A.transpose());
  Values31 at = x_, rate;
  double change = 0;
  for (int i = 0; i < kStages; ++i) {
    for (std::size_t k = 0; k < moving_.size(); ++k)
      at(moving_[k]) = x_(moving_[k]) + moves(static_cast<Index>(k), i);
    rates(at, rate);
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const auto row = static_cast<Index>(k);
      residual(row, i) = rate(moving_[k]) - stages_(row, i);
      const double size = std::max(sizes_(moving_[k]), std::abs((length_ * rate(moving_[k])).hi()));
      const double by = std::abs((length_ * residual(row, i)).hi());
      if (!(by == 0)) change = std::fmax(change, std::isfinite(by) ? by / size : kNone);
    }
  }
  return change;
}

/// The stages go by what the residual, in double, makes of them to first order:
/// d = r + h J (d A').
void State31::correct(const Matrix31& residual) {
  static const numbers::Matrix A = gauss().A.cast<double>();
  numbers::Matrix r(field_->size(), kStages);
  VectorXd all = VectorXd::Zero(x_.size());
  for (int i = 0; i < kStages; ++i) {
    for (std::size_t k = 0; k < moving_.size(); ++k)
      all(moving_[k]) = residual(static_cast<Index>(k), i).hi();
    r.col(i) = field_->gathered(all);
  }
  numbers::Matrix d = r;
  constexpr int kSweeps = 20;
  for (int k = 0; k < kSweeps; ++k) {
    const numbers::Matrix moves = length_.hi() * d * A.transpose();
    for (int i = 0; i < kStages; ++i)
      d.col(i) = r.col(i) + slopes_[static_cast<std::size_t>(i)] * moves.col(i);
  }
  for (int i = 0; i < kStages; ++i) {
    all.setZero();
    field_->spread(d.col(i) - r.col(i), all);
    for (std::size_t k = 0; k < moving_.size(); ++k)
      stages_(static_cast<Index>(k), i) += residual(static_cast<Index>(k), i) + all(moving_[k]);
  }
}

double State31::step(double to) {
  to_ = to;
  length_ = DoubleDouble(to) - t_;
  sizes_ = sizes_.cwiseMax(rounded(x_).cwiseAbs());
  sizes_ = sizes_.cwiseMax(k31Least * sizes_.maxCoeff());
  try {
    Values31 rate;
    rates(x_, rate);
    stages_.resize(static_cast<Index>(moving_.size()), kStages);
    for (std::size_t k = 0; k < moving_.size(); ++k)
      stages_.row(static_cast<Index>(k)).setConstant(rate(moving_[k]));
    if (!solve_in_double()) return kNone;
    Matrix31 rest(stages_.rows(), kStages);
    // A correction leaves of the residual what the slopes are off by, 1e-7.
    constexpr int kMostCorrections = 8;
    for (int k = 0; k < kMostCorrections; ++k) {
      const double change = residual(rest);
      if (!(change < k31Residual || k + 1 < kMostCorrections)) return kNone;
      correct(rest);
      if (change <= k31Residual) break;
    }
  } catch (const expr::EvaluationError&) {
    return kNone;
  }
  end_ = x_;
  double most = 0;
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    const auto rates_of = stages_.row(static_cast<Index>(k));
    DoubleDouble sum(0), largest(0), terms[] = {0, 0};
    for (int i = 0; i < kStages; ++i) {
      const DoubleDouble part = gauss().b(i) * rates_of(i);
      sum += part;
      largest = std::max(largest, abs(rates_of(i)));
      for (int n : {0, 1}) terms[n] += part * gauss().legendre(i, kStages - 1 - n);
    }
    const double size = std::max(sizes_(moving_[k]), std::abs((length_ * largest).hi()));
    const double term = std::max(std::abs(terms[0].hi()), std::abs(terms[1].hi()));
    if (size > 0) most = std::max(most, std::abs(length_.hi()) * 2 * kStages * term / size);
    end_(moving_[k]) += length_ * sum;
  }
  return most / k31Terms;
}

numbers::Matrix State31::along(const VectorXd& parts) const {
  numbers::Matrix weights(kStages, parts.size());
  const numbers::Matrix legendre = gauss().legendre.leftCols(kStages).cast<double>();
  const VectorXd b = rounded(gauss().b);
  for (Index p = 0; p < parts.size(); ++p)
    weights.col(p) =
        b.cwiseProduct(legendre * ode::GaussStages<double>::integrals(kStages, 2 * parts(p) - 1));
  numbers::Matrix values = rounded(x_).replicate(1, parts.size());
  const numbers::Matrix moves = length_.hi() * stages_.cast<double>() * weights;
  for (std::size_t k = 0; k < moving_.size(); ++k)
    values.row(moving_[k]) += moves.row(static_cast<Index>(k));
  return values;
}

void State31::arrive(double to) {
  if (to != to_ && !std::isfinite(step(to)))
    throw RunEnd(hybrid::Ending::lost, "a step in 31 digits does not converge");
  x_ = end_;
  t_ = DoubleDouble(to);
  longest_ = std::max(longest_, std::abs(length_.hi()));
  move(k31LastPlaces);
}

void State31::move(double part) {
  if (moved_ == nullptr) return;
  for (const Rate& rate : rates_) {
    const hybrid::Slot& slot = system_->layout.slots[rate.variable];
    for (DoubleDouble& value : x_.segment(slot.offset, slot.shape.size()))
      value += part * moved_->of(value.hi(), std::abs(value.hi()));
  }
}

void State31::shift(const DoubleDouble& by) {
  Values31 rate;
  rates(x_, rate);
  rates(Values31(x_ + by / DoubleDouble(2) * rate), rate);
  x_ += by * rate;
  t_ += by;
}

}  // namespace gainsmith::simulate
