// Eight symmetric matrices side by side, for inner products with one sparse matrix at vector speed.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "sdp/data.h"

namespace gainsmith::sdp {

constexpr int kLanes = 8;

/// Sums of products with their rounding errors (Ogita, Rump, Oishi 2005, Dot2, extended to factors
/// of two halves): as accurate as if computed in twice the precision and rounded.
struct PairSums {
  std::array<double, kLanes> high{}, low{};

  void add(const double* a_high, const double* a_low, double b_high, double b_low) {
    for (std::size_t r = 0; r < kLanes; ++r) {
      const double p = a_high[r] * b_high;
      double e = std::fma(a_high[r], b_high, -p);
      e = std::fma(a_high[r], b_low, e);
      e = std::fma(a_low[r], b_high, e);
      const double s = high[r] + p;
      const double t = s - high[r];
      low[r] += ((high[r] - (s - t)) + (p - t)) + e;
      high[r] = s;
    }
  }
  DoubleDouble operator[](std::size_t r) const {
    return DoubleDouble(high[r]) + DoubleDouble(low[r]);
  }
};

/// Entry e of lane i is value(e, i); lanes lie next to each other.
template <typename T>
class Panel {
 public:
  using Sums = std::array<T, kLanes>;

  void resize(std::size_t entries) { values_.resize(entries * kLanes); }
  void set(std::size_t entry, std::size_t lane, const T& value) {
    values_[entry * kLanes + lane] = value;
  }
  /// sums[i] += factor value(entry, i)
  void add(std::size_t entry, const T& factor, Sums& sums) const {
    const T* at = values_.data() + entry * kLanes;
    for (std::size_t i = 0; i < kLanes; ++i) sums[i] += at[i] * factor;
  }

 private:
  std::vector<T> values_;
};

/// The high halves of an entry's lanes, then the low ones.
template <>
class Panel<DoubleDouble> {
 public:
  using Sums = PairSums;

  void resize(std::size_t entries) { values_.resize(entries * kLanes * 2); }
  void set(std::size_t entry, std::size_t lane, const DoubleDouble& value) {
    values_[entry * kLanes * 2 + lane] = value.hi();
    values_[entry * kLanes * 2 + kLanes + lane] = value.lo();
  }
  void add(std::size_t entry, const DoubleDouble& factor, Sums& sums) const {
    const double* at = values_.data() + entry * kLanes * 2;
    sums.add(at, at + kLanes, factor.hi(), factor.lo());
  }

 private:
  std::vector<double> values_;
};

}  // namespace gainsmith::sdp
