// Stopping, and how much work a question is worth.
//
// What takes long calls spend() or check_stop() about once a millisecond. They end the computation
// by an exception when somebody wishes it to stop (Ctrl-C, --time), or when an allowance is used
// up. Whoever gave the allowance catches OutOfAllowance and goes on with what is known. Whoever has
// something to tell catches Stopped and makes his result of it, as Concluding; the command is last.
//
// An allowance counts estimated work, not time: the same input ends at the same place on every
// machine and for any number of threads. Its unit is a second of one core of about 2020.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>

namespace gainsmith {

/// Somebody does not want to wait longer.
struct Stopped : std::exception {
  const char* what() const noexcept override { return "stopped"; }
};

/// A part of the work took more than it was given.
struct OutOfAllowance : std::exception {
  const char* what() const noexcept override { return "out of its allowance of work"; }
};

/// Whether a stop was requested.
extern std::atomic<bool> stop_requested;
static_assert(std::atomic<bool>::is_always_lock_free);

/// From now on everything stops. Safe in a signal handler.
inline void request_stop() noexcept { stop_requested = true; }
/// Whether the calling thread is to stop.
bool is_stopping() noexcept;
/// Throws Stopped when the calling thread is to stop.
inline void check_stop() {
  if (stop_requested.load(std::memory_order_relaxed) && is_stopping()) throw Stopped();
}

/// Seconds of one multiplication with an addition, by arithmetic: double, 31 digits, 100 digits.
constexpr double kDoubleWork = 1.5e-10;
constexpr double kBlockWork = 3e-11;  // in products and factors of large matrices of doubles
constexpr double kQuadWork = 4e-9;
constexpr double kWideWork = 1.2e-7;

/// A limit for what the calling thread does from here on, loops of parallel_for within included, as
/// long as this object lives. What is spent counts for the allowances around it too.
class Allowance {
 public:
  explicit Allowance(double seconds);
  ~Allowance();
  Allowance(const Allowance&) = delete;
  Allowance& operator=(const Allowance&) = delete;

  double spent() const { return spent_; }

 private:
  friend class Concluding;
  friend void spend(double seconds);
  friend bool is_stopping() noexcept;

  using Clock = std::chrono::steady_clock;

  const double seconds_;
  Clock::time_point concludes_until_ = Clock::time_point::min();
  std::atomic<double> spent_ = 0;
  Allowance* const around_;
};

/// What is left to do of a stopped computation, to tell what is known: nothing stops it, on this
/// thread and in its loops, as long as this object lives. It must be little.
class Concluding : public Allowance {
 public:
  Concluding();
  /// Where it may be much: after these seconds it stops.
  explicit Concluding(double seconds);
};

/// Counts work, and throws Stopped or OutOfAllowance.
void spend(double seconds);

/// The allowance of a loop, on a thread that works in it.
class AllowanceOfLoop {
 public:
  explicit AllowanceOfLoop(Allowance* allowance);
  ~AllowanceOfLoop();
  AllowanceOfLoop(const AllowanceOfLoop&) = delete;
  AllowanceOfLoop& operator=(const AllowanceOfLoop&) = delete;

  /// Of the calling thread; null without one.
  static Allowance* current();

 private:
  Allowance* const before_;
};

}  // namespace gainsmith
