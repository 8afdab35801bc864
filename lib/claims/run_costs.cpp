#include "claims/run_costs.h"

#include <limits>
#include <utility>

#include "claims/smooth_parts.h"
#include "ode/chebyshev.h"

namespace gainsmith::claims {

using Eigen::Index;
using Eigen::RowVectorXd;
using hybrid::DenseStep;

namespace {

/// The integral from -1 of a series on [-1, 1]:
///   int T_k = T_(k+1)/(2(k+1)) - T_(k-1)/(2(k-1)),  int T_0 = T_1,  int T_1 = T_2/4
RowVectorXd antiderivative(const RowVectorXd& c) {
  const Index n = c.size();
  RowVectorXd result = RowVectorXd::Zero(n + 1);
  for (Index k = 1; k <= n; ++k) {
    const double before = k == 1 ? 2 * c(0) : c(k - 1);
    const double after = k + 1 < n ? c(k + 1) : 0;
    result(k) = (before - after) / (2 * static_cast<double>(k));
  }
  for (Index k = 1; k <= n; ++k) result(0) -= (k % 2 == 0 ? 1 : -1) * result(k);
  return result;
}

/// The part of a step that a smooth part is, with room for as many coefficients.
DenseStep part_of(const DenseStep& step, const SmoothPart& part, Index columns) {
  DenseStep result{part.from, part.to, step.coefficients};
  if (part.from != step.from || part.to != step.to)
    result.coefficients = ode::chebyshev::part(step.coefficients,
                                               ode::chebyshev::inner(part.from, step.from, step.to),
                                               ode::chebyshev::inner(part.to, step.from, step.to));
  const Index kept = result.coefficients.cols();
  if (columns > kept) {
    result.coefficients.conservativeResize(Eigen::NoChange, columns);
    result.coefficients.rightCols(columns - kept).setZero();
  }
  return result;
}

}  // namespace

RunCosts::RunCosts(const std::vector<RunCost>& costs, const hybrid::StateLayout& layout,
                   const numbers::Values& constants) {
  const auto value_of = [&](const std::optional<expr::Program>& program) {
    return program ? std::optional<RunValue>(std::in_place, *program, layout, constants)
                   : std::nullopt;
  };
  for (const RunCost& cost : costs)
    integrals_.push_back({cost.element, value_of(cost.flow), value_of(cost.jump)});
}

/// Splits each step at the breaks of q. c on a part is c so far + half int series, half its half
/// length.
void RunCosts::add_to(std::vector<DenseStep>& steps, Integral& integral, bool moved) {
  constexpr double agreement = 1e-12;
  std::vector<DenseStep> all;
  for (DenseStep& step : steps) {
    std::vector<SmoothPart> parts = smooth_parts(*integral.rate, step, nullptr, agreement, true);
    // Breaks lie between two numbers that are next to each other.
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) parts[k].to = parts[k + 1].from;
    parts.back().to = step.to;
    for (const SmoothPart& part : parts) {
      const double half = (part.to - part.from) / 2;
      RowVectorXd series = RowVectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN());
      if (!part.undefined) {
        series = half * antiderivative(part.series);
        // The integral of the largest error of the series of q.
        if (moved) series(0) += 2 * half * part.noise;
        series(0) += integral.total;
      }
      DenseStep dense_step = part_of(step, part, series.size());
      dense_step.coefficients.row(integral.element).setZero();
      dense_step.coefficients.row(integral.element).head(series.size()) = series;
      integral.total = series.sum();
      all.push_back(std::move(dense_step));
    }
  }
  steps = std::move(all);
}

void RunCosts::add_to(hybrid::FlowPiece& flow, bool moved) {
  for (Integral& integral : integrals_) {
    flow.start(integral.element) = integral.total;
    if (integral.rate) {
      add_to(flow.steps, integral, moved);
    } else {
      for (DenseStep& step : flow.steps) {
        step.coefficients.row(integral.element).setZero();
        step.coefficients(integral.element, 0) = integral.total;
      }
    }
    flow.end(integral.element) = integral.total;
  }
}

void RunCosts::add_to(hybrid::Trajectory& run, bool moved) {
  for (Integral& integral : integrals_) integral.total = 0;
  if (integrals_.empty()) return;
  for (auto& part : run.parts) {
    if (auto* flow = std::get_if<hybrid::FlowPiece>(&part)) {
      add_to(*flow, moved);
      continue;
    }
    auto& jump = std::get<hybrid::JumpPoint>(part);
    for (Integral& integral : integrals_) {
      jump.before(integral.element) = integral.total;
      if (integral.jump) integral.total += integral.jump->number(jump.before);
      jump.after(integral.element) = integral.total;
    }
  }
}

}  // namespace gainsmith::claims
