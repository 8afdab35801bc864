// The inequalities of a gain file at its gains as given, for people and as JSON.
#pragma once

#include <string>

#include "design/fixed_gains.h"
#include "gainsmith/load.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

/// check_gains() of what was read.
design::GainCheck check_gains(const LoadedGains& loaded);

/// "GAINS.json: yes: every inequality holds at the gains of the file ...", with a table of margins.
std::string gain_check_text(const std::string& path, const design::GainCheck& check);

io::Json gain_check_json(const std::string& path, const design::GainCheck& check);

/// "flow, jump": the inequalities that are not shown.
std::string not_shown_text(const design::GainCheck& check);

}  // namespace gainsmith::app
