// The inequalities at gains that are given: those of a gain file, whoever wrote them.
//
// A gain is a number there, and the unknown that its formula was made of follows from it: with
// L = inv(P)*Y and L given, Y is P*L in every inequality. What remains unknown, P, only has to
// exist.
//
//   1  with the unknowns of the file: every inequality at their decimals and those of the gains
//   2  where that does not show all of them: solved anew for what remains unknown
//
// So an inequality is shown at the decimals of the gains, and a no excludes every P for them.
#pragma once

#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"
#include "sdp/solver.h"

namespace gainsmith::design {

struct FixedGains {
  /// Without gains and objective: gains are data, and the unknowns that follow from them are none.
  model::Instance instance;
  std::vector<std::string> edited;  ///< gains that are not what their formulas give at the unknowns
  /// Edited gains whose formulas cannot be turned around, "K: inv(Q)*Y*R'": nothing is shown of
  /// them.
  std::vector<std::string> stuck;
  bool solvable =
      true;  ///< false: a gain is a formula over the unknowns, so these are given as well
};

/// `gains`: of a file that states `instance`. InputError as bind::state.
FixedGains fix_gains(const model::Instance& instance, const model::Gains& gains);

/// The verdict about given gains, with what it rests on.
struct GainCheck {
  model::Verdict verdict = model::Verdict::undecided;
  bool own_unknowns = false;           ///< a yes that the unknowns of the file show
  std::vector<std::string> edited;     ///< as FixedGains
  std::vector<std::string> not_shown;  ///< inequalities that the unknowns of the file do not show
  std::vector<model::Margin> margins;  ///< of what the verdict rests on
  std::string message;                 ///< why it is undecided, or what a no rests on
};

/// Whether every inequality holds at the gains: yes shown, no by a checked certificate or, where
/// nothing remains unknown, at a point; otherwise undecided.
GainCheck check_gains(const model::Instance& instance, const model::Gains& gains,
                      const sdp::Options& options);

}  // namespace gainsmith::design
