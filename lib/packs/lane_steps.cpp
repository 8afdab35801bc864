// Steps of lanes. A step of length h is made once in whole (coarse) and twice in halves (fine).
// With a method of order 8 the error of the finer run is about 2^-8 of the difference of both; what
// is counted as its error is PackSystem::error_factor times the difference. The error control is
// that of the whole step. Roots on the step are found on quintics (quintics.h):
//
//   no root     all Bernstein coefficients are on the known side of 0, by more than the error
//   one root    they change their sign once; then the polynomial has just one root (variation
//               diminishing property), and the step is taken again up to it
//   otherwise   the sign is not certain: the step is halved, at most kMostHalvings times
#include "packs/lane_set.h"

#include <algorithm>
#include <utility>

#include "ode/step_control.h"

namespace gainsmith::packs {

using lanes::kLanes;

/// One step of length share * lengths_ in the lanes `active`; what does not move is copied.
void LaneSet::step(const LaneValues& from, double share, LaneValues& to, std::uint32_t active,
                   std::uint32_t& faults) {
  std::copy_n(from.row(0), pack_.whole * kLanes, step_.input(0));
  for (std::size_t l = 0; l < kLanes; ++l) step_.input(pack_.whole)[l] = share * lengths_.at(0, l);
  step_.run(active);
  faults |= step_.faults();
  std::copy_n(from.row(0), pack_.whole * kLanes, to.row(0));
  for (std::size_t k = 0; k < pack_.rows.size(); ++k)
    std::copy_n(step_.result(PackSystem::end, k), kLanes,
                to.row(static_cast<std::size_t>(pack_.rows[k])));
}

/// The quintic (1) of quintics.h at s = 1/4, for the states; at s = 3/4 by exchanging the ends and
/// the sign of the rates. What claims and watches are there tells how far their own quintics are
/// off.
void LaneSet::evaluate_between(bool mirrored, LanePoint& seen, std::uint32_t active) {
  const LaneValues* const values[] = {&fine_, &fine_middle_, &fine_end_};
  const LanePoint* const points[] = {&start_, &middle_, &end_};
  std::copy_n(fine_.row(0), pack_.whole * kLanes, between_.row(0));
  for (std::size_t k = 0; k < pack_.rows.size(); ++k) {
    const auto row = static_cast<std::size_t>(pack_.rows[k]);
    for (std::size_t l = 0; l < kLanes; ++l) {
      double sum = 0;
      for (std::size_t point = 0; point < 3; ++point) {
        const std::size_t weight = mirrored ? 2 - point : point;
        const double length = mirrored ? -lengths_.at(0, l) : lengths_.at(0, l);
        sum += QuarterWeights::values[weight] * values[point]->at(row, l) +
               length * QuarterWeights::rates[weight] * points[point]->at(PackSystem::rates, k, l);
      }
      between_.at(row, l) = sum;
    }
  }
  evaluate(between_points_, between_, seen, active);
}

void LaneSet::follow(std::uint32_t active) {
  using Polynomials = StepPolynomials;
  std::copy_n(lengths_.row(0), kLanes, polynomials_.input(0));
  const auto give = [&](std::size_t value, PackSystem::PointResult values,
                        PackSystem::PointResult rates, std::size_t k) {
    const auto copy = [&](const LanePoint& seen, PackSystem::PointResult of,
                          Polynomials::InputOfValue which) {
      std::copy_n(seen.of[of].row(k), kLanes,
                  polynomials_.input(Polynomials::input_of(value, which)));
    };
    copy(start_, values, Polynomials::start);
    copy(start_, rates, Polynomials::start_rate);
    copy(middle_, values, Polynomials::middle);
    copy(middle_, rates, Polynomials::middle_rate);
    copy(end_, values, Polynomials::end);
    copy(end_, rates, Polynomials::end_rate);
    copy(quarter_, values, Polynomials::quarter);
    copy(three_quarters_, values, Polynomials::three_quarters);
  };
  const std::size_t claims = pack_.claims.size();
  for (std::size_t c = 0; c < claims; ++c)
    give(c, PackSystem::claim_values, PackSystem::claim_rates, c);
  for (std::size_t w = 0; w < pack_.watches.size(); ++w)
    give(claims + w, PackSystem::watch_values, PackSystem::watch_rates, w);
  polynomials_.run(active);
}

/// All lanes make the step at once; each is judged by itself.
void LaneSet::step_all(std::uint32_t mask) {
  for (std::size_t l = 0; l < kLanes; ++l) lengths_.at(0, l) = 0;
  each(mask, [&](std::size_t l) { lengths_.at(0, l) = choose_length(*lanes_[l]); });
  std::uint32_t faults = 0;
  step(coarse_, 1, coarse_end_, mask, faults);
  std::copy_n(step_.result(PackSystem::error, 0), kLanes, errors_.row(0));
  step(fine_, 0.5, fine_middle_, mask, faults);
  step(fine_middle_, 0.5, fine_end_, mask, faults);
  evaluate(point_, fine_middle_, middle_, mask);
  faults |= middle_.faults;
  evaluate(point_, fine_end_, end_, mask);
  faults |= end_.faults;
  evaluate(coarse_point_, coarse_end_, coarse_at_end_, mask);
  faults |= coarse_at_end_.faults;
  evaluate_between(false, quarter_, mask);
  evaluate_between(true, three_quarters_, mask);
  faults |= quarter_.faults | three_quarters_.faults;
  follow(mask);
  std::uint32_t taken = 0;
  each(mask, [&](std::size_t l) {
    const bool fault = (faults >> l & 1U) != 0;
    const bool many = ++lanes_[l]->steps > kMostSteps && !open(Why::steps);
    bool takes = false;
    if (many || !judge_step(l, fault, takes)) return leave_open(l);
    taken |= takes ? 1U << l : 0;
  });
  const LaneMask moved(taken);
  coarse_.copy(coarse_end_, moved);
  fine_.copy(fine_end_, moved);
  start_.copy(end_, moved);
  coarse_start_.copy(coarse_at_end_, moved);
  each(taken, [&](std::size_t l) {
    if (!arrive(l)) leave_open(l);
  });
}

double LaneSet::choose_length(PackLane& lane) {
  const double rest = lane.stop - lane.t;
  lane.h = lane.forced > 0          ? lane.forced
           : lane.wanted >= rest    ? rest
           : 2 * lane.wanted > rest ? rest / 2
                                    : lane.wanted;
  return lane.h;
}

bool LaneSet::shorten(PackLane& lane, double factor) {
  forget_root(lane);
  lane.wanted = lane.h * factor;
  return lane.wanted > kShortestStep * horizon_ || open(Why::steps);
}

/// A method of order 8 loses its order across a kink of the flow. So the step goes up to the first
/// kink, the root of the quartic through five values, if this lies well inside; otherwise it is
/// only shorter.
bool LaneSet::shorten_by_error(std::size_t l) {
  PackLane& lane = *lanes_[l];
  double share = 1;
  for (const std::size_t k : pack_.kinks) share = std::min(share, root_of_extra(k, l).value_or(1));
  const double length = share * lane.h;
  const bool is_inside = share > kKinkInside && share < 1 - kKinkInside;
  if (!is_inside || length <= kShortestStep * horizon_)
    return shorten(lane, std::min(ode::step_factor(errors_.at(0, l)), 0.9));
  forget_root(lane);
  lane.forced = length;
  return true;
}

/// In this order: a value exists, the error is allowed, no narrow peak hides on the step, no sign
/// is uncertain, the root is met within kAtRoot of the horizon, and the claims are decided.
bool LaneSet::judge_step(std::size_t l, bool fault, bool& takes) {
  PackLane& lane = *lanes_[l];
  const double error = errors_.at(0, l);
  if (fault || !std::isfinite(error)) return shorten(lane, 0.25);
  if (error > 1) return shorten_by_error(l);
  if (std::any_of(pack_.flats.begin(), pack_.flats.end(),
                  [&](std::size_t k) { return bends(k, l); }))
    return shorten(lane, 0.5);
  int target = -1;
  double share = 2;
  if (!find_root(l, target, share)) {
    // Two halves may say more.
    if (lane.target >= 0 || ++lane.halvings > kMostHalvings) return open(Why::sign);
    lane.forced = lane.h / 2;
    return true;
  }
  if (target >= 0) {
    lane.target = target;
    lane.retakes = 1;
    lane.forced = share * lane.h;
    return lane.forced > 0 || open(Why::sign);
  }
  if (lane.target >= 0) {
    const auto w = static_cast<std::size_t>(lane.target);
    const double value = end_.at(PackSystem::watch_values, w, l);
    const double rate = end_.at(PackSystem::watch_rates, w, l);
    if (!(rate * lane.sides[w] < 0)) return open(Why::sign);
    const double rest = -value / rate;
    if (std::abs(rest) > kAtRoot * horizon_ && lane.retakes < 4) {
      ++lane.retakes;
      lane.forced = lane.h + rest;
      return lane.forced > 0 || open(Why::sign);
    }
  }
  return judge_claims(l, takes);
}

/// Collects the roots of all watches that may decide something, each with the side that is left.
bool LaneSet::find_root(std::size_t l, int& target, double& share) {
  PackLane& lane = *lanes_[l];
  std::fill(lane.zero.begin(), lane.zero.end(), 0);
  std::fill(lane.passed.begin(), lane.passed.end(), 0);
  roots_.clear();
  for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
    if (lane.relevant[w] == 0 || !pack_.watches[w].moves) continue;
    const pieces::StepPolynomial along = along_watch(w, l);
    const double error =
        std::max(error_of(w, l, start_, coarse_start_), error_of(w, l, end_, coarse_at_end_)) +
        along.error();
    const auto b = along.coefficients();
    const int known = lane.sides[w];
    const int side = known != 0 ? known : sign_of(b[5]);
    bool clear = true;
    for (std::size_t k = 1; k < b.size(); ++k)
      clear = clear && side * b[k] > ((known != 0 && b[0] != 0) || k == 5 ? error : 0);
    if (clear || static_cast<int>(w) == lane.target) continue;
    if (known != 0 && ends_at_root(lane, w, b, error)) {
      lane.zero[w] = error;
      continue;
    }
    if (known != 0 && leaves_at_once(b, known, error)) {
      roots_.push_back({0, w, lane.sides[w]});
      continue;
    }
    const std::int8_t from = known != 0 ? lane.sides[w] : left_side(w, l, b, error);
    if (from == 0 || !(from * b[5] < -error) || !crosses_once(b, from)) return false;
    roots_.push_back(
        {along.first_change(from, std::max(0.0, -from * b.front())).value_or(1), w, from});
  }
  return roots_.empty() || choose_root(lane, target, share);
}

