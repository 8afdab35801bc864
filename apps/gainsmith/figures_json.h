// Figures over runs as JSON: every number is read back to the same bits.
#pragma once

#include "io/json_reader.h"
#include "io/json_text.h"
#include "verify/figure_survey.h"

namespace gainsmith::app {

io::Json ranges_json(const verify::RunSet& runs);
verify::RunSet ranges_from(const io::JsonReader& reader);

io::Json to_json(const verify::SurveyOfRuns& figures);
verify::SurveyOfRuns survey_from(const io::JsonReader& reader);

}  // namespace gainsmith::app
