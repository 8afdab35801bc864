// The optimisation libraries, which a static program cannot hold.
#pragma once

#include <optional>
#include <string>

#include "design/search_request.h"
#include "search/optimizers.h"

namespace gainsmith::app {

/// The libraries when they are linked into this program; null otherwise.
const search::Optimizers* linked_optimizers();

/// A command met a search that needs the libraries, and they are not linked into this program.
/// Thrown before anything is written; main hands the command line to gainsmith-full.
struct OptimizersNeeded {
  /// What was read from standard input, to be read again.
  std::optional<std::string> standard_input;
};

/// linked_optimizers() for a request; null when the request needs none. OptimizersNeeded when it
/// needs them and they are not there.
const search::Optimizers* optimizers_for(const design::SearchRequest& request,
                                         const model::Design& design);

/// Replaces this program by gainsmith-full, which stands beside it, with the same arguments.
/// InputError when that program cannot be started.
[[noreturn]] void continue_with_optimizers(char** arguments, const OptimizersNeeded& need);

}  // namespace gainsmith::app