/// In the order of the roots: the first after which an event, a flow set or a branch is another is
/// the target. Those before it only change their sides. Two roots that are nearer to each other
/// than kHardly times the horizon have no certain order.
bool LaneSet::choose_root(PackLane& lane, int& target, double& share) {
  std::sort(roots_.begin(), roots_.end(),
            [](const Root& root, const Root& other) { return root.share < other.share; });
  for (const Root& root : roots_) lane.sides[root.watch] = root.from;
  sides_ = lane.sides;
  for (std::size_t k = 0; k < roots_.size(); ++k) {
    const std::size_t w = roots_[k].watch;
    const double next = k + 1 < roots_.size() ? roots_[k + 1].share : lane.target >= 0 ? 1 : 2;
    if ((next - roots_[k].share) * lane.h <= hybrid::kHardly * horizon_) return open(Why::order);
    if (decides(w, lane)) {
      target = static_cast<int>(w);
      share = roots_[k].share;
      return lane.target < 0;
    }
    lane.passed[w] = 1;
    sides_[w] = static_cast<std::int8_t>(-sides_[w]);
  }
  return true;
}

bool LaneSet::decides(std::size_t w, const PackLane& lane) {
  if (!pack_.watches[w].branches.empty() || lane.undetermined) return true;
  for (std::size_t e = 0; e < pack_.events.size(); ++e)
    if (const auto& crossing = pack_.events[e].crossing)
      if (crossing->watch == w && is_wanted(e, -crossing->factor * sides_[w])) return true;
  const auto changes = [&](const WatchedCondition& condition) {
    const Truth before = truth(condition, pack_.watches, sides_);
    sides_[w] = static_cast<std::int8_t>(-sides_[w]);
    const Truth after = truth(condition, pack_.watches, sides_);
    sides_[w] = static_cast<std::int8_t>(-sides_[w]);
    return after == Truth::unknown || after != before;
  };
  return std::any_of(pack_.flow_sets.begin(), pack_.flow_sets.end(), changes) ||
         std::any_of(pack_.events.begin(), pack_.events.end(),
                     [&](const PackEvent& event) { return event.when && changes(*event.when); });
}

