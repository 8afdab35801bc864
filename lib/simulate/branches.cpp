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

namespace {

constexpr double kOfAccuracy = 1e-3;
/// Of what D changes: farther from 0 at all points of a step, it has no pair of roots there.
constexpr double kFar = 4;

}  // namespace

/// What the kinks of one step share.
struct Branches::Look {
  explicit Look(const StepValues& inside)
      : points(inside),
        three{inside.at(inside.from()),
              inside.at(inside.from() + (inside.to() - inside.from()) / 2),
              inside.at(inside.to())} {}

  StepPoints points;
  std::array<VectorXd, 3> three;
  std::optional<CrossingsOnStep> border;  ///< of the kink that is looked at
  VectorXd slack;                         ///< of its elements
};

Branches::Branches(const hybrid::System& system, EventWatch& watch, const Accuracy& accuracy)
    : system_(&system),
      watch_(&watch),
      relative_(system.affine ? 0 : kOfAccuracy * accuracy.relative),
      absolute_(system.affine                     ? 0
                : accuracy.absolute_of.size() > 0 ? kOfAccuracy * accuracy.absolute_of.minCoeff()
                                                  : kOfAccuracy * accuracy.absolute) {}

Index Branches::offset(std::size_t one) const {
  return system_->layout.slots[system_->dynamics.variables.size() + one].offset;
}

bool Branches::is_kink(std::size_t one) const {
  return system_->switches[one].kind == hybrid::Switch::Kind::kink;
}

void Branches::hold(VectorXd& values) {
  for (std::size_t k = 0; k < watch_->switches.size(); ++k) hold_one(k, values);
}

void Branches::hold_kinks(VectorXd& values) {
  for (std::size_t k = 0; k < watch_->switches.size(); ++k)
    if (is_kink(k)) hold_one(k, values);
}

void Branches::hold_one(std::size_t k, VectorXd& values) {
  const hybrid::Switch& one = system_->switches[k];
  hybrid::EventFunction& border = watch_->switches[k];
  const Matrix difference = border(values);
  const bool kink = one.kind == hybrid::Switch::Kind::kink;
  const Matrix noise = kink ? Matrix(hybrid::kTermRounding * border.terms(values)) : Matrix();
  for (Index e = 0; e < difference.size(); ++e) {
    double& held = values(offset(k) + e);
    const double d = difference(e);
    if (kink && held != 0 && std::abs(d) <= noise(e)) continue;
    if (kink) {
      held = d > 0 ? 1 : d < 0 ? -1 : held < 0 ? -1 : 1;
    } else if (one.kind == hybrid::Switch::Kind::sign) {
      held = d > 0 ? 1 : d < 0 ? -1 : 0;
    } else {
      held = (one.strict ? d > 0 : d >= 0) ? 1 : -1;
    }
  }
}

std::optional<Branches::Turn> Branches::first_turn(const StepValues& inside,
                                                   const VectorXd& values) {
  std::optional<Turn> first;
  std::optional<Look> look;
  for (std::size_t k = 0; k < watch_->switches.size(); ++k) {
    hybrid::EventFunction& border = watch_->switches[k];
    if (border.rests()) continue;
    if (!look) look.emplace(inside);
    look->border.reset();
    for (Index e = 0; e < border.size(); ++e) {
      const double held = values(offset(k) + e);
      const ode::StepRange range([&](const VectorXd& x) { return border(x)(e); }, look->three);
      if (!border.waves() && range.is_far_from_zero(held)) continue;
      if (const auto turn = turn_of(k, e, held, *look); turn && (!first || turn->t < first->t))
        first = turn;
    }
  }
  return first;
}

std::optional<Branches::Turn> Branches::turn_of(std::size_t one, Index element, double held,
                                                Look& look) {
  const std::vector<double>& times = look.points.times();
  if (!look.border) {
    look.border.emplace(watch_->switches[one], look.points);
    look.slack = look.border->noise();
    const auto terms = watch_->switches[one].terms(look.three[0]).reshaped();
    if (is_kink(one)) look.slack += (relative_ * terms.array() + absolute_ * part_).matrix();
  }
  const double slack = look.slack(element);
  const auto value = [&](double t) { return look.border->value(element, t); };
  const auto beyond = [&](double t) {
    const double d = value(t);
    return held == 0 ? std::abs(d) > slack : d * held < -slack;
  };
  const auto on_side = (held * look.border->values().row(element).array()).eval();
  // No pair of roots hides between points of a D that is far from 0 at all of them.
  if (!watch_->switches[one].waves() &&
      on_side.minCoeff() > (on_side.maxCoeff() - on_side.minCoeff()) / kFar)
    return std::nullopt;
  ode::Found found = look.border->roots(element, held < 0);
  std::vector<double> places(times.begin(), times.end());
  for (std::size_t k = 0; k + 1 < found.roots.size(); ++k)
    places.push_back((found.roots[k].right + found.roots[k + 1].left) / 2);
  std::sort(places.begin(), places.end());
  const auto there = std::find_if(places.begin(), places.end(), beyond);
  if (there == places.end()) return std::nullopt;
  const double to = value(*there) > 0 ? 1 : -1;
  if (held == 0 && to > 0) found = look.border->roots(element, true);
  Turn turn{value(times.front()) * to < 0 ? *there : times.front(), offset(one) + element, to, one};
  for (const ode::Root& root : found.roots)
    if (root.right <= *there) turn.t = root.right;
  return turn;
}

}  // namespace gainsmith::simulate
