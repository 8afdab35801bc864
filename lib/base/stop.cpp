#include "base/stop.h"

#include <limits>
#include <utility>

namespace gainsmith {

std::atomic<bool> stop_requested = false;

namespace {

thread_local Allowance* allowance = nullptr;

}  // namespace

bool is_stopping() noexcept {
  if (!stop_requested) return false;
  for (const Allowance* each = allowance; each != nullptr; each = each->around_)
    if (each->concludes_until_ != Allowance::Clock::time_point::min())
      return Allowance::Clock::now() > each->concludes_until_;
  return true;
}

Allowance::Allowance(double seconds) : seconds_(seconds), around_(std::exchange(allowance, this)) {}

Allowance::~Allowance() { allowance = around_; }

Concluding::Concluding() : Allowance(std::numeric_limits<double>::infinity()) {
  concludes_until_ = Clock::time_point::max();
}

Concluding::Concluding(double seconds) : Concluding() {
  concludes_until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(seconds));
}

void spend(double seconds) {
  check_stop();
  bool over = false;
  for (Allowance* each = allowance; each != nullptr; each = each->around_)
    over |= each->spent_.fetch_add(seconds) + seconds > each->seconds_;
  if (over) throw OutOfAllowance();
}

AllowanceOfLoop::AllowanceOfLoop(Allowance* of_loop) : before_(std::exchange(allowance, of_loop)) {}

AllowanceOfLoop::~AllowanceOfLoop() { allowance = before_; }

Allowance* AllowanceOfLoop::current() { return allowance; }

}  // namespace gainsmith
