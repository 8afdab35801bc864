#include "judge/end.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "expr/program/number_type.h"
#include "judge/flow.h"
#include "judge/jump.h"
#include "ode/tolerances.h"

namespace gainsmith::judge {

namespace {

using hybrid::kFewestRatios;
using hybrid::kHardly;
using hybrid::kSteady;

/// The lengths of the flows between jumps, in order.
std::vector<double> flow_lengths(const hybrid::Trajectory& trajectory) {
  std::vector<double> lengths;
  bool open = false;
  for (const auto& part : trajectory.parts) {
    const auto* piece = std::get_if<hybrid::FlowPiece>(&part);
    if (piece == nullptr) {
      open = false;
      continue;
    }
    if (!open) lengths.push_back(0);
    lengths.back() += piece->to() - piece->from();
    open = true;
  }
  return lengths;
}

/// The number of jumps at the end without a flow between them.
std::int64_t last_chain(const hybrid::Trajectory& trajectory) {
  std::int64_t jumps = 0;
  for (auto part = trajectory.parts.rbegin();
       part != trajectory.parts.rend() && std::holds_alternative<hybrid::JumpPoint>(*part); ++part)
    ++jumps;
  return jumps;
}

/// Whether every text has a value at x: flows, conditions, event functions, reactions.
bool has_values(Texts& texts, const Eigen::VectorXd& x) {
  try {
    Eigen::VectorXd rate;
    texts.rate(x, rate);
    if (!rate.allFinite()) return false;
    for (FlowSetText& flow_set : texts.flow_sets) flow_set.left(x);
    for (std::size_t e = 0; e < texts.events.size(); ++e) {
      EventTexts& event = texts.events[e];
      if (event.condition) event.condition->depth(x);
      if (event.crossing) (*event.crossing)(x);
      if (event.only_if) event.only_if->depth(x);
      if (!jump_values(texts, e, false, x).after.allFinite()) return false;
    }
  } catch (const expr::EvaluationError&) {
    return false;
  }
  return true;
}

/// Where the flow leads from x in dt, to first order; x where it has no rate.
Eigen::VectorXd ahead(Texts& texts, const Eigen::VectorXd& x, double dt) {
  Eigen::VectorXd rate;
  try {
    texts.rate(x, rate);
  } catch (const expr::EvaluationError&) {
    return x;
  }
  return x + dt * rate;
}

/// At x, or where the flow leads in 1e-15 to 1e-7 of max(1, t): the simulator may have stopped a
/// little before.
bool is_undefined(Texts& texts, double t, const Eigen::VectorXd& x) {
  const double scale = std::max(1.0, std::abs(t));
  for (const double share : {0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7})
    if (!has_values(texts, ahead(texts, x, share * scale))) return true;
  return false;
}

/// A value is not finite or has grown by kEscape; or at its rate x would double within kHardly of
/// the time.
bool has_escaped(Texts& texts, const hybrid::Trajectory& trajectory, const Eigen::VectorXd& x) {
  if (!x.allFinite() || x.size() == 0) return true;
  const double start = trajectory.start.cwiseAbs().maxCoeff();
  if (x.cwiseAbs().maxCoeff() >= ode::kEscape * (1 + start)) return true;
  Eigen::VectorXd rate;
  try {
    texts.rate(x, rate);
  } catch (const expr::EvaluationError&) {
    return true;
  }
  constexpr double least = std::numeric_limits<double>::min();
  const double time = std::max(trajectory.end, least);
  return (rate.cwiseAbs().array() * kHardly * time >= x.cwiseAbs().array() + least).any() &&
         rate.cwiseAbs().maxCoeff() * kHardly * time >= x.cwiseAbs().maxCoeff();
}

/// Whether each length is r < 1 times that of `period` flows before, and the sum of the last ones
/// times r/(1 - r) leads to where the jumps accumulate.
bool is_zeno(const hybrid::Trajectory& trajectory, const std::vector<double>& lengths,
             std::size_t period) {
  if (lengths.size() < kFewestRatios + period) return false;
  std::vector<double> factors;
  for (std::size_t k = lengths.size() - kFewestRatios; k < lengths.size(); ++k)
    factors.push_back(lengths[k] / lengths[k - period]);
  const auto [least, most] = std::minmax_element(factors.begin(), factors.end());
  if (!(*most < 1 && *most - *least <= kSteady * (1 - *most))) return false;
  const double last =
      std::accumulate(lengths.end() - static_cast<std::ptrdiff_t>(period), lengths.end(), 0.0);
  const double left = trajectory.accumulation - trajectory.end;
  const double rounding = time_rounding(trajectory.end, trajectory.accumulation);
  return left >= last * *least / (1 - *least) * (1 - 2 * kSteady) - rounding &&
         left <= last * *most / (1 - *most) * (1 + 2 * kSteady) + rounding;
}

bool is_zeno(const hybrid::Trajectory& trajectory) {
  const std::vector<double> lengths = flow_lengths(trajectory);
  constexpr std::size_t kLongestPeriod = 3;
  for (std::size_t period = 1; period <= kLongestPeriod; ++period)
    if (is_zeno(trajectory, lengths, period)) return true;
  return false;
}

/// The last kAtOnce flows are each below kHardly of the horizon.
bool is_chattering(const hybrid::Trajectory& trajectory) {
  const std::vector<double> lengths = flow_lengths(trajectory);
  if (lengths.size() < hybrid::kAtOnce) return false;
  return std::all_of(lengths.end() - static_cast<std::ptrdiff_t>(hybrid::kAtOnce), lengths.end(),
                     [&](double length) { return length <= kHardly * trajectory.horizon; });
}

/// The rate kHardly before or behind x along the flow differs by more than kSteady of its size.
bool is_sliding(Texts& texts, double t, const Eigen::VectorXd& x) {
  const double dt = kHardly * std::max(1.0, std::abs(t));
  Eigen::VectorXd here, there;
  try {
    texts.rate(x, here);
    for (const double side : {-1.0, 1.0}) {
      texts.rate(x + side * dt * here, there);
      const double size = std::max(here.cwiseAbs().maxCoeff(), there.cwiseAbs().maxCoeff());
      if ((there - here).cwiseAbs().maxCoeff() > kSteady * size) return true;
    }
  } catch (const expr::EvaluationError&) {
    return false;
  }
  return false;
}

/// Whether the jump of some event, from x, has a loop that ends without its `until`.
bool exhausts_a_loop(Texts& texts, const Eigen::VectorXd& x) {
  for (std::size_t e = 0; e < texts.events.size(); ++e)
    if (jump_values(texts, e, false, x).exhausted) return true;
  return false;
}

/// A flow set is left, or may be within the rounding of x.
bool is_outside(Texts& texts, double t, const Eigen::VectorXd& x) {
  const Eigen::VectorXd rounding = rounding_at(texts, t, x, texts.by_variable(x.cwiseAbs()));
  return std::any_of(texts.flow_sets.begin(), texts.flow_sets.end(), [&](FlowSetText& flow_set) {
    return flow_set.left(x) || flow_set.left.truth(x, rounding) != Truth::no;
  });
}

/// Whether the values at the end show the cause; true of endings that nothing can show.
bool has_its_cause(Texts& texts, const hybrid::Trajectory& trajectory, const Eigen::VectorXd& x) {
  const double t = trajectory.end;
  switch (trajectory.ending) {
    case hybrid::Ending::horizon:
      return t == trajectory.horizon;
    case hybrid::Ending::left:
      return is_outside(texts, t, x);
    case hybrid::Ending::passes:
      return exhausts_a_loop(texts, x);
    case hybrid::Ending::undefined:
      return is_undefined(texts, t, x);
    case hybrid::Ending::stuck:
      return last_chain(trajectory) >= texts.question.least_chain;
    case hybrid::Ending::escaped:
      return has_escaped(texts, trajectory, x);
    case hybrid::Ending::zeno:
      return is_zeno(trajectory);
    case hybrid::Ending::chattering:
      return is_chattering(trajectory);
    case hybrid::Ending::sliding:
      return is_sliding(texts, t, x);
    case hybrid::Ending::full:
    case hybrid::Ending::interrupted:
    case hybrid::Ending::lost:
      break;
  }
  return true;
}

}  // namespace

void check_end(Texts& texts, const hybrid::Trajectory& trajectory, const Eigen::VectorXd& x,
               Faults& faults) {
  const std::size_t part = trajectory.parts.size();
  const double t = trajectory.end;
  const std::string ending = to_string(trajectory.ending);
  if (!(t <= trajectory.horizon))
    faults.add(part, t, "the run ends after its horizon", t, trajectory.horizon);
  if (trajectory.ending != hybrid::Ending::horizon && trajectory.message.empty())
    faults.add(part, t, "the end has no message: " + ending);
  try {
    if (!has_its_cause(texts, trajectory, x))
      faults.add(part, t, "the end is not that of its cause: " + ending);
  } catch (const expr::EvaluationError& error) {
    faults.add(part, t, "a text has no value at the end: " + error.message());
  }
}

}  // namespace gainsmith::judge
