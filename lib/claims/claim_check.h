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
// The comparison is that of real numbers. Each value comes with a bound of its error
// (bounded/bounded_run.h), which says what of it is certain; nothing else is forgiven:
//
//   violated    value - its bound > what it must not exceed + its bound
//   held        value + its bound <= what it must not exceed - its bound, at every sample
//   undecided   neither
//
// A claim with a tolerance d forgives excess as well, by d times the size of what must not be
// exceeded: of b; of the least value so far; of v(0); of factor v(0). With b = 0 it is d times the
// sum of the absolute values of the terms of v, at the sample itself.
//
// A value that cannot have changed since the sample before is not compared with itself: all that it
// depends on is constant along flows, or unchanged by jumps. A value that has no number violates in
// 31 digits and is undecided in double.
//
// A value that falls by more than its digits can show is noise in the end. Noise is not compared,
// and Finding::floor says down to where values were:
//
//   31 digits                            what is undecided below kFloorOfDigits of v(0)
//   flows integrated to an accuracy a    what is undecided below the larger of a and kNoiseOfRuns of
//                                        v(0), and all that is below kFloorOfAccuracy a of v(0), where
//                                        bounds are estimates
//
// In a comparison with a bound of 0 the largest terms of v take the place of v(0), since their sum
// falls to nothing. Where terms merely cancel, and with any other bound, everything is compared.
//
// The integral of a quadratic form over a flow is a quadratic form of its start (step_maps.h). That
// of any other is bounded over pieces of the flow (flow_integral.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "claims/claims.h"
#include "claims/flow_integral.h"
#include "claims/value.h"

namespace gainsmith::claims {

enum class Judgement { held, violated, undecided };
std::string to_string(Judgement judgement);

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
  double value = 0;     ///< at the worst sample
  double bound = 0;     ///< what it must not exceed there
  double rounding = 0;  ///< how far value - bound may be from the true one; infinite: not known
  double t = 0;         ///< where that is, in hybrid time
  std::int64_t j = 0;
  /// The largest value, relative to v(0), that was not compared because no digits are left; 0:
  /// none. Of a comparison with a bound that of its terms, relative to the largest.
  double floor = 0;
  int digits = kDoubleDigits;  ///< of the arithmetic that says so
  bool looked = true;          ///< false: the run has no sample at which the claim is made
  bool ended = false;      ///< the run ends at t, before its horizon, and the claim is left open
  bool estimated = false;  ///< `rounding` is an estimate, of the error of integration too
  bool disputed = false;   ///< the run repeated says otherwise, so that `judgement` is undecided
  double tolerance = 0;    ///< the claim's, which `judgement` forgives and `score` does not

  bool violated() const { return judgement == Judgement::violated; }
  bool undecided() const { return judgement == Judgement::undecided; }
  bool operator==(const Finding&) const = default;
};

/// A claim whose functions are in the coordinates of the judgement.
struct JudgedClaim {
  std::string name;
  model::ClaimKind kind = model::ClaimKind::nonincreasing;
  JudgedFunction value;
  std::optional<JudgedFunction> flow_cost;
  std::optional<JudgedFunction> jump_cost;
  std::optional<JudgedFunction> factor;
  std::optional<JudgedFunction> bound;
  std::optional<JudgedFunction> terms;  ///< of the value: the sum of their absolute values
  double after = 0;                     ///< the time from which on samples count
  std::optional<std::size_t> over{};    ///< the event just after whose jumps alone they do
  double tolerance = 0;                 ///< relative; 0: nothing is forgiven
  int sampled_for = -1;  ///< the coordinate that is the value, of samples made for its sake (Track)
  /// Which integrals of the step maps are those of the flow cost.
  std::optional<std::size_t> integral;
  /// The coordinate that is the integral of the flow cost, when the flow is integrated.
  std::optional<Eigen::Index> accumulated;
};

/// The claim over functions that `next` gives, in the order of programs_of.
JudgedClaim judged_claim(const Claim& claim, const std::function<JudgedFunction()>& next);

/// Checks one claim, run after run; one for each thread. All arguments must outlive it.
template <class Scalar>
class ClaimCheck {
 public:
  using Track = bounded::Track<Scalar>;
  using Bounded = bounded::Bounded<Scalar>;

  ClaimCheck(const JudgedClaim& claim, const bounded::BoundedSystem<Scalar>& system);

  const JudgedClaim& claim() const { return *claim_; }

  Finding operator()(const Track& track);

  /// The claim's value at every sample.
  std::vector<Bounded> values(const Track& track);
  /// cost: c at every sample.
  std::vector<Bounded> running_cost(const Track& track);

 private:
  Finding judged(const Track& track);
  Finding nonincreasing(const Track& track);
  Finding cost(const Track& track);
  Finding shrinks(const Track& track);
  Finding bounded(const Track& track);
  Finding nothing_counts(const Track& track) const;
  Bounded eased(const Bounded& bound, double size, double error) const;
  std::vector<double> term_sizes(const Track& track, const std::vector<Bounded>& v);
  bool counts(const Track& track, std::size_t sample) const;
  bool is_own(const Track& track, std::size_t sample) const;
  bool is_crowded(const Track& track, std::size_t sample) const;
  bool is_of_another(const Track& track, std::size_t sample) const;
  bool may_change(const Track& track, std::size_t before, std::size_t sample,
                  const std::vector<Bounded>& v) const;
  Bounded step_cost(const Track& track, std::size_t move);
  Bounded rest_cost(const Track& track, std::size_t move);

  const JudgedClaim* claim_;
  const bounded::BoundedSystem<Scalar>* system_;
  Value<Scalar> value_;
  std::optional<Value<Scalar>> jump_cost_;
  std::optional<Value<Scalar>> factor_;
  std::optional<Value<Scalar>> bound_;
  std::optional<Value<Scalar>> terms_;
  std::optional<FlowIntegral<Scalar>> flow_cost_;  ///< when it is no quadratic form
  bounded::Form<Scalar> rest_form_;                ///< the integral over a rest
};

}  // namespace gainsmith::claims
