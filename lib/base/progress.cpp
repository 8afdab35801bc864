#include "base/progress.h"

#include <chrono>
#include <cmath>

namespace gainsmith {

namespace {

// Texts of several threads replace one another: any of them is what is being done.
std::atomic<const char*> current = nullptr;
std::atomic<std::uint64_t> all = 0;
std::atomic<std::uint64_t> done = 0;
std::atomic<std::int64_t> began = 0;  ///< the count, in milliseconds of the clock

std::int64_t milliseconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

}  // namespace

std::string time_left(double seconds, std::uint64_t steps, std::uint64_t of) {
  constexpr double kEarly = 3;  // seconds
  if (steps == 0 || steps >= of || seconds < kEarly) return {};
  const double left = seconds * static_cast<double>(of - steps) / static_cast<double>(steps);
  return ", about " + std::to_string(std::llround(left)) + " s left";
}

Doing::Doing(const char* what, std::uint64_t of) : shown_(all == 0) {
  if (!shown_) return;
  // The name is last: who sees it sees its count.
  done = 0;
  began = milliseconds();
  all = of;
  before_ = current.exchange(what);
}

Doing::~Doing() {
  if (!shown_) return;
  all = 0;
  current = before_;
}

void Doing::step(std::uint64_t steps) { done += steps; }

std::string Doing::now() {
  const char* const what = current;
  if (what == nullptr) return {};
  const std::uint64_t of = all;
  if (of == 0) return what;
  const std::uint64_t steps = done;
  return std::string(what) + " " + std::to_string(steps) + "/" + std::to_string(of) +
         time_left(1e-3 * static_cast<double>(milliseconds() - began), steps, of);
}

}  // namespace gainsmith
