// Pictures of linear systems over the plant's uncertain data, with the same gains.
#pragma once

#include <utility>

#include "gainsmith/system_figures.h"
#include "model/stated.h"

namespace gainsmith::app {

/// Adds to a picture over this range where its curves, or poles, lie in draws of the plant's
/// uncertain data, and at the corners of their boxes. Draw k is that of run k of the campaign.
void add_bands(const model::SystemFigure& figure, const model::Design& design,
               const model::Stated& stated, std::pair<double, double> range, SystemResult& result);

}  // namespace gainsmith::app
