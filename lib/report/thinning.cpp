#include "report/thinning.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace gainsmith::report {

namespace {

struct Vertex {
  Point at;
  bool starts = false;  ///< a line
};

int column_of(const Vertex& vertex) { return vertex.at.x / 10; }

void append_extremes(std::span<const Vertex> points, std::vector<Polyline>& lines) {
  if (points.empty()) return;
  const auto [least, greatest] =
      std::minmax_element(points.begin(), points.end(),
                          [](const Vertex& a, const Vertex& b) { return a.at.y < b.at.y; });
  std::array<std::ptrdiff_t, 4> kept = {0, least - points.begin(), greatest - points.begin(),
                                        std::ssize(points) - 1};
  std::sort(kept.begin(), kept.end());
  if (points.front().starts || lines.empty()) lines.emplace_back();
  std::ptrdiff_t last = -1;
  for (const std::ptrdiff_t k : kept)
    if (k != last) {
      lines.back().push_back(points[static_cast<std::size_t>(k)].at);
      last = k;
    }
}

/// The box around points, from its upper left to its lower right corner.
struct Extremes {
  Point low;
  Point high;

  void join(const Extremes& other) {
    low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
    high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
  }
};

/// What is left of whole lines within one column.
void append_joined(std::span<const Vertex> points, std::vector<Polyline>& lines) {
  constexpr int near = 20;
  constexpr std::size_t most = 4;
  std::vector<Extremes> boxes;
  for (const Vertex& vertex : points)
    if (vertex.starts)
      boxes.push_back({vertex.at, vertex.at});
    else
      boxes.back().join({vertex.at, vertex.at});
  std::sort(boxes.begin(), boxes.end(), [](const Extremes& a, const Extremes& b) {
    return std::pair(a.low.y, a.low.x) < std::pair(b.low.y, b.low.x);
  });
  std::vector<Extremes> apart;
  for (const Extremes& box : boxes)
    if (!apart.empty() && box.low.y <= apart.back().high.y + near)
      apart.back().join(box);
    else
      apart.push_back(box);
  for (; apart.size() > most; apart.pop_back()) apart[apart.size() - 2].join(apart.back());
  for (const Extremes& box : apart) lines.push_back({box.low, box.high});
}

/// The points of one column.
void append_column(std::span<const Vertex> points, std::vector<Polyline>& lines) {
  const auto starts = [](const Vertex& vertex) { return vertex.starts; };
  const auto second = std::find_if(points.begin() + 1, points.end(), starts);
  if (second == points.end()) {
    append_extremes(points, lines);
    return;
  }
  const auto last = std::find_if(points.rbegin(), points.rend(), starts).base() - 1;
  append_extremes({points.begin(), second}, lines);
  append_joined({second, last}, lines);
  append_extremes({last, points.end()}, lines);
}

/// The slopes of the lines from one point that pass those behind it within a tenth.
struct Cone {
  bool upright = false;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  /// Does the line to a point that is dx, dy away pass all before it? If so, it is one of them.
  bool takes(int dx, int dy) {
    if (dx == 0) return upright = true;
    const double slope = static_cast<double>(dy) / dx;
    if (upright || slope < low || slope > high) return false;
    low = std::max(low, static_cast<double>(dy - 1) / dx);
    high = std::min(high, static_cast<double>(dy + 1) / dx);
    return true;
  }
};

int sign(int number) { return (number > 0) - (number < 0); }

}  // namespace

std::vector<Polyline> thinned(const std::vector<Polyline>& lines) {
  std::vector<Vertex> all;
  for (const Polyline& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) all.push_back({line[k], k == 0});
  std::vector<Polyline> kept;
  for (auto begin = all.begin(); begin != all.end();) {
    const int column = column_of(*begin);
    const auto end =
        std::find_if(begin, all.end(), [&](const Vertex& v) { return column_of(v) != column; });
    append_column({begin, end}, kept);
    begin = end;
  }
  return kept;
}

Polyline straightened(const Polyline& line) {
  if (line.empty()) return {};
  Polyline kept = {line.front()};
  Point previous = line.front();
  Cone cone;
  int direction = 0;
  for (const Point& point : line) {
    if (point == previous) continue;
    const int turn = sign(point.y - previous.y);
    const bool begins = previous == kept.back();
    if (begins || turn * direction < 0 ||
        !cone.takes(point.x - kept.back().x, point.y - kept.back().y)) {
      if (!begins) kept.push_back(previous);
      cone = {};
      cone.takes(point.x - kept.back().x, point.y - kept.back().y);
      direction = 0;
    }
    if (turn != 0) direction = turn;
    previous = point;
  }
  if (previous != kept.back()) kept.push_back(previous);
  return kept;
}

}  // namespace gainsmith::report
