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

/// Empty where nothing is counted.
std::string log_text(double seconds) {
  if (Doing::now().what.empty()) return "";
  return fmt::format("gainsmith: after {:.0f} s: {}\n", seconds, to_text(Doing::now()));
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
  explicit Reporter(ProgressKind kind) : kind_(kind), thread_([this] { report(); }) {}

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
    std::chrono::milliseconds pause = first_pause();
    std::unique_lock lock(mutex_);
    for (auto next = start + pause; !ends_.wait_until(lock, next, [&] { return ending_; });
         next += pause) {
      if (kind_ == ProgressKind::lines)
        pause = std::chrono::duration_cast<std::chrono::milliseconds>(next - start);
      if (hidden_) continue;
      const std::chrono::duration<double> seconds = Clock::now() - start;
      std::fputs(text(seconds.count()).c_str(), stderr);
      shown_ = kind_ == ProgressKind::updated;
    }
  }

  std::chrono::milliseconds first_pause() const {
    switch (kind_) {
      case ProgressKind::updated:
        return std::chrono::milliseconds(500);
      case ProgressKind::lines:
        return std::chrono::seconds(30);
      case ProgressKind::json:
        break;
    }
    return std::chrono::seconds(10);
  }

  std::string text(double seconds) const {
    switch (kind_) {
      case ProgressKind::updated:
        return terminal_text(seconds);
      case ProgressKind::lines:
        return log_text(seconds);
      case ProgressKind::json:
        break;
    }
    return json_line(seconds);
  }

  const ProgressKind kind_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ending_ = false;
  bool shown_ = false;
  bool hidden_ = false;
  std::thread thread_;  ///< last: it begins when all else is there
};

std::unique_ptr<Reporter> reporter;

}  // namespace

void show_progress(ProgressKind kind) { reporter = std::make_unique<Reporter>(kind); }

void clear_progress() {
  if (reporter) reporter->clear();
}

void hide_progress(bool hidden) {
  if (reporter) reporter->hide(hidden);
}

void end_progress() { reporter.reset(); }

}  // namespace gainsmith::app
