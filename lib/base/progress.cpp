#include "base/progress.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "base/number.h"

namespace gainsmith {

namespace {

// Texts of several threads replace one another: any of them is what is being done.
std::atomic<const char*> current = nullptr;
std::atomic<std::uint64_t> all = 0;
std::atomic<std::uint64_t> done = 0;
std::atomic<std::uint64_t> before = 0;  ///< the count began
std::atomic<std::int64_t> began = 0;    ///< the count, in milliseconds of the clock

std::int64_t milliseconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

/// "40 s", "12 min", "5.2 h", "3.1 days".
std::string duration(double seconds) {
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
  if (seconds < 2 * kMinute) return std::to_string(std::llround(seconds)) + " s";
  if (seconds < 2 * kHour) return std::to_string(std::llround(seconds / kMinute)) + " min";
  const bool days = seconds >= 2 * kDay;
  const double units = seconds / (days ? kDay : kHour);
  return (units < 10 ? brief(units, 2) : std::to_string(std::llround(units))) +
         (days ? " days" : " h");
}

/// "0.31", "47", "120000".
std::string rate_text(double rate) {
  if (rate < 10) return brief(rate, 2);
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(rate)) - 1));
  return std::to_string(static_cast<std::uint64_t>(std::round(rate / unit) * unit));
}

}  // namespace

std::optional<double> Progress::rate() const {
  // A rate of the first seconds says little of the rest.
  constexpr double kEarly = 3;  // seconds
  if (done <= before || of == 0 || seconds < kEarly) return std::nullopt;
  return static_cast<double>(done - before) / seconds;
}

std::optional<double> Progress::left() const {
  if (!rate() || done >= of) return std::nullopt;
  return static_cast<double>(of - done) / *rate();
}

std::string to_text(const Progress& progress) {
  if (progress.of == 0) return progress.what;
  std::string text =
      progress.what + " " + std::to_string(progress.done) + "/" + std::to_string(progress.of);
  const auto left = progress.left();
  if (!left) return text;
  return text + ", " + rate_text(*progress.rate()) + " a second, about " + duration(*left) +
         " left";
}

Doing::Doing(const char* what, std::uint64_t of, std::uint64_t made) : shown_(all == 0) {
  if (!shown_) return;
  // The name is last: who sees it sees its count.
  done = made;
  before = made;
  began = milliseconds();
  all = of;
  before_ = current.exchange(what);
}

Doing::~Doing() {
  if (!shown_) return;
  all = 0;
  current = before_;
}

void Doing::step(std::uint64_t steps) const {
  if (shown_) done += steps;
}

Progress Doing::now() {
  Progress progress;
  const char* const what = current;
  if (what == nullptr) return progress;
  progress.what = what;
  progress.of = all;
  if (progress.of == 0) return progress;
  progress.done = done;
  progress.before = before;
  progress.seconds = 1e-3 * static_cast<double>(milliseconds() - began);
  return progress;
}

}  // namespace gainsmith
