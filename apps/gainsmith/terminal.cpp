#include "gainsmith/terminal.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <system_error>

#include "base/error.h"
#include "base/number.h"
#include "gainsmith/progress_line.h"

namespace gainsmith::app {

namespace {

volatile std::sig_atomic_t interrupted_at = 0;  // seconds
volatile std::sig_atomic_t out_of_time = 0;
volatile std::sig_atomic_t telling_now = 0;
double patience_seconds = 0;
double used_at_stop = 0, used_last = 0;  // processor time, in seconds

double processor_seconds() {
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

std::sig_atomic_t seconds_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::sig_atomic_t>(now.tv_sec);
}

void set_timer(double seconds) {
  constexpr double kLongest = 1e9;
  const double whole = std::floor(std::min(seconds, kLongest));
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>(1e6 * std::clamp(seconds - whole, 0.0, 0.999999));
  // A timer of 0 would not end.
  if (seconds > 0 && whole == 0 && timer.it_value.tv_usec == 0) timer.it_value.tv_usec = 1;
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

constexpr double kToBegin = 0.9;  ///< seconds

/// What is known must be told from now on.
void stop() {
  request_stop();
  used_at_stop = used_last = processor_seconds();
  set_timer(kToBegin);
}

/// On a busy machine a process that works may not have had its time yet. One that waits, for a file, uses none.
bool has_had_its_time() {
  constexpr double kNothing = 0.01;
  const double used = processor_seconds();
  const bool waits = used - used_last < kNothing;
  used_last = used;
  return waits || used - used_at_stop >= kToBegin;
}

/// One that follows within two seconds is the first again: timeout(1) and schedulers signal a
/// process and then its group. A later one ends the program.
void on_interrupt(int number) {
  if (interrupted_at == 0) {
    interrupted_at = seconds_now();
    if (!stop_requested) stop();
  } else if (seconds_now() - interrupted_at > 1) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

/// The first is the end of the patience, unless Ctrl-C came before; the next one that of the time
/// in which to begin to tell.
void on_timer(int) {
  if (!stop_requested) {
    out_of_time = 1;
    return stop();
  }
  if (telling_now != 0) return;
  if (!has_had_its_time()) return set_timer(kToBegin);
  constexpr char kText[] = "gainsmith: stopped, before anything was known\n";
  static_cast<void>(!::write(STDERR_FILENO, kText, sizeof kText - 1));
  ::_exit(static_cast<int>(ExitCode::undecided));
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  ::sigaction(number, &action, nullptr);
}

}  // namespace

void open_standard_files() {
  constexpr const char* kNothing = "/dev/null";
  // open() takes the lowest number that is free, so each is the one that was found closed.
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(file, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open(kNothing, file == STDOUT_FILENO ? O_RDONLY : O_WRONLY));
}

void say(const std::string& text) {
  clear_progress();
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void finish_output() {
  if (std::fflush(stdout) != 0)
    throw InputError({"standard output"},
                     "cannot write: " + std::generic_category().message(errno));
  if (std::ferror(stdout) != 0) throw InputError({"standard output"}, "cannot write");
}

bool is_terminal() { return isatty(STDERR_FILENO) != 0; }

void begin_work(const Patience& patience) {
  telling_now = 0;
  // Schedulers end a job by SIGTERM and wait a little.
  handle(SIGINT, on_interrupt);
  handle(SIGTERM, on_interrupt);
  handle(SIGALRM, on_timer);
  patience_seconds = patience.seconds.value_or(0);
  if (patience.seconds) set_timer(*patience.seconds);
  show_progress(is_terminal()       ? ProgressKind::updated
                : patience.progress ? ProgressKind::json
                                    : ProgressKind::lines);
}

Telling::Telling() {
  telling_now = 1;
  hide_progress(true);
}

Telling::~Telling() {
  // What a stop asked for is told, though it may not have left the buffer of standard output.
  if (stop_requested) set_timer(0);
  telling_now = 0;
  hide_progress(false);
}

void end_work() {
  set_timer(0);
  telling_now = 1;
  end_progress();
}

std::string stop_text() {
  if (!stop_requested) return {};
  if (out_of_time == 0) return "interrupted";
  return "stopped after " + brief(patience_seconds) + " s (--time); a longer time goes further";
}

}  // namespace gainsmith::app
