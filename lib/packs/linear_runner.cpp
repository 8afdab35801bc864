#include "packs/linear_runner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/stop.h"
#include "hybrid/tolerances.h"
#include "linear/length_table.h"
#include "linear/tolerances.h"
#include "packs/lane_lengths.h"
#include "packs/tolerances.h"

namespace gainsmith::packs {

using lanes::kLanes;
using lanes::LaneMachine;
using model::ClaimKind;

/// What is drawn, over lanes.
class LaneStarts {
 public:
  explicit LaneStarts(const linear::LinearModel& model) : model_(&model) {}

  /// Bit by bit that of hybrid::draw_start, to the inputs from `first` on.
  void draw(std::uint64_t seed, const LaneRuns& runs, std::size_t first, LaneMachine& machine) {
    if (model_->scenario->given_for(runs.front()) != nullptr)
      return take_given(seed, runs, first, machine);
    for (std::size_t k = 0; k < model_->drawn.size(); ++k) {
      const linear::DrawnElement& element = model_->drawn[k];
      const hybrid::StartRule& rule = *model_->scenario->starts[element.variable];
      double* const out = machine.input(first + k);
      if (rule.kind == model::StartKind::box) {
        const double low = rule.values[0](element.element);
        const double width = rule.values[1](element.element) - low;
        lanes::variant().uniforms(
            hybrid::stream_key(seed, hybrid::Purpose::start, element.variable), runs.data(),
            static_cast<std::uint64_t>(element.element), low, width, out);
      } else if (rule.kind == model::StartKind::list) {
        for (std::size_t l = 0; l < kLanes; ++l)
          out[l] = rule.values[runs[l] % rule.values.size()](element.element);
      } else if (k == 0 || model_->drawn[k - 1].variable != element.variable) {
        draw_around(seed, runs, k, first, machine);
      }
    }
  }

 private:
  /// Of runs whose draws are given.
  void take_given(std::uint64_t seed, const LaneRuns& runs, std::size_t first,
                  LaneMachine& machine) {
    const hybrid::System& system = *model_->sampled->dynamics;
    Eigen::VectorXd start;
    for (std::size_t l = 0; l < kLanes; ++l) {
      if (l == 0 || runs[l] != runs[l - 1])
        start = hybrid::draw_start(system, *model_->scenario, seed, runs[l]);
      for (std::size_t k = 0; k < model_->drawn.size(); ++k) {
        const linear::DrawnElement& drawn = model_->drawn[k];
        machine.input(first + k)[l] =
            start(system.layout.slots[drawn.variable].offset + drawn.element);
      }
    }
  }
  /// All elements of the variable whose first one is number k.
  void draw_around(std::uint64_t seed, const LaneRuns& runs, std::size_t k, std::size_t first,
                   LaneMachine& machine) {
    const std::size_t variable = model_->drawn[k].variable;
    const hybrid::StartRule& rule = *model_->scenario->starts[variable];
    for (std::size_t l = 0; l < kLanes; ++l) {
      RandomStream random = hybrid::draw_stream(seed, runs[l], hybrid::Purpose::start, variable);
      const numbers::Matrix point = hybrid::draw_around(rule, random);
      for (std::size_t e = k; e < model_->drawn.size() && model_->drawn[e].variable == variable;
           ++e)
        machine.input(first + e)[l] = point(model_->drawn[e].element);
    }
  }

  const linear::LinearModel* model_;
};

/// One pack of runs after the other. A flow is one call of `step_`. Every `flows_of_block` flows
/// `gather_` renews the error bounds and scales z by powers of 2; quadratic forms then have the
/// unit 2^(-2 exponent).
class LinearLanes {
 public:
  explicit LinearLanes(const linear::LinearSystem& system)
      : system_(system),
        starts_(system.model),
        lengths_(*system.model.sampled->dynamics, *system.model.scenario),
        first_(*system.first),
        step_(*system.step),
        gather_(*system.gather),
        last_(*system.last),
        longest_((1 + hybrid::kAddedUp) * system.model.longest()) {}

