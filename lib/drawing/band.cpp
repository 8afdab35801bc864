#include "drawing/band.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/drawing.h"

namespace gainsmith::drawing {

namespace {

/// The ends of one shape, from left to right.
struct Ends {
  Polyline low;
  Polyline high;
};

/// The parts of a band between gaps and, where they are few, jumps. Values beyond an end of the
/// axis are moved to it.
std::vector<Ends> ends_of(const Band& band, const Axis& time, const Axis& values, const Box& box) {
  const bool parted = band.jumps.size() <= single_jumps;
  const auto place = [&](std::size_t k, double value) {
    const double x = box.left + time.share(band.t[k]) * box.width;
    const double y = box.bottom() - std::clamp(values.share(value), 0.0, 1.0) * box.height;
    return Point{static_cast<int>(std::lround(10 * x)), static_cast<int>(std::lround(10 * y))};
  };
  std::vector<Ends> all;
  bool open = false;
  auto jump = band.jumps.begin();
  for (std::size_t k = 0; k < band.t.size(); ++k) {
    while (jump != band.jumps.end() && *jump + 1 < k) ++jump;
    if (parted && jump != band.jumps.end() && *jump + 1 == k) open = false;
    if (!time.shows(band.t[k]) || !values.shows(band.low[k]) || !values.shows(band.high[k])) {
      open = false;
      continue;
    }
    if (!open) all.emplace_back();
    open = true;
    all.back().low.push_back(place(k, band.low[k]));
    all.back().high.push_back(place(k, band.high[k]));
  }
  return all;
}

/// With no more points than the picture shows.
Polyline spare(const Polyline& line) { return coarser(thinned({line}).front()); }

}  // namespace

std::string drawn(const Band& band, const Axis& time, const Axis& values, const Box& box) {
  std::string shapes;
  for (const Ends& ends : ends_of(band, time, values, box)) {
    // The upper end from left to right, then the lower one back.
    Polyline around = spare(ends.high);
    const Polyline low = spare(ends.low);
    around.insert(around.end(), low.rbegin(), low.rend());
    if (around.size() > 2) shapes += path(around) + "z";
  }
  if (shapes.empty()) return {};
  return fmt::format("<path {} d=\"{}\"/>\n", shade(band.colour), shapes);
}

}  // namespace gainsmith::drawing
