// The attempts of a synthesis, in their order.
//
//   rung          asks                                 is tried after
//   own           the problem's own goal               -
//   margin        a certificate at the margin that     a search for the largest margin that found
//                 was asked for                        none, or one too small: its own certificate
//                                                      may rest on the limits on x
//   free          the same without bounds on gains     an infeasible one with bounds, which are not
//                                                      to decide
//   (more points: an exchange grows by the points at which the solution fails, and begins again)
//   backed off    more than the margin                 a point short of it by what the solver's
//                                                      tolerance explains
//   tighter       bounds ten times smaller             a yes with gains near their bounds: those
//                                                      that shrink are limited by them alone
//
// Each rung is tried once at most and its record stays; what they mean together is conclude().
#pragma once

#include <map>

#include "design/attempt.h"
#include "model/gains.h"

namespace gainsmith::design {

enum class Rung { own, margin, free, backed_off, tighter };

/// The attempts so far.
class Climb {
 public:
  /// `bounds` are those of the problem.
  Climb(const Posed& posed, lmi::GainBounds bounds, Solve solve);

  /// The rungs up to a point or a certificate.
  void to_answer();
  /// The rungs that improve on a point.
  void from_point();

  /// nullptr: not tried.
  const Attempt* find(Rung rung) const;
  const Attempt& own() const { return tried_.at(Rung::own); }
  /// The attempt whose point counts; nullptr without one.
  const Attempt* point() const;
  /// The attempt whose certificate counts; nullptr without one. With `within_bounds` it needs the
  /// bounds on the gains.
  const Attempt* certificate(bool& within_bounds) const;

  const Posed& posed() const { return posed_; }
  double seconds() const { return seconds_; }

 private:
  friend struct Rungs;

  void climb(bool from_point);

  const Posed posed_;
  lmi::GainBounds bounds_;
  Solve solve_;
  std::map<Rung, Attempt> tried_;
  double seconds_ = 0;
};

/// The verdict of the attempts, with the point or the certificate, its margins, bounds and
/// messages. Verdicts come from margins as recomputed and from certificates as checked, never from
/// the solver's word alone.
void conclude(const Climb& climb, model::Gains& gains);

}  // namespace gainsmith::design
