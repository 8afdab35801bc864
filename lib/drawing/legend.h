// The head of a panel, above its frame: title and legend.
#pragma once

#include <string>
#include <vector>

#include "drawing/drawing.h"
#include "drawing/figure.h"

namespace gainsmith::drawing {

struct LegendEntry {
  double x = 0;                  ///< from the left end of the head
  double y = 0;                  ///< of the middle of its row, from the top of the head
  std::string label;             ///< shortened to the width where it is longer
  const Curve* curve = nullptr;  ///< none: of a band
  Style style{};
};

struct Legend {
  std::string title;
  std::vector<LegendEntry> entries;
  double height = 0;  ///< of the whole head
};

/// The legend is beside the title, at the right, where it fits into one row, and else in as
/// many rows below as it needs. The entries point into the panel.
Legend legend(const Panel& panel, double width);

/// Its elements, the head's upper left corner at (left, top).
std::string drawn(const Legend& legend, double left, double top);

}  // namespace gainsmith::drawing
