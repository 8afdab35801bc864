#include "claims/run_values.h"

#include <cmath>
#include <limits>

#include "ode/chebyshev.h"

namespace gainsmith::claims {

RunValue::RunValue(const expr::Program& program, const hybrid::StateLayout& layout,
                   const numbers::Values& constants)
    : function_(hybrid::stacked({&program}, layout, constants)),
      breaks_(program, layout, constants,
              [&](const std::string& name) { return layout.moves(name); }),
      none_(numbers::Matrix::Constant(program.shape().rows, program.shape().cols,
                                      std::numeric_limits<double>::quiet_NaN())),
      used_(function_.elements()),
      used_values_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(used_.size()))),
      point_(Eigen::VectorXd::Zero(layout.size)) {}

const numbers::Matrix& RunValue::operator()(const Eigen::VectorXd& x) {
  try {
    return function_(x);
  } catch (const InputError&) {
    return none_;
  }
}

double RunValue::number(const Eigen::VectorXd& x) {
  return function_.run(x) ? function_.element(0, 0) : (*this)(x)(0, 0);
}

std::optional<double> RunValue::rounding(const Eigen::VectorXd& x) {
  here_.resize(static_cast<std::size_t>(point_.size()));
  for (const Eigen::Index e : used_) here_[static_cast<std::size_t>(e)] = {x(e), x(e)};
  constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
  if (!function_.enclose(here_, unit)) return std::nullopt;
  const numbers::Range& range = function_.range(0, 0);
  return range.high - range.low;
}

void RunValue::follow(const hybrid::DenseStep& step) {
  from_ = step.from;
  to_ = step.to;
  followed_ = step.coefficients(used_, Eigen::all);
}

const Eigen::VectorXd& RunValue::point(double t) {
  ode::chebyshev::at(followed_, ode::chebyshev::inner(t, from_, to_), used_values_.data());
  for (std::size_t k = 0; k < used_.size(); ++k)
    point_(used_[k]) = used_values_(static_cast<Eigen::Index>(k));
  return point_;
}

numbers::Box RunValue::box() const {
  numbers::Box box(static_cast<std::size_t>(point_.size()));
  const numbers::Box ranges = ode::chebyshev::ranges(followed_);
  for (std::size_t k = 0; k < used_.size(); ++k)
    box[static_cast<std::size_t>(used_[k])] = ranges[k];
  return box;
}

std::optional<numbers::Range> RunValue::range() {
  if (!function_.enclose(box())) return std::nullopt;
  return function_.range(0, 0);
}

namespace {

/// Points strictly inside, then the end of the flow.
void visit_flow(const hybrid::FlowPiece& flow, double step,
                const std::function<void(const Moment&)>& seen) {
  const auto see = [&](const hybrid::DenseStep& in, double t) {
    seen({t, flow.j, nullptr, in(t)});
  };
  double next = step > 0 ? std::floor(flow.from() / step + 1) * step : 0;
  std::int64_t count = step > 0 ? std::llround(next / step) : 0;
  for (std::size_t k = 0; k < flow.steps.size(); ++k) {
    const hybrid::DenseStep& in = flow.steps[k];
    if (step > 0) {
      for (; next <= in.to && next < flow.to(); next = static_cast<double>(++count) * step)
        if (next > flow.from()) see(in, next);
      continue;
    }
    see(in, in.from + (in.to - in.from) / 2);
    if (k + 1 < flow.steps.size()) see(in, in.to);
  }
  seen({flow.to(), flow.j, nullptr, flow.end});
}

}  // namespace

void visit(const hybrid::Trajectory& run, double step,
           const std::function<void(const Moment&)>& seen) {
  seen({0, 0, nullptr, run.start});
  for (const auto& part : run.parts) {
    if (const auto* flow = std::get_if<hybrid::FlowPiece>(&part)) {
      visit_flow(*flow, step, seen);
      continue;
    }
    const auto& jump = std::get<hybrid::JumpPoint>(part);
    seen({jump.t, jump.j + 1, &jump, jump.after});
  }
}

void visit_steps(const hybrid::Trajectory& run,
                 const std::function<void(const hybrid::DenseStep&)>& seen) {
  for (const auto& part : run.parts)
    if (const auto* flow = std::get_if<hybrid::FlowPiece>(&part))
      for (const hybrid::DenseStep& step : flow->steps) seen(step);
}

}  // namespace gainsmith::claims
