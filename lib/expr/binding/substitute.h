// Programs with other programs in the place of parts of them. Products are kept short: what is
// beside its inverse in a product, inv(P)*P*L, is left out.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expr/program/rewrite.h"

namespace gainsmith::expr {

/// What replaces names: inputs by programs of the same shape, functions by bodies. Names in the
/// replacements are not replaced again.
/// By name. What is not in them stays.
struct Replacements {
  std::map<std::string, Program> inputs;
  std::map<std::string, Body> functions;
};

/// The program with its inputs and calls replaced; calls of other functions stay calls.
Program substitute(const Program& program, const Replacements& replacements);

/// The program that reads an input of the given name where it computes the same as one of the
/// programs; the largest such parts are replaced. No program calls functions.
Program with_inputs(const Program& program,
                    const std::vector<std::pair<std::string, Program>>& parts);

/// The program for the input `part` at which `program` has the value of the input `value`: part =
/// inv(P)*... turned around. std::nullopt where `part` occurs in it more than once or not at all,
/// and where an operation around it cannot be undone: sums, multiples and products with square
/// factors can. `part` may be a function that is called with `variable` itself.
std::optional<Program> isolated(const Program& program, const std::string& part,
                                const std::string& variable, const std::string& value);

}  // namespace gainsmith::expr
