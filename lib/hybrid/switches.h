// What has branches in the text of a flow. They are fixed between zero crossings, so that what is
// integrated is smooth.
//
//   where(D, A, B)  becomes  where(H, A, B),   H = 1 where D > 0 (D >= 0), -1 elsewhere
//   sign(D)         becomes  H,                H = sign(D)
//   abs(D)          becomes  D.*H              a kink: H = 1 or -1, the sign that D has or had last
//   max(A, B)       becomes  where(H, A, B),   the same of D = A - B
//   min(A, B)       becomes  where(H, B, A)
//
// H is an input that a run sets; D is an event function. What is inside a jacobian is fixed
// by the same H as outside of it.
//
// A flow with fixed H is smooth, so that the order of an integrator holds on every step. The run
// stops at each root of D, sets H anew and goes on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "expr/program/program.h"

namespace gainsmith::hybrid {

struct Switch {
  enum class Kind { where, sign, kink };

  expr::Program difference;  ///< D; may use the H of switches before it
  Kind kind = Kind::where;
  bool strict = true;  ///< of where: D > 0, otherwise D >= 0
  std::string input;   ///< the name of H, of the shape of D
  Place place;
};

/// The program with inputs for the branches that depend on what `moves`; new switches are appended,
/// those with an equal D serve again.
expr::Program fix_branches(const expr::Program& program,
                           const std::function<bool(const std::string&)>& moves,
                           std::vector<Switch>& switches);

}  // namespace gainsmith::hybrid
