// Fewer points for the same picture, by two rules.
//
// Over time: of each column of pixels the first, lowest, highest and last point. A line through
// them covers the same pixels as one through all (M4; Jugel, Jerzak, Hackenbroich, Markl 2014).
// In any direction: the line between two kept points is within the tolerance of all points between
// them; the farthest one is kept otherwise, and both parts are treated alike (Douglas, Peucker
// 1973).
#include "drawing/thinning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <utility>

namespace gainsmith::drawing {

namespace {

/// A point of all lines together; a line begins at those that start one.
struct Vertex {
  Point at;
  bool starts = false;  ///< a line
};

int column_of(const Vertex& vertex) { return vertex.at.x / 10; }

/// Adds the first, lowest, highest and last of some points, in their order.
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
  // Tenths of a pixel: boxes nearer than this above each other become one.
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

/// Without those within a distance of the one before, in tenths; the last stays.
Polyline spaced(const Polyline& line, double distance) {
  Polyline kept = {line.front()};
  for (const Point& point : line)
    if (std::hypot(point.x - kept.back().x, point.y - kept.back().y) >= distance)
      kept.push_back(point);
  if (kept.back() != line.back()) kept.push_back(line.back());
  return kept;
}

/// Of a point from the stretch between two others.
double distance_from(const Point& point, const Point& from, const Point& to) {
  const double dx = to.x - from.x, dy = to.y - from.y, x = point.x - from.x, y = point.y - from.y;
  const double square = dx * dx + dy * dy;
  const double share = square > 0 ? std::clamp((x * dx + y * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(x - share * dx, y - share * dy);
}

/// Marks the points between two others that these do not show.
void keep_far(const Polyline& points, std::size_t begin, std::size_t end, double tolerance,
              std::vector<char>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{begin, end}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double greatest = tolerance;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double away = distance_from(points[k], points[first], points[last]);
      if (away > greatest) {
        greatest = away;
        farthest = k;
      }
    }
    if (farthest == first) continue;
    kept[farthest] = 1;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
}

/// The steps of a line that are the first from one cell of this width to another, with up to three
/// points in each cell.
std::vector<Polyline> new_ways(const Polyline& line, int cell) {
  constexpr int most_within = 3;
  std::set<std::array<int, 4>> seen;
  std::vector<Polyline> parts;
  bool open = false;
  int within = 0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Point &from = line[k - 1], &to = line[k];
    const std::array<int, 4> step = {from.x / cell, from.y / cell, to.x / cell, to.y / cell};
    if (step[0] == step[2] && step[1] == step[3]) {
      if (open && ++within > most_within) parts.back().pop_back();
      if (open) parts.back().push_back(to);
      continue;
    }
    within = 0;
    if (!seen.insert(step).second) {
      open = false;
      continue;
    }
    if (!open) parts.push_back({from});
    open = true;
    parts.back().push_back(to);
  }
  return parts;
}

constexpr double kFine = 1;  // tenths of a pixel

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

Polyline coarser(const Polyline& line, double tolerance) {
  if (line.empty()) return {};
  constexpr std::size_t piece = 1000;  // the time grows with its square
  std::vector<char> kept(line.size(), 0);
  kept.front() = 1;
  for (std::size_t begin = 0; begin + 1 < line.size(); begin += piece) {
    const std::size_t end = std::min(begin + piece, line.size() - 1);
    kept[end] = 1;
    keep_far(line, begin, end, tolerance, kept);
  }
  Polyline left;
  for (std::size_t k = 0; k < line.size(); ++k)
    if (kept[k] != 0) left.push_back(line[k]);
  if (left.size() == 2 && left.front() == left.back()) left.pop_back();
  return left;
}

std::vector<Polyline> simplified(const Polyline& line) {
  // Points of a line in a plane: up to `many` it is kept, and of others at most `most` are left.
  constexpr std::size_t many = 20000, most = 50000;
  if (line.empty()) return {};
  const Polyline fine = coarser(spaced(line, 2), kFine);
  if (fine.size() <= many) return {fine};
  const Polyline points = spaced(line, 10);
  std::vector<Polyline> parts;
  std::size_t count = most + 1;
  for (int cell = 20; count > most; cell *= 2) {
    parts = new_ways(points, cell);
    count = 0;
    for (const Polyline& part : parts) count += part.size();
  }
  for (Polyline& part : parts) part = coarser(part, kFine);
  return parts;
}

}  // namespace gainsmith::drawing
