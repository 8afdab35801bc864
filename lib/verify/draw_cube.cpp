#include "verify/draw_cube.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/number.h"
#include "verify/tolerances.h"

namespace gainsmith::verify {

namespace {

using Eigen::Index;
using hybrid::GivenRun;
using model::Dynamics;
using numbers::Matrix;

/// floor(number u), at most number - 1.
std::size_t index_in(std::size_t number, double u) {
  return std::min(number - 1, static_cast<std::size_t>(u * static_cast<double>(number)));
}

/// The cube [-1, 1]^n onto the unit ball, along rays.
Eigen::VectorXd ball_point(const Eigen::VectorXd& w) {
  const double length = w.norm();
  // |w|_max/|w| maps the face |w|_max = 1 to the sphere.
  return length == 0 ? w : Eigen::VectorXd(w * (w.cwiseAbs().maxCoeff() / length));
}

/// A list that repeats a part of it, as that part.
template <class List>
void shorten(List& list) {
  for (std::size_t period = 1; period < list.size(); ++period) {
    if (list.size() % period != 0) continue;
    if (!std::equal(list.begin() + static_cast<std::ptrdiff_t>(period), list.end(), list.begin()))
      continue;
    list.resize(period);
    return;
  }
}

}  // namespace

DrawCube::DrawCube(const hybrid::System& system, const hybrid::Scenario& scenario,
                   std::size_t period)
    : system_(&system), scenario_(&scenario), period_(period) {
  walk({[&](const Name& name) {
    names_.push_back(name);
    return 0.5;
  }});
}

double DrawCube::Take::between(double low, double high, const Name& name) const {
  const double value = std::lerp(low, high, u(name));
  return digits == 0 ? value : std::clamp(*parse_decimal(brief(value, digits)), low, high);
}

GivenRun DrawCube::at(const std::vector<double>& u) const { return rounded(u, 0); }

GivenRun DrawCube::rounded(const std::vector<double>& u, int digits) const {
  std::size_t next = 0;
  GivenRun run = walk({[&](const Name&) { return std::clamp(u[next++], 0.0, 1.0); }, digits});
  for (auto& list : run.lengths) shorten(list);
  for (auto& list : run.losses) shorten(list);
  for (auto& list : run.noise) shorten(list);
  return run;
}

std::vector<double> DrawCube::start() const {
  constexpr double kAside = 0.85;
  std::vector<double> u;
  for (const Name& name : names_) u.push_back(std::get<0>(name) == Purpose::start ? kAside : 0.5);
  return u;
}

std::vector<double> DrawCube::with_lengths(std::vector<double> u, std::size_t event,
                                           const std::vector<double>& lengths) const {
  const auto& clock = system_->clocks[event];
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const auto [purpose, index, k, element] = names_[i];
    if (purpose == Purpose::length && index == event)
      u[i] = (lengths[k % lengths.size()] - clock->low) / (clock->high - clock->low);
  }
  return u;
}

/// Draw k of the other cube is its draw k modulo its period; what it has not is 1/2.
std::vector<double> DrawCube::unrolled(const DrawCube& other, const std::vector<double>& u) const {
  std::map<Name, double> values;
  for (std::size_t i = 0; i < other.names_.size(); ++i) values[other.names_[i]] = u[i];
  std::vector<double> result;
  for (const auto& [purpose, index, k, element] : names_) {
    const std::size_t place = other.period_ == 0 ? k : k % other.period_;
    const auto known = values.find({purpose, index, place, element});
    result.push_back(known == values.end() ? 0.5 : known->second);
  }
  return result;
}

GivenRun DrawCube::walk(const Take& take) const {
  GivenRun run;
  walk_starts(take, run);
  run.first.resize(system_->dynamics.events.size());
  run.lengths.resize(run.first.size());
  run.losses.resize(run.first.size());
  for (std::size_t e = 0; e < run.first.size(); ++e) walk_event(e, take, run);
  run.noise.resize(system_->noise.size());
  for (std::size_t i = 0; i < run.noise.size(); ++i) walk_noise(i, take, run);
  return run;
}

template <class NameOf>
Matrix DrawCube::around(const std::vector<Matrix>& rule, bool is_lognormal, const Take& take,
                        const NameOf& name) const {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(rule[0].size());
  for (Index k = 0; k < z.size(); ++k)
    if (!rule[1].col(k).isZero(0)) z(k) = take.between(-kReach, kReach, name(k));
  return hybrid::around(rule[0], rule[1], z, is_lognormal);
}

