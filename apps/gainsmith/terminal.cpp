#include "gainsmith/terminal.h"

#include <unistd.h>

#include <csignal>

namespace gainsmith::app {

namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

void on_interrupt(int) {
  interrupt_flag = 1;
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

bool progress_wanted() { return isatty(STDERR_FILENO) != 0; }

void catch_interrupts() { std::signal(SIGINT, on_interrupt); }

bool interrupted() { return interrupt_flag != 0; }

}  // namespace gainsmith::app
