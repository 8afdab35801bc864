#include "drawing/marks.h"

#include <fmt/format.h>

#include "drawing/drawing.h"

namespace gainsmith::drawing {

std::string marks(const std::vector<double>& times, const Axis& time, const Box& box) {
  constexpr double apart = 3, height = 5;
  std::string lines;
  double last = box.left - apart;
  for (const double t : times) {
    if (!time.shows(t)) continue;
    const double share = time.share(t);
    const double x = box.left + share * box.width;
    if (share < 0 || share > 1 || x - last < apart) continue;
    lines += "M" + pixels(x) + "," + pixels(box.bottom()) + "v" + pixels(-height);
    last = x;
  }
  if (lines.empty()) return "";
  return fmt::format("<path fill=\"none\" stroke=\"#606060\" d=\"{}\"/>\n", lines);
}

}  // namespace gainsmith::drawing
