#include "judge/end.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "expr/number_type.h"
#include "judge/flow.h"
#include "judge/jump.h"

namespace gainsmith::judge {

namespace {

constexpr double kLarge = 1e6;         ///< times the start: has escaped
constexpr double kAtOnce = 1e-9;       ///< of a time
constexpr std::size_t kLengths = 4;    ///< that must shrink by one factor
constexpr double kSteady = 0.02;       ///< a factor may change by that
constexpr double kOfRest = 0.25;       ///< how far an accumulation may be off
constexpr double kSmallSteady = 3e-3;  ///< of 1 - factor: what small factors may change by
constexpr std::size_t kShort = 8;      ///< flows of a chattering run
constexpr double kShortLength = 1e-3;  ///< of the time until then

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

std::int64_t last_chain(const hybrid::Trajectory& trajectory) {
  std::int64_t jumps = 0;
  for (auto part = trajectory.parts.rbegin();
       part != trajectory.parts.rend() && std::holds_alternative<hybrid::JumpPoint>(*part); ++part)
    ++jumps;
  return jumps;
}

/// Whether every text has a value at x: flows, conditions, borders, reactions.
bool has_values(JudgedTexts& texts, const Eigen::VectorXd& x) {
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
Eigen::VectorXd ahead(JudgedTexts& texts, const Eigen::VectorXd& x, double dt) {
  Eigen::VectorXd rate;
  try {
    texts.rate(x, rate);
  } catch (const expr::EvaluationError&) {
    return x;
  }
  return x + dt * rate;
}

bool is_undefined(JudgedTexts& texts, double t, const Eigen::VectorXd& x) {
  const double scale = std::max(1.0, std::abs(t));
  for (const double share : {0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7})
    if (!has_values(texts, ahead(texts, x, share * scale))) return true;
  return false;
}

bool has_escaped(JudgedTexts& texts, const hybrid::Trajectory& trajectory,
                 const Eigen::VectorXd& x) {
  if (!x.allFinite() || x.size() == 0) return true;
  const double start = trajectory.start.cwiseAbs().maxCoeff();
  if (x.cwiseAbs().maxCoeff() >= kLarge * (1 + start)) return true;
  Eigen::VectorXd rate;
  try {
    texts.rate(x, rate);
  } catch (const expr::EvaluationError&) {
    return true;
  }
  const double time = std::max(trajectory.end, 1e-300);
  return (rate.cwiseAbs().array() * kAtOnce * time >= x.cwiseAbs().array() + 1e-300).any() &&
         rate.cwiseAbs().maxCoeff() * kAtOnce * time >= x.cwiseAbs().maxCoeff();
}

bool is_zeno(const hybrid::Trajectory& trajectory) {
  const std::vector<double> lengths = flow_lengths(trajectory);
  if (lengths.size() < kLengths + 1) return false;
  std::vector<double> factors;
  for (std::size_t k = lengths.size() - kLengths; k < lengths.size(); ++k)
    factors.push_back(lengths[k] / lengths[k - 1]);
  const auto [least, most] = std::minmax_element(factors.begin(), factors.end());
  const double steady = std::max(kSteady * *most, kSmallSteady * (1 - *most));
  if (!(*most < 1 && *most - *least <= steady)) return false;
  const double rest = factors.back() / (1 - factors.back()) * lengths.back();
  return std::abs(trajectory.accumulation - trajectory.end - rest) <=
         kOfRest * rest + time_rounding(trajectory.end, trajectory.accumulation);
}

bool is_chattering(const hybrid::Trajectory& trajectory) {
  const std::vector<double> lengths = flow_lengths(trajectory);
  if (lengths.size() < kShort) return false;
  return std::all_of(lengths.end() - static_cast<std::ptrdiff_t>(kShort), lengths.end(),
                     [&](double length) {
                       return length <= kShortLength * std::max(trajectory.end, lengths.front());
                     });
}

bool is_sliding(JudgedTexts& texts, double t, const Eigen::VectorXd& x) {
  const double dt = kAtOnce * std::max(1.0, std::abs(t));
  Eigen::VectorXd here, there;
  try {
    texts.rate(x, here);
    for (const double side : {-1.0, 1.0}) {
      texts.rate(x + side * dt * here, there);
      const double size = std::max(here.cwiseAbs().maxCoeff(), there.cwiseAbs().maxCoeff());
      if ((there - here).cwiseAbs().maxCoeff() > 1e-3 * size) return true;
    }
  } catch (const expr::EvaluationError&) {
    return false;
  }
  return false;
}

bool exhausts_a_loop(JudgedTexts& texts, const Eigen::VectorXd& x) {
  for (std::size_t e = 0; e < texts.events.size(); ++e)
    if (jump_values(texts, e, false, x).exhausted) return true;
  return false;
}

bool is_outside(JudgedTexts& texts, double t, const Eigen::VectorXd& x) {
  const Eigen::VectorXd rounding = rounding_at(texts, t, x, texts.by_variable(x.cwiseAbs()));
  return std::any_of(texts.flow_sets.begin(), texts.flow_sets.end(), [&](FlowSetText& flow_set) {
    return flow_set.left(x) || flow_set.left.truth(x, rounding) != Truth::no;
  });
}

bool has_its_cause(JudgedTexts& texts, const hybrid::Trajectory& trajectory,
                   const Eigen::VectorXd& x) {
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

void check_end(JudgedTexts& texts, const hybrid::Trajectory& trajectory, const Eigen::VectorXd& x,
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
