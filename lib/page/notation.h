// What the names of a problem represent, as far as its formulas are shown differently for it.
#pragma once

#include <map>
#include <set>
#include <string>

#include "model/problem.h"

namespace gainsmith::page {

struct Notation {
  using Names = std::set<std::string, std::less<>>;

  Names functions;  ///< f(x) is a value: not an element of a matrix
  Names families;   ///< P(i) is a member: the index is a subscript
  Names scalars;    ///< numbers, functions and members that are numbers too
  /// Estimates by what they estimate, "xh" or "x_hat" of an observer by "x": shown with a hat.
  std::map<std::string, std::string, std::less<>> estimates;
};

/// Of a problem with its method, which must be there.
Notation notation_of(const model::Problem& problem);

/// Whether the value of an expression is a number for certain.
bool is_scalar(const expr::Node& node, const Notation& notation);

}  // namespace gainsmith::page
