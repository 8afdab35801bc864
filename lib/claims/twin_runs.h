// Runs with their second ones, from which figures have their errors (statistics/bound_figure.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "claims/event_doubts.h"
#include "claims/run_setup.h"

namespace gainsmith::claims {

/// The run of a (seed, number), and a second one whose errors may be a hundred times as large. The
/// second one is moved in the last places (simulate/last_places.h).
struct TwinRun {
  hybrid::Trajectory run, twin;
  double accuracy = 0;  ///< of the run, relative; 0 where flows are exact
  /// Until when it is certain which events happen, and why not from there on.
  double certain = std::numeric_limits<double>::infinity();
  std::string doubt;
  /// By element of the variables: from when on the two runs have nothing to do with each other, as
  /// they differ by more than a thousandth of its range so far (RunTracks). Infinite: never.
  Eigen::VectorXd parted;

  /// Of the flows of the run.
  double steps() const;

  /// Why what is read of some elements up to a time is not known; empty: it is.
  std::string unknown(double until, const std::vector<Eigen::Index>& elements,
                      const hybrid::System& system) const;
};

/// Makes one after the other; one for each thread. The setup must outlive it.
class TwinRuns {
 public:
  explicit TwinRuns(const RunSetup& setup)
      : setup_(&setup), simulator_(setup.system, setup.scenario), doubts_(setup.system) {}

  /// The run to a hundredth of `usual`, the second one to `usual`, unless the campaign asks for
  /// another accuracy; times a factor. A stop (base/stop.h) is thrown.
  TwinRun operator()(std::uint64_t seed, std::uint64_t run, double usual, double factor = 1);
  /// The same, both in 31 digits: of setups whose runs may be made so.
  TwinRun in_31_digits(std::uint64_t seed, std::uint64_t run, double usual);

 private:
  TwinRun made(std::uint64_t seed, std::uint64_t run, const simulate::Accuracy& accuracy,
               const simulate::Accuracy& coarser);
  void compare(const TwinParts& twins, const simulate::Accuracy& accuracy, TwinRun& result) const;

  const RunSetup* setup_;
  simulate::Simulator simulator_;
  EventDoubts doubts_;
};

}  // namespace gainsmith::claims
