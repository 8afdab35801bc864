// What is being done, in a few words, for people who wait.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gainsmith {

/// What is being done, and how far it has come.
struct Progress {
  std::string what;          ///< empty: nothing was said
  std::uint64_t done = 0;    ///< steps
  std::uint64_t of = 0;      ///< 0: they are not counted
  double seconds = 0;        ///< since the count began
  std::uint64_t before = 0;  ///< steps that were done before it began

  // Empty while they are no more than guesses.
  std::optional<double> rate() const;  ///< steps a second
  std::optional<double> left() const;  ///< seconds, as if all steps took the same time
};

/// "100 digits", "points 12/200, 4 a second, about 47 s left".
std::string to_text(const Progress& progress);

/// From its construction to its end this is being done. A count is shown in place of what is done
/// within it, and nothing within it counts.
class Doing {
 public:
  /// `what` must be a literal. `of`: how many steps there are; 0: they are not counted. `done`: of
  /// them, before.
  explicit Doing(const char* what, std::uint64_t of = 0, std::uint64_t done = 0);
  ~Doing();
  Doing(const Doing&) = delete;
  Doing& operator=(const Doing&) = delete;

  /// So many steps more are done; from any thread.
  void step(std::uint64_t steps = 1) const;
  /// From any thread.
  static Progress now();

 private:
  const char* before_ = nullptr;
  bool shown_ = false;
};

}  // namespace gainsmith
