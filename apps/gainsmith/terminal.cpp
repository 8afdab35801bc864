#include "gainsmith/terminal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <system_error>

#include "base/error.h"

namespace gainsmith::app {

namespace {

volatile std::sig_atomic_t interrupt_flag = 0;
volatile std::sig_atomic_t interrupted_at = 0;  // seconds

std::sig_atomic_t seconds_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::sig_atomic_t>(now.tv_sec);
}

/// One that follows within two seconds is the first again: timeout(1) and schedulers signal a
/// process and then its group. A later one ends the program.
void on_interrupt(int) {
  if (interrupt_flag == 0) {
    interrupt_flag = 1;
    interrupted_at = seconds_now();
  } else if (seconds_now() - interrupted_at > 1) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  }
}

}  // namespace

void open_standard_files() {
  constexpr const char* kNothing = "/dev/null";
  // open() takes the lowest number that is free, so each is the one that was found closed.
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(file, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open(kNothing, file == STDOUT_FILENO ? O_RDONLY : O_WRONLY));
}

void say(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void finish_output() {
  if (std::fflush(stdout) != 0)
    throw InputError({"standard output"},
                     "cannot write: " + std::generic_category().message(errno));
  if (std::ferror(stdout) != 0) throw InputError({"standard output"}, "cannot write");
}

bool progress_wanted() { return isatty(STDERR_FILENO) != 0; }

void catch_interrupts() { std::signal(SIGINT, on_interrupt); }

bool interrupted() { return interrupt_flag != 0; }

}  // namespace gainsmith::app
