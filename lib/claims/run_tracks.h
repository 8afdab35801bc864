// Runs of dynamics with events as the samples that claims are judged by.
#pragma once

#include <optional>
#include <vector>

#include "base/unit_roundoff.h"
#include "base/whole_number.h"
#include "claims/event_doubts.h"
#include "claims/parting.h"
#include "claims/run_setup.h"
#include "claims/text_ball.h"
#include "claims/track.h"
#include "claims/twin_parts.h"

namespace gainsmith::claims {

/// The runs of one (seed, number) as the samples of the functions. One is integrated to an
/// accuracy. The second one, to a hundredth of it, is moved by random units in the last place in
/// every exact flow and every jump (simulate/last_places.h). One object for each thread. The setup
/// must outlive it.
///
///   samples   the sample points along each flow (claims/sample_points.h), and the values after
///             each jump; at a point for the sake of one claim only its values, 0 for the others; so
///             too after a jump over which a claim is not made
///   bound     four times the largest difference between the two runs at five samples around it, 64
///             times where flows are exact (twin_parts.h), or what a rounding for each step and
///             jump so far makes of the value, up for some elements and down for the others,
///             + 8 u |value| and what its evaluation rounds (text_ball.h): an estimate that leaves
///             a margin, and no proof. Counts and the like, which no error reaches, are exact.
///             Where such an error of the variables makes a branch uncertain, all values that are
///             possible
///
/// Once the two runs differ by more than a thousandth of the range of a value so far, and of that of
/// one of its variables, they are two runs that have nothing to do with each other: from there on
/// bounds of the claim are infinite. Two signals that are equal differ by nothing but rounding, which is
/// as large as their difference and says nothing of that kind. Bounds are infinite, too, from where a
/// text branches more often than can be searched.
///
/// Where it is not certain which events happen, because the two runs take others or because they
/// lie within their errors (event_doubts.h), the run is lost: the samples end there. Events at one
/// instant may come in another order (twin_parts.h). A run that ends by accumulating jumps is
/// complete.
class RunTracks {
 public:
  explicit RunTracks(const RunSetup& setup);

  /// `factor`: of the accuracy of a campaign. `twin`: which of several perturbed runs.
  const Track& run(std::uint64_t seed, std::uint64_t run, double factor, std::uint64_t twin = 0);

  /// Whether flows are integrated, so that a smaller factor means smaller errors.
  bool is_integrated() const { return !setup_->system.affine; }

  /// The same, both runs in 31 digits: what differs by less than a double's rounding is the same.
  const Track& run_in_31_digits(std::uint64_t seed, std::uint64_t run);
  /// Whether that may decide what the last run left open.
  bool can_decide_in_31_digits() const { return !ended_early_ && setup_->has_31_digits(); }

 private:
  const Track& compare(std::uint64_t seed, std::uint64_t run, const simulate::Accuracy& accuracy,
                       const simulate::Accuracy& sharper, std::uint64_t twin);
  void append(const SamplePoint& point, std::int64_t j, const Eigen::VectorXd& coarse,
              const Eigen::VectorXd& fine, const Eigen::VectorXd& around, int pattern, int stride,
              bool within_instant = false);
  /// Up to a time before which all is certain.
  void add_flow(const TwinFlow& flow, const hybrid::Trajectory& run, double certain);
  void add_jump(const TwinParts& twins, std::size_t at);
  /// The part of both runs that is certain; whether that is all.
  bool add_parts(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine);
  /// Whether a value differs by a part of its range so far; `size`: of the terms that it is the sum of.
  bool differs(std::size_t function, double value, double difference, double size);
  double difference_between(std::size_t function, const Eigen::VectorXd& coarse,
                            const Eigen::VectorXd& fine);
  /// The two runs have parted in it if they have in one of its variables.
  void part(std::size_t function);
  bool has_parted(std::size_t function) const {
    return parted_[static_cast<std::size_t>(setup_->first_of_claim[function])] != 0;
  }
  /// Rises below the noise of the integration are not sought.
  RiseLimits limits_of_rises(const Eigen::VectorXd& start, double accuracy);
  /// Why the samples end: the horizon, an end that both runs share, or a doubt.
  void end(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine, bool certain);
  /// Bounds of the samples from `first` on: factor (largest difference around) + 8 u |value| +
  /// rounding of the evaluation.
  void widen(std::size_t first);
  bool counts(const SamplePoint& point, std::size_t function) const;
  void come_to(std::size_t event);
  void find_fresh(const SamplePoint& point, const Eigen::VectorXd& coarse,
                  const Eigen::VectorXd& fine, const Eigen::VectorXd& around);
  Eigen::VectorXd values(const Eigen::VectorXd& x);
  /// Whether rounding reaches an element (simulate/last_places.h).
  bool rounds(Eigen::Index element, double value) const {
    const auto e = static_cast<std::size_t>(element);
    return rounds_[e] && chosen_[e] == 0 && !is_exact_whole(value);
  }
  double rounding_of(double value) const {
    return (4 + rounded_) * kUnitRoundoff * std::abs(value) + rounding_31_;
  }
  Eigen::VectorXd with_rounding(const Eigen::VectorXd& x, int bit) const;
  Eigen::VectorXd errors(const Eigen::VectorXd& fine, const Eigen::VectorXd& around) const;

  const RunSetup* setup_;
  simulate::Simulator simulator_;
  RunCosts costs_;
  std::optional<Parting> parting_;  ///< of the variables of this run
  std::vector<RunValue> functions_;
  std::vector<TextBall> balls_;  ///< of the functions
  EventDoubts doubts_;
  std::vector<char> rests_;   ///< by function: of a claim over another event than the last
  bool amid_ = false;         ///< what comes is neither the start nor the last flow of a run
  std::vector<bool> rounds_;  ///< by element: whether it is no whole number, which is exact
  std::vector<Eigen::Index> resting_;  ///< elements that no flow changes
  /// By element: whether a jump has made it a constant of the text, as the end of a clip is.
  std::vector<char> chosen_;
  Track track_;
  std::vector<double> rounding_;  ///< of the evaluation, as the bounds of the track
  RiseLimits rises_;
  /// What a function has been so far.
  struct Range {
    double low = 0, high = 0;
    bool seen = false;
  };
  std::vector<Range> ranges_;  ///< by function
  /// A function at its last sample, unless it may have branched there.
  struct Sampled {
    std::vector<double> at;  ///< its variables in both runs, and by how much they differ around
    bool is_known = false;
    double value = 0, difference = 0, rounding = 0;
    char is_fixed = 0;
  };
  std::vector<Sampled> sampled_;  ///< by function
  std::vector<bool> fresh_;       ///< by function: whether the next sample differs
  std::vector<double> sizes_;     ///< by claim, at its first function: of values and their terms
  std::vector<char> parted_;      ///< the same: whether the two runs have
  bool ended_early_ = false;      ///< the last run, both times alike, before its horizon
  std::string doubt_;             ///< why the run is lost
  bool in_31_digits_ = false;     ///< the last run
  double rounding_31_ = 0;        ///< of the largest value so far, in 31 digits
  double rounded_ = 0;            ///< steps and jumps so far that round to double
};

}  // namespace gainsmith::claims
