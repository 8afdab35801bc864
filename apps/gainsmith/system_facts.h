// What one reads from the responses of linear systems: margins, peaks, what a step does, modes.
#pragma once

#include "gainsmith/system_figures.h"
#include "gainsmith/system_picture.h"

namespace gainsmith::app {

/// null for what is not finite.
io::Json number_json(double value);
/// Row by row.
io::Json rows_json(const response::Matrix& matrix);

/// Adds the lines and the curves of a system to the result.
void add_facts(const DrawnSystem& drawn, model::SystemPicture kind, SystemResult& result);

}  // namespace gainsmith::app
