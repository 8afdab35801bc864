// Samples to places on the picture. A part of a line ends at a gap, and at a jump that is seen.
#include "drawing/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace gainsmith::drawing {

namespace {

/// Verticals that hold the jumps of each column of pixels.
std::vector<JumpTrace> joined(const std::vector<JumpTrace>& jumps) {
  std::vector<JumpTrace> verticals;
  for (const JumpTrace& jump : jumps) {
    if (verticals.empty() || verticals.back().before.x / 10 != jump.before.x / 10) {
      verticals.push_back(jump);
      continue;
    }
    JumpTrace& vertical = verticals.back();
    const auto [least, greatest] =
        std::minmax({vertical.before.y, vertical.after.y, jump.before.y, jump.after.y});
    vertical.before.y = least;
    vertical.after = {vertical.before.x, greatest};
  }
  return verticals;
}

/// The parts of a curve as they are, sample by sample.
class Parts {
 public:
  void add(std::optional<Point> point, bool behind_jump) {
    const bool joins = point && last_;
    if (joins && behind_jump && *point != *last_) jumps.push_back({*last_, *point});
    if (point && (!joins || (behind_jump && *point != *last_))) lines.emplace_back();
    if (point) lines.back().push_back(*point);
    last_ = point;
  }

  std::vector<Polyline> lines;
  std::vector<JumpTrace> jumps;

 private:
  std::optional<Point> last_;
};

/// The parts of a curve in tenths of a pixel. Samples that an axis cannot show leave gaps.
Parts parts_of(const Curve& curve, const Axis& time, const Axis& values, const Box& box) {
  const auto place = [&](std::size_t k) -> std::optional<Point> {
    if (!time.shows(curve.t[k]) || !values.shows(curve.value[k])) return std::nullopt;
    const double x = box.left + time.share(curve.t[k]) * box.width;
    const double y = box.bottom() - values.share(curve.value[k]) * box.height;
    return Point{static_cast<int>(std::lround(10 * x)), static_cast<int>(std::lround(10 * y))};
  };
  Parts parts;
  auto jump = curve.jumps.begin();
  for (std::size_t k = 0; k < curve.t.size(); ++k) {
    while (jump != curve.jumps.end() && *jump + 1 < k) ++jump;
    parts.add(place(k), jump != curve.jumps.end() && *jump + 1 == k);
  }
  return parts;
}

/// A line, or a dot where it has one point alone.
void add(const Polyline& line, Trace& trace) {
  if (line.size() > 1)
    trace.flows.push_back(line);
  else
    trace.dots.push_back(line.front());
}

}  // namespace

Trace trace(const Curve& curve, const Axis& time, const Axis& values, const Box& box) {
  Parts parts = parts_of(curve, time, values, box);
  Trace drawn;
  for (const Polyline& part : thinned(parts.lines)) add(coarser(part), drawn);
  drawn.jumps = curve.jumps.size() > single_jumps ? joined(parts.jumps) : std::move(parts.jumps);
  return drawn;
}

Trace trace_in_plane(const Curve& curve, const Axis& across, const Axis& values, const Box& box) {
  // More jumps in a plane cover everything else.
  constexpr std::size_t most_jumps = 2000;
  const Parts parts = parts_of(curve, across, values, box);
  Trace drawn;
  for (const Polyline& line : parts.lines)
    for (const Polyline& part : simplified(line)) add(part, drawn);
  // Whole pixels of both ends: equal jumps of a periodic run are drawn once.
  std::set<std::array<int, 4>> seen;
  for (const JumpTrace& jump : parts.jumps) {
    const auto& [before, after] = jump;
    if (seen.insert({before.x / 10, before.y / 10, after.x / 10, after.y / 10}).second)
      drawn.jumps.push_back(jump);
  }
  if (drawn.jumps.size() > most_jumps) drawn.jumps.clear();
  return drawn;
}

}  // namespace gainsmith::drawing
