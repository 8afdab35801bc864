// Values of all lanes: row k is the kLanes numbers of value k, and those that the texts have there.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "packs/pack_system.h"

namespace gainsmith::packs {

/// Some lanes, of which rows are copied.
class LaneMask {
 public:
  explicit LaneMask(std::uint32_t lanes) {
    for (std::size_t l = 0; l < lanes::kLanes; ++l) in_[l] = lanes >> l & 1U ? ~0ULL : 0;
  }
  /// Copies the lanes of the mask by bits, so that what is no number in the others does not matter.
  void copy(const double* from, double* to) const {
    for (std::size_t l = 0; l < lanes::kLanes; ++l)
      to[l] = std::bit_cast<double>((std::bit_cast<std::uint64_t>(from[l]) & in_[l]) |
                                    (std::bit_cast<std::uint64_t>(to[l]) & ~in_[l]));
  }

 private:
  std::array<std::uint64_t, lanes::kLanes> in_{};
};

/// rows x kLanes numbers, row after row: a row is one value of all lanes.
class LaneValues {
 public:
  explicit LaneValues(std::size_t rows = 0) : rows_(rows), data_(rows * lanes::kLanes, 0) {}

  double* row(std::size_t k) { return data_.data() + k * lanes::kLanes; }
  const double* row(std::size_t k) const { return data_.data() + k * lanes::kLanes; }
  double& at(std::size_t k, std::size_t lane) { return row(k)[lane]; }
  double at(std::size_t k, std::size_t lane) const { return row(k)[lane]; }
  std::size_t rows() const { return rows_; }
  void copy(const LaneValues& from, const LaneMask& mask) {
    for (std::size_t k = 0; k < rows_; ++k) mask.copy(from.row(k), row(k));
  }

 private:
  std::size_t rows_;
  std::vector<double> data_;
};

/// -1, 0 or 1; 0 of what is not a number.
inline std::int8_t sign_of(double x) {
  return static_cast<std::int8_t>(x > 0 ? 1 : x < 0 ? -1 : 0);
}

/// The results of PackSystem::point, by PointResult.
struct LanePoint {
  std::array<LaneValues, PackSystem::extras + 1> of;
  std::uint32_t faults = 0;

  double at(PackSystem::PointResult result, std::size_t k, std::size_t lane) const {
    return of[result].at(k, lane);
  }
  void copy(const LanePoint& from, const LaneMask& mask) {
    for (std::size_t r = 0; r < of.size(); ++r) of[r].copy(from.of[r], mask);
  }
};

}  // namespace gainsmith::packs
