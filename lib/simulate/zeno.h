// Internal to hybrid: whether the jumps of a run accumulate.
//
//   Zeno         over the last flows each length is r times that of a period of 1 to 3 flows
//                before, over 12 of them or at least 4 that make a millionth,
//                r < 1, and what is left, sum of the last period * r/(1 - r), is below 1e-7 of the
//                time so far, and over the last period no state changed by more than 1e-4 of its
//                largest size: the jumps accumulate there. While a state counts, what is left is
//                to be below 1e-8. Before a run chatters r may be that of the last hundred flows,
//                the same over both halves of them, and what is left 1e-5 of the time
//   chattering   a hundred flows in a row below 1e-10 of the horizon, or ten thousand below 1e-6,
//                without such an r; the clock of an event ends the row
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gainsmith::simulate {

class ZenoDetector {
 public:
  explicit ZenoDetector(double horizon) : horizon_(horizon) {}

  /// A flow of positive length has ended at t with this event, at these values of states and modes;
  /// `largest`: how large they were along it, at most.
  void push(double t, double length, std::size_t event, bool has_clock,
            const Eigen::VectorXd& states, const Eigen::VectorXd& largest);

  /// The time at which jumps accumulate, when lengths shrink by a steady factor.
  std::optional<double> accumulation() const;
  bool chatters() const { return shortest_flows_ >= 100 || short_flows_ >= 10000; }
  /// The length of the last flow, as a part of the longest one.
  double shrinkage() const { return lengths_.empty() ? 1 : lengths_.back() / longest_; }
  /// The events of the last flows, each once, in order.
  std::vector<std::size_t> events() const;

 private:
  std::optional<double> steady_rest(std::size_t period, std::size_t ratios) const;
  std::optional<double> slow_rest() const;
  bool settles(std::size_t period) const;

  double horizon_;
  double t_ = 0;
  double longest_ = 0;
  int short_flows_ = 0, shortest_flows_ = 0;  ///< in a row
  std::vector<double> lengths_;
  std::vector<std::size_t> events_;
  std::vector<Eigen::VectorXd> states_;
  Eigen::VectorXd sizes_;  ///< the largest of each state so far
};

}  // namespace gainsmith::simulate
