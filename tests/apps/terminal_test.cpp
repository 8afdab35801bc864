// A stop ends what has told nothing; what is told reaches standard output.
#include "gainsmith/terminal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace gainsmith::app {
namespace {

constexpr int kUndecided = 3;
constexpr int kWentOn = 10;

/// Longer than the time in which one must begin to tell.
void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(1200)); }

TEST(TerminalDeathTest, AStopEndsWhatTellsNothing) {
  const auto work = [] {
    begin_work({});
    std::raise(SIGINT);
    wait();
    ::_exit(kWentOn);
  };
  EXPECT_EXIT(work(), ::testing::ExitedWithCode(kUndecided), "before anything was known");
}

TEST(TerminalDeathTest, AStopDoesNotEndWhatHasTold) {
  const auto work = [] {
    begin_work({});
    std::raise(SIGINT);
    { const Telling telling; }
    wait();
    ::_exit(kWentOn);
  };
  EXPECT_EXIT(work(), ::testing::ExitedWithCode(kWentOn), "");
}

TEST(TerminalDeathTest, AStopDoesNotEndWhatIsDone) {
  const auto work = [] {
    begin_work({});
    end_work();
    std::raise(SIGINT);
    wait();
    ::_exit(kWentOn);
  };
  EXPECT_EXIT(work(), ::testing::ExitedWithCode(kWentOn), "");
}

}  // namespace
}  // namespace gainsmith::app
