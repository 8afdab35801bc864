// Runs of a campaign, kLanes at once.
//
// A lane is one run: its own time, steps, clocks and events; a lane that has ended takes the next
// run. Each run is made twice over the same steps, once in whole and once in half steps: what they
// differ by is the error of the first, 256 times that of the second, of which values are taken.
//
//   steps    to clocks and the horizon exactly; a step on which a watched difference comes to 0,
//            and decides something by that, is taken again to its root
//   roots    each run is moved along its flow to its own root, jumps there, and is moved back, to
//            first order: so their difference knows of the error of the event's time
//   open     whatever is unusual ends the lane, and the run is left to the careful simulator: signs
//            that are not certain, two events at nearly one time, chains of jumps, short steps,
//            texts without a value, claims next to their bounds
//
// A run is a function of (seed, run); nothing crosses lanes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "claims/claim_check.h"
#include "packs/pack_system.h"

namespace gainsmith::packs {

/// Why a run is left to the careful simulator.
enum class Why : std::uint8_t {
  claim,     ///< a claim is next to its bound
  sign,      ///< the sign of a difference that decides about an event or a branch is not certain
  order,     ///< it is not certain which event comes first
  no_value,  ///< a text has no value
  range,     ///< a value leaves its flow set or every bound
  steps,     ///< steps are too short or too many
  jumps      ///< many jumps at one time, or within hardly any
};
constexpr std::size_t kWhys = 7;
std::string to_string(Why why);

struct PackVerdict {
  bool open = true;  ///< what follows says nothing but why
  Why why = Why::claim;
  bool proved = false;   ///< by bounds of all errors, otherwise by estimates
  bool nearest = false;  ///< open since it may come nearest to a bound of those around it
  /// Of the claims that are stated: judgement, score, floor and whether it is sampled; of linear
  /// runs value, bound and rounding too.
  std::vector<claims::Finding> findings;
  std::vector<char> happened;  ///< by event

  /// Whether one of the findings is a violation; of no use where `open`.
  bool violated() const;
};

class LaneSet;

/// Runs packs of one PackSystem. It holds the registers of one thread.
class PackRunner {
 public:
  /// One for each thread. The system must outlive it.
  explicit PackRunner(const PackSystem& system);
  PackRunner(PackRunner&&) noexcept;
  PackRunner& operator=(PackRunner&&) noexcept;
  ~PackRunner();

  /// Runs first, ..., last - 1. Stopped (base/stop.h) when it is asked to stop.
  std::vector<PackVerdict> run(std::uint64_t seed, std::uint64_t first, std::uint64_t last);
  /// The same of those runs from `first` on whose verdicts are open.
  void decide(std::uint64_t seed, std::uint64_t first, std::vector<PackVerdict>& verdicts);

 private:
  std::unique_ptr<LaneSet> lanes_;
};

}  // namespace gainsmith::packs
