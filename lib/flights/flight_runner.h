// Runs made of flights in closed form (flight_system.h), kLanes at once. Each lane makes one flight
// after the other; a lane that has ended takes the next run.
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

  void refill();
  void begin(std::size_t l, std::uint64_t run);
  void set_limits(std::uint32_t fresh);
  void fly();
  /// The lanes that go on, at the ends of their flights.
  void arrive(std::uint32_t mask);
  /// Of them, those whose jumps do not accumulate; the others are over.
  std::uint32_t watch_zeno(std::uint32_t mask);
  std::uint32_t may_accumulate() const;
  bool accumulates(std::size_t l);
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
  std::uint64_t seed_ = 0, first_ = 0, next_ = 0, last_ = 0;
  std::uint32_t busy_ = 0;
  Row t_{};
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