  std::vector<PackVerdict> run(std::uint64_t seed, std::uint64_t first, std::uint64_t last) {
    verdicts_.assign(static_cast<std::size_t>(last - first), {});
    first_run_ = first;
    const std::uint64_t laws =
        std::max<std::uint64_t>(system_.model.scenario->laws.front().size(), 1);
    for (std::uint64_t law = 0; law < laws; ++law) {
      LaneRuns runs{};
      std::size_t count = 0;
      for (std::uint64_t run = first + (law + laws - first % laws) % laws; run < last;
           run += laws) {
        runs[count++] = run;
        if (count == kLanes) {
          make(seed, runs, count);
          count = 0;
        }
      }
      if (count == 0) continue;
      std::fill(runs.begin() + static_cast<std::ptrdiff_t>(count), runs.end(), runs.front());
      make(seed, runs, count);
    }
    return std::move(verdicts_);
  }

 private:
  // Inputs of the code.
  static constexpr std::size_t kFirstXi = 1, kStepCarried = 1, kGatherCarried = 2, kLastCarried = 4;

  /// The first `count` lanes hold runs; the others repeat the first of them and are not judged.
  void make(std::uint64_t seed, const LaneRuns& runs, std::size_t count) {
    check_stop();
    begin(seed, runs, count);
    for (std::int64_t flows = 1; running_ != 0; ++flows) {
      if ((flows - 1) % system_.flows_of_block == 0) {
        check_stop();
        gather();
      }
      lengths_.advance();
      end_lanes(static_cast<double>(flows));
      if (running_ == 0) break;
      if (flows > hybrid::kMost) {
        open_ |= running_;
        running_ = 0;
        break;
      }
      std::copy_n(lengths_.length().data(), kLanes, step_.input(0));
      step_.run();
      open_ |= step_.faults() & running_;
      t_ = lengths_.due();
    }
    last_.run();
    open_ |= last_.faults();
    for (std::size_t l = 0; l < count; ++l)
      verdicts_[static_cast<std::size_t>(runs[l] - first_run_)] = verdict(l);
  }

  /// The first flow and its jump.
  void begin(std::uint64_t seed, const LaneRuns& runs, std::size_t count) {
    const double horizon = system_.model.scenario->horizon;
    running_ = count == kLanes ? ~0U : (1U << count) - 1;
    open_ = 0;
    gathered_ = 0;
    exponent_.fill(0);
    for (auto& cost : costs_) cost = {};
    costs_.resize(system_.claims.size());
    starts_.draw(seed, runs, kFirstXi, first_);
    lengths_.begin(seed, runs);
    std::copy_n(lengths_.length().data(), kLanes, first_.input(0));
    const std::size_t given = kFirstXi + system_.model.drawn.size();
    if (system_.first_table.has_pieces())
      for (std::size_t l = 0; l < kLanes; ++l)
        system_.first_table.values(lengths_.length()[l], first_.input(given) + l, kLanes);
    first_.run();
    t_ = lengths_.due();
    std::uint32_t without = 0;
    for (std::size_t l = 0; l < kLanes; ++l)
      if (!(t_[l] <= horizon + hybrid::kOneInstant * horizon)) without |= 1U << l;
    // Runs without a jump.
    open_ |= (without | first_.faults()) & running_;
    running_ &= ~without;
    for (std::size_t k = 0; k < system_.carried; ++k)
      std::copy_n(first_.result(0, k), kLanes, step_.input(kStepCarried + k));
    for (std::size_t k = 0; k < kLastCarried + system_.carried; ++k)
      std::fill_n(last_.input(k), kLanes, 0.0);
  }

