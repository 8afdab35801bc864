// The lanes of a pack and what they do: the machinery of pack_runner.h.
//
// Each lane is in one of three phases. All lanes of one phase are computed together:
//
//   evaluate   new values at an instant: sides, branches and due events are found
//   step       a step of both runs, its polynomials, and the first root that decides something
//   jump       the maps of one event, in all lanes in which it is due
//
// A step is judged lane by lane: it is taken, taken again to a root or shorter, or the lane is left
// open. A step costs the same for few lanes. So steps wait while fewer than 7 of 8 lanes step and
// others have work at an instant.
//
//   lane_set.cpp     lanes, values at a point      lane_instants.cpp   what follows at an instant
//   lane_jumps.cpp   noise, conditions, maps       lane_steps.cpp      steps, roots, kinks
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "hybrid/tolerances.h"
#include "packs/lane_values.h"
#include "packs/pack_lane.h"
#include "packs/pack_runner.h"

namespace gainsmith::packs {

/// It keeps all values of 32 runs, each twice: `coarse_` from whole steps, `fine_` from half steps.
class LaneSet {
 public:
  explicit LaneSet(const PackSystem& pack);
  /// Decides those of the runs from `first` on whose verdicts are open.
  void run(std::uint64_t seed, std::uint64_t first, std::vector<PackVerdict>& verdicts);

 private:
  /// Runs all that is waiting to one accuracy.
  void run_waiting(const PackAccuracy& accuracy);

  // --- Lanes. ---

  /// How many rows a result of `point` has.
  std::size_t rows_of(std::size_t result) const;
  void find_clock_elements();
  /// The lanes in a phase, as bits.
  std::uint32_t in(Phase phase) const {
    std::uint32_t mask = 0;
    for (std::size_t l = 0; l < lanes::kLanes; ++l)
      if (lanes_[l] && lanes_[l]->phase == phase) mask |= 1U << l;
    return mask;
  }
  template <class Visit>
  static void each(std::uint32_t mask, const Visit& visit) {
    for (; mask != 0; mask &= mask - 1) visit(static_cast<std::size_t>(std::countr_zero(mask)));
  }
  /// Gives empty lanes the runs that wait, each at its drawn start.
  void refill();
  void leave_open(std::size_t l);
  /// The lane is left open, for this reason.
  bool open(Why why) {
    why_ = why;
    return false;
  }
  /// Writes the verdict of a run that has ended, and empties its lane.
  void finish(std::size_t l);
  /// Sets an element in both runs: what is exact, such as clocks and noise.
  void set(std::size_t element, std::size_t l, double value) {
    coarse_.at(element, l) = fine_.at(element, l) = value;
  }
  /// Sets the time, and the times that are left to clocks, never below 0.
  void fill_clocks(std::size_t l);

  // --- Values at a point. ---

  void evaluate(lanes::LaneMachine& by, const LaneValues& values, LanePoint& seen,
                std::uint32_t active);
  /// How far a watched difference may be from the true one.
  double error_of(std::size_t w, std::size_t l, const LanePoint& fine,
                  const LanePoint& coarse) const {
    return pack_.error_factor * std::abs(fine.at(PackSystem::watch_values, w, l) -
                                         coarse.at(PackSystem::watch_values, w, l)) +
           hybrid::kTermRounding * fine.at(PackSystem::watch_terms, w, l);
  }
  /// The same now, where a jump may have led it to 0 from far away.
  double error_here(std::size_t w, std::size_t l) const {
    const double before = lanes_[l]->jumped ? std::abs(lanes_[l]->before[w]) : 0;
    return error_of(w, l, start_, coarse_start_) + hybrid::kTermRounding * before;
  }
  void evaluate_all(std::uint32_t mask);
  /// With what the claims of lanes that begin are compared; the lanes in which it has no value.
  std::uint32_t begin_claims(std::uint32_t mask);
  Reading reading(std::size_t claim, std::size_t l, const LanePoint& fine,
                  const LanePoint& coarse) const {
    return {fine.at(PackSystem::claim_values, claim, l),
            coarse.at(PackSystem::claim_values, claim, l),
            fine.at(PackSystem::claim_terms, claim, l)};
  }

  // --- Instants. Each gives false where the run is to be left open. ---

