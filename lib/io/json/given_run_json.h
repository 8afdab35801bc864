// A run whose draws are given, as JSON:
//
//   {"start": {"z": [1, 2]}, "first": {"sample": 0.3}, "lengths": {"sample": [1.1, 0.5]},
//    "lost": {"sample": [false, true]}, "noise": {"w": [0.1, -0.1]}}
//
// All keys are optional. A column is a list of numbers, any other matrix a list of rows. Lists are
// used in turn, again from their start.
#pragma once

#include <string>

#include "hybrid/given_run.h"
#include "io/json/json_text.h"
#include "model/dynamics.h"

namespace gainsmith::io {

/// Without what is not given.
Json to_json(const hybrid::GivenRun& run, const model::Dynamics& dynamics);

/// `file`: what errors call the text. InputError with the place for what is no such run, and for
/// names that the dynamics do not have.
hybrid::GivenRun parse_given_run(const std::string& text, const std::string& file,
                                 const model::Dynamics& dynamics);

}  // namespace gainsmith::io
