// Internal to the judge (judge.h): what was found, and sizes of rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hybrid/tolerances.h"
#include "judge/judge.h"

namespace gainsmith::judge {

/// Keeps the worst fault of a kind in each part.
class Faults {
 public:
  void add(std::size_t part, double t, const std::string& what, double size = 0,
           double allowed = 0) {
    const Fault fault{part, t, what, size, allowed};
    const auto [place, is_new] = worst_.try_emplace({part, what}, fault);
    if (!is_new && excess(fault) > excess(place->second)) place->second = fault;
  }
  /// A fault when size > allowed, or is no number.
  void check(std::size_t part, double t, const std::string& what, double size, double allowed) {
    if (!(size <= allowed)) add(part, t, what, size, allowed);
  }
  std::vector<Fault> list() const {
    std::vector<Fault> result;
    for (const auto& [key, fault] : worst_) result.push_back(fault);
    return result;
  }

 private:
  /// How many times too large it is; the size itself where nothing is allowed.
  static double excess(const Fault& fault) {
    return fault.allowed > 0 ? fault.size / fault.allowed : fault.size;
  }

  std::map<std::pair<std::size_t, std::string>, Fault> worst_;
};

/// Of sums of a few times.
/// kTermRounding max(|a|, |b|).
inline double time_rounding(double a, double b) {
  // Below the smallest normal number digits are lost.
  return hybrid::kTermRounding * std::max(std::abs(a), std::abs(b)) +
         std::numeric_limits<double>::min();
}

/// Whether rounding may have made two times of one, such as sums of lengths.
inline bool same_time(double a, double b) {
  return std::abs(a - b) <=
         2 * hybrid::kOneInstant * std::max(std::abs(a), std::abs(b)) + time_rounding(a, b);
}

}  // namespace gainsmith::judge