std::int8_t LaneSet::left_side(std::size_t w, std::size_t l, std::span<const double> b,
                               double error) const {
  const std::int8_t side = lanes_[l]->undetermined ? std::int8_t{0} : leaving_side(w, l);
  return side * b[1] > error ? side : std::int8_t{0};
}

bool LaneSet::ends_at_root(const PackLane& lane, std::size_t w, std::span<const double> b,
                           double error) const {
  if (!arrives(lane)) return false;
  for (std::size_t k = 1; k + 1 < b.size(); ++k)
    if (lane.sides[w] * b[k] <= error) return false;
  return std::abs(b.back()) <= error;
}

bool LaneSet::leaves_at_once(std::span<const double> b, int side, double error) {
  bool leaves = std::abs(b[0]) <= error;
  for (std::size_t k = 1; k < b.size(); ++k) leaves = leaves && side * b[k] < -error;
  return leaves;
}

/// Whether the coefficients change their sign just once after the start, at which the value may
/// still be 0 within its error.
bool LaneSet::crosses_once(std::span<const double> b, int side) {
  if (side * b[0] <= 0 && side * b[1] <= 0) return false;
  int changes = 0;
  for (std::size_t k = 1; k < b.size(); ++k) {
    const bool before = k == 1 || side * b[k - 1] > 0;
    changes += before != (side * b[k] > 0) ? 1 : 0;
  }
  return changes == 1;
}

