// The lengths of the flows of kLanes runs, bit by bit those of hybrid::EventClocks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hybrid/scenario.h"
#include "lanes/steps.h"

namespace gainsmith::packs {

using LaneNumbers = std::array<double, lanes::kLanes>;
using LaneRuns = std::array<std::uint64_t, lanes::kLanes>;

/// Draws of all lanes at once, by counters: each is a function of (seed, run, number of the draw).
class LaneLengths {
 public:
  /// Of event 0, which has a clock. All runs have the same law. Both must outlive it.
  LaneLengths(const hybrid::System& system, const hybrid::Scenario& scenario);

  /// The first flow of these runs. They are all drawn, or all given by the scenario.
  void begin(std::uint64_t seed, const LaneRuns& runs);
  /// Of the flow that is next, and the times at which it ends.
  const LaneNumbers& length() const { return length_; }
  const LaneNumbers& due() const { return due_; }
  /// The flow is over.
  void advance();

 private:
  void draw_lengths(std::uint64_t number);
  void take_given();

  const hybrid::System* system_;
  const hybrid::System::Clock* clock_;
  const hybrid::Scenario* scenario_;
  const hybrid::Law* law_ = nullptr;  ///< none: uniform
  LaneRuns runs_{};
  std::vector<hybrid::EventClocks> given_;  ///< of runs whose draws are given: by lane, or of all
  std::uint64_t key_ = 0;                   ///< of the stream of lengths
  std::uint64_t occurrences_ = 0, numbers_ = 0, drawn_ = 0;
  alignas(64) LaneNumbers length_{}, due_{}, first_{};
};

}  // namespace gainsmith::packs
