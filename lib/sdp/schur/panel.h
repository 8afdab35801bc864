// Eight symmetric matrices side by side, for inner products with one sparse matrix at vector speed:
// F_j . U_i for the eight U_i of a batch, F_j read once (schur.h).
#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "sdp/schur/pairs.h"

namespace gainsmith::sdp {

/// Entry e of lane i is value(e, i); lanes lie next to each other.
template <typename T>
class Panel {
 public:
  using Sums = std::array<T, kLanes>;

  void resize(std::size_t entries) { values_.resize(entries * kLanes); }
  void set(std::size_t entry, std::size_t lane, const T& value) {
    values_[entry * kLanes + lane] = value;
  }
  /// sums[i] = sum_k factor[k] value(entry[k], i), in chains that do not wait for each other.
  Sums inner(const int* entry, const T* factor, std::size_t count) const {
    constexpr std::size_t kChains = std::is_same_v<T, double> ? 4 : 1;
    std::array<Sums, kChains> chains{};
    std::size_t k = 0;
    for (; k + kChains <= count; k += kChains)
      for (std::size_t c = 0; c < kChains; ++c) add(entry[k + c], factor[k + c], chains[c]);
    for (; k < count; ++k) add(entry[k], factor[k], chains[0]);
    for (std::size_t c = 1; c < kChains; ++c)
      for (std::size_t i = 0; i < kLanes; ++i) chains[0][i] += chains[c][i];
    return chains[0];
  }

 private:
  void add(int entry, const T& factor, Sums& sums) const {
    const T* at = values_.data() + static_cast<std::size_t>(entry) * kLanes;
    for (std::size_t i = 0; i < kLanes; ++i) sums[i] += at[i] * factor;
  }

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
  Sums inner(const int* entry, const DoubleDouble* factor, std::size_t count) const {
    Sums sums;
    for (std::size_t k = 0; k < count; ++k) {
      const double* at = values_.data() + static_cast<std::size_t>(entry[k]) * kLanes * 2;
      sums.add(at, at + kLanes, factor[k].hi(), factor[k].lo());
    }
    return sums;
  }

 private:
  std::vector<double> values_;
};

}  // namespace gainsmith::sdp
