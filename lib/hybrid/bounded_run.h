// One run in the coordinates of a judgement, in double or in 31 digits, with a bound of its error.
//
// The run is that of its draws: first state, intervals and horizon are the doubles that were drawn,
// and its maps are those of the decimals. With e = true x - x, a step x+ = fl(E x + f) has
//
//   e+ = E e + d,   |d_i| <= delta_i = (n + 4) u (|E| |x| + |f|)_i + what the error of E adds
//
// and the e_i are bounded by an ellipsoid that takes the same steps (error_ellipsoid.h). A row of
// the identity adds nothing, so what stays as it is has no error of its own, and 0 that is exact
// stays so.
//
// A jump that is affine in the states with coefficients that depend on clocks (F(s)) is a step
// whose E has a bound of its own. An entry of any other kind is evaluated over balls (ball.h): its
// row of E is 0 and delta is the radius.
//
// A rest is x + [D f] [x; 1] with [D f] a polynomial in its length (Series).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hybrid/arc.h"
#include "hybrid/bounded_system.h"
#include "hybrid/error_ellipsoid.h"
#include "hybrid/simulate.h"

namespace gainsmith::hybrid {

/// The samples of a run in these coordinates, those of the Arc of the same run.
template <class Scalar>
struct Track {
  Eigen::Index size = 0;
  std::vector<double> t;
  std::vector<std::int64_t> j;
  std::vector<Scalar> timer;
  std::vector<double> timer_bound;
  std::vector<Move> moves;
  std::vector<Scalar> stacked;
  std::vector<double> bounds;
  /// By sample: the coordinate for whose sake alone it is there, or kForAll. Empty: all are for
  /// all.
  std::vector<int> looked_for;
  static constexpr int kForAll = -1;
  /// By coordinate, sample after sample: whether its value is the same to the last bit whatever the
  /// errors of what it is made of. Empty: of none.
  std::vector<char> is_fixed;
  /// By sample: whether it lies in a flow of hardly any length, near others as its own may be.
  /// Empty: none does.
  std::vector<char> within_instant;
  Termination termination = Termination::horizon;
  std::string message;
  /// The relative accuracy of a flow that is integrated (integrated_run.h): its bounds are
  /// estimates. 0: they are bounds.
  double accuracy = 0;

  void clear() {
    for (auto* list : {&t, &timer_bound, &bounds}) list->clear();
    timer.clear();
    j.clear();
    moves.clear();
    stacked.clear();
    looked_for.clear();
    is_fixed.clear();
    within_instant.clear();
    termination = Termination::horizon;
    message.clear();
  }
  std::size_t samples() const { return t.size(); }
  Eigen::Map<const ColumnOf<Scalar>> state(std::size_t sample) const {
    return {stacked.data() + static_cast<Eigen::Index>(sample) * size, size};
  }
  Eigen::Map<const Eigen::VectorXd> bound(std::size_t sample) const {
    return {bounds.data() + static_cast<Eigen::Index>(sample) * size, size};
  }
};

/// Simulates run after run; one for each thread. All arguments must outlive it.
template <class Scalar>
class BoundedSimulator {
 public:
  BoundedSimulator(const System& system, const Scenario& scenario, const FlowSteps& steps,
                   const BoundedSystem<Scalar>& bounded);

  /// The run that Simulator makes of the same seed and number. It ends as diverged when a
  /// coordinate leaves [-1e150, 1e150]; what is no coordinate may grow.
  const Track<Scalar>& run(std::uint64_t seed, std::uint64_t run);

 private:
  void start(std::uint64_t run, RandomStream& random);
  void flow(double interval);
  void jump(double reset_value);
  void linear_entry(std::size_t coordinate);
  void ball_entry(std::size_t coordinate);
  void rest(double length);
  void step(const BoundedMap<Scalar>& map);
  void add_coarse_errors(const BoundedMap<Scalar>& map);
  /// x_ becomes next_; its errors take the same step with delta_, E and |E|.
  void take_step(const numbers::Matrix& E, const numbers::Matrix& sizes);
  void append(double t, std::int64_t j, const Scalar& timer, double timer_bound);

  const System* system_;
  const Scenario* scenario_;
  const FlowSteps* cutting_;
  const BoundedSystem<Scalar>* bounded_;
  Starts starts_;
  std::vector<BallFunction<Scalar>> first_;  ///< of the expressions, over the system's states
  std::vector<BallFunction<Scalar>> begin_;  ///< of the coordinates, over the system's states
  std::vector<std::unique_ptr<BallFunction<Scalar>>> after_;
  std::vector<StartRule> const* rules_;
  std::vector<FlowStep> cuts_;
  Track<Scalar> track_;
  ColumnOf<Scalar> x_, next_;
  Eigen::VectorXd size_;             ///< |x_|
  numbers::MatrixOf<Scalar> added_;  ///< of a rest: [D f]
  numbers::Matrix E_, E_sizes_;      ///< of a rest: I + D
  ErrorEllipsoid errors_;
  Eigen::VectorXd r_, delta_;
  numbers::MatrixOf<Scalar> J_;
  numbers::Matrix J_rounded_, J_sizes_;
};

}  // namespace gainsmith::hybrid