  /// What follows from new values at an instant.
  bool settle(std::size_t l);
  static std::int8_t side_of(const Watched& watched, const PackLane& lane) {
    return static_cast<std::int8_t>(watched.factor * lane.sides[watched.watch]);
  }
  /// The side of 0 of each watched difference: its sign where it exceeds its error, otherwise 0. A
  /// crossing that has just changed its sign keeps its side.
  bool find_sides(std::size_t l);
  /// Not at a root, to which both runs are moved.
  bool is_exact_zero(std::size_t w, std::size_t l) const {
    return !(pack_.watches[w].moves && lanes_[l]->moved) &&
           start_.at(PackSystem::watch_values, w, l) == 0 &&
           coarse_start_.at(PackSystem::watch_values, w, l) == 0;
  }
  /// To which it moves; 0: that is not certain.
  std::int8_t leaving_side(std::size_t w, std::size_t l) const;
  /// Whether the crossing of an event is to this side.
  bool is_wanted(std::size_t event, int side) const {
    using Kind = model::Dynamics::EventKind;
    const Kind kind = pack_.system->dynamics.events[event].kind;
    return kind == Kind::crosses || (kind == Kind::rises) == (side > 0);
  }
  /// Whether the jump of another event has turned back what was just to cross 0.
  bool turns_back(std::size_t w, std::size_t l) const {
    const PackLane& lane = *lanes_[l];
    return lane.has_jumped && lane.zero[w] > 0 && leaving_side(w, l) != lane.sides[w];
  }
  /// A crossing that starts or jumps lead to exactly 0 is on the side to which it moves; where that
  /// is a crossing, the careful run tells when it happens.
  bool leave_zero(std::size_t w, std::size_t l);
  /// Whether a branch of the flow has changed; none where one is not certain. What is 0 takes the
  /// branch to which it moves.
  std::optional<bool> set_branches(std::size_t l);
  /// To the jump that is due, or into a flow.
  bool go_on(std::size_t l);
  /// The first event that is due.
  bool find_due(std::size_t l);
  /// The event that is due jumps; at the accumulation of jumps the run ends.
  bool begin_jump(std::size_t l);
  bool has_exact_zeros(const WatchedCondition& condition, std::size_t l) const;
  bool begin_flow(std::size_t l);
  static void forget_root(PackLane& lane) {
    lane.target = -1;
    lane.retakes = lane.halvings = 0;
    lane.forced = 0;
  }
  /// Along the flow, to first order.
  void move(std::size_t l, LaneValues& values, const LanePoint& seen, double time);
  /// Whether the conditions that hung on unknown sides are as they must be, and flow sets hold.
  bool still_inside(std::size_t l);
  /// At the end of a step that ends at a root: finds what is due, and moves both runs to their own
  /// roots.
  bool arrive_at_root(std::size_t l, std::size_t target);
  /// At a clock, a draw of noise, a start of claims or the horizon.
  bool arrive_at_stop(std::size_t l);
  bool has_open_branch(const PackLane& lane) const;

  // --- Jumps. ---

  /// Jumps the lanes that have the event of the first of them due; the others wait.
  void jump_all(std::uint32_t mask);
  /// The noise of an event.
  void draw(std::size_t event, std::size_t l);
  void take_noise(std::size_t noise, std::size_t l);
  /// The lanes in which an event may jump; in the others its occurrence is spent.
  std::uint32_t allowed(std::size_t event, std::uint32_t mask);
  /// The occurrence of an event is over: its clock goes on to the next.
  void spend(std::size_t event, std::size_t l);
  void keep_before(std::size_t l) {
    for (std::size_t w = 0; w < pack_.watches.size(); ++w)
      lanes_[l]->before[w] = start_.at(PackSystem::watch_values, w, l);
  }
  void jump(std::size_t event, std::uint32_t mask, lanes::LaneMachine& machine);

  // --- Steps. ---

