#include "packs/pack_runner.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "base/stop.h"
#include "claims/tolerances.h"
#include "hybrid/tolerances.h"
#include "packs/lane_values.h"
#include "packs/pack_lane.h"
#include "packs/tolerances.h"

namespace gainsmith::packs {

namespace {

using lanes::kLanes;
using lanes::LaneMachine;
using model::Dynamics;
using VariableKind = Dynamics::VariableKind;

constexpr PackAccuracy kAccuracies[] = {{kFirstRelative, kFirstAbsolute},
                                        {kAgainRelative, kAgainAbsolute}};

/// 0.9 e^(-1/8) for the power of 2 above e, within [0.2, 4]: the same on every machine.
double step_factor(double error) {
  if (!(error > 0)) return 4;
  int exponent = 0;
  std::frexp(error, &exponent);
  constexpr double eighths[] = {1,
                                0.917004043204671232,
                                0.840896415253714543,
                                0.771105412703970411,
                                0.707106781186547524,
                                0.648419777325504832,
                                0.594603557501360533,
                                0.545253866332628830};
  const int part = ((exponent % 8) + 8) % 8;
  const double factor = 0.9 * std::ldexp(eighths[part], -(exponent - part) / 8);
  return std::clamp(factor, 0.2, 4.0);
}

std::int8_t sign_of(double x) { return static_cast<std::int8_t>(x > 0 ? 1 : x < 0 ? -1 : 0); }

}  // namespace

std::string to_string(Why why) {
  switch (why) {
    case Why::claim:
      return "a claim is next to its bound";
    case Why::sign:
      return "the sign of a condition is not certain";
    case Why::order:
      return "it is not certain which event comes first";
    case Why::no_value:
      return "a text has no value";
    case Why::range:
      return "a value leaves its range";
    case Why::steps:
      return "steps are short, or many";
    case Why::jumps:
      return "jumps follow each other at once";
  }
  return "?";
}

bool PackVerdict::violated() const {
  return std::any_of(claims.begin(), claims.end(), [](const Claim& one) { return one.violated; });
}

class PackRunner::Lanes {
 public:
  explicit Lanes(const PackSystem& pack)
      : pack_(pack),
        horizon_(pack.scenario->horizon),
        step_(*pack.step),
        look_(*pack.look),
        coarse_(pack.whole),
        fine_(pack.whole),
        coarse_end_(pack.whole),
        fine_middle_(pack.whole),
        fine_end_(pack.whole),
        lengths_(1),
        errors_(1),
        scratch_(Eigen::VectorXd::Zero(pack.system->whole)) {
    for (LaneLook* look : {&start_, &coarse_start_, &middle_, &end_, &coarse_look_})
      for (std::size_t r = 0; r < look->of.size(); ++r) look->of[r] = LaneValues(rows_of(r));
    for (const PackEvent& event : pack.events) {
      jumps_.emplace_back(*event.jump);
      lost_.emplace_back();
      if (event.lost) lost_.back().emplace(*event.lost);
    }
    find_clock_elements();
    is_crossing_.assign(pack.watches.size(), false);
    for (const PackEvent& event : pack.events)
      if (event.crossing) is_crossing_[event.crossing->watch] = true;
  }

  std::vector<PackVerdict> run(std::uint64_t seed, std::uint64_t first, std::uint64_t last) {
    seed_ = seed;
    first_ = first;
    verdicts_.assign(static_cast<std::size_t>(last - first), {});
    for (const PackAccuracy& accuracy : kAccuracies) {
      waiting_.clear();
      for (std::uint64_t run = last; run-- > first;)
        if (verdicts_[static_cast<std::size_t>(run - first)].open) waiting_.push_back(run);
      run_waiting(accuracy);
    }
    return std::move(verdicts_);
  }

 private:
  void run_waiting(const PackAccuracy& accuracy) {
    accuracy_ = &accuracy;
    std::fill_n(step_.input(pack_.whole + 1), kLanes, accuracy.relative);
    std::fill_n(step_.input(pack_.whole + 2), kLanes, accuracy.absolute);
    lanes_.clear();
    lanes_.resize(kLanes);
    while (true) {
      check_stop();
      if (const std::uint32_t stepping = in(Phase::step)) {
        step_all(stepping);
        continue;
      }
      refill();
      if (const std::uint32_t jumping = in(Phase::jump)) {
        jump_all(jumping);
      } else if (const std::uint32_t looking = in(Phase::look)) {
        look_all(looking);
      } else {
        break;
      }
    }
  }

