// A run in the coordinates of a judgement: its samples, with a bound of the error of each value.
// Hybrid time is (t, j), t the continuous time and j the number of jumps so far.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bounded/ball.h"
#include "bounded/steps.h"
#include "numbers/matrix.h"

namespace gainsmith::bounded {

/// Why a run ended.
enum class Termination {
  horizon,     ///< the horizon was reached
  diverged,    ///< an element of the state left [-1e150, 1e150] or is not a number
  lost,        ///< the integration of the flow could not go on, and why is not certain
  jump_limit,  ///< more jumps than allowed before the horizon: intervals that shrink to nothing
  undefined,   ///< a map has no value at the state, such as a division by zero, or a flow escapes
  broken_off   ///< it ended before: the message says why
};
std::string to_string(Termination termination);

/// How one sample follows from the one before it.
struct Move {
  bool jump = false;
  FlowStep step;          ///< of the flow, when it is no jump
  std::size_t event = 0;  ///< of dynamics with events, whose jump it is
};

/// The samples of one run in the coordinates of a judgement, in order. At a jump the sample before
/// (t, j) and the one after (t, j + 1) are both there. A flow has its two ends and the points
/// between its steps.
template <class Scalar>
struct Track {
  Eigen::Index size = 0;
  std::vector<double> t;
  std::vector<std::int64_t> j;
  std::vector<Scalar> timer;  ///< runs down; 0 before each jump
  std::vector<double> timer_bound;
  std::vector<Move> moves;      ///< moves[k] leads from sample k to k + 1
  std::vector<Scalar> stacked;  ///< the states, one after the other
  std::vector<double> bounds;
  /// By sample: the coordinate for whose sake alone it is there, or kForAll. Empty: all for all.
  std::vector<int> sampled_for;
  static constexpr int kForAll = -1;
  /// By coordinate, sample after sample: whether its value is the same to the last bit whatever the
  /// errors of what it is made of. Empty: of none.
  std::vector<char> is_fixed;
  /// By sample: whether it lies in a flow of hardly any length, near others as its own may be.
  /// Empty: none does.
  std::vector<char> within_instant;
  Termination termination = Termination::horizon;
  std::string message;
  /// The relative accuracy of flows that are integrated, whose bounds are estimates. 0: proved
  /// ones.
  double accuracy = 0;

  void clear() {
    for (auto* list : {&t, &timer_bound, &bounds}) list->clear();
    timer.clear();
    j.clear();
    moves.clear();
    stacked.clear();
    sampled_for.clear();
    is_fixed.clear();
    within_instant.clear();
    termination = Termination::horizon;
    message.clear();
  }
  std::size_t samples() const { return t.size(); }
  Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>> state(std::size_t sample) const {
    return {stacked.data() + static_cast<Eigen::Index>(sample) * size, size};
  }
  Eigen::Map<const Eigen::VectorXd> bound(std::size_t sample) const {
    return {bounds.data() + static_cast<Eigen::Index>(sample) * size, size};
  }
};

}  // namespace gainsmith::bounded
