// What the runs of a campaign share when the dynamics have events (model/dynamics.h).
//
// A claim is judged by its own values along a run: they are the coordinates of the judgement. The
// integral of a flow cost is a state beside those of the plant and the observers.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hybrid/bounded_system.h"
#include "hybrid/event_run.h"
#include "verify/claim_check.h"
#include "verify/claims.h"
#include "verify/flow_looks.h"
#include "verify/run_values.h"
#include "verify/text_rounding.h"

namespace gainsmith::verify {

struct EventSetup {
  hybrid::EventSystem system;
  hybrid::StateLayout layout;  ///< of the variables: without branches that flows hold
  hybrid::EventScenario scenario;
  std::vector<model::Dynamics::Assignment> flow;  ///< as written, before branches are held
  std::vector<LinkedClaim> claims;
  std::vector<expr::Program> functions;  ///< of the claims that are stated: the coordinates
  hybrid::BallsOf<double> constants;     ///< of the functions, with their errors
  hybrid::Coordinates coordinates;
  std::vector<JudgedClaim> judged;  ///< the claims that are stated, in order
  FlowLooks looks;                  ///< that the claims ask for
  std::unique_ptr<hybrid::BoundedSystem<double>> narrow;
  std::optional<model::Design::RunAccuracy> asked;  ///< of the campaign

  /// To what a run is integrated: as the campaign asks, otherwise to `usual`; times a factor.
  hybrid::Accuracy accuracy(double usual, double factor = 1) const;
};

/// Of a run that is looked at; those of a campaign, which are made twice, are coarser.
constexpr double kUsualOfOne = 1e-10;
constexpr double kUsualOfMany = 1e-8;

/// At an address of its own: its parts point to each other.
std::unique_ptr<const EventSetup> make_event_setup(const model::Instance& instance,
                                                   const model::Gains& gains);

/// The runs of one (seed, number), to an accuracy and to a hundredth of it, as the samples of the
/// functions; one for each thread. The setup must outlive it.
///
///   samples   the looks along each flow (flow_looks.h), and the values after each jump
///   bound     four times the largest difference between the two runs at five samples around it, or
///             what a rounding for each step and jump so far makes of the value, up for some
///             elements and down for the others, + 8 u |value| and what its evaluation rounds
///             (text_rounding.h): an estimate that leaves a margin, and no proof
///
/// Where the two runs take other events, or end otherwise, it hangs on the accuracy: the run is
/// lost. A run that ends by accumulating jumps is complete.
class EventTracks {
 public:
  /// `stopped` is asked along the runs: true ends them.
  explicit EventTracks(const EventSetup& setup, std::function<bool()> stopped = {});

  /// `factor`: of the accuracy of a campaign.
  const hybrid::Track<double>& run(std::uint64_t seed, std::uint64_t run, double factor);

 private:
  void append(const FlowLook& look, std::int64_t j, const Eigen::VectorXd& coarse,
              const Eigen::VectorXd& fine, int pattern, int stride);
  void add_flow(const hybrid::FlowPiece& coarse, const hybrid::FlowPiece& fine);
  void add_parts(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine);
  void end(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine);
  void widen(std::size_t first);
  Eigen::VectorXd values(const Eigen::VectorXd& x);
  Eigen::VectorXd with_rounding(const Eigen::VectorXd& x, int bit) const;

  const EventSetup* setup_;
  hybrid::EventSimulator simulator_;
  std::vector<RunValue> functions_;
  std::vector<TextRounding> roundings_;  ///< of the functions
  std::vector<bool> rounds_;  ///< by element: whether it is no whole number, which is exact
  hybrid::Track<double> track_;
  std::vector<double> rounding_;  ///< of the evaluation, as the bounds of the track
  double rounded_ = 0;            ///< steps and jumps so far
};

}  // namespace gainsmith::verify
