// What is being done, in a few words, for people who wait.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace gainsmith {

/// ", about 40 s left" of a count that took so long for its first steps, as if all took the same
/// time; empty while that is no more than a guess.
std::string time_left(double seconds, std::uint64_t steps, std::uint64_t of);

/// From its construction to its end this is being done. A count is shown in place of what is done
/// within it.
class Doing {
 public:
  /// `what` must be a literal. `of`: how many steps there are; 0: they are not counted.
  explicit Doing(const char* what, std::uint64_t of = 0);
  ~Doing();
  Doing(const Doing&) = delete;
  Doing& operator=(const Doing&) = delete;

  /// So many steps more are done; from any thread.
  static void step(std::uint64_t steps = 1);
  /// "100 digits", "points 12/200, about 40 s left"; empty when nothing was said. From any thread.
  static std::string now();

 private:
  const char* before_ = nullptr;
  bool shown_ = false;
};

}  // namespace gainsmith
