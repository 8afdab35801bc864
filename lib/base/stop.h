// Stopping, and how much work a question is worth.
//
// What takes long calls spend() about once a millisecond. It ends the computation by an exception
// when somebody wishes it to stop (Ctrl-C, --time), or when an allowance is used up. Whoever gave
// the allowance catches OutOfAllowance and goes on with what is known; Stopped is for the command.
//
// An allowance counts estimated work, not time: the same input ends at the same place on every
// machine and for any number of threads. Its unit is a second of one core of about 2020.
#pragma once

#include <atomic>
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

/// From now on everything stops. Safe in a signal handler.
void request_stop() noexcept;
/// Everything stops `seconds` from now.
void stop_after(double seconds);
/// Whether everything is to stop.
bool is_stopping() noexcept;
/// Throws Stopped when everything is to stop.
void check_stop();

/// Seconds of one operation, a multiplication with an addition.
constexpr double kDoubleWork = 1.5e-10;
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
  friend void spend(double seconds);
  friend class AllowanceOfLoop;

  const double seconds_;
  std::atomic<double> spent_ = 0;
  Allowance* const around_;
};

/// Counts work, and throws Stopped or OutOfAllowance.
void spend(double seconds);

/// As long as one lives, spend() and check_stop() do nothing on its thread: for the last words of
/// what was stopped.
class Undisturbed {
 public:
  Undisturbed();
  ~Undisturbed();
  Undisturbed(const Undisturbed&) = delete;
  Undisturbed& operator=(const Undisturbed&) = delete;

 private:
  const bool before_;
};

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
