#include "forall/midpoints.h"

#include <iterator>
#include <set>
#include <string>

namespace gainsmith::forall {

namespace {

/// The values on the axis, in order, of the points with the values of `element`.
std::set<double> line_of(const Imposed& imposed, const Point& element, const std::string& axis) {
  std::set<double> line;
  for (const Point& point : imposed.points)
    if (has_values_of(point, element)) line.insert(point.values.at(axis)(0, 0));
  return line;
}

}  // namespace

std::vector<Point> midpoints(const Imposed& imposed, const Domain& domain) {
  constexpr double kWide = 0.5;
  const auto axes = intervals(domain);
  if (axes.size() != 1) return {};
  std::vector<Point> found;
  for (const Point& element : combinations(domain, model::Over::set)) {
    const std::set<double> line = line_of(imposed, element, axes.front()->name);
    if (line.size() < 2) continue;
    const double width = *line.rbegin() - *line.begin();
    const double least = kWide * width / static_cast<double>(line.size() - 1);
    for (auto low = line.begin(), high = std::next(low); high != line.end(); ++low, ++high)
      if (*high - *low > least)
        found.push_back(extended(element, axes.front()->name, *low + (*high - *low) / 2));
  }
  return found;
}

}  // namespace gainsmith::forall
