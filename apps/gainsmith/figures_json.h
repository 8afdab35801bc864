// Figures over runs as JSON: every number is read back to the same bits.
#pragma once

#include "io/json/json_reader.h"
#include "io/json/json_text.h"
#include "statistics/figure_survey.h"

namespace gainsmith::app {

io::Json ranges_json(const statistics::RunSet& runs);
statistics::RunSet ranges_from(const io::JsonReader& reader);

io::Json to_json(const statistics::SurveyOfRuns& figures);
statistics::SurveyOfRuns survey_from(const io::JsonReader& reader);

}  // namespace gainsmith::app