  // --- Lanes. ---

  std::size_t rows_of(std::size_t result) const {
    switch (result) {
      case PackSystem::rates:
        return pack_.rows.size();
      case PackSystem::claim_values:
      case PackSystem::claim_rates:
      case PackSystem::claim_terms:
      case PackSystem::limits:
        return pack_.claims.size();
      case PackSystem::extras: {
        std::size_t count = 0;
        for (const PackClaim& claim : pack_.claims) count += claim.branches.size();
        return count;
      }
      default:
        return pack_.watches.size();
    }
  }

  void find_clock_elements() {
    since_.resize(pack_.events.size());
    left_.resize(pack_.events.size());
    const auto& variables = pack_.system->dynamics.variables;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const auto at = static_cast<std::size_t>(pack_.system->layout.slots[i].offset);
      if (variables[i].kind == VariableKind::time) times_.push_back(at);
      if (variables[i].kind == VariableKind::since) since_[variables[i].of].push_back(at);
      if (variables[i].kind == VariableKind::left) left_[variables[i].of].push_back(at);
    }
  }

  std::uint32_t in(Phase phase) const {
    std::uint32_t mask = 0;
    for (std::size_t l = 0; l < kLanes; ++l)
      if (lanes_[l] && lanes_[l]->phase == phase) mask |= 1U << l;
    return mask;
  }

  template <class Visit>
  static void each(std::uint32_t mask, const Visit& visit) {
    for (; mask != 0; mask &= mask - 1) visit(static_cast<std::size_t>(std::countr_zero(mask)));
  }

  void refill() {
    for (std::size_t l = 0; l < kLanes; ++l) {
      if (lanes_[l] || waiting_.empty()) continue;
      const std::uint64_t run = waiting_.back();
      waiting_.pop_back();
      lanes_[l].emplace(pack_, seed_, run);
      scratch_ = hybrid::draw_start(*pack_.system, *pack_.scenario, seed_, run);
      for (std::size_t k = 0; k < pack_.system->noise.size(); ++k)
        lanes_[l]->noise.draw(k, scratch_);
      for (std::size_t k = 0; k < pack_.whole; ++k)
        coarse_.at(k, l) = fine_.at(k, l) = scratch_(static_cast<Eigen::Index>(k));
      lanes_[l]->wanted = kFirstStep * horizon_;
      fill_clocks(l);
    }
  }

  void leave_open(std::size_t l) {
    verdicts_[static_cast<std::size_t>(lanes_[l]->run_number - first_)].why = why_;
    lanes_[l].reset();
  }
  /// The lane is left open, for this reason.
  bool open(Why why) {
    why_ = why;
    return false;
  }

  void finish(std::size_t l) {
    PackLane& lane = *lanes_[l];
    PackVerdict& verdict = verdicts_[static_cast<std::size_t>(lane.run_number - first_)];
    verdict.open = false;
    for (ClaimLane& claim : lane.claims) {
      claim.finish();
      verdict.open = verdict.open || claim.open();
      if (claim.open()) verdict.why = Why::claim;
      verdict.claims.push_back({claim.violated(), claim.looked(), claim.score(), claim.floor()});
    }
    verdict.happened = lane.happened;
    lanes_[l].reset();
  }

  void set(std::size_t element, std::size_t l, double value) {
    coarse_.at(element, l) = fine_.at(element, l) = value;
  }

  void fill_clocks(std::size_t l) {
    const PackLane& lane = *lanes_[l];
    for (const std::size_t element : times_) set(element, l, lane.t);
    for (std::size_t e = 0; e < left_.size(); ++e)
      for (const std::size_t element : left_[e])
        set(element, l, std::max(lane.clocks.due(e) - lane.t, 0.0));
  }

  // --- Looking at values. ---

  void look(const LaneValues& values, LaneLook& seen, std::uint32_t active) {
    std::copy_n(values.row(0), values.rows() * kLanes, look_.input(0));
    look_.run(active);
    seen.faults = look_.faults();
    for (std::size_t r = 0; r < seen.of.size(); ++r)
      for (std::size_t k = 0; k < seen.of[r].rows(); ++k)
        std::copy_n(look_.result(r, k), kLanes, seen.of[r].row(k));
  }

