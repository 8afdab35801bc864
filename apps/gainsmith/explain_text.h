// Explanations as text and JSON.
#pragma once

#include <string>

#include "design/explain.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

/// What conflicts, the table of relaxations, how far to go.
std::string explanation_text(const design::Explanation& explanation);

/// One line: "flow and jump cannot hold together; T2 at most 0.76831 would do".
std::string explanation_line(const design::Conflict& conflict,
                             const std::vector<design::Reach>& reaches);

io::Json explanation_json(const design::Explanation& explanation);

}  // namespace gainsmith::app