/// |v/v'| at the end of the step: a claim may have changed by its rate times that since the true
/// root.
double LaneSet::time_beside_root(const PackLane& lane, std::size_t l) const {
  if (lane.target < 0) return 0;
  const auto w = static_cast<std::size_t>(lane.target);
  return std::abs(end_.at(PackSystem::watch_values, w, l) / end_.at(PackSystem::watch_rates, w, l));
}

/// A claim that stays open sees more on half a step, as long as it is not halved too often.
bool LaneSet::judge_claims(std::size_t l, bool& takes) {
  PackLane& lane = *lanes_[l];
  const double now = end_of_step(lane);
  lane.claims_before = lane.claims;
  const double late = time_beside_root(lane, l);
  for (std::size_t c = 0; c < lane.claims.size(); ++c) {
    Reading end = reading(c, l, end_, coarse_at_end_);
    end.late = late * std::abs(end_.at(PackSystem::claim_rates, c, l));
    const StepSamples samples = claim_samples(c, l);
    const pieces::StepPolynomial along = along_claim(c, l);
    const bool breaks = may_branch(c, l);
    if (breaks && lane.claims[c].is_blurred(now, samples, along, end) && stop_beside_kink(c, l)) {
      lane.claims = lane.claims_before;
      return true;
    }
    lane.claims[c].along(now, samples, along, end, breaks,
                         lane.halvings > 0 || 2 * lane.h < lane.wanted);
    if (!lane.claims[c].open()) continue;
    // Two halves may say more.
    if (lane.target >= 0 || ++lane.halvings > kMostHalvings) return open(Why::claim);
    lane.claims = lane.claims_before;
    lane.forced = lane.h / 2;
    return true;
  }
  for (const int row : pack_.rows)
    if (!(std::abs(fine_end_.at(static_cast<std::size_t>(row), l)) <= hybrid::kLargestState))
      return open(Why::range);
  if (ends_in_zeno_)
    for (const LaneValues* values : {&fine_, &fine_middle_, &fine_end_})
      for (Eigen::Index k = 0; k < lane.largest.size(); ++k)
        lane.largest(k) =
            std::max(lane.largest(k), std::abs(values->at(static_cast<std::size_t>(k), l)));
  find_new_sides(l);
  takes = true;
  return true;
}

