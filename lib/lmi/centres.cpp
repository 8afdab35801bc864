#include "lmi/centres.h"

#include <algorithm>
#include <map>
#include <string>

namespace gainsmith::lmi {

std::vector<double> multiplier_sizes(const Lmi& lmi, const Formulation& formulation,
                                     const sdp::Solution& solution, const std::string& requirement,
                                     std::size_t points) {
  std::vector<double> sizes(points, 0.0);
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const Block& block = lmi.blocks[k];
    if (block.name != requirement && !block.name.starts_with(requirement + ".")) continue;
    const std::size_t n = formulation.releases.kept[k].size();
    for (std::size_t i = 0; i < n; ++i) sizes.at(block.at) += solution.Y.values[k][i * n + i];
  }
  return sizes;
}

std::vector<Point> centres(const Imposed& imposed, const Domain& domain,
                           const std::vector<double>& sizes) {
  constexpr double kSmall = 1e-3;  // of the largest: not in contact
  const auto axes = intervals(domain);
  if (axes.size() != 1 || sizes.size() != imposed.points.size()) return {};
  const std::string& axis = axes.front()->name;
  const double least = kSmall * *std::max_element(sizes.begin(), sizes.end());
  // Points in the order of the interval, those of other elements of the sets apart.
  std::map<std::string, std::map<double, double>> lines;
  std::map<std::string, Point> elements;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    Point element;
    for (const Point& candidate : combinations(domain, model::Forall::Over::set)) {
      const bool same =
          std::all_of(candidate.values.begin(), candidate.values.end(), [&](const auto& value) {
            return imposed.points[k].values.at(value.first) == value.second;
          });
      if (same) element = candidate;
    }
    lines[element.label][imposed.points[k].values.at(axis)(0, 0)] = sizes[k];
    elements[element.label] = element;
  }
  std::vector<Point> found;
  for (const auto& [label, line] : lines) {
    double weight = 0;
    double moment = 0;
    int count = 0;
    const auto close_run = [&] {
      if (count > 1) found.push_back(extended(elements.at(label), axis, moment / weight));
      weight = moment = 0;
      count = 0;
    };
    for (const auto& [at, size] : line) {
      if (!(size > least)) {
        close_run();
        continue;
      }
      weight += size;
      moment += size * at;
      ++count;
    }
    close_run();
  }
  return found;
}

}  // namespace gainsmith::lmi