  /// Lanes whose next flow is the last one, perhaps of length 0; after so many others.
  void end_lanes(double flows) {
    const double horizon = system_.model.scenario->horizon;
    const double latest = horizon + hybrid::kOneInstant * horizon;
    if ((flows + 1) * longest_ < horizon) return;
    const LaneNumbers& due = lengths_.due();
    std::uint32_t ended = 0;
    for (std::uint32_t left = lanes::variant().reached(due.data(), horizon) & running_; left != 0;
         left &= left - 1) {
      const int l = std::countr_zero(left);
      const auto at = static_cast<std::size_t>(l);
      if (t_[at] >= horizon || due[at] > latest) ended |= 1U << l;
    }
    running_ &= ~ended;
    for (std::size_t l = 0; ended != 0 && l < kLanes; ++l) {
      if ((ended >> l & 1U) == 0) continue;
      const double length = lengths_.length()[l];
      const double rest = t_[l] >= horizon ? 0 : horizon - t_[l];
      last_.input(0)[l] = rest;
      last_.input(1)[l] = length;
      last_.input(2)[l] = length - rest;
      last_.input(3)[l] = root_;
      for (std::size_t k = 0; k < system_.carried; ++k)
        last_.input(kLastCarried + k)[l] = step_.input(kStepCarried + k)[l];
      if (system_.rest_table.has_pieces())
        system_.rest_table.values(rest, last_.input(kLastCarried + system_.carried) + l, kLanes);
      flows_[l] = flows;
    }
  }

  /// A block begins: z near 1, new errors in G.
  void gather() {
    ++gathered_;
    const double root = std::sqrt(static_cast<double>(gathered_));
    root_ = root * linear::kBoundSlack;
    rescale(gather_.input(0));
    std::fill_n(gather_.input(1), kLanes, root);
    for (std::size_t k = 0; k < system_.carried; ++k)
      std::copy_n(step_.input(kStepCarried + k), kLanes, gather_.input(kGatherCarried + k));
    gather_.run();
    open_ |= gather_.faults() & running_;
    for (std::size_t k = 0; k < system_.carried; ++k)
      std::copy_n(gather_.result(0, k), kLanes, step_.input(kStepCarried + k));
  }

  /// What has been added in another unit than what comes.
  void keep_costs(std::size_t l) {
    const double unit = unit_of(l);
    for (std::size_t c = 0; c < system_.claims.size(); ++c) {
      if (system_.model.claims[c].kind != ClaimKind::cost) continue;
      double& sum = step_.input(kStepCarried + system_.claims[c].first)[l];
      double& error = step_.input(kStepCarried + system_.claims[c].first + 1)[l];
      costs_[c].sum[l] += unit * sum;
      costs_[c].error[l] += unit * error;
      sum = error = 0;
    }
  }

  /// The powers of 2 that take the largest |z| near 1, where it is far from it. Not beside a
  /// constant, which has a unit of its own.
  void rescale(double* scale) {
    LaneNumbers most{};
    for (std::size_t i = 0; i < system_.rank; ++i) {
      const double* const z = step_.input(kStepCarried + system_.z(i));
      for (std::size_t l = 0; l < kLanes; ++l) most[l] = std::max(most[l], std::abs(z[l]));
    }
    constexpr int kFar = 400;
    constexpr double near = 0x1p64;
    const double far = std::ldexp(1.0, kFar);
    std::uint32_t apart = 0;
    for (std::size_t l = 0; l < kLanes; ++l)
      if (!(most[l] >= 1 / near && most[l] <= near)) apart |= 1U << l;
    std::fill_n(scale, kLanes, 1.0);
    apart &= running_;
    for (std::size_t l = 0; apart != 0 && l < kLanes; ++l) {
      if ((apart >> l & 1U) == 0) continue;
      if (!(most[l] <= far)) open_ |= 1U << l;
      if (most[l] == 0 || system_.model.constant) continue;
      if (most[l] < 1 / far) open_ |= 1U << l;
      int exponent = 0;
      std::frexp(most[l], &exponent);
      keep_costs(l);
      exponent_[l] -= exponent;
      // The careful run ends at hybrid::kLargestState.
      if (exponent_[l] < -kFar) open_ |= 1U << l;
      scale[l] = std::ldexp(1.0, -exponent);
    }
  }

  /// Of forms, in the unit of the start.
  double unit_of(std::size_t l) const {
    return exponent_[l] == 0 ? 1 : std::ldexp(1.0, -2 * exponent_[l]);
  }

  // --- Verdicts. ---

