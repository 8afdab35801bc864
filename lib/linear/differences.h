// Differences of states as states of their own: the coordinates of an observer's error.
//
//   d = a - b takes the place of b;   a text of b reads a - d
//
// A claim of z - zh that is computed from z and zh drowns in their rounding when they are large.
// Texts are formed as polynomials (polynomial.h), so that equal terms cancel exactly.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "hybrid/state_layout.h"
#include "linear/polynomial.h"

namespace gainsmith::linear {

struct StateDifference {
  std::string name;   ///< "z - zh"
  std::string plus;   ///< a
  std::string minus;  ///< b
  expr::Shape shape;
};

/// The differences of states of one shape that occur in the functions, none of which uses what
/// another one replaces.
std::vector<StateDifference> find_differences(const std::vector<expr::Program>& functions,
                                              const hybrid::StateLayout& layout);

/// Programs over the states of a layout, over differences in place of some of them.
class ErrorRewriting {
 public:
  ErrorRewriting(const std::vector<StateDifference>& differences,
                 const hybrid::StateLayout& layout);

  bool replaces(const std::string& state) const { return by_.contains(state); }
  /// As a polynomial, when that uses less of what moves.
  expr::Program operator()(const expr::Program& program);

 private:
  expr::Program simplified(const expr::Program& program);

  std::map<std::string, expr::Program> by_;  ///< a - d, by b
  std::set<std::string> names_;              ///< of what moves
  Polynomials polynomials_;
};

}  // namespace gainsmith::linear
