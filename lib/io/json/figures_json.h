// Figures over runs as JSON: `simulate --compare --json`, and a part of campaigns.
#pragma once

#include "io/json/json_reader.h"
#include "io/json/json_text.h"
#include "model/figure_record.h"

namespace gainsmith::io {

/// An infinite value is the text "inf" or "-inf"; what has no value is null.
Json to_json(const model::FiguresRecord& record);

/// InputError with the place when a key is missing or a value is of the wrong kind.
model::FiguresRecord figures_of(const JsonReader& reader);

}  // namespace gainsmith::io