  /// A number that is known up to an error.
  struct Known {
    double value = 0, error = 0;
  };
  Known start(std::size_t c, std::size_t l) const {
    return {first_.result(1, 2 * c)[l], first_.result(1, 2 * c + 1)[l]};
  }
  Known end(std::size_t c, std::size_t l) const {
    const double unit = unit_of(l);
    return {unit * last_.result(1, 2 * c)[l], unit * last_.result(1, 2 * c + 1)[l]};
  }
  double carried(std::size_t c, std::size_t number, std::size_t l) const {
    return last_.result(0, system_.claims[c].first + number)[l];
  }
  static void decide(bool violated, claims::Finding& claim) {
    claim.judgement = violated ? claims::Judgement::violated : claims::Judgement::held;
  }
  /// Whether value <= bound; false: it is not certain.
  static bool compare(const Known& value, const Known& bound, claims::Finding& claim) {
    const double rounding = 8 * kUnitRoundoff * (std::abs(value.value) + std::abs(bound.value));
    const double error = (value.error + bound.error + rounding) * linear::kBoundSlack;
    const double excess = value.value - bound.value;
    decide(excess > error, claim);
    return claim.violated() || excess <= -error;
  }
  /// Whether the verdict on a claim is certain, and how near the run comes to the bound is known.
  bool judge(std::size_t c, std::size_t l, claims::Finding& claim) const {
    switch (system_.model.claims[c].kind) {
      case ClaimKind::nonincreasing:
        return judge_rise(c, l, claim);
      case ClaimKind::cost:
        return judge_cost(c, l, claim);
      case ClaimKind::below:
        return judge_peak(c, l, claim);
      default:
        return judge_shrinking(c, l, claim);
    }
  }
  bool judge_rise(std::size_t c, std::size_t l, claims::Finding& claim) const;
  bool judge_cost(std::size_t c, std::size_t l, claims::Finding& claim) const;
  bool judge_peak(std::size_t c, std::size_t l, claims::Finding& claim) const;
  bool judge_shrinking(std::size_t c, std::size_t l, claims::Finding& claim) const;
  PackVerdict verdict(std::size_t l) const;

  struct Costs {
    LaneNumbers sum{}, error{};
  };

