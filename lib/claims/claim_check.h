// One claim against one run.
//
// With v(k) the claim's value at sample k, v(0) at the start:
//
//   nonincreasing   v(k) <= min over i < k of v(i)   at every sample, over jumps too
//   cost            c(k) <= v(0)                     at every sample; c(k) is the cost so far,
//                   int flow_cost dt + sum of jump_cost before jumps, as their maps see it
//   shrinks         v(end) <= factor v(0)            held at once when v(0) = 0
//   below, above    v(k) <= b, v(k) >= b             at every sample; b a constant
//
// Some samples may lie as near the one before as rounding allows: those for the sake of the value
// alone, and those in a flow of hardly any length. There an undecided comparison counts only when
// the value seems to have grown by the part kGrown of its bounds. Later samples are compared with
// the least value of all.
//
// `after` a time, the samples before it do not count; `over` an event, only those just after its
// jumps do. Then v(0) is the first that counts.
//
// The comparison is that of real numbers. Each value comes with a bound of its error (track.h),
// which says what of it is certain; nothing else is forgiven:
//
//   violated    value - its bound > what it must not exceed + its bound
//   held        value + its bound <= what it must not exceed - its bound, at every sample
//   undecided   neither
//
// A start that is the bound, bit by bit, counts as equal to it, and so does a constant that a
// jump has taken as it is, as the end of a clip. So do the first points after it that
// are there for the sake of the value alone, unless it seems to have grown by kGrown of its error.
//
// A claim with a tolerance d forgives excess as well, by d times the size of what must not be
// exceeded: of b; of the least value so far; of v(0); of factor v(0). With b = 0 it is d times the
// sum of the absolute values of the terms of v, at the sample itself.
//
// A value that cannot have changed since the sample before is not compared with itself: all that it
// depends on is constant along flows, or unchanged by jumps. A value that has no number is
// undecided.
//
// A value that falls by more than its digits can show is noise in the end. Noise is not compared,
// and Finding::floor says down to where values were. Of flows that are integrated to an accuracy a
// it is what is undecided below the larger of a and kNoiseOfRuns of v(0), and all that is below
// kFloorOfAccuracy a of v(0), since bounds are estimates.
//
// In a comparison with a bound of 0 the largest terms of v take the place of v(0), since their sum
// falls to nothing. Where terms merely cancel, and with any other bound, everything is compared.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "claims/claims.h"
#include "claims/track.h"

namespace gainsmith::claims {

/// Of one run; of a campaign it is the worst of its runs.
using Judgement = model::CampaignVerdict;

/// How near a run came to violating a claim.
struct Finding {
  Judgement judgement = Judgement::held;
  /// (value - bound) / |scale|, the scale being v(0) or, for `shrinks`, factor v(0), for `below`
  /// the bound, or 1 when that is 0; (bound - value) / |scale| for `above`. While
  /// `nonincreasing` holds, value and bound are v(end) and v(0): what is left at the end. Of a cost
  /// that is never positive the value is c(end), the whole cost. Infinite when a value is no number
  /// or the scale of a violation is 0; -1 when the scale is 0 and the claim holds; minus infinite
  /// when no sample counts.
  double score = -1;
  double value = 0;  ///< at the worst sample
  double bound = 0;  ///< what it must not exceed there
  double rounding =
      0;         ///< how far value - bound may be from the true one, by an estimate; infinite:
                 ///< not known
  double t = 0;  ///< where that is, in hybrid time
  std::int64_t j = 0;
  /// The largest value, relative to v(0), that was not compared because no digits are left; 0:
  /// none. Of a comparison with a bound that of its terms, relative to the largest.
  double floor = 0;
  bool sampled = true;    ///< false: the run has no sample at which the claim is made
  bool ended = false;     ///< the run ends at t, before its horizon, and the claim is left open
  bool disputed = false;  ///< the run repeated says otherwise, so that `judgement` is undecided
  double tolerance = 0;   ///< the claim's, which `judgement` forgives and `score` does not

  bool violated() const { return judgement == Judgement::violated; }
  bool undecided() const { return judgement == Judgement::undecided; }
  bool operator==(const Finding&) const = default;
};

/// With the claim that it is of.
struct NamedFinding {
  std::string name;
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  Finding finding;
};

/// A claim over the values of a track, by their numbers.
struct JudgedClaim {
  std::string name;
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  int value = 0;            ///< samples made for the sake of the claim are those for this value
  bool is_still = false;    ///< the value keeps its bits along flows
  std::optional<int> cost;  ///< so far
  std::optional<int> factor;
  std::optional<int> bound;
  std::optional<int> terms;           ///< of the value: the sum of their absolute values
  double after = 0;                   ///< the time from which on samples count
  std::optional<std::size_t> over{};  ///< the event just after whose jumps alone they do
  double tolerance = 0;               ///< relative; 0: nothing is forgiven
  bool always = false;                ///< Claim::always
};

/// Checks one claim, run after run. The claim must outlive it.
class ClaimCheck {
 public:
  explicit ClaimCheck(const JudgedClaim& claim) : claim_(&claim) {}

  const JudgedClaim& claim() const { return *claim_; }

  /// `holds`: the claim is known to hold, and what is not certain counts as held.
  Finding operator()(const Track& track, bool holds = false) const;

 private:
  /// By the kind of the claim; the tolerance of the finding is set by the caller.
  Finding judged(const Track& track, bool holds) const;
  Finding nonincreasing(const Track& track, bool holds) const;
  Finding cost(const Track& track, bool holds) const;
  Finding shrinks(const Track& track, bool holds) const;
  Finding bounded(const Track& track, bool holds) const;
  /// No sample counts: held, not sampled, score minus infinity.
  Finding nothing_counts(const Track& track) const;
  /// The value at all samples; along flows the last one where it keeps its bits.
  std::vector<Bounded> values(const Track& track) const;
  Bounded eased(const Bounded& bound, double size, double error) const;
  std::vector<double> term_sizes(const Track& track, const std::vector<Bounded>& v) const;
  /// Whether the claim is made at a sample: by `after`, `over` and for whose sake it is there.
  bool counts(const Track& track, std::size_t sample) const;
  bool is_crowded(const Track& track, std::size_t sample) const;
  bool is_chosen(const Track& track, std::size_t sample, const Bounded& value) const;
  bool is_of_another(const Track& track, std::size_t sample) const;
  bool may_change(const Track& track, std::size_t before, std::size_t sample,
                  const std::vector<Bounded>& v) const;

  const JudgedClaim* claim_;
};

}  // namespace gainsmith::claims
