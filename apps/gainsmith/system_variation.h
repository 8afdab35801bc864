// Pictures of linear systems over many values of their data: a scan of a scalar, for each of whose
// values the gains are designed anew, and draws of the plant's uncertain data at the same gains.
#pragma once

#include <utility>

#include "gainsmith/system_figures.h"
#include "model/stated.h"

namespace gainsmith::app {

/// The picture over the figure's scan: margins over the scalar, a locus of poles, or the curves of a
/// few values. InputError where no value has a system.
void add_scan(const model::SystemFigure& figure, const LoadedGains& loaded, SystemResult& result);

/// Adds to a picture over this range where its curves, or poles, lie in draws of the plant's
/// uncertain data. Draw k is that of run k of the campaign.
void add_bands(const model::SystemFigure& figure, const model::Design& design,
               const model::Stated& stated, std::pair<double, double> range, SystemResult& result);

}  // namespace gainsmith::app
