// A text about any member of a family, made one about a certain member.
#pragma once

#include <map>
#include <string>

#include "expr/binding/scope.h"

namespace gainsmith::expr {

/// The expression with numbers for indices and with plain names for the members of families that
/// these numbers choose: for i = 2, "inv(P(i))*Y(i)" becomes "inv(P_2)*Y_2". Its text says so too;
/// the places are those of what was written. InputError when a sum in it has an index of the same
/// name.
Expression instantiate(const Expression& expression, const std::map<std::string, int>& indices,
                       const std::map<std::string, Ranges>& families);

}  // namespace gainsmith::expr
