// The attempts of a synthesis, in their order.
//
//   attempt           asks                                     is made after
//   on equations      a point, the minimum or a no on the      -  (where equations are stated)
//                     face that equations leave
//                     (facial_reduction.h)
//   minimum           the objective, within the gain bounds    -  (where it can have a minimum, and
//                                                              without equations)
//   free inside       the largest margin, gains of any size    -  (where it cannot), or nothing
//                                                              that holds: bounds depend on units
//   inside            the largest margin, within the bounds    nothing that holds within them
//   large minimum     the minimum, unknowns of any size        a point inside, where only unknowns
//                                                              of ordinary size were excluded
//   blended           a point between minimum and inside       both, the minimum found but not
//                                                              holding
//   free minimum      the objective, gains of any size         nothing that holds within the bounds
//   31 digits         the largest margin in these digits       nothing that holds, nothing refuted
//   facial reduction  a point or a no on the face that all     the same, without equations
//                     solutions share (facial_reduction.h)
//   tighter           bounds ten times smaller                 a yes with gains near their bounds:
//                                                              those that shrink are limited by
//                                                              them alone
//
// (An exchange grows by the points at which a solution fails, and begins again. After some rounds a
// point near the minimum ends it.) Each attempt is made once at most and its record stays; what
// they mean together is conclude(). A no comes from an attempt without bounds.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "design/attempt.h"
#include "model/gains.h"

namespace gainsmith::design {

enum class AttemptKind {
  minimum,
  free_inside,
  inside,
  large_minimum,
  blended,
  free_minimum,
  on_equations,
  in_31_digits,
  facial_reduction,
  tighter
};

/// The attempts so far.
class Attempts {
 public:
  /// `bounds` are those of the problem.
  Attempts(const Posed& posed, lmi::GainBounds bounds, Solve solve);

  /// The attempts up to the first point, or the refutation.
  void to_point();
  /// Where that is a minimum that fails between its points: a point inside, `inside` where it is
  /// known, and one near the minimum (near_minimum()).
  void to_near_minimum(std::optional<Attempt> inside);
  /// All the others that are due.
  void to_end();

  bool has_begun() const { return !tried_.empty(); }
  /// The attempt that was made last, in words: the one that a stop ended.
  const std::string& doing() const { return doing_; }
  /// nullptr: not tried.
  const Attempt* find(AttemptKind kind) const;
  /// The point inside that to_near_minimum() used.
  const std::optional<Attempt>& inside() const { return inside_; }
  /// The attempt whose point counts: the first that is a yes, otherwise the first that holds, or
  /// has one; nullptr without one.
  const Attempt* point() const;
  /// The attempt that refutes the inequalities; nullptr without one.
  const Attempt* refutation() const;
  /// The last attempt without gain bounds, or with them when there is no other.
  const Attempt& last() const;
  /// Whether the point was found without the bounds of the problem.
  bool is_free(const Attempt& attempt) const;
  /// Whether the attempt is a yes, with gains within the bound of the problem.
  bool is_yes(const Attempt& attempt) const;

  const Posed& posed() const { return posed_; }
  const lmi::GainBounds& bounds() const { return bounds_; }
  double seconds() const { return seconds_; }
  /// Whether what is left would have taken more than the allowance: 20 times the work of the solver
  /// in double, but at least two and at most sixty seconds, and never less than twice that work.
  /// With full effort there is no limit.
  bool is_out_of_allowance() const { return out_of_allowance_; }

 private:
  friend struct AttemptRules;

  /// Makes the attempts that are due, in their order; without `to_end` until a point or a
  /// refutation.
  void make_due(bool to_end);
  /// One attempt, within the allowance.
  template <class Tries>
  void make(AttemptKind kind, const char* doing, const Tries& tries);
  /// Seconds of work for all attempts together (base/stop.h).
  double allowance() const;

  /// The inequalities and the plan that it refers to outlive this object.
  const Posed posed_;
  lmi::GainBounds bounds_;
  Solve solve_;
  std::map<AttemptKind, Attempt> tried_;
  std::optional<Attempt> inside_;  ///< holds
  std::set<AttemptKind> done_;     ///< those that came to nothing included
  std::string doing_;
  double seconds_ = 0;  ///< measured time of all attempts
  double spent_ = 0;    ///< work, in the seconds of an allowance
  bool out_of_allowance_ = false;
};

/// The certificate that excludes every solution with this objective or less; none where none is
/// found.
using ExcludesObjective = std::function<std::optional<model::CertificateRecord>(double value)>;

/// The verdict of the attempts, with the point or the certificate, its margins, bounds and
/// messages. A yes is a check of the decimals that are written, a no a certificate that was checked
/// on the decimals of the file; never the solver's own word. `excludes` is asked where weak duality
/// shows no lower bound near the minimum.
void conclude(const Attempts& attempts, const ExcludesObjective& excludes, model::Gains& gains);

}  // namespace gainsmith::design
