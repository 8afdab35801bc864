// The verdict on one run by the careful run, which is repeated more accurately where it does not decide.
//
//   1. two runs to kAccuracyOfMany and a hundredth of it        (claims/run_tracks.h)
//   2. undecided, or not to the horizon: to kAccuracyOfOne, another perturbed run
//   3. still undecided, or violated within kDoubtful errors: in 31 digits, else to a third accuracy
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "claims/run_tracks.h"
#include "verify/setup.h"

namespace gainsmith::verify {

/// The judgement is the worst of the findings; of a run that breaks off it is violated.
struct RunVerdict {
  claims::Judgement judgement = claims::Judgement::held;
  std::vector<claims::Finding> findings;  ///< of the claims that are stated, in order
  claims::Termination termination = claims::Termination::horizon;
  std::string message;         ///< why it ended
  std::vector<char> happened;  ///< by event: whether it did in this run
  bool repeated = false;
  bool confirmed = false;  ///< violated when repeated

  bool unfinished() const { return termination != claims::Termination::horizon; }
};

/// Judges run after run; one for each thread. The setup must outlive it.
class Judge {
 public:
  /// A stop (base/stop.h) may end a run; then its verdict says nothing.
  explicit Judge(const Setup& setup);

  /// A run with a claim that is not decided, or that does not reach the horizon, is repeated. What that
  /// leaves open is made in 31 digits, or, where those are lost, to a third accuracy. So is a claim
  /// that is violated by little: where the truth is a tie, two runs may agree by chance, and what 31
  /// digits do not confirm is undecided. Of a campaign the first kIn31Digits runs are made so.
  /// `holds`: claims that are known to hold, of which what is not certain counts as held.
  RunVerdict operator()(std::uint64_t seed, std::uint64_t run, const std::vector<bool>& holds = {});

  /// The run repeated, so too.
  RunVerdict confirm(std::uint64_t seed, std::uint64_t run);

  /// To the accuracy of a campaign, until the next call.
  const claims::Track& track(std::uint64_t seed, std::uint64_t run) {
    return *(track_ = &tracks_.run(seed, run, 1));
  }
  const std::vector<claims::ClaimCheck>& checks() const { return checks_; }

 private:
  const claims::Track& noted(const claims::Track& track);
  /// Step 2.
  RunVerdict sharper(std::uint64_t seed, std::uint64_t run);
  /// Step 3, of the claims that step 2 leaves open.
  void decide(std::uint64_t seed, std::uint64_t run, bool in_31_digits, RunVerdict& verdict);
  /// Judges undecided claims again that are known to hold.
  void take_held(const std::vector<bool>& holds, RunVerdict& verdict) const;

  std::size_t event_count_;
  std::vector<char> happened_;  ///< by event, in the runs made of one number
  claims::RunTracks tracks_;
  const claims::Track* track_ = nullptr;  ///< the last one
  std::vector<claims::ClaimCheck> checks_;
};

}  // namespace gainsmith::verify
