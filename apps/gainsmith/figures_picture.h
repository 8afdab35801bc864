// Figures over runs as a picture.
#pragma once

#include <string>

#include "drawing/figure.h"
#include "statistics/figure_survey.h"

namespace gainsmith::app {

/// Histograms: a panel for each figure, with an outline for each observer; of observers whose
/// values spread far less or more than those of others panels of their own. Infinite values
/// are not drawn; the legend says how many runs have no finite one.
drawing::Figure histograms(const std::string& title, const statistics::FigureSurvey& survey);

}  // namespace gainsmith::app
