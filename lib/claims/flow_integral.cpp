#include "claims/flow_integral.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gainsmith::claims {

namespace {

using bounded::Bounded;
using Eigen::Index;
using Eigen::VectorXd;
using numbers::Enclosed;
using numbers::Jet;
using numbers::Matrix;

constexpr double kNoBound = bounded::no_bound();

/// A step is cut into 2^kCuts pieces.
template <class Scalar>
constexpr int kCuts = 2;
template <>
constexpr int kCuts<DoubleDouble> = 5;

/// Beyond this norm of A d its exponential says nothing of the flow.
constexpr double kLongest = 4;

/// M in double, of the decimals; A covers its rounding.
constexpr double kUnit = 2 * bounded::unit_roundoff<double>();

Matrix in_double(const numbers::MatrixOf<Decimal100>& matrix) {
  return matrix.unaryExpr([](const Decimal100& value) { return static_cast<double>(value); });
}

/// Not below e^(A d) v.
VectorXd grown(const Matrix& A, double d, VectorXd v) {
  const double norm = A.size() == 0 ? 0 : A.rowwise().sum().maxCoeff() * d;
  if (!(norm <= kLongest)) return VectorXd::Constant(v.size(), kNoBound);
  VectorXd sum = v;
  for (int k = 1; k <= 40; ++k) {
    v = (A.lazyProduct(v) * (d / k)).eval();
    sum += v;
  }
  // What is left falls faster than 1/2^k.
  const double rest = v.size() == 0 ? 0 : 2 * v.maxCoeff();
  return sum.unaryExpr([&](double x) { return x > 0 ? x + rest : 0; }) * bounded::kBoundSlack;
}

Jet number_jet(const Matrix& mid, const Matrix& rad) {
  for (Index e = 0; e < mid.size(); ++e)
    if (!std::isfinite(mid(e)) || !std::isfinite(rad(e)))
      return numbers::constant_jet(numbers::nothing_known<double>(mid));
  return numbers::constant_jet({mid, rad});
}

/// The largest |value| of the k-th derivative of a 1 x 1 jet.
double largest(const Jet& jet, int k) {
  const Enclosed<double> value = jet.derivative(k);
  return value.mid.size() == 0 ? 0 : (std::abs(value.mid(0)) + value.rad(0)) * bounded::kBoundSlack;
}

}  // namespace

template <class Scalar>
FlowIntegral<Scalar>::FlowIntegral(const JudgedFunction& function,
                                   const bounded::BoundedSystem<Scalar>& system)
    : system_(&system),
      at_middle_(function.program, system.coordinates->layout, system.constants),
      flow_(in_double(system.coordinates->linear)),
      sizes_(flow_.cwiseAbs() * bounded::kBoundSlack),
      constant_(in_double(system.coordinates->constant).col(0)),
      constant_sizes_(constant_.cwiseAbs() * bounded::kBoundSlack),
      over_piece_(function.program) {
  const hybrid::StateLayout& layout = system.coordinates->layout;
  for (const hybrid::Slot& slot : layout.slots)
    if (function.program.uses(slot.name)) slots_.push_back(slot);
  moving_.resize(slots_.size() + 1);
  for (std::size_t i = 0; i < slots_.size(); ++i) over_piece_.set(slots_[i].name, moving_[i]);
  over_piece_.set(layout.timer, moving_.back());
  for (const expr::Input& input : function.program.inputs)
    if (const auto known = system.coordinates->constants.find(input.name);
        known != system.coordinates->constants.end() && !layout.moves(input.name)) {
      const Matrix mid = in_double(known->second);
      over_piece_.fix(input.name, number_jet(mid, mid.cwiseAbs() * kUnit));
    }
}

template <class Scalar>
void FlowIntegral<Scalar>::advance(double length, int level) {
  const Index n = x_.rows();
  const double unit = bounded::unit_roundoff<Scalar>();
  VectorXd sizes = bounded::sizes_of(x_).col(0);
  if (level >= 0) {
    const auto& map = system_->steps.maps[static_cast<std::size_t>(level)];
    r_ = (map.sizes.lazyProduct(r_) * (1 + 8 * unit * static_cast<double>(n)) +
          map.gamma.cwiseProduct(map.sizes.lazyProduct(sizes) + map.constant_sizes) +
          map.errors.leftCols(n).lazyProduct(sizes + r_) + map.errors.col(n))
             .eval();
    x_ = (map.linear.lazyProduct(x_) + map.constant).eval();
    return;
  }
  const auto& series = system_->steps.rest;
  const double sigma = series.share(length);
  series.sum(sigma, added_);
  const numbers::MatrixOf<Scalar> D = added_.leftCols(n);
  r_ = (r_ + bounded::sizes_of(D).lazyProduct(r_) +
        sigma * (series.errors.leftCols(n).lazyProduct(sizes + r_) + series.errors.col(n)) +
        2 * unit * sizes)
           .eval();
  x_ = (x_ + (D.lazyProduct(x_) + added_.col(n))).eval();
}

