// A stop ends what has told nothing; what is told reaches standard output.
#include "gainsmith/terminal.h"

#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <thread>

namespace gainsmith::app {
namespace {

constexpr int kUndecided = 3;
constexpr int kWentOn = 10;

/// Whether the timer of a stop runs, at the end of which one must have begun to tell.
bool is_timed() {
  itimerval timer{};
  ::getitimer(ITIMER_REAL, &timer);
  return timer.it_value.tv_sec > 0 || timer.it_value.tv_usec > 0;
}

TEST(TerminalDeathTest, AStopEndsWhatTellsNothing) {
  const auto work = [] {
    begin_work({});
    std::raise(SIGINT);
    for (;;) ::pause();
  };
  EXPECT_EXIT(work(), ::testing::ExitedWithCode(kUndecided), "before anything was known");
}

TEST(TerminalDeathTest, AStopDoesNotEndWhatHasTold) {
  const auto work = [] {
    begin_work({});
    std::raise(SIGINT);
    const bool before = is_timed();
    { const Telling telling; }
    ::_exit(before && !is_timed() ? kWentOn : kUndecided);
  };
  EXPECT_EXIT(work(), ::testing::ExitedWithCode(kWentOn), "");
}

TEST(TerminalDeathTest, AStopDoesNotEndWhatIsDone) {
  const auto work = [] {
    begin_work({});
    end_work();
    std::raise(SIGINT);
    while (is_timed()) std::this_thread::yield();
    ::_exit(kWentOn);
  };
  EXPECT_EXIT(work(), ::testing::ExitedWithCode(kWentOn), "");
}

}  // namespace
}  // namespace gainsmith::app