  void step(const LaneValues& from, double share, LaneValues& to, std::uint32_t active,
            std::uint32_t& faults);
  void step_all(std::uint32_t mask);
  /// The finer run at a quarter of the step, or at three quarters (`mirrored`), by its quintic.
  void evaluate_between(bool mirrored, LanePoint& seen, std::uint32_t active);
  /// The length of the next step. A rest shorter than two steps is halved, so that no tiny step is
  /// left.
  static double choose_length(PackLane& lane);
  /// Takes the step again, by this factor shorter; false below kShortestStep of the horizon.
  bool shorten(PackLane& lane, double factor);
  /// After a step with too large an error: up to the first kink on it, or shorter.
  bool shorten_by_error(std::size_t l);
  /// False: the run is left open. `takes`: the step is taken; otherwise another one is tried.
  bool judge_step(std::size_t l, bool fault, bool& takes);
  /// The polynomials of claims and watches over the step.
  void follow(std::uint32_t active);
  pieces::StepPolynomial along_claim(std::size_t claim, std::size_t l) {
    return quintic(polynomials_, claim, l);
  }
  pieces::StepPolynomial along_watch(std::size_t watch, std::size_t l) {
    return quintic(polynomials_, pack_.claims.size() + watch, l);
  }
  StepSamples claim_samples(std::size_t claim, std::size_t l) const {
    const auto at = [&](const LanePoint& seen) {
      return Sample{seen.at(PackSystem::claim_values, claim, l),
                    seen.at(PackSystem::claim_rates, claim, l)};
    };
    return {lanes_[l]->h, at(start_), at(middle_), at(end_)};
  }
  struct Root {
    double share = 0;  ///< of the step
    std::size_t watch = 0;
    std::int8_t from = 0;  ///< the side that it leaves
  };
  /// The first root on the step that decides about an event, a flow set or a branch. False: a sign
  /// is not certain.
  bool find_root(std::size_t l, int& target, double& share);
  bool choose_root(PackLane& lane, int& target, double& share);
  /// Whether anything depends on the side of a watch, with the others on the sides `sides_`.
  bool decides(std::size_t w, const PackLane& lane);
  /// Of what may be 0 at the start of the step: the side that it is on a moment later; 0: that is
  /// not certain.
  std::int8_t left_side(std::size_t w, std::size_t l, std::span<const double> b,
                        double error) const;
  bool arrives(const PackLane& lane) const {
    return (lane.forced == 0 && lane.h == lane.stop - lane.t) ||
           lane.stop - (lane.t + lane.h) <= hybrid::kOneInstant * lane.stop;
  }
  /// Whether a difference comes to 0 just where a step ends anyway, and not before.
  bool ends_at_root(const PackLane& lane, std::size_t w, std::span<const double> b,
                    double error) const;
  /// From 0, where a flow or a jump has left it on this side, to the other one.
  static bool leaves_at_once(std::span<const double> b, int side, double error);
  /// From its side to the other, which it may have left a moment ago.
  static bool crosses_once(std::span<const double> b, int side);
  /// How far the end of the step is from the root that it goes to.
  double time_beside_root(const PackLane& lane, std::size_t l) const;
  bool judge_claims(std::size_t l, bool& takes);
  /// A step on which a claim has a kink ends just before it, and a short one passes it. False: it
  /// is short already.
  bool stop_beside_kink(std::size_t claim, std::size_t l);
  /// Of a difference on the step; none: it does not change its sign.
  std::optional<double> root_of_extra(std::size_t k, std::size_t l) const {
    return first_root({start_.at(PackSystem::extras, k, l), quarter_.at(PackSystem::extras, k, l),
                       middle_.at(PackSystem::extras, k, l),
                       three_quarters_.at(PackSystem::extras, k, l),
                       end_.at(PackSystem::extras, k, l)});
  }
  double end_of_step(const PackLane& lane) const {
    return arrives(lane) ? lane.stop : lane.t + lane.h;
  }
  /// At the end of a step that is taken.
  bool arrive(std::size_t l);
  /// Whether on the step a claim may come to where it branches, or to a sharp turn of a square
  /// root.
  bool may_branch(std::size_t c, std::size_t l) const;
  /// Between which values an extra is on the step.
  std::pair<double, double> range_of_extra(std::size_t k, std::size_t l) const;
  /// Whether it comes so near to 0 that a square root of it, or a quotient by it, bends sharply.
  bool bends(std::size_t k, std::size_t l) const;
  /// Notes the new sign of a crossing that no event wants.
  void pass(std::size_t w, PackLane& lane) const;
  void find_new_sides(std::size_t l);

  const PackSystem& pack_;
  double horizon_;
  lanes::LaneMachine step_, point_, coarse_point_, between_points_, polynomials_, begin_;
  std::vector<lanes::LaneMachine> jumps_;
  std::vector<std::optional<lanes::LaneMachine>> lost_;
  LaneValues coarse_, fine_;  ///< now
  LaneValues coarse_end_, fine_middle_, fine_end_;
  LaneValues between_;  ///< at a quarter of the step
  LaneValues lengths_, errors_;
  LanePoint start_, coarse_start_;  ///< at the values now
  LanePoint middle_, end_, coarse_at_end_, quarter_, three_quarters_;
  bool ends_in_zeno_ = false;              ///< whether events without a clock may accumulate
  std::vector<bool> is_crossing_;          ///< by watch: of rises, falls, crosses
  std::vector<char> in_condition_;         ///< by watch: of `when`
  std::vector<std::size_t> set_by_jumps_;  ///< elements
  std::vector<std::size_t> times_;
  std::vector<std::vector<std::size_t>> since_, left_;  ///< by event: elements
  Eigen::VectorXd scratch_;
  std::vector<Root> roots_;  ///< on the step of a lane
  Sides sides_;              ///< between two of them
  Why why_ = Why::claim;     ///< of the lane that is left open
  std::vector<std::optional<PackLane>> lanes_;
  std::uint64_t seed_ = 0, first_ = 0;
  std::vector<std::uint64_t> waiting_;  ///< the runs that are to be made, from the last
  const PackAccuracy* accuracy_ = nullptr;
  std::vector<PackVerdict> verdicts_;
};

}  // namespace gainsmith::packs
