// Systems of a figure as matrices, with the responses that its picture shows.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gainsmith/load.h"
#include "gainsmith/system_picture.h"
#include "model/stated.h"

namespace gainsmith::app {

/// What a gain file says, with the plant's uncertain data as they are without a tolerance.
model::Stated nominal(const LoadedGains& loaded);

/// All systems of the figure, without responses yet. Nothing where one uses what has no value:
/// `missing` then says which. InputError at the place of a system that is not finite.
std::optional<std::vector<DrawnSystem>> systems_of(const model::SystemFigure& figure,
                                                   const model::Stated& stated,
                                                   std::string& missing);

/// That of the figure, or the hull of those that its systems need; of frequencies or times.
std::pair<double, double> range_of(const model::SystemFigure& figure, const model::Stated& stated,
                                   const std::vector<DrawnSystem>& systems);

/// The responses over the range.
void compute(const model::SystemFigure& figure, std::pair<double, double> range,
             DrawnSystem& drawn);

}  // namespace gainsmith::app