  const linear::LinearSystem& system_;
  LaneStarts starts_;
  LaneLengths lengths_;
  LaneMachine first_, step_, gather_, last_;
  double longest_;  ///< no flow is longer
  std::vector<PackVerdict> verdicts_;
  std::uint64_t first_run_ = 0;
  std::uint32_t running_ = 0, open_ = 0;
  std::uint64_t gathered_ = 0;
  double root_ = 0;
  std::array<int, kLanes> exponent_{};  ///< z is 2^exponent times the true one
  LaneNumbers t_{}, flows_{};
  std::vector<Costs> costs_;
};

/// v' <= 0: violated where the largest certain rise is positive; held where none is possible. The
/// score is the rise, or the change from start to end, as a part of |v(0)|.
bool LinearLanes::judge_rise(std::size_t c, std::size_t l, claims::Finding& claim) const {
  const Known before = start(c, l), after = end(c, l);
  const bool compared = linear::is_compared(system_.model.claims[c]);
  const double open = compared ? carried(c, 2, l) : 0, rise = compared ? carried(c, 3, l) : 0;
  const double scale = std::abs(before.value);
  decide(rise > 0, claim);
  const bool tolerant = compared && system_.model.claims[c].tolerance > 0;
  const double whole = tolerant ? carried(c, linear::kWholeRise, l) : rise;
  claim.score = (claim.violated() ? unit_of(l) * whole : after.value - before.value) / scale;
  claim.bound = before.value;
  claim.rounding = after.error;
  claim.value = claim.violated() ? before.value + claim.score * scale : after.value;
  const double error = (before.error + after.error) / scale;
  return (claim.violated() || open <= 0) && error <= kScore;
}

/// sum <= bound. The sums have terms >= 0, so their rounding is (4 flows + 8) u of the sum.
bool LinearLanes::judge_cost(std::size_t c, std::size_t l, claims::Finding& claim) const {
  const Known bound = start(c, l);
  const double unit = unit_of(l);
  Known cost{costs_[c].sum[l] + unit * carried(c, 0, l),
             costs_[c].error[l] + unit * carried(c, 1, l)};
  // Sums of what is not negative, at most two a flow.
  cost.error += (4 * flows_[l] + 8) * kUnitRoundoff * cost.value;
  const double scale = std::abs(bound.value);
  claim.score = (cost.value - bound.value) / scale;
  claim.value = cost.value;
  claim.rounding = cost.error;
  claim.bound = bound.value;
  return compare(cost, bound, claim) && (cost.error + bound.error) / scale <= kScore;
}

/// max v <= bound; of norms by squares. The largest value is between the largest at a start of a flow
/// and `growth` times that, which is `rounding` of the finding.
bool LinearLanes::judge_peak(std::size_t c, std::size_t l, claims::Finding& claim) const {
  const linear::LinearClaim& stated = system_.model.claims[c];
  const auto own = [&](double value) {
    return stated.squared ? std::sqrt(std::max(value, 0.0)) : value;
  };
  const double unit = unit_of(l), high = unit * carried(c, 1, l);
  const double least = own(unit * carried(c, 0, l));
  const double most = own(std::max(high, stated.growth * high));
  const Known peak{(least + most) / 2, (most - least) / 2};
  const double scale = stated.bound == 0 ? 1 : std::abs(stated.bound);
  claim.score = (peak.value - stated.bound) / scale;
  claim.value = peak.value;
  claim.bound = stated.bound;
  claim.rounding = peak.error;
  return compare(peak, {stated.bound, 0}, claim);
}

/// v(end) <= factor v(0); of norms by squares, with factor^2. The score is the ratio of both sides,
/// in the unit of the claim, less 1.
bool LinearLanes::judge_shrinking(std::size_t c, std::size_t l, claims::Finding& claim) const {
  const linear::LinearClaim& stated = system_.model.claims[c];
  const Known before = start(c, l), after = end(c, l);
  const double factor = stated.squared ? stated.factor * stated.factor : stated.factor;
  const Known goal{factor * before.value, factor * before.error};
  if (!(before.value > before.error)) return false;
  const auto part = [&](double value) {
    const double ratio = std::max(value, 0.0) / goal.value;
    return stated.squared ? std::sqrt(ratio) : ratio;
  };
  claim.score = part(after.value) - 1;
  const auto own = [&](double value) {
    return stated.squared ? std::sqrt(std::max(value, 0.0)) : value;
  };
  claim.value = own(after.value);
  claim.bound = own(goal.value);
  const double error = part(after.value + after.error) - part(after.value - after.error) +
                       before.error / before.value;
  claim.rounding = error * claim.bound;
  return compare(after, goal, claim) && error <= kScore * (1 + std::abs(claim.score));
}

/// A run without a jump, with a fault or out of range is left open with the reason Why::range.
PackVerdict LinearLanes::verdict(std::size_t l) const {
  PackVerdict verdict;
  verdict.why = Why::range;
  if ((open_ >> l & 1U) != 0) return verdict;
  verdict.open = false;
  verdict.proved = true;
  verdict.happened = {1};
  for (std::size_t c = 0; c < system_.claims.size(); ++c) {
    claims::Finding& claim = verdict.findings.emplace_back();
    claim.tolerance = system_.model.claims[c].tolerance;
    if (judge(c, l, claim)) continue;
    verdict.open = true;
    verdict.why = Why::claim;
  }
  return verdict;
}

LinearRunner::LinearRunner(const linear::LinearSystem& system)
    : lanes_(std::make_unique<LinearLanes>(system)) {}
LinearRunner::LinearRunner(LinearRunner&&) noexcept = default;
LinearRunner& LinearRunner::operator=(LinearRunner&&) noexcept = default;
LinearRunner::~LinearRunner() = default;

std::vector<PackVerdict> LinearRunner::run(std::uint64_t seed, std::uint64_t first,
                                           std::uint64_t last) {
  return lanes_->run(seed, first, last);
}

}  // namespace gainsmith::packs
