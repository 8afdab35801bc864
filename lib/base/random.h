// Counter-based random numbers: each draw is a pure function of (seed, run, draw), so that any run
// of a campaign replays alone and the number of threads cannot matter.
#pragma once

#include <array>
#include <cstdint>

namespace gainsmith {

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: "Parallel random numbers: as easy as 1, 2, 3",
/// SC'11): four 32-bit words from a 128-bit counter and a 64-bit key.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

/// The stream of one run. Key = seed, counter = (draw, run).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t run) : seed_(seed), run_(run) {}

  /// Uniform in [0, 1), a multiple of 2^-53; draw number `draw` of this run.
  double uniform_at(std::uint64_t draw) const;

  /// The next draw of this run, counting from 0.
  double uniform() { return uniform_at(draw_++); }

  std::uint64_t draws() const { return draw_; }

 private:
  std::uint64_t seed_;
  std::uint64_t run_;
  std::uint64_t draw_ = 0;
};

}  // namespace gainsmith
