#include "search/minimize.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/parallel.h"
#include "base/stop.h"

namespace gainsmith::search {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A cell of the grid or a start: its middle in the unit box, and what was found there.
struct Trial {
  Point unit;
  std::optional<double> value{};
  bool tried = false;  ///< false when a stop came first
};

class Search {
 public:
  Search(const Figure& figure, const std::vector<Axis>& axes, const LocalSearch& local,
         const MinimizeOptions& options)
      : figure_(figure), axes_(axes), local_(local), options_(options) {}

  Minimum run() {
    try {
      search();
      found_.finished = true;
    } catch (const Stopped&) {
      found_.finished = false;
    }
    return found_;
  }

 private:
  /// The grid, a feasible point where it has none, then local searches from up to three starts,
  /// each with an equal share of the evaluations that are left.
  void search() {
    std::vector<Trial> trials = spread();
    if (found_.feasible == 0 && options_.violation && may_go_on()) approach(trials);
    std::stable_sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
      return a.value.value_or(kInfinity) < b.value.value_or(kInfinity);
    });
    set_penalty(trials);
    const std::vector<Point> starts = separate(trials);
    for (std::size_t i = 0; i < starts.size() && may_go_on(); ++i)
      descend(starts[i], static_cast<int>(starts.size() - i));
  }

  /// Cells along each axis, so that the grid takes about a third of the evaluations.
  int cells() const {
    const double third = std::max(1.0, options_.evaluations / 3.0);
    return std::max(
        1, static_cast<int>(std::pow(third, 1.0 / static_cast<double>(axes_.size())) + 1e-9));
  }

  /// From fractions of the axes to values.
  Point point(const Point& unit) const {
    Point result(axes_.size());
    for (std::size_t i = 0; i < axes_.size(); ++i) result[i] = axes_[i].at(unit[i]);
    return result;
  }

  bool may_go_on() const { return found_.evaluations < options_.evaluations; }

  /// The starts and the middles of the cells, on several threads.
  std::vector<Trial> spread() {
    std::vector<Trial> trials;
    for (const Point& start : options_.starts) {
      Point unit(axes_.size());
      for (std::size_t i = 0; i < axes_.size(); ++i) unit[i] = axes_[i].fraction(start[i]);
      trials.push_back({std::move(unit)});
    }
    const int count = cells();
    std::vector<double> middles;
    middles.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) middles.push_back((i + 0.5) / count);
    for (Point& unit : grid(std::vector<std::vector<double>>(axes_.size(), middles)))
      trials.push_back({std::move(unit)});
    if (std::ssize(trials) > options_.evaluations)
      trials.resize(static_cast<std::size_t>(options_.evaluations));
    const auto record_all = [&] {
      for (const Trial& trial : trials)
        if (trial.tried) record(trial.unit, trial.value);
    };
    try {
      parallel_for(trials.size(), options_.threads, [&](std::size_t i) {
        trials[i].value = figure_(point(trials[i].unit));
        trials[i].tried = true;
      });
    } catch (const Stopped&) {
      record_all();
      throw;
    }
    record_all();
    return trials;
  }

  void record(const Point& unit, std::optional<double> value) {
    ++found_.evaluations;
    if (!value) return;
    ++found_.feasible;
    if (found_.point && !(*value < found_.value)) return;
    found_.point = point(unit);
    found_.value = *value;
  }

  /// From the least violated trial towards a feasible point, which is added to the trials.
  void approach(std::vector<Trial>& trials) {
    std::vector<double> violations(trials.size());
    parallel_for(trials.size(), options_.threads,
                 [&](std::size_t i) { violations[i] = options_.violation(point(trials[i].unit)); });
    const auto least = std::min_element(violations.begin(), violations.end());
    if (least == violations.end() || !std::isfinite(*least)) return;
    Trial& start = trials[static_cast<std::size_t>(least - violations.begin())];
    const double limit =
        *std::max_element(violations.begin(), violations.end(), [](double a, double b) {
          return (std::isfinite(a) ? a : -1) < (std::isfinite(b) ? b : -1);
        });
    std::optional<Trial> feasible;
    const auto function = [&](const Point& unit) {
      const auto value = figure_(point(unit));
      record(unit, value);
      if (value) {
        feasible = Trial{unit, value, true};
        return -1.0;
      }
      const double violation = options_.violation(point(unit));
      return std::isfinite(violation) ? violation : 2 * limit;
    };
    LocalSearchOptions local = local_options(1);
    local.target = -0.5;
    local_(function, start.unit, local, [&] { return !feasible && may_go_on(); });
    if (feasible) trials.push_back(*feasible);
  }

  LocalSearchOptions local_options(int share) const {
    LocalSearchOptions local;
    local.step = 0.5 / cells();
    local.tolerance = options_.tolerance;
    local.evaluations = std::max(1, (options_.evaluations - found_.evaluations) / share);
    return local;
  }

  /// What an infeasible point counts as: clearly more than any value of the grid.
  void set_penalty(const std::vector<Trial>& trials) {
    double low = kInfinity;
    double high = -kInfinity;
    for (const Trial& trial : trials) {
      if (!trial.value) continue;
      low = std::min(low, *trial.value);
      high = std::max(high, *trial.value);
    }
    if (low <= high) penalty_ = high + (high - low) + std::max(std::abs(high), 1e-300);
  }

  /// The best feasible trials, each beyond the cells that a search from a better one covers.
  std::vector<Point> separate(const std::vector<Trial>& sorted) const {
    constexpr std::ptrdiff_t kMost = 3;
    const double reach = 1.5 / cells();
    const auto near = [&](const Point& a, const Point& b) {
      for (std::size_t i = 0; i < a.size(); ++i)
        if (std::abs(a[i] - b[i]) > reach) return false;
      return true;
    };
    std::vector<Point> starts;
    for (const Trial& trial : sorted) {
      if (!trial.value || std::ssize(starts) == kMost) break;
      if (std::none_of(starts.begin(), starts.end(),
                       [&](const Point& start) { return near(start, trial.unit); }))
        starts.push_back(trial.unit);
    }
    return starts;
  }

  /// One local search in the unit box, an infeasible point counting as `penalty_`.
  void descend(const Point& start, int share) {
    const auto function = [&](const Point& unit) {
      const auto value =
          options_.warm ? options_.warm(point(unit), found_.value) : figure_(point(unit));
      record(unit, value);
      return value.value_or(penalty_);
    };
    local_(function, start, local_options(share), [&] { return may_go_on(); });
  }

  const Figure& figure_;
  const std::vector<Axis>& axes_;
  const LocalSearch& local_;
  const MinimizeOptions& options_;
  double penalty_ = 1;
  Minimum found_;
};

}  // namespace

Minimum minimize(const Figure& figure, const std::vector<Axis>& axes, const LocalSearch& local,
                 const MinimizeOptions& options) {
  return Search(figure, axes, local, options).run();
}

}  // namespace gainsmith::search
