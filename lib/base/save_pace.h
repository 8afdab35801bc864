// When long work is kept: a kill loses a tenth of what was done at most, or ten seconds. A slow
// disk takes a small part of the time, and many programs on one disk do not wear it out.
#pragma once

#include <algorithm>
#include <chrono>

namespace gainsmith {

class SavePace {
 public:
  bool is_due() const { return Clock::now() >= next_; }

  /// Calls `save` and says when the next one is due.
  template <class Save>
  void save(const Save& save) {
    // Pauses of a tenth of the time so far, from 0.2 s to 10 s; a save takes 5 % of them at most.
    constexpr Seconds kLeast(0.2), kMost(10);
    constexpr double kLost = 0.1, kOfDisk = 0.05;
    const auto begin = Clock::now();
    save();
    const auto end = Clock::now();
    const Seconds usual = std::clamp(kLost * Seconds(end - begin_), kLeast, kMost);
    const Seconds pause = std::max(usual, Seconds(end - begin) / kOfDisk);
    next_ = end + std::chrono::duration_cast<Clock::duration>(pause);
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  const Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
};

}  // namespace gainsmith
