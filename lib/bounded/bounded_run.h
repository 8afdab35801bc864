// One run in the coordinates of a judgement, in double or in 31 digits, with a bound of its error.
//
// The first state, intervals and horizon are the doubles that were drawn; the maps are those of the
// decimals. With e = true x - x, a step x+ = fl(E x + f) has
//
//   e+ = E e + d,   |d_i| <= delta_i = (n + 4) u (|E| |x| + |f|)_i + what the error of E adds
//
// and the e_i are bounded by an ellipsoid that takes the same steps (error_ellipsoid.h). A row of
// the identity adds nothing, so what stays as it is has no error of its own, and 0 that is exact
// stays so.
//
// A jump may be affine in the states with coefficients that depend on clocks, F(s): then its E has
// a bound of its own. An entry of any other kind is evaluated over balls (ball.h): its row of E is
// 0 and delta is the radius.
//
// A rest is x + [D f] [x; 1] with [D f] a polynomial in its length (Series).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bounded/bounded_system.h"
#include "bounded/error_ellipsoid.h"
#include "bounded/sampled_system.h"
#include "bounded/track.h"

namespace gainsmith::bounded {

/// Simulates run after run; one for each thread. All arguments must outlive it.
template <class Scalar>
class BoundedSimulator {
 public:
  BoundedSimulator(const SampledSystem& system, const hybrid::Scenario& scenario,
                   const FlowSteps& steps, const BoundedSystem<Scalar>& bounded);

  /// The run that Simulator makes of the same seed and number. It ends as diverged when a
  /// coordinate leaves [-1e150, 1e150]; what is no coordinate may grow.
  const Track<Scalar>& run(std::uint64_t seed, std::uint64_t run);

 private:
  void start(const Eigen::VectorXd& drawn);
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

  const SampledSystem* system_;
  const hybrid::Scenario* scenario_;
  const FlowSteps* cutting_;
  const BoundedSystem<Scalar>* bounded_;
  /// Of the starts that are expressions, over the system's states, with their slots.
  std::vector<std::pair<std::size_t, BallFunction<Scalar>>> first_;
  std::vector<BallFunction<Scalar>> begin_;  ///< of the coordinates, over the system's states
  std::vector<std::unique_ptr<BallFunction<Scalar>>> after_;
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

}  // namespace gainsmith::bounded
