// The draws of a run as a point u of the cube [0, 1]^d, for searches over runs.
//
//   start in a box           low + (high - low) u, an element
//   start in an ellipsoid    c + M b, b = w |w|_max/|w|, w = 2u - 1: the cube onto the ball
//   normal, lognormal start  c + M z, c .* exp(M z), z = kReach (2u - 1)
//   start from a list        its element floor(number u)
//   first time, length       low + (high - low) u, whatever the laws of the campaign
//   loss                     u > 1/2, within `in_a_row`
//   noise, uncertain data    normal, lognormal: as starts; uniform: as lengths; vertices and corners:
//                            that of number floor(number u)
//
// What is drawn again and again repeats with a period, or has coordinates of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <tuple>
#include <vector>

#include "hybrid/scenario.h"

namespace gainsmith::verify {

class DrawCube {
 public:
  /// `period`: after so many draws lists repeat; 0: not before the horizon, or before kLongestList
  /// (tolerances.h). System and scenario must outlive it.
  DrawCube(const hybrid::System& system, const hybrid::Scenario& scenario, std::size_t period);

  /// d; 0: nothing is drawn.
  std::size_t size() const { return names_.size(); }
  /// The draws at u; elements outside [0, 1] are moved to its ends.
  hybrid::GivenRun at(const std::vector<double>& u) const;
  /// The same with numbers of so many digits, within their ranges; all digits in an ellipsoid and
  /// around a center.
  hybrid::GivenRun rounded(const std::vector<double>& u, int digits) const;

  /// Where a search begins: starts away from the middle, which often is an equilibrium.
  std::vector<double> start() const;
  /// The same with these lengths of an event, repeated.
  std::vector<double> with_lengths(std::vector<double> u, std::size_t event,
                                   const std::vector<double>& lengths) const;
  /// The point whose lists repeat those of a point of a cube with a period.
  std::vector<double> unrolled(const DrawCube& other, const std::vector<double>& u) const;

 private:
  enum class Purpose { start, first, length, loss, noise };
  using Name = std::tuple<Purpose, std::size_t, std::size_t, Eigen::Index>;  ///< index, k, element

  /// Where values come from, coordinate by coordinate.
  struct Take {
    std::function<double(const Name&)> u;
    int digits = 0;  ///< 0: all

    /// low + (high - low) u.
    double between(double low, double high, const Name& name) const;
  };

  /// All draws in a fixed order; `take` is asked for each coordinate once, in that order.
  hybrid::GivenRun walk(const Take& take) const;
  /// Around a center, with a name for each element.
  template <class NameOf>
  numbers::Matrix around(const std::vector<numbers::Matrix>& rule, bool is_lognormal,
                         const Take& take, const NameOf& name) const;
  void walk_starts(const Take& take, hybrid::GivenRun& run) const;
  void walk_event(std::size_t event, const Take& take, hybrid::GivenRun& run) const;
  void walk_noise(std::size_t noise, const Take& take, hybrid::GivenRun& run) const;
  std::size_t count(double every) const;
  /// How many lengths or losses an event has: by the mean of its range of lengths.
  std::size_t count_of_event(std::size_t event) const;

  const hybrid::System* system_;
  const hybrid::Scenario* scenario_;
  std::size_t period_;
  std::vector<Name> names_;  ///< of the coordinates
};

}  // namespace gainsmith::verify