  /// How far a watched difference may be from the true one.
  static double error_of(std::size_t w, std::size_t l, const LaneLook& fine,
                         const LaneLook& coarse) {
    return kErrorOfPair * std::abs(fine.at(PackSystem::watch_values, w, l) -
                                   coarse.at(PackSystem::watch_values, w, l)) +
           hybrid::kTermRounding * fine.at(PackSystem::watch_terms, w, l);
  }

  void look_all(std::uint32_t mask) {
    look(fine_, middle_, mask);
    look(coarse_, end_, mask);
    const std::uint32_t faults = middle_.faults | end_.faults;
    each(mask, [&](std::size_t l) {
      start_.copy_lane(middle_, l);
      coarse_start_.copy_lane(end_, l);
      if (((faults >> l & 1U) != 0 && !open(Why::no_value)) || !settle(l)) leave_open(l);
    });
  }

  Reading reading(std::size_t claim, std::size_t l, const LaneLook& fine,
                  const LaneLook& coarse) const {
    return {fine.at(PackSystem::claim_values, claim, l),
            coarse.at(PackSystem::claim_values, claim, l),
            fine.at(PackSystem::claim_terms, claim, l)};
  }

  // --- Instants. Each gives false where the run is to be left open. ---

  /// What follows from new values at an instant.
  bool settle(std::size_t l) {
    PackLane& lane = *lanes_[l];
    if (!find_sides(l)) return false;
    const std::optional<bool> changed = set_branches(l);
    if (!changed) return false;
    if (*changed) return true;  // to be looked at again
    for (std::size_t c = 0; c < lane.claims.size(); ++c) {
      if (lane.fresh)
        lane.claims[c].begin(pack_.claims[c], pack_, *accuracy_,
                             start_.at(PackSystem::limits, c, l));
      if (lane.fresh || lane.jumped)
        lane.claims[c].at(lane.t, reading(c, l, start_, coarse_start_), lane.jumped);
      if (lane.claims[c].open()) return open(Why::claim);
    }
    if (lane.jumped)
      if (const auto& crossing = pack_.events[*lane.jumped].crossing)
        lane.signs[*lane.jumped] = side_of(*crossing, lane);
    lane.fresh = false;
    lane.jumped.reset();
    return go_on(l);
  }

  static std::int8_t side_of(const Watched& watched, const PackLane& lane) {
    return static_cast<std::int8_t>(watched.factor * lane.sides[watched.watch]);
  }

