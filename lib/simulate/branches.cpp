#include "simulate/branches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ode/step_range.h"
#include "simulate/crossings_on_step.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::VectorXd;
using numbers::Matrix;

/// What the kinks of one step share.
struct Branches::OnStep {
  explicit OnStep(const StepValues& values) : inside(values), box(values.box()) {}

  /// The start, the middle and the end.
  const std::array<VectorXd, 3>& three() {
    const double from = inside.from(), to = inside.to();
    if (!points) points = {inside.at(from), inside.at(from + (to - from) / 2), inside.at(to)};
    return *points;
  }

  const StepValues& inside;
  numbers::Box box;
  std::vector<double> times;  ///< ode::first_points; none: not asked for yet
  std::optional<std::array<VectorXd, 3>> points;
  std::optional<CrossingsOnStep> crossings;  ///< of one kink
  VectorXd slack;                            ///< of its elements
};

Branches::Branches(const hybrid::System& system, EventWatch& watch, const Accuracy& accuracy)
    : system_(&system),
      watch_(&watch),
      relative_(system.affine ? 0 : hybrid::kOfAccuracy * accuracy.relative),
      absolute_(system.affine ? 0
                : accuracy.absolute_of.size() > 0
                    ? hybrid::kOfAccuracy * accuracy.absolute_of.minCoeff()
                    : hybrid::kOfAccuracy * accuracy.absolute) {}

Index Branches::offset(std::size_t which) const {
  return system_->layout.slots[system_->dynamics.variables.size() + which].offset;
}

bool Branches::is_kink(std::size_t which) const {
  return system_->switches[which].kind == hybrid::Switch::Kind::kink;
}

void Branches::update(VectorXd& values) {
  for (std::size_t k = 0; k < watch_->switches.size(); ++k) update_one(k, values);
}

void Branches::update_kinks(VectorXd& values) {
  for (std::size_t k = 0; k < watch_->switches.size(); ++k)
    if (is_kink(k)) update_one(k, values);
}

void Branches::update_one(std::size_t k, VectorXd& values) {
  const hybrid::Switch& branching = system_->switches[k];
  hybrid::EventFunction& function = watch_->switches[k];
  const Matrix difference = function(values);
  const bool kink = branching.kind == hybrid::Switch::Kind::kink;
  const Matrix noise = kink ? Matrix(hybrid::kTermRounding * function.terms(values)) : Matrix();
  for (Index e = 0; e < difference.size(); ++e) {
    double& branch = values(offset(k) + e);
    const double d = difference(e);
    if (kink && branch != 0 && std::abs(d) <= noise(e)) continue;
    if (kink) {
      branch = d > 0 ? 1 : d < 0 ? -1 : branch < 0 ? -1 : 1;
    } else if (branching.kind == hybrid::Switch::Kind::sign) {
      branch = d > 0 ? 1 : d < 0 ? -1 : 0;
    } else {
      branch = (branching.strict ? d > 0 : d >= 0) ? 1 : -1;
    }
  }
}

/// Two cheap tests exclude most elements: an interval over the whole step, and a parabola through
/// three of its points where D is slow.
std::optional<Branches::Change> Branches::first_change(const StepValues& inside,
                                                       const VectorXd& values) {
  std::optional<Change> first;
  std::optional<OnStep> on_step;
  for (std::size_t k = 0; k < watch_->switches.size(); ++k) {
    hybrid::EventFunction& function = watch_->switches[k];
    if (function.rests()) continue;
    if (!on_step) on_step.emplace(inside);
    on_step->crossings.reset();
    const std::vector<int>& sides = function.sides(on_step->box);
    for (Index e = 0; e < function.size(); ++e) {
      const double branch = values(offset(k) + e);
      if (!sides.empty() && sides[static_cast<std::size_t>(e)] * branch > 0) continue;
      const ode::StepRange range([&](const VectorXd& x) { return function(x)(e); },
                                 on_step->three());
      if (!function.waves() && range.is_far_from_zero(branch)) continue;
      if (const auto change = change_of(k, e, branch, *on_step);
          change && (!first || change->t < first->t))
        first = change;
    }
  }
  return first;
}

std::optional<Branches::Change> Branches::change_of(std::size_t which, Index element, double branch,
                                                    OnStep& on_step) {
  const std::vector<double>& times = on_step.times;
  if (!on_step.crossings) {
    if (times.empty())
      on_step.times = ode::first_points(on_step.inside.from(), on_step.inside.to());
    on_step.crossings.emplace(watch_->switches[which], on_step.inside, times);
    on_step.slack = on_step.crossings->noise();
    const auto terms = watch_->switches[which].terms(on_step.three()[0]).reshaped();
    if (is_kink(which)) on_step.slack += (relative_ * terms.array() + absolute_ * part_).matrix();
  }
  const double slack = on_step.slack(element);
  const auto value = [&](double t) { return on_step.crossings->value(element, t); };
  const auto beyond = [&](double t) {
    const double d = value(t);
    return branch == 0 ? std::abs(d) > slack : d * branch < -slack;
  };
  double least = branch * value(times.front());
  double largest = least;
  for (const double t : times) {
    least = std::min(least, branch * value(t));
    largest = std::max(largest, branch * value(t));
  }
  // No pair of roots hides between points of a D that is far from 0 at all of them.
  if (!watch_->switches[which].waves() && least > (largest - least) / ode::kFar)
    return std::nullopt;
  ode::Found found = on_step.crossings->roots(element, branch < 0);
  // D is asked at sample points and between neighbouring roots: between two of these its sign is
  // one.
  std::vector<double> places(times.begin(), times.end());
  for (std::size_t k = 0; k + 1 < found.roots.size(); ++k)
    places.push_back((found.roots[k].right + found.roots[k + 1].left) / 2);
  std::sort(places.begin(), places.end());
  const auto there = std::find_if(places.begin(), places.end(), beyond);
  if (there == places.end()) return std::nullopt;
  const double to = value(*there) > 0 ? 1 : -1;
  if (branch == 0 && to > 0) found = on_step.crossings->roots(element, true);
  Change change{value(times.front()) * to < 0 ? *there : times.front(), offset(which) + element, to,
                which};
  for (const ode::Root& root : found.roots)
    if (root.right <= *there && on_step.crossings->hidden_slope(element, root.right) == 0)
      change.t = root.right;
  return change;
}

}  // namespace gainsmith::simulate
