// Whether the jumps of a run accumulate.
//
//   Zeno         Each length is r < 1 times that of a period of 1 to 3 flows before. This r is the
//                same over 12 of them, or over at least 4 that shrink by 1e-7 together. What is
//                left, the sum of the last period * r/(1 - r), is below 1e-7 of the time so far,
//                and no state changed by more than 3e-3 of its largest size over the last period.
//                While a state counts, what is left is to be below 1e-8.
//   chattering   a hundred flows in a row below 1e-9 of the horizon, without such an r; the clock
//                of an event ends the row
//
// With lengths T_k -> r T_k over a period, what is left is the geometric sum T r/(1 - r), T the sum
// of the last period. Such a solution is Zeno: infinitely many jumps in finite time (Goebel,
// Sanfelice & Teel 2012). The bouncing ball has r = its restitution.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "hybrid/system.h"
#include "hybrid/tolerances.h"

namespace gainsmith::hybrid {

class ZenoDetector {
 public:
  /// The system must outlive it.
  ZenoDetector(const System& system, double horizon);

  /// A flow of positive length has ended at t with this event, at these values; `largest`: how large
  /// they were along it, at most.
  void push(double t, double length, std::size_t event, const Eigen::VectorXd& values,
            const Eigen::VectorXd& largest);

  /// The time at which jumps accumulate, when lengths shrink by a steady factor.
  std::optional<double> accumulation() const;
  /// Whether little may be left after a period of flows whose last one is so long: a steady factor
  /// is no smaller than the last ratio by more than kSteady.
  static bool is_near(double period, double length, double length_before, double t) {
    const double next = length - kSteady * length_before;  // r times the one before
    return (next < length_before) & (period * next <= kLeftOver * t * (length_before - next));
  }
  /// As if nothing had been pushed.
  void start_over();

  static constexpr std::size_t kLongestPeriod = 3;
  static constexpr std::size_t kKept = kRatios + kLongestPeriod;  ///< so many flows count
  bool chatters() const { return short_flows_ >= kInARow; }
  /// The length of the last flow, as a part of the longest one.
  double shrinkage() const { return count_ == 0 ? 1 : before(0).length / longest_; }
  /// The events of the last flows, each once, in order.
  std::vector<std::size_t> events() const;

 private:
  struct Flow {
    double length = 0;
    std::size_t event = 0;  ///< that ended it
    Eigen::VectorXd state;  ///< there
  };
  /// T r/(1 - r), when the last `ratios` ratios of lengths one period apart agree; otherwise none.
  std::optional<double> steady_rest(std::size_t period, std::size_t ratios) const;
  /// Whether no state has changed by more than kSteady of its largest size over the last period.
  bool settles(std::size_t period) const;
  /// So many flows before the last, below `count_`.
  const Flow& before(std::size_t count) const {
    return flows_[(next_ + kKept - 1 - count) % kKept];
  }
  /// The sum of the last lengths.
  double last(std::size_t period) const;

  const System* system_;
  std::vector<Eigen::Index> rows_;  ///< of states and modes
  double horizon_;
  double t_ = 0;
  double longest_ = 0;
  std::size_t short_flows_ = 0;    ///< in a row
  std::array<Flow, kKept> flows_;  ///< the last ones
  std::size_t count_ = 0;          ///< of them
  std::size_t next_ = 0;           ///< where the next one goes
  Eigen::VectorXd sizes_;          ///< the largest of each state so far
};

}  // namespace gainsmith::hybrid
