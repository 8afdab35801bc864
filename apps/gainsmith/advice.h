// What to ask next where there is no yes.
#pragma once

#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::app {

/// Command lines that can be pasted: an explanation, unless a hidden mode explains a no, and the longest
/// interval with gains for each interval that ends at a scalar of the problem, by a search of the
/// scalars that were searched too. None for a yes.
/// `file`: the problem as it was named on the command line; its --set options are carried over.
std::vector<std::string> next_commands(const model::Instance& instance, const model::Gains& gains,
                                       const std::string& file);

/// The same as lines of a summary.
std::string advice(const model::Instance& instance, const model::Gains& gains,
                   const std::string& file);

/// "held        delta = 0.03, eta = 0.0001; ...": the scalars that synth would search and that a
/// command keeps at their values, without those that it varies. Empty when there are none.
std::string held_line(const model::Instance& instance, const std::vector<std::string>& varied = {});

/// "plant       the output does not show a mode ...": the mode that makes the plant undetectable.
/// Empty when there is none.
std::string hidden_line(const model::Instance& instance);

}  // namespace gainsmith::app
