#include "gainsmith/level_curves.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace gainsmith::app {

namespace {

constexpr int kCells = 160;  // in each direction

class Grid {
 public:
  Grid(const std::function<double(double, double)>& f, const Window& window) : window_(window) {
    for (int j = 0; j <= kCells; ++j)
      for (int i = 0; i <= kCells; ++i) values_[place(i, j)] = f(at(i, j).x, at(i, j).y);
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) add_cell(i, j, f);
  }

  LevelCurves curves() {
    LevelCurves result;
    result.inside = !neighbours_.empty();
    // Curves with ends first; what is left is closed.
    for (const bool closed : {false, true})
      for (const auto& [edge, near] : neighbours_) {
        if (near.empty() || (!closed && near.size() == 2)) continue;
        result.curves.push_back(followed(edge));
        if (!closed) result.inside = false;
      }
    return result;
  }

 private:
  /// Of a grid point and a direction: the edge to the next point across (0) or up (1).
  using Edge = std::pair<std::size_t, int>;

  static std::size_t place(int i, int j) {
    return static_cast<std::size_t>(j) * (kCells + 1) + static_cast<std::size_t>(i);
  }

  PlanePoint at(double i, double j) const {
    return {window_.low.x + (window_.high.x - window_.low.x) * i / kCells,
            window_.low.y + (window_.high.y - window_.low.y) * j / kCells};
  }

  void add_cell(int i, int j, const std::function<double(double, double)>& f) {
    const std::array<double, 4> corner = {values_[place(i, j)], values_[place(i + 1, j)],
                                          values_[place(i + 1, j + 1)], values_[place(i, j + 1)]};
    // The edge from each corner to the next, around the cell.
    const std::array<Edge, 4> edges = {Edge{place(i, j), 0}, Edge{place(i + 1, j), 1},
                                       Edge{place(i, j + 1), 0}, Edge{place(i, j), 1}};
    std::vector<Edge> crossed;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!std::isfinite(corner[k])) return;
      if ((corner[k] > 0) != (corner[(k + 1) % 4] > 0)) crossed.push_back(edges[k]);
    }
    if (crossed.size() == 4) {
      const PlanePoint middle = at(i + 0.5, j + 0.5);
      // The corner 0 is joined with the middle, or cut off by the first and the last edge.
      if ((f(middle.x, middle.y) > 0) != (corner[0] > 0)) std::swap(crossed[1], crossed[3]);
    }
    for (std::size_t k = 0; k + 1 < crossed.size(); k += 2) {
      neighbours_[crossed[k]].push_back(crossed[k + 1]);
      neighbours_[crossed[k + 1]].push_back(crossed[k]);
    }
  }

  PlanePoint point(const Edge& edge) const {
    const auto i = static_cast<double>(edge.first % (kCells + 1));
    const auto j = static_cast<double>(edge.first / (kCells + 1));
    const double here = values_[edge.first];
    const double there = values_[edge.first + (edge.second == 0 ? 1 : kCells + 1)];
    const double share = here / (here - there);
    return edge.second == 0 ? at(i + share, j) : at(i, j + share);
  }

  /// The curve from an edge on, taken out of the neighbours.
  std::vector<PlanePoint> followed(Edge edge) {
    std::vector<PlanePoint> curve = {point(edge)};
    while (!neighbours_[edge].empty()) {
      const Edge next = neighbours_[edge].back();
      neighbours_[edge].pop_back();
      std::erase(neighbours_[next], edge);
      curve.push_back(point(next));
      edge = next;
    }
    return curve;
  }

  const Window window_;
  std::array<double, (kCells + 1) * (kCells + 1)> values_{};
  std::map<Edge, std::vector<Edge>> neighbours_;
};

}  // namespace

LevelCurves zero_curves(const std::function<double(double, double)>& f, const Window& window) {
  return Grid(f, window).curves();
}

}  // namespace gainsmith::app
