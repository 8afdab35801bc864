#include "verify/check.h"

#include <cmath>
#include <limits>

namespace gainsmith::verify {

namespace {

using Eigen::Index;
using hybrid::Arc;

constexpr double kRelativeTolerance = 1e-9;
constexpr double kStateRounding = 1e-12;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::optional<AlongFunction> make_function(const std::optional<expr::Program>& program,
                                           const hybrid::System& system) {
  if (!program) return std::nullopt;
  return AlongFunction(*program, system);
}

Eigen::Map<const Eigen::VectorXd> timers(const Arc& arc) {
  return {arc.timer.data(), static_cast<Index>(arc.timer.size())};
}

Finding finding_at(const Arc& arc, std::size_t sample, double value, double bound) {
  Finding finding;
  finding.value = value;
  finding.bound = bound;
  finding.t = arc.t[sample];
  finding.j = arc.j[sample];
  return finding;
}

/// The score of an excess; see Finding.
double score_of(double excess, double scale, bool violated) {
  if (std::isnan(excess) || (violated && scale == 0)) return kInfinity;
  return scale == 0 ? -1 : excess / std::abs(scale);
}

/// Whether value <= bound fails by more than rounding; a NaN fails. The floor costs several
/// evaluations and is asked for only when it can matter.
template <class Floor>
bool exceeds(double value, double bound, double scale, Floor floor) {
  const double slack = bound + kRelativeTolerance * std::abs(scale);
  if (value <= slack) return false;
  return !(value <= slack + floor());
}

}  // namespace

Check::Check(const CompiledClaim& claim, const hybrid::System& system, const hybrid::Steps& steps)
    : kind_(claim.kind),
      steps_(&steps),
      value_(claim.value, system),
      flow_cost_(make_function(claim.flow_cost, system)),
      jump_cost_(make_function(claim.jump_cost, system)),
      factor_(make_function(claim.factor, system)) {}

Finding Check::operator()(const Arc& arc) {
  switch (kind_) {
    case model::Claim::Kind::nonincreasing:
      return nonincreasing(arc);
    case model::Claim::Kind::cost:
      return cost(arc);
    case model::Claim::Kind::shrinks:
      return shrinks(arc);
  }
  return {};
}

Eigen::VectorXd Check::values(const Arc& arc) {
  return value_(arc.states(), timers(arc)).row(0).transpose();
}

Eigen::VectorXd Check::running_cost(const Arc& arc) {
  const auto moves = static_cast<Index>(arc.moves.size());
  Eigen::VectorXd flows = Eigen::VectorXd::Zero(moves);
  if (flow_cost_) flows = integrate_steps(arc, *steps_, *flow_cost_);

  Eigen::VectorXd jumps = Eigen::VectorXd::Zero(moves);
  std::vector<Index> before;
  for (Index k = 0; k < moves; ++k)
    if (arc.moves[static_cast<std::size_t>(k)].jump) before.push_back(k);
  if (jump_cost_ && !before.empty())
    jumps(before) = (*jump_cost_)(arc.states()(Eigen::all, before), timers(arc)(before)).row(0);

  Eigen::VectorXd cost = Eigen::VectorXd::Zero(moves + 1);
  for (Index k = 0; k < moves; ++k) cost(k + 1) = cost(k) + flows(k) + jumps(k);
  return cost;
}

Finding Check::nonincreasing(const Arc& arc) {
  const Eigen::VectorXd v = values(arc);
  const std::size_t last = arc.samples() - 1;
  Finding worst = finding_at(arc, last, v(v.size() - 1), v(0));
  worst.score = score_of(worst.value - worst.bound, v(0), false);
  double least = v(0);
  for (std::size_t k = 0; k <= last; ++k) {
    const double value = v(static_cast<Index>(k));
    const auto floor = [&] { return rounding_floor(arc, k, k); };
    if (exceeds(value, least, v(0), floor)) {
      const double score = score_of(value - least, v(0), true);
      if (!worst.violated || score > worst.score) {
        worst = finding_at(arc, k, value, least);
        worst.violated = true;
        worst.score = score;
      }
    }
    if (value < least) least = value;
  }
  return worst;
}

Finding Check::cost(const Arc& arc) {
  const Eigen::VectorXd c = running_cost(arc);
  const double bound = value_at(arc, 0);
  Index worst = 0;
  while (worst + 1 < c.size() && std::isnan(c(worst)) == false && std::isnan(c(worst + 1))) ++worst;
  for (Index k = 0; k < c.size() && !std::isnan(c(worst)); ++k)
    if (!(c(k) <= c(worst))) worst = k;
  const auto sample = static_cast<std::size_t>(worst);
  Finding finding = finding_at(arc, sample, c(worst), bound);
  finding.violated =
      exceeds(c(worst), bound, bound, [&] { return rounding_floor(arc, 0, sample); });
  finding.score = score_of(c(worst) - bound, bound, finding.violated);
  return finding;
}

Finding Check::shrinks(const Arc& arc) {
  const std::size_t last = arc.samples() - 1;
  const double start = value_at(arc, 0);
  const double factor = (*factor_)(arc.states().leftCols(1), timers(arc).head(1))(0, 0);
  Finding finding = finding_at(arc, last, value_at(arc, last), factor * start);
  if (start == 0) return finding;
  finding.violated = exceeds(finding.value, finding.bound, finding.bound,
                             [&] { return rounding_floor(arc, last, last); });
  finding.score = score_of(finding.value - finding.bound, finding.bound, finding.violated);
  return finding;
}

double Check::value_at(const Arc& arc, std::size_t sample) {
  const auto at = static_cast<Index>(sample);
  return value_(arc.states().col(at), timers(arc).segment(at, 1))(0, 0);
}

double Check::rounding_floor(const Arc& arc, std::size_t sample, std::size_t last) {
  const double largest = arc.states().leftCols(static_cast<Index>(last) + 1).cwiseAbs().maxCoeff();
  expr::Matrix states = arc.state(sample).replicate(1, arc.size + 1);
  for (Index i = 0; i < arc.size; ++i) states(i, i + 1) += kStateRounding * largest;
  const Eigen::VectorXd times = Eigen::VectorXd::Constant(arc.size + 1, arc.timer[sample]);
  const Eigen::VectorXd v = value_(states, times).row(0).transpose();
  return (v.tail(arc.size).array() - v(0)).abs().sum();
}

}  // namespace gainsmith::verify
