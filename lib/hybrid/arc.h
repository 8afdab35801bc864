// A solution of a hybrid system: its samples in hybrid time (t, j), t the continuous time and j the
// number of jumps so far.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hybrid/steps.h"
#include "numbers/matrix.h"

namespace gainsmith::hybrid {

/// Why a run ended.
enum class Termination {
  horizon,     ///< the horizon was reached
  diverged,    ///< an element of the state left [-1e150, 1e150] or is not a number
  lost,        ///< the integration of the flow could not go on, and why is not certain
  jump_limit,  ///< more jumps than allowed before the horizon: intervals that shrink to nothing
  undefined,   ///< a map has no value at the state, such as a division by zero, or a flow escapes
  broken_off   ///< a run of dynamics with events ended before: the message says why
};
std::string to_string(Termination termination);

/// How one sample follows from the one before it.
struct Move {
  bool jump = false;
  FlowStep step;          ///< of the flow, when it is no jump
  std::size_t event = 0;  ///< of dynamics with events, whose jump it is
};

/// The samples of one run, in order. At a jump the sample before (t, j) and the one after (t, j +
/// 1) are both there; a flow interval has its two ends and the points between its steps.
struct Arc {
  Eigen::Index size = 0;  ///< of the state
  std::vector<double> t;
  std::vector<std::int64_t> j;
  std::vector<double> timer;    ///< runs down; 0 before each jump
  std::vector<Move> moves;      ///< moves[k] leads from sample k to k + 1
  std::vector<double> stacked;  ///< the states, one after the other
  Termination termination = Termination::horizon;
  std::string message;  ///< undefined: what has no value, and where

  std::size_t samples() const { return t.size(); }
  Eigen::Map<const Eigen::VectorXd> state(std::size_t sample) const {
    return {stacked.data() + static_cast<Eigen::Index>(sample) * size, size};
  }
  /// All states, one a column.
  Eigen::Map<const numbers::Matrix> states() const {
    return {stacked.data(), size, static_cast<Eigen::Index>(samples())};
  }
  void append(double time, std::int64_t jumps, double tau, const Eigen::VectorXd& x);
};

}  // namespace gainsmith::hybrid