void DrawCube::walk_starts(const Take& take, GivenRun& run) const {
  run.starts.resize(scenario_->starts.size());
  for (std::size_t v = 0; v < run.starts.size(); ++v) {
    const auto& rule = scenario_->starts[v];
    if (!rule || rule->kind == model::StartKind::expression) continue;
    const auto name = [&](Index element) { return Name{Purpose::start, v, 0, element}; };
    Matrix value = rule->values[0];
    if (rule->kind == model::StartKind::list) {
      if (rule->values.size() < 2) continue;
      value = rule->values[index_in(rule->values.size(), take.u(name(0)))];
    } else if (has_center(rule->kind)) {
      value = around(rule->values, rule->kind == model::StartKind::lognormal, take, name);
    } else if (rule->kind == model::StartKind::ellipsoid) {
      Eigen::VectorXd w(value.size());
      for (Index k = 0; k < w.size(); ++k) w(k) = 2 * take.u(name(k)) - 1;
      value = value + rule->values[1] * hybrid::in_shell(*rule, ball_point(w));
    } else {
      const bool symmetric =
          system_->dynamics.variables[v].structure == model::Structure::symmetric;
      for (Index j = 0; j < value.cols(); ++j)
        for (Index i = symmetric ? j : 0; i < value.rows(); ++i) {
          const double high = rule->values[1](i, j);
          if (value(i, j) < high)
            value(i, j) = take.between(value(i, j), high, name(i + j * value.rows()));
          if (symmetric) value(j, i) = value(i, j);
        }
    }
    run.starts[v] = value;
  }
}

/// How many draws a list has of which one is made in each such time.
std::size_t DrawCube::count(double every) const {
  if (period_ > 0) return period_;
  const double number = every > 0 ? std::ceil(scenario_->horizon / every) + 1 : kLongestList;
  return static_cast<std::size_t>(std::clamp(number, 1.0, kLongestList));
}

std::size_t DrawCube::count_of_event(std::size_t event) const {
  const auto& clock = system_->clocks[event];
  return count(clock ? (clock->low + clock->high) / 2 : 0);
}

void DrawCube::walk_event(std::size_t event, const Take& take, GivenRun& run) const {
  const auto& clock = system_->clocks[event];
  if (clock && clock->first && !scenario_->first[event] &&
      clock->first->first < clock->first->second)
    run.first[event] =
        take.between(clock->first->first, clock->first->second, {Purpose::first, event, 0, 0});
  if (clock && clock->low < clock->high)
    for (std::size_t k = 0; k < count_of_event(event); ++k)
      run.lengths[event].push_back(
          take.between(clock->low, clock->high, {Purpose::length, event, k, 0}));
  if (system_->dynamics.events[event].lost > 0)
    for (std::size_t k = 0; k < count_of_event(event); ++k)
      run.losses[event].push_back(take.u({Purpose::loss, event, k, 0}) > 0.5 ? 1 : 0);
}

void DrawCube::walk_noise(std::size_t noise, const Take& take, GivenRun& run) const {
  const Dynamics::Noise& one = system_->dynamics.noise[noise];
  const hybrid::System::NoiseValues& rule = system_->noise[noise];
  const auto name = [&](std::size_t k, Index element) {
    return Name{Purpose::noise, noise, k, element};
  };
  if (one.kind == Dynamics::NoiseKind::vertices || one.kind == Dynamics::NoiseKind::corners) {
    if (rule.values.size() > 1)
      run.noise[noise] = {rule.values[index_in(rule.values.size(), take.u(name(0, 0)))]};
    return;
  }
  const Matrix &low = rule.values[0], &high = rule.values[1];
  if (one.has_center() ? high.isZero(0) : low == high) return;
  const std::size_t number = rule.every  ? count(*rule.every)
                             : one.event ? count_of_event(*one.event)
                                         : 1;
  for (std::size_t k = 0; k < number; ++k) {
    Matrix value = low;
    if (one.has_center())
      value = around(rule.values, one.kind == Dynamics::NoiseKind::lognormal, take,
                     [&](Index e) { return name(k, e); });
    for (Index e = 0; !one.has_center() && e < value.size(); ++e)
      if (low(e) != high(e)) value(e) = take.between(low(e), high(e), name(k, e));
    run.noise[noise].push_back(value);
  }
}

}  // namespace gainsmith::verify
