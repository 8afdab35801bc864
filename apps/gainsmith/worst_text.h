// The report of `verify --worst` as text and JSON.
#pragma once

#include <string>

#include "io/json/json_text.h"
#include "model/instance.h"
#include "verify/worst.h"

namespace gainsmith::app {

/// For each claim the worst value and the run that has it, with the command that repeats this run;
/// `gains_file` is named in it, with its --set options.
std::string worst_summary(const verify::WorstReport& report, const model::Design& design,
                          const std::string& gains_file);

io::Json worst_json(const verify::WorstReport& report, const model::Design& design);

}  // namespace gainsmith::app
