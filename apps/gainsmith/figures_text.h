// Figures over runs as text and records.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "model/figure_record.h"
#include "statistics/figure_survey.h"

namespace gainsmith::app {

/// With the quantiles 5, 50 and 95 %. `asked`: how many runs were to be made. `confidence`: of their
/// intervals; none where nothing is drawn. `fit`: the probability with which a consistent filter
/// passes; none likewise.
model::FiguresRecord figures_record(const statistics::FigureSurvey& survey, std::uint64_t asked,
                                    std::uint64_t seed, std::optional<double> confidence,
                                    std::optional<double> fit);

/// Of `verify`: a table with quantiles and their intervals, and the fit of covariances.
std::string figures_text(const model::FiguresRecord& record);

/// Of `simulate --compare`: figures of observers side by side, of a run; of several runs a line for
/// each figure and observer, with its least, median and largest value, and the fit of covariances.
std::string comparison_text(const model::FiguresRecord& record);

/// "ekf: peak norm(e)".
std::string title_of(const model::FigureRecord& figure);

}  // namespace gainsmith::app
