// What the names of a problem stand for, as far as its formulas look different for it.
#pragma once

#include <map>
#include <set>
#include <string>

#include "model/problem.h"

namespace gainsmith::page {

struct Notation {
  using Names = std::set<std::string, std::less<>>;

  Names functions;  ///< f(x) stands for a value: not for an element of a matrix
  Names families;   ///< P(i) is a member: the index stands below the line
  Names scalars;    ///< numbers, functions and members that are numbers too
  /// Estimates by what they estimate, "xh" or "x_hat" of an observer by "x": shown with a hat.
  std::map<std::string, std::string, std::less<>> estimates;
};

Notation notation_of(const model::Problem& problem);

/// Whether the value of an expression is a number for certain.
bool is_scalar(const expr::Node& node, const Notation& notation);

}  // namespace gainsmith::page
