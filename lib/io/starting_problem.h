// A problem to begin with, for one who has a method and data of his own.
#pragma once

#include <string>

#include "model/method.h"

namespace gainsmith::io {

/// A problem of the method with the values of `example`, another problem of it as text: what the
/// method says of each datum and parameter is above it as a comment, and those that have
/// defaults and no value are comments. All other keys are copied, but for what the example expects.
/// `own`: the text of the method, which is then in the problem to be changed; empty: it is
/// named. InputError for an example that is no problem file.
std::string starting_problem(const model::Method& method, const std::string& example,
                             const std::string& own = {});

}  // namespace gainsmith::io
