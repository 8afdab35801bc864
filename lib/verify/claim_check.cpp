#include "verify/claim_check.h"

#include <algorithm>
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

/// Whether value <= bound fails by more than the relative tolerance; a NaN fails.
bool exceeds(double value, double bound, double scale, double floor = 0) {
  return !(value <= bound + kRelativeTolerance * std::abs(scale) + floor);
}

/// max |x| over the samples up to `last`.
double largest_state(const Arc& arc, std::size_t last) {
  return arc.states().leftCols(static_cast<Index>(last) + 1).cwiseAbs().maxCoeff();
}

/// Rounding excuses no value larger than the one at the start: then nothing of the claim is left to
/// see. A start at exactly 0 has no size of its own.
double forgiven(double floor, double start) {
  return start == 0 ? floor : std::min(floor, std::abs(start));
}

}  // namespace

ClaimCheck::ClaimCheck(const LinkedClaim& claim, const hybrid::System& system,
                       const hybrid::FlowSteps& steps)
    : claim_(&claim),
      steps_(&steps),
      value_(claim.value, system),
      flow_cost_(make_function(claim.flow_cost, system)),
      jump_cost_(make_function(claim.jump_cost, system)),
      factor_(make_function(claim.factor, system)) {}

Finding ClaimCheck::operator()(const Arc& arc) {
  switch (claim_->kind) {
    case model::ClaimKind::nonincreasing:
      return nonincreasing(arc);
    case model::ClaimKind::cost:
      return cost(arc);
    case model::ClaimKind::shrinks:
      return shrinks(arc);
  }
  return {};
}

Eigen::VectorXd ClaimCheck::values(const Arc& arc) {
  return value_(arc.states(), timers(arc)).row(0).transpose();
}

Eigen::VectorXd ClaimCheck::running_cost(const Arc& arc) {
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

Finding ClaimCheck::nonincreasing(const Arc& arc) {
  const Eigen::VectorXd v = values(arc);
  const std::size_t last = arc.samples() - 1;
  std::vector<std::size_t> rising;  // by more than the relative tolerance
  std::vector<double> bounds;
  std::vector<double> scales;  // largest |x| so far
  double least = v(0);
  double largest = 0;
  for (std::size_t k = 0; k <= last; ++k) {
    const double value = v(static_cast<Index>(k));
    largest = std::max(largest, arc.state(k).cwiseAbs().maxCoeff());
    if (exceeds(value, least, v(0))) {
      rising.push_back(k);
      bounds.push_back(least);
      scales.push_back(largest);
    }
    if (value < least) least = value;
  }

  Finding worst = finding_at(arc, last, v(v.size() - 1), v(0));
  worst.score = score_of(worst.value - worst.bound, v(0), false);
  const Eigen::VectorXd floors = rounding_floors(
      arc, rising,
      Eigen::Map<const Eigen::VectorXd>(scales.data(), static_cast<Index>(scales.size())));
  for (std::size_t i = 0; i < rising.size(); ++i) {
    const double value = v(static_cast<Index>(rising[i]));
    if (!exceeds(value, bounds[i], v(0), forgiven(floors(static_cast<Index>(i)), v(0)))) continue;
    const double score = score_of(value - bounds[i], v(0), true);
    if (worst.violated && !(score > worst.score)) continue;
    worst = finding_at(arc, rising[i], value, bounds[i]);
    worst.violated = true;
    worst.score = score;
  }
  return worst;
}

Finding ClaimCheck::cost(const Arc& arc) {
  const Eigen::VectorXd c = running_cost(arc);
  const double bound = value_at(arc, 0);
  Index worst = 0;  // the largest cost; a NaN counts as the largest
  for (Index k = 1; k < c.size() && !std::isnan(c(worst)); ++k)
    if (!(c(k) <= c(worst))) worst = k;
  const auto sample = static_cast<std::size_t>(worst);
  Finding finding = finding_at(arc, sample, c(worst), bound);
  finding.violated =
      exceeds(c(worst), bound, bound) &&
      exceeds(c(worst), bound, bound, forgiven(rounding_floor(arc, 0, sample), bound));
  finding.score = score_of(c(worst) - bound, bound, finding.violated);
  return finding;
}

Finding ClaimCheck::shrinks(const Arc& arc) {
  const std::size_t last = arc.samples() - 1;
  const double start = value_at(arc, 0);
  const double factor = (*factor_)(arc.states().leftCols(1), timers(arc).head(1))(0, 0);
  Finding finding = finding_at(arc, last, value_at(arc, last), factor * start);
  if (start == 0) return finding;
  const double bound = finding.bound;
  finding.violated =
      exceeds(finding.value, bound, bound) &&
      exceeds(finding.value, bound, bound, forgiven(rounding_floor(arc, last, last), start));
  finding.score = score_of(finding.value - bound, bound, finding.violated);
  return finding;
}

double ClaimCheck::value_at(const Arc& arc, std::size_t sample) {
  const auto at = static_cast<Index>(sample);
  return value_(arc.states().col(at), timers(arc).segment(at, 1))(0, 0);
}

double ClaimCheck::rounding_floor(const Arc& arc, std::size_t sample, std::size_t last) {
  return rounding_floors(arc, {sample}, Eigen::VectorXd::Constant(1, largest_state(arc, last)))(0);
}

Eigen::VectorXd ClaimCheck::rounding_floors(const Arc& arc, const std::vector<std::size_t>& samples,
                                            const Eigen::VectorXd& largest) {
  const Index points = arc.size + 1;  // the sample itself, then one element moved at a time
  const auto count = static_cast<Index>(samples.size());
  numbers::Matrix states(arc.size, count * points);
  Eigen::VectorXd taus(count * points);
  for (Index i = 0; i < count; ++i) {
    const std::size_t sample = samples[static_cast<std::size_t>(i)];
    auto around = states.middleCols(i * points, points);
    around = arc.state(sample).replicate(1, points);
    around.rightCols(arc.size).diagonal().array() += kStateRounding * largest(i);
    taus.segment(i * points, points).setConstant(arc.timer[sample]);
  }
  const Eigen::VectorXd v = value_(states, taus).row(0).transpose();
  Eigen::VectorXd floors(count);
  for (Index i = 0; i < count; ++i)
    floors(i) = (v.segment(i * points + 1, arc.size).array() - v(i * points)).abs().sum();
  return floors;
}

}  // namespace gainsmith::verify
