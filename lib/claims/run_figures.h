// Figures of a run (model/figure.h), on its dense output.
//
//   peak, least       sup v, inf v over the run
//   settles           the last time at which v >= level
//   rms, integral     sqrt(int v^2 dt/(b - a)), int v dt over [a, b]
//   nees              v = e' inv(P) e at one moment
//   nis               its mean over the jumps of an event that are not lost
//   count, passes, lost   numbers of jumps
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "claims/run_values.h"
#include "model/figure.h"

namespace gainsmith::claims {

/// The numbers e'*inv(P)*e of a run, of `nees` and `nis`.
struct Squares {
  std::uint64_t count = 0;     ///< that are finite and not negative
  double sum = 0;              ///< of these
  std::uint64_t improper = 0;  ///< the others: no covariance gives them

  void add(double square);
};

/// The number of a figure; infinite where a value never settles. None where the run has none: an
/// event that did not happen so often, a time beyond its end, a value that is no number. `ended` is
/// no number. `passes`: the element of the variable that counts them, of a figure that needs it.
class FigureOf {
 public:
  /// `value` and `numbers` as the figure has them, without calls.
  FigureOf(const model::FigureKind kind, std::optional<RunValue> value, std::vector<double> numbers,
           std::size_t event, std::int64_t count, bool after, std::optional<Eigen::Index> passes);

  std::optional<double> operator()(const hybrid::Trajectory& run);
  /// The end of the part of the last run that its number depends on.
  double until() const { return until_; }
  /// The variables that its number is the value at, in the last run; empty: not at one moment.
  const Eigen::VectorXd& moment() const { return moment_; }
  /// What the difference of two runs does not show of the last run: where a value comes within its
  /// errors of the level below which it settles, and what series of exact flows leave of an integral.
  double own_error(const hybrid::Trajectory& run);
  std::optional<RunValue>& value() { return value_; }
  /// Of the last run; only of figures `nees` and `nis` they have a meaning.
  const Squares& squares() const { return squares_; }

 private:
  std::optional<double> counted(std::optional<double> square);
  std::optional<double> at_event(const hybrid::Trajectory& run);
  std::optional<double> at_time(const hybrid::Trajectory& run);
  /// The largest v for sign 1, the least for -1; not a number where v has no value somewhere.
  double extreme(const hybrid::Trajectory& run, double sign);
  double extreme(const hybrid::DenseStep& step, double sign, double most);
  /// 0 where v is below the level from the start on; infinite where it is not below at the end.
  double settled(const hybrid::Trajectory& run, double level);
  double last_above(const hybrid::DenseStep& step, double level);
  template <class Rate>
  std::optional<double> integral(const hybrid::Trajectory& run, const Rate& rate);
  /// None without such a jump.
  std::optional<double> mean_before(const hybrid::Trajectory& run);
  double number_of(const hybrid::Trajectory& run) const;

  model::FigureKind kind_;
  std::optional<RunValue> value_;
  std::vector<double> numbers_;
  std::size_t event_;
  std::int64_t count_;
  bool after_;
  std::optional<Eigen::Index> passes_;
  Squares squares_;
  double size_ = 0;  ///< of an integral: that of the absolute values
  double until_ = 0;
  Eigen::VectorXd moment_;
};

}  // namespace gainsmith::claims
