// Runs made of flights in closed form (flight_system.h), kLanes at once. Each lane makes one flight
// after the other; a lane that has ended takes the next run.
//
// One call of the code makes a whole flight in all lanes, so that a run costs as many calls as it
// has flights. A run ends at the horizon, or where its jumps accumulate (hybrid/zeno.h). It is left
// open where a flight is not ok.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flights/flight_system.h"
#include "hybrid/zeno.h"
#include "packs/claim_lane.h"
#include "packs/lane_values.h"
#include "packs/moves.h"
#include "packs/pack_runner.h"

namespace gainsmith::flights {

using packs::ClaimLane;
using packs::LaneMask;
using packs::LaneValues;
using packs::PackVerdict;
using packs::Why;

/// It holds the registers, the states and the recent flights of kLanes runs.
class FlightRunner {
 public:
  /// One for each thread. Both must outlive it; the flights are those of the pack.
  FlightRunner(const packs::PackSystem& pack, const FlightSystem& flights);

  /// Runs first, ..., last - 1; those that are open are left to steps.
  std::vector<PackVerdict> run(std::uint64_t seed, std::uint64_t first, std::uint64_t last);

 private:
  using Row = std::array<double, lanes::kLanes>;
  template <class Visit>
  static void each(std::uint32_t mask, const Visit& visit) {
    for (; mask != 0; mask &= mask - 1) visit(static_cast<std::size_t>(std::countr_zero(mask)));
  }

  /// Begins the next runs in the lanes that are empty.
  void refill();
  void begin(std::size_t l, std::uint64_t run);
  /// The limits of the claims of runs that begin; not a number, and so never held, where there is
  /// none.
  void set_limits(std::uint32_t fresh);
  /// One flight in all lanes that are busy.
  void fly();
  /// The lanes that go on, at the ends of their flights.
  void arrive(std::uint32_t mask);
  /// Of them, those whose jumps do not accumulate; the others are over.
  std::uint32_t watch_zeno(std::uint32_t mask);
  /// The lanes in which the last lengths allow an accumulation: the cheap test before the full one.
  std::uint32_t may_accumulate() const;
  /// Whether the jumps of a lane accumulate by its last `kept` flights.
  bool accumulates(std::size_t l);
  /// Applies the maps of an event to both runs, the second of them moved in its last places.
  void jump(std::size_t event, std::uint32_t mask);
  void finish(std::size_t l);
  double* input(FlightSystem::Input which) { return code_.input(flights_.at(which)); }
  const double* result(FlightSystem::Flight which) const {
    return code_.result(FlightSystem::flight, which);
  }
  PackVerdict& verdict_of(std::size_t l) {
    return verdicts_[static_cast<std::size_t>(runs_[l] - first_)];
  }

  const PackSystem& pack_;
  const FlightSystem& flights_;
  double horizon_;
  lanes::LaneMachine code_, begin_;
  std::vector<lanes::LaneMachine> jumps_;
  std::vector<std::vector<std::size_t>> since_;  ///< by event: elements
  /// Runs first_ ... last_ - 1 are made; next_ begins next.
  std::uint64_t seed_ = 0, first_ = 0, next_ = 0, last_ = 0;
  /// The lanes with a run, as bits.
  std::uint32_t busy_ = 0;
  Row t_{};
  /// By lane: the number of its run, and the events that happened in it, as bits.
  std::array<std::uint64_t, lanes::kLanes> runs_{}, happened_{};
  std::array<packs::Moves, lanes::kLanes> moves_;
  std::vector<std::size_t> set_by_jumps_;  ///< elements
  std::array<std::size_t, lanes::kLanes> count_{},
      short_{};  ///< of flights; of short ones in a row
  /// The last flights of all lanes, by number modulo `kept`.
  static constexpr std::size_t kept = hybrid::ZenoDetector::kKept;
  std::size_t number_ = 0;
  std::array<Row, kept> lengths_{};
  std::array<Row, kept> events_{};
  std::array<LaneValues, kept> states_;
  LaneValues sizes_;  ///< the largest values so far
  hybrid::ZenoDetector zeno_;
  Eigen::VectorXd scratch_, largest_;
  std::array<std::vector<ClaimLane>, lanes::kLanes> claims_;
  std::vector<PackVerdict> verdicts_;
};

}  // namespace gainsmith::flights
