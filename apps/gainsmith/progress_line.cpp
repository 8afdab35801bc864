#include "gainsmith/progress_line.h"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "base/progress.h"

namespace gainsmith::app {

namespace {

std::string terminal_text(double seconds) {
  return fmt::format("\r\033[K{:.0f} s  {}", seconds, to_text(Doing::now()));
}

/// For programs that wait. The names of what is done need no quotation.
std::string json_line(double seconds) {
  const Progress progress = Doing::now();
  std::string text =
      fmt::format("{{\"seconds\": {:.0f}, \"doing\": \"{}\"", seconds, progress.what);
  if (progress.of > 0)
    text += fmt::format(", \"done\": {}, \"of\": {}", progress.done, progress.of);
  if (const auto rate = progress.rate()) text += fmt::format(", \"rate\": {:.4g}", *rate);
  if (const auto left = progress.left()) text += fmt::format(", \"seconds_left\": {:.0f}", *left);
  return text + "}\n";
}

class Reporter {
 public:
  explicit Reporter(bool terminal) : terminal_(terminal), thread_([this] { report(); }) {}

  ~Reporter() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    ends_.notify_one();
    thread_.join();
    clear();
  }

  void hide(bool hidden) {
    clear();
    const std::lock_guard lock(mutex_);
    hidden_ = hidden;
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(shown_, false)) return;
    std::fputs("\r\033[K", stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void report() {
    const auto start = Clock::now();
    const std::chrono::milliseconds pause(terminal_ ? 500 : 10'000);
    std::unique_lock lock(mutex_);
    for (auto next = start + pause; !ends_.wait_until(lock, next, [&] { return ending_; });
         next += pause) {
      if (hidden_) continue;
      const std::chrono::duration<double> seconds = Clock::now() - start;
      const std::string text =
          terminal_ ? terminal_text(seconds.count()) : json_line(seconds.count());
      std::fputs(text.c_str(), stderr);
      shown_ = terminal_;
    }
  }

  const bool terminal_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ending_ = false;
  bool shown_ = false;
  bool hidden_ = false;
  std::thread thread_;  ///< last: it begins when all else is there
};

std::unique_ptr<Reporter> reporter;

}  // namespace

void show_progress(bool terminal) { reporter = std::make_unique<Reporter>(terminal); }

void clear_progress() {
  if (reporter) reporter->clear();
}

void hide_progress(bool hidden) {
  if (reporter) reporter->hide(hidden);
}

void end_progress() { reporter.reset(); }

}  // namespace gainsmith::app
