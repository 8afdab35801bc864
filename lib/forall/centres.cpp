#include "forall/centres.h"

#include <algorithm>
#include <map>
#include <string>

namespace gainsmith::forall {

namespace {

/// Points in the order of the interval, with the sizes of their multipliers.
using Line = std::map<double, double>;

/// The weighted means of the runs of two or more points above `least`.
std::vector<double> means_of_runs(const Line& line, double least) {
  std::vector<double> means;
  double weight = 0;
  double moment = 0;
  int count = 0;
  const auto close_run = [&] {
    if (count > 1) means.push_back(moment / weight);
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
  return means;
}

}  // namespace

std::vector<Point> centres(const Imposed& imposed, const Domain& domain,
                           const std::vector<double>& sizes) {
  constexpr double kSmall = 1e-3;  // of the largest: not in contact
  const auto axes = intervals(domain);
  if (axes.size() != 1 || sizes.empty() || sizes.size() != imposed.points.size()) return {};
  const std::string& axis = axes.front()->name;
  // Points without a multiplier separate the runs.
  const double least = kSmall * *std::max_element(sizes.begin(), sizes.end());
  std::vector<Point> found;
  for (const Point& element : combinations(domain, model::Over::set)) {
    Line line;
    for (std::size_t k = 0; k < sizes.size(); ++k)
      if (has_values_of(imposed.points[k], element))
        line[imposed.points[k].values.at(axis)(0, 0)] = sizes[k];
    for (const double mean : means_of_runs(line, least))
      found.push_back(extended(element, axis, mean));
  }
  return found;
}

}  // namespace gainsmith::forall