template <class Scalar>
void FlowIntegral<Scalar>::enclose(double half, double timer, double timer_bound) {
  const VectorXd x = x_.unaryExpr([](const Scalar& value) { return static_cast<double>(value); });
  const VectorXd r = r_ + x.cwiseAbs() * kUnit;
  const VectorXd slope = flow_ * x + constant_;
  const VectorXd steepness = sizes_ * (x.cwiseAbs() + r) + constant_sizes_;
  const VectorXd bend = grown(sizes_, half, sizes_ * steepness);
  const double unit = static_cast<double>(x.size() + 4) * kUnit;
  const VectorXd slope_error = sizes_ * r + unit * steepness + half * bend;
  const VectorXd second = flow_ * slope;
  const VectorXd second_error = sizes_ * (slope_error + unit * slope.cwiseAbs());
  const VectorXd spread =
      (r + half * slope.cwiseAbs() + half * unit * steepness + half * half / 2 * bend) *
      bounded::kBoundSlack;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const hybrid::Slot& slot = slots_[i];
    const auto part = [&](const VectorXd& whole) {
      return Matrix(
          whole.segment(slot.offset, slot.shape.size()).reshaped(slot.shape.rows, slot.shape.cols));
    };
    Jet& jet = moving_[i];
    jet = number_jet(part(x), part(spread));
    jet.derivatives[1] = number_jet(part(slope), part(slope_error)).derivatives[0];
    jet.derivatives[2] = number_jet(part(second), part(second_error)).derivatives[0];
    jet.order = 2;
  }
  moving_.back() = number_jet(Matrix::Constant(1, 1, timer),
                              Matrix::Constant(1, 1, (half + timer_bound) * bounded::kBoundSlack));
  moving_.back().derivatives[1] = numbers::exact_number<double>(-1);
  moving_.back().order = 1;
}

template <class Scalar>
Bounded<Scalar> FlowIntegral<Scalar>::operator()(const bounded::Track<Scalar>& track,
                                                 std::size_t move) try {
  const bounded::FlowStep& step = track.moves[move].step;
  constexpr int kPieces = 1 << kCuts<Scalar>;
  const bool rest = step.level == bounded::FlowStep::kRest;
  const double h = step.length / kPieces;
  x_ = track.state(move);
  r_ = track.bound(move);
  Bounded<Scalar> total;
  for (int piece = 0; piece < kPieces; ++piece) {
    const int cuts = kCuts<Scalar> + (piece == 0 ? 1 : 0);
    advance(piece == 0 ? h / 2 : h, rest ? -1 : step.level - cuts);
    const double since = (piece + 0.5) * h;
    const Scalar timer = track.timer[move] - Scalar(since);
    const double late = track.timer_bound[move] +
                        2 * bounded::unit_roundoff<Scalar>() * bounded::size_of(track.timer[move]);
    const bounded::Ball<Scalar>& middle = at_middle_(x_, r_, timer, late);
    enclose(h / 2, static_cast<double>(timer), late + kUnit * std::abs(static_cast<double>(timer)));
    const Jet& jet = over_piece_.run();
    const double spread =
        jet.value().rad(0) + std::abs(jet.value().mid(0) - static_cast<double>(middle.mid(0)));
    const double error = std::min({h * h / 24 * largest(jet, 2), h / 4 * largest(jet, 1),
                                   (spread + middle.rad(0)) * (1 + kUnit)});
    total.value += Scalar(h) * middle.mid(0);
    total.bound += h * (error + middle.rad(0)) + 4 * kPieces * bounded::unit_roundoff<Scalar>() *
                                                     h * bounded::size_of(middle.mid(0));
  }
  total.bound = std::isnan(total.bound) ? kNoBound : total.bound * bounded::kBoundSlack;
  return total;
} catch (const expr::EvaluationError&) {
  return {Scalar(0), kNoBound};
}

template class FlowIntegral<double>;
template class FlowIntegral<DoubleDouble>;

}  // namespace gainsmith::claims
