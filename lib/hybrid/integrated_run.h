// One run in the coordinates of a judgement when the flow is not affine with constant coefficients:
// integrated twice (integrator.h), to a relative accuracy and to a hundredth of it.
//
//   x' = f(x, tau)   over a flow of length T from a jump on, samples at its 32 equal pieces
//
// A takes steps of at most a 32nd of the flow, B of a 128th: what lasts less may be stepped over. A
// also errs by the rounding of its start and jumps, to twice the radius of their balls (ball.h), so
// that what becomes of such errors shows in |A - B|; the rounding within flows does not.
//
// The samples are those of B, which is the sharper one. The bound of an element's error is four
// times the largest |A - B| of its state at the sample and at two on each side, + 8 u |B|: A errs
// some hundred times more than B, so it is an estimate that leaves a margin, and no proof. u has to
// stay below the accuracy. An element may err by 1e-2 of its state's relative accuracy below the
// largest element of that state when a flow begins; a state that is small there counts 1e-4 of the
// largest state, or of what the rates at the start give in the time of the flow.
//
// Where a flow is linear but for clocks (clocked_flow.h), it is integrated once for all runs, to
// both accuracies.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/bounded_run.h"
#include "hybrid/clocked_flow.h"
#include "hybrid/coordinates.h"
#include "hybrid/integrator.h"
#include "hybrid/simulate.h"

namespace gainsmith::hybrid {

/// The flows of a system that is linear but for clocks, made when they are first asked for.
class SharedFlows {
 public:
  /// `integrals`: elements of the coordinates that are integrals, of quadratic forms all. All
  /// arguments must outlive it.
  SharedFlows(const System& system, const Scenario& scenario, const Coordinates& coordinates,
              std::vector<Eigen::Index> integrals);

  /// To this relative accuracy; nullptr when the system is not of that kind or its flow cannot be
  /// integrated so far. May be called from many threads.
  const ClockedFlow* to(double relative);

 private:
  const Coordinates* coordinates_;
  numbers::Values constants_;
  std::vector<Eigen::Index> integrals_;
  double longest_;
  std::optional<Eigen::VectorXd> start_;
  std::mutex mutex_;
  std::map<double, std::unique_ptr<const ClockedFlow>> made_;
};

/// Simulates run after run; one for each thread. All arguments must outlive it.
class IntegratedSimulator {
 public:
  static constexpr int kPieces = 32;
  /// Where A errs by the rounding of jumps: the first element of each state up or down.
  enum class Rounding { up, down };

  IntegratedSimulator(const System& system, const Scenario& scenario,
                      const Coordinates& coordinates, SharedFlows* shared = nullptr);

  /// The run of the draws that Simulator makes of the same seed and number, integrated to
  /// `relative` and `relative`/100. It ends as undefined where a jump map has no value or both
  /// integrations escape at the same time (to 1e-6 of the flow), as lost where the flow cannot be
  /// continued otherwise, as diverged where a coordinate leaves [-1e150, 1e150].
  const Track<double>& run(std::uint64_t seed, std::uint64_t run, double relative,
                           Rounding rounding = Rounding::up);

 private:
  /// One of the two runs.
  struct Copy {
    Eigen::VectorXd x;       ///< of all coordinates
    Eigen::VectorXd start;   ///< of the flow
    Eigen::VectorXd moving;  ///< the elements that are integrated
    Integrator integrator;
    const ClockedFlow* shared = nullptr;
  };

  Copy make_copy();
  Eigen::VectorXd absolute(const Eigen::VectorXd& x, double relative, double interval);
  double reach(const Eigen::VectorXd& x, double interval);
  void begin(std::uint64_t run, RandomStream& random);
  void flow(double interval, double relative);
  void advance(double t);
  void jump(double reset_value);
  void jump(Eigen::VectorXd& x);
  void jump_with_rounding(Eigen::VectorXd& x);
  void lose(const std::string& why);
  void append(double t, std::int64_t j, double timer, double timer_bound);
  Eigen::VectorXd difference() const;
  void set_bounds();

  const System* system_;
  const Scenario* scenario_;
  const Coordinates* coordinates_;
  SharedFlows* shared_;
  numbers::Values constants_;
  Starts starts_;
  FlowRate rate_;
  std::vector<PointFunction> begin_;  ///< of the coordinates, over the states
  std::vector<std::unique_ptr<PointFunction>> after_;
  BallsOf<double> balls_;  ///< the constants
  std::vector<BallFunction<double>> begin_balls_;
  std::vector<std::unique_ptr<BallFunction<double>>> after_balls_;
  const Eigen::VectorXd* flow_start_ = nullptr;
  double flow_timer_ = 0;
  double rounding_ = 0;  ///< of A, in radii
  std::vector<Copy> copies_;
  std::size_t flow_first_ = 0;  ///< the first sample since the last jump
  Track<double> track_;
};

}  // namespace gainsmith::hybrid