  bool find_sides(std::size_t l) {
    PackLane& lane = *lanes_[l];
    for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
      const double value = start_.at(PackSystem::watch_values, w, l);
      if (!pack_.watches[w].moves) {
        lane.sides[w] = sign_of(value);
        if (sign_of(coarse_start_.at(PackSystem::watch_values, w, l)) != lane.sides[w])
          return open(Why::sign);
        continue;
      }
      const double error = std::max(error_of(w, l, start_, coarse_start_), lane.zero[w]);
      if (std::abs(value) > error) {
        lane.sides[w] = sign_of(value);
      } else if (lane.fresh || !is_crossing_[w] || std::abs(value - lane.before[w]) > error) {
        // What has crossed 0 goes on; otherwise the next step tells where it goes.
        lane.sides[w] = 0;
      }
    }
    return true;
  }

  /// Whether a branch of the flow has changed; none where one is not certain. What is 0 takes the
  /// branch to which it moves.
  std::optional<bool> set_branches(std::size_t l) {
    bool changed = false;
    for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
      const Watch& watch = pack_.watches[w];
      if (watch.branches.empty()) continue;
      std::int8_t& side = lanes_[l]->sides[w];
      if (side == 0 && watch.moves) side = sign_of(start_.at(PackSystem::watch_rates, w, l));
      if (side == 0 && watch.moves) {
        why_ = Why::sign;
        return std::nullopt;
      }
      for (const Watch::Branch& one : watch.branches) {
        const int own = one.factor * side;
        const double value = one.sign ? own : own > 0 || (own == 0 && !one.strict) ? 1 : -1;
        changed = changed || fine_.at(one.element, l) != value;
        set(one.element, l, value);
      }
    }
    return changed;
  }

  /// To the jump that is due, or into a flow.
  bool go_on(std::size_t l) {
    PackLane& lane = *lanes_[l];
    lane.undetermined = false;
    if (!find_due(l)) return false;
    if (lane.due) {
      lane.phase = Phase::jump;
      return ++lane.chain <= kMostChain || open(Why::jumps);
    }
    if (lane.t >= horizon_) {
      finish(l);
      return true;
    }
    // A branch that changes here is to be set before the flow goes on.
    if (has_open_branch(lane)) {
      lane.phase = Phase::look;
      return true;
    }
    return begin_flow(l);
  }

  /// The first event that is due.
  bool find_due(std::size_t l) {
    PackLane& lane = *lanes_[l];
    lane.due.reset();
    const double now = lane.t >= horizon_ ? lane.t + hybrid::kAddedUp * horizon_ : lane.t;
    for (std::size_t e = 0; e < pack_.events.size(); ++e) {
      const PackEvent& event = pack_.events[e];
      bool due = false;
      if (event.crossing) {
        const std::int8_t side = side_of(*event.crossing, lane);
        if (side == 0) return open(Why::sign);
        const Dynamics::EventKind kind = pack_.system->dynamics.events[e].kind;
        if (lane.signs[e] != 0 && side != lane.signs[e])
          lane.crossed[e] = kind == Dynamics::EventKind::crosses ||
                            (kind == Dynamics::EventKind::rises) == (side > 0);
        lane.signs[e] = side;
        due = lane.crossed[e] != 0;
      } else if (event.when) {
        const Truth is = truth(*event.when, pack_.watches, lane.sides);
        lane.undetermined = lane.undetermined || is == Truth::unknown;
        if (is == Truth::no) lane.spent[e] = 0;
        due = is == Truth::yes && lane.spent[e] == 0;
      } else {
        due = lane.clocks.is_due(e, now);
      }
      // An event before it may be due as well.
      if (due && lane.undetermined) return open(Why::order);
      if (due) {
        lane.due = e;
        return true;
      }
    }
    return true;
  }

  bool begin_flow(std::size_t l) {
    PackLane& lane = *lanes_[l];
    std::fill(lane.relevant.begin(), lane.relevant.end(), 0);
    std::fill(lane.zero.begin(), lane.zero.end(), 0);
    for (const PackEvent& event : pack_.events) {
      if (event.when && truth(*event.when, pack_.watches, lane.sides, true) == Truth::unknown)
        mark(*event.when, lane.relevant);
      if (event.crossing) lane.relevant[event.crossing->watch] = 1;
    }
    for (const WatchedCondition& set : pack_.flow_sets) {
      const Truth is = truth(set, pack_.watches, lane.sides);
      if (is == Truth::no) return open(Why::range);
      lane.undetermined = lane.undetermined || is == Truth::unknown;
      if (truth(set, pack_.watches, lane.sides, true) == Truth::unknown) mark(set, lane.relevant);
    }
    for (std::size_t w = 0; w < pack_.watches.size(); ++w)
      if (!pack_.watches[w].branches.empty()) lane.relevant[w] = 1;
    if (lane.moved) {
      move(l, coarse_, coarse_start_, -lane.coarse_shift);
      move(l, fine_, start_, -lane.fine_shift);
      lane.moved = false;
    }
    lane.stop = std::min({horizon_, lane.clocks.next(), lane.noise.next()});
    for (const PackClaim& claim : pack_.claims)
      if (claim.after > lane.t) lane.stop = std::min(lane.stop, claim.after);
    lane.flow_start = lane.t;
    lane.chain = 0;
    lane.phase = Phase::step;
    forget_root(lane);
    return lane.stop > lane.t || open(Why::jumps);
  }

  static void forget_root(PackLane& lane) {
    lane.target = -1;
    lane.retakes = lane.halvings = 0;
    lane.forced = 0;
  }

  /// Along the flow, to first order.
  void move(std::size_t l, LaneValues& values, const LaneLook& seen, double time) {
    for (std::size_t k = 0; k < pack_.rows.size(); ++k)
      values.at(static_cast<std::size_t>(pack_.rows[k]), l) +=
          time * seen.at(PackSystem::rates, k, l);
  }

  // --- Jumps. ---

  void jump_all(std::uint32_t mask) {
    const std::size_t event = *lanes_[static_cast<std::size_t>(std::countr_zero(mask))]->due;
    std::uint32_t same = 0;
    each(mask, [&](std::size_t l) {
      if (lanes_[l]->due == event) same |= 1U << l;
    });
    each(same, [&](std::size_t l) { draw(event, l); });
    if (pack_.events[event].only_if) same = allowed(event, same);
    std::uint32_t lost = 0;
    if (lost_[event])
      each(same, [&](std::size_t l) {
        if (lanes_[l]->clocks.loses(event)) lost |= 1U << l;
      });
    if ((same & ~lost) != 0) jump(event, same & ~lost, jumps_[event]);
    if (lost != 0) jump(event, lost, *lost_[event]);
  }

  /// The noise of an event.
  void draw(std::size_t event, std::size_t l) {
    const auto& noise = pack_.system->dynamics.noise;
    for (std::size_t k = 0; k < noise.size(); ++k) {
      if (noise[k].event != event) continue;
      lanes_[l]->noise.draw(k, scratch_);
      take_noise(k, l);
    }
  }

  void take_noise(std::size_t noise, std::size_t l) {
    const auto& variables = pack_.system->dynamics.variables;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (variables[i].kind != VariableKind::noise || variables[i].of != noise) continue;
      const hybrid::Slot& slot = pack_.system->layout.slots[i];
      for (Eigen::Index k = slot.offset; k < slot.offset + slot.shape.size(); ++k)
        set(static_cast<std::size_t>(k), l, scratch_(k));
    }
  }

  /// The lanes in which an event may jump; in the others its occurrence is spent.
  std::uint32_t allowed(std::size_t event, std::uint32_t mask) {
    look(fine_, middle_, mask);
    look(coarse_, end_, mask);
    std::uint32_t goes = 0;
    each(mask, [&](std::size_t l) {
      Sides sides(pack_.watches.size(), 0);
      bool same = ((middle_.faults | end_.faults) >> l & 1U) == 0;
      for (std::size_t w = 0; w < sides.size(); ++w) {
        const double value = middle_.at(PackSystem::watch_values, w, l);
        const bool exact = !pack_.watches[w].moves;
        if (exact || std::abs(value) > error_of(w, l, middle_, end_)) sides[w] = sign_of(value);
        if (exact && sign_of(end_.at(PackSystem::watch_values, w, l)) != sides[w]) same = false;
      }
      const Truth is = truth(*pack_.events[event].only_if, pack_.watches, sides);
      if (!same || is == Truth::unknown) {
        why_ = Why::sign;
        return leave_open(l);
      }
      if (is == Truth::yes) {
        goes |= 1U << l;
        return;
      }
      PackLane& lane = *lanes_[l];
      spend(event, l);
      lane.spent[event] =
          pack_.system->dynamics.events[event].kind == Dynamics::EventKind::when ? 1 : 0;
      keep_before(l);
      lane.phase = Phase::look;
    });
    return goes;
  }

  void spend(std::size_t event, std::size_t l) {
    PackLane& lane = *lanes_[l];
    lane.crossed[event] = 0;
    lane.spent[event] = 0;
    const Dynamics::EventKind kind = pack_.system->dynamics.events[event].kind;
    if (kind != Dynamics::EventKind::every && kind != Dynamics::EventKind::at) return;
    lane.clocks.advance(event, lane.t);
    fill_clocks(l);
  }

  void keep_before(std::size_t l) {
    for (std::size_t w = 0; w < pack_.watches.size(); ++w)
      lanes_[l]->before[w] = start_.at(PackSystem::watch_values, w, l);
  }

  void jump(std::size_t event, std::uint32_t mask, LaneMachine& machine) {
    std::uint32_t bad = 0;
    for (LaneValues* values : {&fine_, &coarse_}) {
      std::copy_n(values->row(0), pack_.whole * kLanes, machine.input(0));
      machine.run(mask);
      bad |= machine.faults();
      each(mask, [&](std::size_t l) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(pack_.system->size); ++k) {
          const double value = machine.result(0, k)[l];
          if (!(std::abs(value) <= hybrid::kLargestState)) bad |= 1U << l;
          values->at(k, l) = value;
        }
        for (std::size_t k = 0; k < machine.size(1); ++k)
          if (machine.result(1, k)[l] != 0) bad |= 1U << l;
      });
    }
    each(mask, [&](std::size_t l) {
      if ((bad >> l & 1U) != 0) {
        why_ = Why::no_value;
        return leave_open(l);
      }
      PackLane& lane = *lanes_[l];
      for (const std::size_t element : since_[event]) set(element, l, 0);
      spend(event, l);
      keep_before(l);
      lane.happened[event] = 1;
      lane.jumped = event;
      lane.phase = Phase::look;
    });
  }

  // --- Steps. ---

  void step(const LaneValues& from, double share, LaneValues& to, std::uint32_t active,
            std::uint32_t& faults) {
    std::copy_n(from.row(0), pack_.whole * kLanes, step_.input(0));
    for (std::size_t l = 0; l < kLanes; ++l)
      step_.input(pack_.whole)[l] = share * lengths_.at(0, l);
    step_.run(active);
    faults |= step_.faults();
    std::copy_n(from.row(0), pack_.whole * kLanes, to.row(0));
    for (std::size_t k = 0; k < pack_.rows.size(); ++k)
      std::copy_n(step_.result(PackSystem::end, k), kLanes,
                  to.row(static_cast<std::size_t>(pack_.rows[k])));
  }

  void step_all(std::uint32_t mask) {
    for (std::size_t l = 0; l < kLanes; ++l) lengths_.at(0, l) = 0;
    each(mask, [&](std::size_t l) { lengths_.at(0, l) = choose_length(*lanes_[l]); });
    std::uint32_t faults = 0;
    step(coarse_, 1, coarse_end_, mask, faults);
    std::copy_n(step_.result(PackSystem::error, 0), kLanes, errors_.row(0));
    step(fine_, 0.5, fine_middle_, mask, faults);
    step(fine_middle_, 0.5, fine_end_, mask, faults);
    look(fine_middle_, middle_, mask);
    faults |= middle_.faults;
    look(fine_end_, end_, mask);
    faults |= end_.faults;
    look(coarse_end_, coarse_look_, mask);
    faults |= coarse_look_.faults;
    each(mask, [&](std::size_t l) {
      const bool fault = (faults >> l & 1U) != 0;
      const bool many = ++lanes_[l]->steps > kMostSteps && !open(Why::steps);
      if (many || !judge_step(l, fault)) leave_open(l);
    });
  }

  static double choose_length(PackLane& lane) {
    const double rest = lane.stop - lane.t;
    lane.h = lane.forced > 0          ? lane.forced
             : lane.wanted >= rest    ? rest
             : 2 * lane.wanted > rest ? rest / 2
                                      : lane.wanted;
    return lane.h;
  }

  bool shorten(PackLane& lane, double factor) {
    forget_root(lane);
    lane.wanted = lane.h * factor;
    return lane.wanted > kShortestStep * horizon_ || open(Why::steps);
  }

  bool judge_step(std::size_t l, bool fault) {
    PackLane& lane = *lanes_[l];
    const double error = errors_.at(0, l);
    if (fault || !std::isfinite(error)) return shorten(lane, 0.25);
    if (error > 1) return shorten(lane, std::min(step_factor(error), 0.9));
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
    return accept(l);
  }

  Sample watch_sample(const LaneLook& seen, std::size_t w, std::size_t l) const {
    return {seen.at(PackSystem::watch_values, w, l), seen.at(PackSystem::watch_rates, w, l)};
  }

  StepPolynomial along_watch(std::size_t w, std::size_t l) const {
    return {watch_sample(start_, w, l), watch_sample(middle_, w, l), watch_sample(end_, w, l),
            lanes_[l]->h};
  }

  /// The first root on the step of what is relevant. False: a sign is not certain.
  bool find_root(std::size_t l, int& target, double& share) {
    PackLane& lane = *lanes_[l];
    std::fill(lane.zero.begin(), lane.zero.end(), 0);
    for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
      if (lane.relevant[w] == 0 || !pack_.watches[w].moves) continue;
      const StepPolynomial along = along_watch(w, l);
      const double error =
          std::max(error_of(w, l, start_, coarse_start_), error_of(w, l, end_, coarse_look_)) +
          along.error();
      const auto& b = along.coefficients();
      const int known = lane.sides[w];
      const int side = known != 0 ? known : sign_of(b[5]);
      bool clear = true;
      for (std::size_t k = 1; k < b.size(); ++k)
        clear = clear && side * b[k] > (known != 0 || k == 5 ? error : 0);
      if (clear || static_cast<int>(w) == lane.target) continue;
      if (known != 0 && ends_at_root(lane, w, b, error)) {
        lane.zero[w] = error;
        continue;
      }
      const bool crosses = known != 0 && side * b[5] < -error && crosses_once(b, side);
      if (!crosses || lane.target >= 0) return false;
      const double at = along.root(known);
      const double apart = std::abs(at - share) * lane.h;
      if (share <= 1 && apart <= hybrid::kHardly * horizon_) return open(Why::order);
      if (at < share) {
        share = at;
        target = static_cast<int>(w);
      }
    }
    return true;
  }

  bool arrives(const PackLane& lane) const {
    return (lane.forced == 0 && lane.h == lane.stop - lane.t) ||
           lane.stop - (lane.t + lane.h) <= hybrid::kOneInstant * lane.stop;
  }

  /// Whether a difference comes to 0 just where a step ends anyway, and not before.
  bool ends_at_root(const PackLane& lane, std::size_t w, const std::array<double, 6>& b,
                    double error) const {
    if (!arrives(lane)) return false;
    for (std::size_t k = 1; k + 1 < b.size(); ++k)
      if (lane.sides[w] * b[k] <= error) return false;
    return std::abs(b.back()) <= error;
  }

  /// From its side to the other, which it may have left a moment ago.
  static bool crosses_once(const std::array<double, 6>& b, int side) {
    if (side * b[0] <= 0 && side * b[1] <= 0) return false;
    int changes = 0;
    for (std::size_t k = 1; k < b.size(); ++k) {
      const bool before = k == 1 || side * b[k - 1] > 0;
      changes += before != (side * b[k] > 0) ? 1 : 0;
    }
    return changes == 1;
  }

  bool accept(std::size_t l) {
    PackLane& lane = *lanes_[l];
    const bool at_stop = arrives(lane);
    const double now = at_stop ? lane.stop : lane.t + lane.h;
    const std::vector<ClaimLane> claims_before = lane.claims;
    for (std::size_t c = 0; c < lane.claims.size(); ++c) {
      lane.claims[c].along(now, lane.h, claim_sample(start_, c, l), claim_sample(middle_, c, l),
                           claim_sample(end_, c, l), reading(c, l, end_, coarse_look_),
                           may_branch(c, l), lane.halvings > 0 || 2 * lane.h < lane.wanted);
      if (!lane.claims[c].open()) continue;
      // Two halves may say more.
      if (lane.target >= 0 || ++lane.halvings > kMostHalvings) return open(Why::claim);
      lane.claims = claims_before;
      lane.forced = lane.h / 2;
      return true;
    }
    for (const int row : pack_.rows)
      if (!(std::abs(fine_end_.at(static_cast<std::size_t>(row), l)) <= hybrid::kLargestState))
        return open(Why::range);
    find_new_sides(l);
    coarse_.copy_lane(coarse_end_, l);
    fine_.copy_lane(fine_end_, l);
    start_.copy_lane(end_, l);
    coarse_start_.copy_lane(coarse_look_, l);
    const double wanted = lane.h * step_factor(errors_.at(0, l));
    const bool shortened = lane.forced > 0 || lane.h < lane.wanted;
    lane.wanted = shortened ? std::max(lane.wanted, wanted) : wanted;
    lane.t = now;
    fill_clocks(l);
    const int target = lane.target;
    forget_root(lane);
    if (!still_inside(l)) return false;
    if (target >= 0) return arrive_at_root(l, static_cast<std::size_t>(target));
    return !at_stop || arrive_at_stop(l);
  }

  Sample claim_sample(const LaneLook& seen, std::size_t c, std::size_t l) const {
    return {seen.at(PackSystem::claim_values, c, l), seen.at(PackSystem::claim_rates, c, l)};
  }

  /// Whether what a claim branches on may come to 0 on the step, by the parabola through it.
  bool may_branch(std::size_t c, std::size_t l) const {
    return std::any_of(
        pack_.claims[c].branches.begin(), pack_.claims[c].branches.end(), [&](std::size_t k) {
          const double first = start_.at(PackSystem::extras, k, l);
          const double last = end_.at(PackSystem::extras, k, l);
          const double middle = 2 * middle_.at(PackSystem::extras, k, l) - (first + last) / 2;
          return !(first > 0 && middle > 0 && last > 0) && !(first < 0 && middle < 0 && last < 0);
        });
  }

  void find_new_sides(std::size_t l) {
    PackLane& lane = *lanes_[l];
    for (std::size_t w = 0; w < pack_.watches.size(); ++w) {
      if (!pack_.watches[w].moves) continue;
      const double value = std::abs(end_.at(PackSystem::watch_values, w, l));
      const double error = error_of(w, l, end_, coarse_look_);
      if (static_cast<int>(w) == lane.target) {
        lane.sides[w] = static_cast<std::int8_t>(-lane.sides[w]);
        lane.zero[w] = std::max(error, 2 * value);
      } else if (lane.zero[w] > 0) {
        lane.sides[w] = 0;
      } else if (lane.relevant[w] == 0 || lane.sides[w] == 0) {
        lane.sides[w] = value > error ? sign_of(end_.at(PackSystem::watch_values, w, l)) : 0;
      }
    }
  }

  /// Whether the conditions that hung on unknown sides are as they must be, and flow sets hold.
  bool still_inside(std::size_t l) {
    PackLane& lane = *lanes_[l];
    for (const WatchedCondition& set : pack_.flow_sets)
      if (truth(set, pack_.watches, lane.sides) != Truth::yes) return open(Why::range);
    if (!lane.undetermined) return true;
    lane.undetermined = false;
    for (std::size_t e = 0; e < pack_.events.size(); ++e)
      if (pack_.events[e].when && lane.spent[e] == 0 &&
          truth(*pack_.events[e].when, pack_.watches, lane.sides) != Truth::no)
        return open(Why::sign);
    return true;
  }

  bool arrive_at_root(std::size_t l, std::size_t target) {
    PackLane& lane = *lanes_[l];
    if (!find_due(l)) return false;
    const Watch& watch = pack_.watches[target];
    if (!lane.due && watch.branches.empty()) return true;
    const bool is_short = lane.t - lane.flow_start < claims::kInstantOfRun * horizon_;
    lane.short_flows = is_short ? lane.short_flows + 1 : 0;
    if (lane.short_flows > kMostShortFlows) return open(Why::jumps);
    const auto shift = [&](const LaneLook& seen) {
      return -seen.at(PackSystem::watch_values, target, l) /
             seen.at(PackSystem::watch_rates, target, l);
    };
    lane.coarse_shift = shift(coarse_start_);
    lane.fine_shift = shift(start_);
    if (!std::isfinite(lane.coarse_shift) || !std::isfinite(lane.fine_shift))
      return open(Why::sign);
    move(l, coarse_, coarse_start_, lane.coarse_shift);
    move(l, fine_, start_, lane.fine_shift);
    lane.moved = true;
    keep_before(l);
    lane.phase = Phase::look;
    if (lane.due) {
      lane.phase = Phase::jump;
      return ++lane.chain <= kMostChain || open(Why::jumps);
    }
    return true;
  }

  bool arrive_at_stop(std::size_t l) {
    PackLane& lane = *lanes_[l];
    keep_before(l);
    for (std::size_t k = 0; k < pack_.whole; ++k)
      scratch_(static_cast<Eigen::Index>(k)) = fine_.at(k, l);
    if (lane.noise.draw_due(lane.t, scratch_)) {
      for (std::size_t k = 0; k < pack_.system->noise.size(); ++k)
        if (pack_.system->noise[k].every) take_noise(k, l);
      lane.phase = Phase::look;
      return true;
    }
    return go_on(l);
  }

  bool has_open_branch(const PackLane& lane) const {
    for (std::size_t w = 0; w < pack_.watches.size(); ++w)
      if (!pack_.watches[w].branches.empty() && lane.sides[w] == 0) return true;
    return false;
  }

  const PackSystem& pack_;
  double horizon_;
  LaneMachine step_, look_;
  std::vector<LaneMachine> jumps_;
  std::vector<std::optional<LaneMachine>> lost_;
  LaneValues coarse_, fine_;  ///< now
  LaneValues coarse_end_, fine_middle_, fine_end_;
  LaneValues lengths_, errors_;
  LaneLook start_, coarse_start_;  ///< at the values now
  LaneLook middle_, end_, coarse_look_;
  std::vector<bool> is_crossing_;  ///< by watch: of rises, falls, crosses
  std::vector<std::size_t> times_;
  std::vector<std::vector<std::size_t>> since_, left_;  ///< by event: elements
  Eigen::VectorXd scratch_;
  Why why_ = Why::claim;  ///< of the lane that is left open
  std::vector<std::optional<PackLane>> lanes_;
  std::uint64_t seed_ = 0, first_ = 0;
  std::vector<std::uint64_t> waiting_;  ///< the runs that are to be made, from the last
  const PackAccuracy* accuracy_ = nullptr;
  std::vector<PackVerdict> verdicts_;
};

PackRunner::PackRunner(const PackSystem& system) : lanes_(std::make_unique<Lanes>(system)) {}
PackRunner::PackRunner(PackRunner&&) noexcept = default;
PackRunner& PackRunner::operator=(PackRunner&&) noexcept = default;
PackRunner::~PackRunner() = default;

std::vector<PackVerdict> PackRunner::run(std::uint64_t seed, std::uint64_t first,
                                         std::uint64_t last) {
  return lanes_->run(seed, first, last);
}

}  // namespace gainsmith::packs
