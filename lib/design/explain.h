// Why a problem has no solution: what conflicts, how much would have to give, how far one must go.
// And of one that has a solution: what keeps it from being better.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/limits.h"
#include "design/search_request.h"
#include "model/gains.h"
#include "model/instance.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// A set of inequalities that cannot hold together, found by deletion: one after the other, from
/// the last to the first, is left out, for good when a certificate still excludes the rest. So
/// leaving out any one of `names` leaves a set that is feasible or, for those in `undecided`, not
/// decided.
struct Conflict {
  std::vector<std::string> names;  ///< in the order of the method
  std::vector<std::string> undecided;
  model::CertificateRecord certificate;  ///< of these requirements, checked
  /// All requirements hold together without the bounds on the gains: these are the conflict.
  bool gain_bound = false;
  /// Whether they do is not decided: all of them are in `names` and in `undecided`, and the
  /// certificate may need the bounds.
  bool within_gain_bound = false;
};

/// How much a requirement would have to give, as the identity times `scale` times these numbers.
struct Relaxation {
  std::string name;
  double scale = 0;                ///< of the inequality (elastic.h)
  std::optional<double> alone;     ///< when all others hold; none: it alone does not help
  bool alone_undecided = false;    ///< or whether it does is not decided
  bool alone_at_most = false;      ///< this is enough, and less may be
  std::optional<double> together;  ///< in the solution with the smallest sum
  bool together_at_most = false;   ///< these sums are enough, and less may be
};

/// How far one must go along a scalar from the problem's value; where that has gains, how far one
/// may go.
struct Reach {
  std::string name;
  double value = 0;  ///< the problem's
  /// `feasible` is then the largest feasible value of that side of the range; otherwise the
  /// smallest.
  bool at_most = true;  ///< go down to `feasible`; otherwise up
  /// The nearest value found, with every margin recomputed; none when nothing in the range is.
  std::optional<double> feasible;
  std::optional<double> beyond;                         ///< next to it, excluded
  std::optional<model::CertificateRecord> certificate;  ///< there
  std::optional<double> open = {};  ///< next to it where none is excluded, undecided
  double end = 0;                   ///< of the range, in this direction
  /// What cannot hold together a little further, at `conflict_at`.
  std::optional<Conflict> conflict = {};
  double conflict_at = 0;
};

/// What explain() found; parts that do not apply, or that a stop left out, are empty.
struct Explanation {
  model::Gains gains;  ///< the problem's own result
  std::optional<Conflict> conflict;
  std::vector<Relaxation> relaxations;  ///< one a requirement, in the order of the method
  std::vector<Reach> reaches;           ///< of `negotiable`, and of what the problem searches
  std::optional<Limits> limits;         ///< of a minimum
  std::vector<HeldScalar> held;         ///< at which all of this is said; synth searches them
  bool finished = true;                 ///< not stopped (base/stop.h)
};

/// The conflict of a problem whose result is `gains`; none unless that is a no. After a stop what
/// was not checked is undecided.
std::optional<Conflict> find_conflict(const model::Instance& instance, const model::Gains& gains,
                                      const sdp::Options& solver);

/// The same in little time: what may be left out is taken from the solver in double, and only the
/// set that this leads to is decided, each within `seconds` of work (base/stop.h). Where they are
/// not enough, or that set is not excluded, `names` are more than it takes; those of which nothing
/// is known are `undecided`.
std::optional<Conflict> guess_conflict(const model::Instance& instance, const model::Gains& gains,
                                       const sdp::Options& solver, double seconds);

/// Along every negotiable scalar, the others held: the nearest feasible value below the problem's
/// own, and above it, as far as the range goes: the directions that have one, or one entry for a
/// scalar that does not help. After a stop those that are found.
std::vector<Reach> find_reaches(const model::Instance& instance, const sdp::Options& solver);

/// The same where the problem's own values have gains: the largest and the smallest feasible value
/// of every negotiable scalar, and the extreme one that the problem searches, each with what
/// excludes more.
std::vector<Reach> find_room(const model::Instance& instance, const sdp::Options& solver);

/// All of it, or what was found before a stop. With the verdict no: the conflict, relaxations and
/// reaches; with yes: limits and room. Where only the bound on gains excludes them, its smallest
/// value that does not is one of the reaches.
Explanation explain(const model::Instance& instance, const sdp::Options& solver);

}  // namespace gainsmith::design
