#include "base/stop.h"

#include <chrono>
#include <limits>
#include <utility>

namespace gainsmith {

namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> requested = false;
std::atomic<double> deadline = std::numeric_limits<double>::infinity();
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free);

thread_local Allowance* allowance = nullptr;
thread_local bool undisturbed = false;

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

}  // namespace

void request_stop() noexcept { requested = true; }

void stop_after(double seconds) { deadline = now() + seconds; }

bool is_stopping() noexcept {
  if (requested) return true;
  const double end = deadline;
  return end < std::numeric_limits<double>::infinity() && now() >= end;
}

void check_stop() {
  if (!undisturbed && is_stopping()) throw Stopped();
}

Allowance::Allowance(double seconds)
    : seconds_(seconds), around_(std::exchange(allowance, this)) {}

Allowance::~Allowance() { allowance = around_; }

void spend(double seconds) {
  if (undisturbed) return;
  check_stop();
  bool over = false;
  for (Allowance* each = allowance; each != nullptr; each = each->around_)
    over |= each->spent_.fetch_add(seconds) + seconds > each->seconds_;
  if (over) throw OutOfAllowance();
}

Undisturbed::Undisturbed() : before_(std::exchange(undisturbed, true)) {}

Undisturbed::~Undisturbed() { undisturbed = before_; }

AllowanceOfLoop::AllowanceOfLoop(Allowance* of_loop)
    : before_(std::exchange(allowance, of_loop)) {}

AllowanceOfLoop::~AllowanceOfLoop() { allowance = before_; }

Allowance* AllowanceOfLoop::current() { return allowance; }

}  // namespace gainsmith
