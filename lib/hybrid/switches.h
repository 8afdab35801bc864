// Internal to hybrid: `where` and `sign` in the text of a flow, whose branches are held between
// borders.
//
//   where(D, A, B)  becomes  where(H, A, B),   H = 1 where D > 0 (D >= 0), -1 elsewhere
//   sign(D)         becomes  H,                H = sign(D)
//
// H is an input that a run sets; the roots of D are borders. What is inside a jacobian stays.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "expr/program.h"

namespace gainsmith::hybrid {

struct Switch {
  expr::Program difference;  ///< D; may use the H of switches before it
  bool is_sign = false;
  bool strict = true;  ///< of where: D > 0, otherwise D >= 0
  std::string input;   ///< the name of H, of the shape of D
  Place place;
};

/// The program with inputs for the branches that depend on what `moves`; new switches are appended,
/// those with an equal D serve again.
expr::Program hold_branches(const expr::Program& program,
                            const std::function<bool(const std::string&)>& moves,
                            std::vector<Switch>& switches);

}  // namespace gainsmith::hybrid
