// Linear systems as pictures: curves of their responses in panels.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/system_figure.h"
#include "drawing/figure.h"
#include "response/margins.h"
#include "response/peak.h"
#include "response/sweep.h"
#include "response/time_response.h"

namespace gainsmith::app {

/// A system with what a picture of its kind needs of it.
struct DrawnSystem {
  std::string label;
  response::StateSpace system;
  response::Sweep sweep;                     ///< of pictures over the frequency
  std::optional<response::Margins> margins;  ///< of a single one
  std::optional<response::Peak> peak;
  std::vector<response::TimeResponse> time;  ///< of pictures over time: of each input
  response::Matrix poles, zeros;             ///< of poles
  std::size_t design = 0;                    ///< of several
  std::string own_label{};                   ///< without the name of its design
};

/// "" for a single element, " y1/u2" otherwise.
std::string element_label(const response::StateSpace& system, Eigen::Index i, Eigen::Index j);

/// Without a title.
drawing::Figure system_picture(model::SystemPicture kind, const std::vector<DrawnSystem>& systems);

/// Decibels of a gain; not a number for 0.
double decibels(double gain);

/// Single points, such as a crossing.
drawing::Curve points(drawing::Mark mark, int colour);

}  // namespace gainsmith::app