bool LaneSet::stop_beside_kink(std::size_t claim, std::size_t l) {
  PackLane& lane = *lanes_[l];
  const double beside = kBesideKink * std::min(lane.wanted, lane.stop - lane.flow_start);
  if (lane.h <= 4 * beside) return false;
  double share = 1;
  for (const std::size_t k : pack_.claims[claim].kinks)
    share = std::min(share, root_of_extra(k, l).value_or(1));
  if (share == 1) return false;
  const double reach = share * lane.h;
  forget_root(lane);
  lane.forced = reach > 2 * beside ? reach - beside : reach + beside;
  return true;
}

/// The next step: the length times the factor of the error control. A step that was shortened for
/// another reason never makes the next one shorter.
bool LaneSet::arrive(std::size_t l) {
  PackLane& lane = *lanes_[l];
  const bool at_stop = arrives(lane);
  const double now = end_of_step(lane);
  const double wanted = lane.h * ode::step_factor(errors_.at(0, l));
  const bool shortened = lane.forced > 0 || lane.h < lane.wanted;
  lane.wanted = shortened ? std::max(lane.wanted, wanted) : wanted;
  if (pack_.system->pulses)
    lane.wanted = std::min(lane.wanted, pack_.system->longest_step() * horizon_);
  lane.t = now;
  fill_clocks(l);
  const int target = lane.target;
  forget_root(lane);
  if (!still_inside(l)) return false;
  if (target >= 0) return arrive_at_root(l, static_cast<std::size_t>(target));
  return !at_stop || arrive_at_stop(l);
}

/// The extremes of five samples and of 2 m - (a + b)/2, with a, m, b the values at the start, the
/// middle and the end: where the samples suggest a turn beyond them.
std::pair<double, double> LaneSet::range_of_extra(std::size_t k, std::size_t l) const {
  const double first = start_.at(PackSystem::extras, k, l);
  const double middle = middle_.at(PackSystem::extras, k, l);
  const double last = end_.at(PackSystem::extras, k, l);
  const double points[] = {first,
                           middle,
                           last,
                           2 * middle - (first + last) / 2,
                           quarter_.at(PackSystem::extras, k, l),
                           three_quarters_.at(PackSystem::extras, k, l)};
  const auto [least, largest] = std::minmax_element(std::begin(points), std::end(points));
  return {*least, *largest};
}

bool LaneSet::bends(std::size_t k, std::size_t l) const {
  const auto [least, largest] = range_of_extra(k, l);
  return !(least > kFlatRoot * largest);
}

bool LaneSet::may_branch(std::size_t c, std::size_t l) const {
  const PackClaim& claim = pack_.claims[c];
  const auto comes_to_0 = [&](std::size_t k) {
    const auto [least, largest] = range_of_extra(k, l);
    return !(least > 0) && !(largest < 0);
  };
  return std::any_of(claim.branches.begin(), claim.branches.end(), comes_to_0) ||
         std::any_of(claim.roots.begin(), claim.roots.end(),
                     [&](std::size_t k) { return bends(k, l); });
}

void LaneSet::pass(std::size_t w, PackLane& lane) const {
  for (std::size_t e = 0; e < pack_.events.size(); ++e)
    if (const auto& crossing = pack_.events[e].crossing; crossing && crossing->watch == w)
      lane.signs[e] = static_cast<std::int8_t>(-side_of(*crossing, lane));
}

/// Behind the root that the step goes to, a side is the opposite one. Other sides follow from the
/// values.
void LaneSet::find_new_sides(std::size_t l) {
  PackLane& lane = *lanes_[l];
  for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
    if (!pack_.watches[w].moves) continue;
    const double value = std::abs(end_.at(PackSystem::watch_values, w, l));
    const double error = error_of(w, l, end_, coarse_at_end_);
    if (lane.passed[w] != 0) pass(w, lane);
    if (static_cast<int>(w) == lane.target) {
      lane.sides[w] = static_cast<std::int8_t>(-lane.sides[w]);
      lane.zero[w] = std::max(error, 2 * value);
    } else if (lane.zero[w] > 0) {
      lane.sides[w] = 0;
    } else if (lane.relevant[w] == 0 || lane.sides[w] == 0 || lane.passed[w] != 0) {
      lane.sides[w] = value > error ? sign_of(end_.at(PackSystem::watch_values, w, l)) : 0;
    }
  }
}

}  // namespace gainsmith::packs
