// The values of claims along a run: its samples, with a bound of the error of each value. Hybrid
// time is (t, j), t the continuous time and j the number of jumps so far.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gainsmith::claims {

/// Why a run ended.
enum class Termination {
  horizon,    ///< the horizon was reached, or jumps accumulate
  lost,       ///< it is not certain how it goes on: the message says why
  broken_off  ///< it ended before: the message says why
};
std::string to_string(Termination termination);

/// A value, and how far the true one may be from it.
struct Bounded {
  double value = 0;
  double bound = 0;
};

/// How one sample follows from the one before it.
struct Move {
  bool jump = false;
  std::size_t event = 0;  ///< whose jump it is
};

/// The samples of one run, in order. At a jump the sample before (t, j) and the one after (t, j + 1)
/// are both there. A flow has its two ends and points between them.
struct Track {
  Eigen::Index size = 0;  ///< values at a sample
  std::vector<double> t;
  std::vector<std::int64_t> j;
  std::vector<Move> moves;     ///< moves[k] leads from sample k to k + 1
  std::vector<double> values;  ///< sample after sample
  std::vector<double> bounds;
  /// By sample: the value for whose sake alone it is there, or kForAll. Empty: all for all.
  std::vector<int> sampled_for;
  static constexpr int kForAll = -1;
  /// By value, sample after sample: whether it is the same to the last bit whatever the errors of
  /// what it is made of. Empty: of none.
  std::vector<char> is_fixed;
  /// By sample: whether it lies in a flow of hardly any length, near others as its own may be.
  /// Empty: none does.
  std::vector<char> within_instant;
  Termination termination = Termination::horizon;
  std::string message;
  /// The relative accuracy to which flows are integrated; bounds are estimates.
  double accuracy = 0;

  void clear();
  std::size_t samples() const { return t.size(); }
  /// Value `of` at a sample.
  Bounded at(std::size_t sample, int of) const {
    const std::size_t at = sample * static_cast<std::size_t>(size) + static_cast<std::size_t>(of);
    return {values[at], bounds[at]};
  }
};

}  // namespace gainsmith::claims
