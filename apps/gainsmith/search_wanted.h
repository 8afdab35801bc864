// What a problem wants searched, with figures of runs: design and verify meet here alone.
#pragma once

#include "design/search_request.h"
#include "model/problem.h"

namespace gainsmith::app {

/// design::request_of, and the measure where the problem minimises a figure of runs. What the
/// measure refers to is held by `instance`'s design, which must outlive the request.
design::SearchRequest wanted_search(const model::Instance& instance);

/// States ranges of the command line in the gain file, as `--set search=...` does: `certify` asks
/// the statement in which range a value may lie.
void state_search(const model::Search& search, model::Problem& problem);

/// Sets the error of what a search found, where it is a figure of runs.
void find_error(const model::Instance& instance, model::Gains& gains);

}  // namespace gainsmith::app
