// The verdict on one run: in double, and in 31 digits where double does not decide. A flow that is
// integrated is repeated to a hundredth of its error instead.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "verify/setup.h"
#include "verify/tracks.h"

namespace gainsmith::verify {

struct RunVerdict {
  claims::Judgement judgement = claims::Judgement::held;
  std::vector<claims::Finding> findings;  ///< of the claims that are stated, in order
  bounded::Termination termination = bounded::Termination::horizon;
  std::string message;         ///< why it ended, when a jump map had no value
  std::vector<char> happened;  ///< by event: whether it did in this run
  bool repeated = false;
  bool confirmed = false;  ///< violated when repeated

  bool unfinished() const { return termination != bounded::Termination::horizon; }
};

/// Judges run after run; one for each thread. The setup must outlive it.
class Judge {
 public:
  /// A stop (base/stop.h) may end a careful run; then its verdict says nothing.
  explicit Judge(const Setup& setup);

  /// What double decides is decided; a run with a claim that it does not decide, or that does not
  /// reach the horizon, is repeated. Of a run that diverges there with less than half of its last
  /// state certain, the end is undecided.
  RunVerdict operator()(std::uint64_t seed, std::uint64_t run);

  /// The run repeated.
  RunVerdict confirm(std::uint64_t seed, std::uint64_t run);

  /// In double, until the next call.
  const bounded::Track<double>& track(std::uint64_t seed, std::uint64_t run);
  std::vector<claims::ClaimCheck<double>>& checks() { return checks_; }

 private:
  /// The track, whose events are noted.
  template <class Scalar>
  const bounded::Track<Scalar>& noted(const bounded::Track<Scalar>& track) {
    happened_.resize(event_count_, 0);
    for (const bounded::Move& move : track.moves)
      if (move.jump) happened_[move.event] = 1;
    return track;
  }

  std::size_t event_count_;
  std::vector<char> happened_;  ///< by event, in the runs made of one number
  std::optional<EventTracks> events_;
  std::optional<bounded::ClockedSimulator> clocked_;
  std::optional<bounded::BoundedSimulator<double>> narrow_;
  std::optional<bounded::BoundedSimulator<DoubleDouble>> wide_;
  std::vector<claims::ClaimCheck<double>> checks_;
  std::vector<claims::ClaimCheck<DoubleDouble>> wide_checks_;
};

}  // namespace gainsmith::verify
