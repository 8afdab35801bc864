// Runs of dynamics with events as the samples that claims are judged by.
#pragma once

#include <functional>
#include <vector>

#include "verify/event_setup.h"
#include "verify/text_ball.h"

namespace gainsmith::verify {

/// The runs of one (seed, number), to an accuracy and to a hundredth of it, as the samples of the
/// functions; one for each thread. The setup must outlive it.
///
///   samples   the looks along each flow (flow_looks.h), and the values after each jump; of a look
///             for the sake of one claim only its values, 0 for the others
///   bound     four times the largest difference between the two runs at five samples around it, or
///             what a rounding for each step and jump so far makes of the value, up for some
///             elements and down for the others, + 8 u |value| and what its evaluation rounds
///             (text_ball.h): an estimate that leaves a margin, and no proof. Where such an error
///             of the variables makes a branch uncertain, all values that are possible
///
/// Where the two runs take other events, or end otherwise, it hangs on the accuracy: the run is
/// lost. A run that ends by accumulating jumps is complete.
class EventTracks {
 public:
  explicit EventTracks(const EventSetup& setup);

  /// `factor`: of the accuracy of a campaign.
  const hybrid::Track<double>& run(std::uint64_t seed, std::uint64_t run, double factor);

 private:
  void append(const FlowLook& look, std::int64_t j, const Eigen::VectorXd& coarse,
              const Eigen::VectorXd& fine, const Eigen::VectorXd& around, int pattern, int stride);
  void add_flow(const hybrid::FlowPiece& coarse, const hybrid::FlowPiece& fine);
  void add_parts(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine);
  RiseLimits limits_of_rises(const Eigen::VectorXd& start, double accuracy);
  void end(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine);
  void widen(std::size_t first);
  bool counts(const FlowLook& look, std::size_t function) const;
  Eigen::VectorXd values(const FlowLook& look, const Eigen::VectorXd& x);
  Eigen::VectorXd with_rounding(const Eigen::VectorXd& x, int bit) const;
  Eigen::VectorXd errors(const Eigen::VectorXd& fine, const Eigen::VectorXd& around) const;

  const EventSetup* setup_;
  hybrid::EventSimulator simulator_;
  std::vector<RunValue> functions_;
  std::vector<TextBall> balls_;  ///< of the functions
  std::vector<bool> rounds_;     ///< by element: whether it is no whole number, which is exact
  hybrid::Track<double> track_;
  std::vector<double> rounding_;  ///< of the evaluation, as the bounds of the track
  RiseLimits rises_;
  double rounded_ = 0;  ///< steps and jumps so far
};

}  // namespace gainsmith::verify
