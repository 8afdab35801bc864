// Pictures of linear systems over the values of a scalar.
#pragma once

#include "gainsmith/system_figures.h"

namespace gainsmith::app {

/// The picture over the figure's scan: margins over the scalar, a locus of poles, or the curves of a
/// few values. For each value the gains are designed anew; "plant.k" leaves them as they are.
/// InputError where no value has a system.
void add_scan(const model::SystemFigure& figure, const LoadedGains& loaded, SystemResult& result);

}  // namespace gainsmith::app
