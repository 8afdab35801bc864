// One claim against one run of a pack, as it goes.
//
// The comparisons are those of claims/claim_check.h, over values at the ends and the middles of
// steps and, between them, over the quintic through these. The run is made twice. The error of a
// value is
//
//   error_factor max |v_fine - v_coarse| + rounding of its terms
//
// with the maximum over the last three ends of steps. One end alone may have a small difference by
// chance. What the comparison leaves open is left to the careful run.
//
//   below   v <= limit + tolerance |limit|    nonincreasing   v(t) <= the least v before
//   above   the same of -v                    shrinks         v(end) <= factor v(start)
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "claims/claim_check.h"
#include "packs/pack_system.h"
#include "packs/quintics.h"

namespace gainsmith::packs {

/// A value in both runs, and the size of its terms.
struct Reading {
  double fine = 0;
  double coarse = 0;
  double terms = 0;
  double late = 0;  ///< what the value may have changed since a root that the step has passed
};

/// Begun, then given every start, jump and step of the run in order, then finished. Once open it
/// stays so, unless the claim holds always.
class ClaimLane {
 public:
  /// `limit`: the bound, the factor, or of a cost the value at the start with its `terms`.
  void begin(const PackClaim& claim, const PackSystem& pack, const PackAccuracy& accuracy,
             double limit, double terms = 0);
  /// The start of a run, or the state after a jump of `event`.
  void at(double t, const Reading& reading, std::optional<std::size_t> event);
  /// A step up to t, `along` through its samples. `end`: there. `breaks`: whether the value may
  /// branch on it. `halved`: it ends nearer to its start than errors ask for, so that a value may
  /// hardly have changed.
  void along(double t, const StepSamples& samples, const pieces::StepPolynomial& along,
             const Reading& end, bool breaks, bool halved);
  /// Whether a step up to t on which the value branches says too little of it.
  bool is_blurred(double t, const StepSamples& samples, const pieces::StepPolynomial& along,
                  const Reading& end) const;
  /// Compares what is known at the end alone: `shrinks`, and the scores of all kinds.
  void finish();
  /// What a run made otherwise came to; values with the sign that they are compared with.
  struct Course {
    bool sampled = true, violated = false;
    double peak = 0;  ///< the largest value
    double first = 0, first_error = 0, last = 0, last_error = 0;
    double floor = 0;
  };
  void finish(const Course& course);
  /// With what values are compared, with their sign.
  double limit() const { return limit_; }

  bool open() const { return open_ && !always_; }
  /// Where it is not open.
  claims::Finding finding() const;

 private:
  /// A value with the sign that it is compared with, and its estimated error.
  struct Known {
    double value = 0;
    double error = 0;
  };
  /// The value of a reading and its error. A jump begins a new history of differences.
  Known known(const Reading& reading, bool jumped);
  /// At one point. `same`: bit for bit as at the point before. `crowded`: the point may be so near
  /// to the one before that a rise within a part of its error counts for nothing.
  void compare(Known value, double terms, bool same, bool crowded);
  void compare_within(const StepSamples& samples, const pieces::StepPolynomial& along, Known end,
                      double terms, bool breaks);
  /// Leaves the claim open where both runs have parted: their difference says no more of the error.
  void check_parting(double value, double difference, double terms);
  /// How near a value comes to what it must not exceed (claims::Finding::score), by their roots
  /// where they are squares.
  double score_of(double value) const;
  /// What a bound is compared by, and what a tolerance forgives of it.
  double scale() const { return limit_ == 0 ? 1 : std::abs(limit_); }
  double forgiven(double terms) const {
    const bool of_terms = limit_ == 0 && claim_->kind != model::ClaimKind::cost;
    return tolerance_ * (of_terms ? terms : std::abs(limit_));
  }

  const PackClaim* claim_ = nullptr;
  double accuracy_ = 0, noise_ = 0;
  double factor_ = 0;  ///< PackSystem::error_factor
  double tolerance_ = 0;
  double sign_ = 1;  ///< -1: of `above`, which is `below` of what is negated
  double limit_ = 0;
  double limit_error_ = 0;
  std::array<double, 3> differences_{};
  double least_ = 0, most_ = 0, size_ = 0;  ///< of the values so far
  bool seen_ = false;
  Known first_, last_, low_, high_;
  bool always_ = false;  ///< PackClaim::always
  bool sampled_ = false, open_ = false, violated_ = false;
  double score_ = -std::numeric_limits<double>::infinity();
  double possible_score_ = -std::numeric_limits<double>::infinity();  ///< amid branches
  double floor_ = 0;
};

}  // namespace gainsmith::packs
