// One run in the coordinates of a judgement, when the flow is linear but for clocks.
//
// All runs share the flow (clocked_flow.h), which is integrated to an accuracy for copy A and to a
// hundredth of it for copy B. Samples lie at the ends of 32 equal parts of each flow. A also errs
// by twice the rounding of its start and jumps (ball.h), so that |A - B| shows what becomes of such
// errors.
//
// The samples are those of B. The bound of an element is four times the largest |A - B| of its
// state at the sample and at two on each side, + 8 u |B|. A errs some hundred times more than B, so
// the bound is an estimate with a margin, and no proof. u has to stay below the accuracy.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bounded/bounded_system.h"
#include "bounded/clocked_flow.h"
#include "bounded/coordinates.h"
#include "bounded/flow_rate.h"
#include "bounded/sampled_system.h"
#include "bounded/track.h"

namespace gainsmith::bounded {

/// The flows of a system that is linear but for clocks, made when they are first asked for.
class ClockedFlows {
 public:
  /// `integrals`: elements of the coordinates that are integrals, of quadratic forms all. All
  /// arguments must outlive it.
  ClockedFlows(const SampledSystem& system, const hybrid::Scenario& scenario,
               const Coordinates& coordinates, std::vector<Eigen::Index> integrals);

  /// To this relative accuracy, in steps that are no longer than this part of the longest; nullptr
  /// when the system is not of that kind or its flow cannot be integrated so far. May be called from
  /// many threads.
  const ClockedFlow* to(double relative, double step = 1);

 private:
  const Coordinates* coordinates_;
  numbers::Values constants_;
  std::vector<Eigen::Index> integrals_;
  double longest_;
  std::optional<Eigen::VectorXd> start_;
  std::mutex mutex_;
  std::map<std::pair<double, double>, std::unique_ptr<const ClockedFlow>> made_;
};

/// Simulates run after run; one for each thread. All arguments must outlive it.
class ClockedSimulator {
 public:
  /// Where A errs by the rounding of jumps: the first element of each state up or down.
  enum class Rounding { up, down };

  ClockedSimulator(const SampledSystem& system, const hybrid::Scenario& scenario,
                   const Coordinates& coordinates, ClockedFlows& flows);

  /// The run that Simulator makes of the same seed and number, to `relative` and to a hundredth of
  /// it. It ends as undefined where a jump map has no value, as lost where the flows are not known
  /// so accurately, as diverged where a coordinate leaves [-1e150, 1e150].
  const Track<double>& run(std::uint64_t seed, std::uint64_t run, double relative,
                           Rounding rounding = Rounding::up);

 private:
  struct Copy {
    const ClockedFlow* flow = nullptr;
    Eigen::VectorXd x, start;
  };

  void begin(const Eigen::VectorXd& drawn);
  void flow(double interval);
  void advance(double t);
  void jump(Eigen::VectorXd& x);
  void jump_with_rounding(Eigen::VectorXd& x);
  void jump(double length);
  void append(double t, std::int64_t j, double timer, double timer_bound);
  void lose(const std::string& why);
  void set_bounds();
  Eigen::VectorXd difference() const;

  const SampledSystem* system_;
  const hybrid::Scenario* scenario_;
  const Coordinates* coordinates_;
  ClockedFlows* flows_;
  numbers::Values constants_;
  BallsOf<double> balls_;
  std::vector<hybrid::PointFunction> begin_;
  std::vector<std::unique_ptr<hybrid::PointFunction>> after_;
  std::vector<BallFunction<double>> begin_balls_;
  std::vector<std::unique_ptr<BallFunction<double>>> after_balls_;
  FlowRate rate_;
  std::array<Copy, 2> copies_;
  Track<double> track_;
  std::size_t flow_first_ = 0;  ///< the sample where the flow at hand begins
  double rounding_ = 2;
};

}  // namespace gainsmith::bounded
