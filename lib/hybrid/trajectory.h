// A solution of Dynamics (model/dynamics.h) in hybrid time: flows with dense output, and jumps with
// their events. What is judged, written and drawn.
//
// The domain is a hybrid time domain: a union of intervals [t_j, t_(j+1)] x {j}. A jump goes from
// (t, j) to (t, j + 1). A flow of length 0 has no FlowPiece.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "numbers/matrix.h"

namespace gainsmith::hybrid {

/// Why a run ended.
enum class Ending {
  horizon,      ///< the horizon was reached
  escaped,      ///< a variable left every bound, or is no number any more
  undefined,    ///< a text has no value there, and no shorter step helps
  left,         ///< a condition under `while` is false
  stuck,        ///< 10^6 jumps without a flow between them
  zeno,         ///< flows that shrink by a steady factor: jumps accumulate
  chattering,   ///< flows ever shorter without such a factor
  sliding,      ///< both branches of a `where` lead back to its switching surface
  full,         ///< more jumps or steps than a run may keep
  passes,       ///< a loop of a jump whose `until` did not become true
  interrupted,  ///< stopped from outside
  lost          ///< the integration could not go on, and why is not certain
};
std::string to_string(Ending ending);

/// Whether a run that ends so says all that there is: its horizon, or where jumps accumulate.
constexpr bool is_complete(Ending ending) {
  return ending == Ending::horizon || ending == Ending::zeno;
}

/// The variables over one step of a flow: sums of Chebyshev polynomials of the time, exact at both
/// ends up to rounding.
struct DenseStep {
  double from = 0;  ///< continuous time
  double to = 0;
  /// One row a variable element, column k the coefficient of T_k on [from, to].
  numbers::Matrix coefficients;

  /// All elements at t in [from, to].
  Eigen::VectorXd operator()(double t) const;
  /// The same on [from, t], t in (from, to].
  DenseStep until(double t) const;
};

/// A turning point of what decides about an event, or about `while`, next to 0: had it come to the
/// other side of 0, or not, something else would have happened.
struct NearTurn {
  enum class Of { when, crossing, flow_set };
  Of of = Of::when;
  std::size_t index = 0;       ///< of the event, or of the `while`
  std::size_t comparison = 0;  ///< of its condition
  Eigen::Index element = 0;
  double t = 0;      ///< where the flow turns there, or where 0 is reached before
  double value = 0;  ///< at the turning point
  std::string text;
};

/// A flow of positive length.
struct FlowPiece {
  std::int64_t j = 0;  ///< the number of jumps before it
  Eigen::VectorXd start;
  Eigen::VectorXd end;
  /// Contiguous. Noise that is drawn anew after a time of its own changes between two of them.
  std::vector<DenseStep> steps;

  double from() const { return steps.front().from; }
  double to() const { return steps.back().to; }
};

/// JumpPoint::terms of a constant that a map has taken as it is.
constexpr double kConstantTerms = -1;

struct JumpPoint {
  double t = 0;
  std::int64_t j = 0;      ///< the number of jumps before it
  std::size_t event = 0;   ///< of the dynamics
  bool lost = false;       ///< the plant alone jumped
  Eigen::VectorXd before;  ///< what the maps saw: noise of the event is drawn anew already
  Eigen::VectorXd after;
  /// Of a perturbed run, by element: the size of the terms that a map has computed it from, next to
  /// nothing of a copy; kConstantTerms: it is a constant of the text; 0: it is what it was.
  Eigen::VectorXd terms{};
};

struct Trajectory {
  /// All variables at t = 0, in the order of the dynamics, columns of each below each other.
  Eigen::VectorXd start;
  std::vector<std::variant<FlowPiece, JumpPoint>> parts;  ///< in order
  double horizon = 0;
  Ending ending = Ending::horizon;
  double end = 0;               ///< its time
  std::string message;          ///< why it ended, with time, place and values; empty at the horizon
  double accumulation = 0;      ///< zeno: the time at which jumps accumulate
  std::vector<NearTurn> turns;  ///< of a perturbed run (simulate/simulator.h)
  std::vector<std::string> notes;  ///< such as a condition that came near without being met
};

}  // namespace gainsmith::hybrid
