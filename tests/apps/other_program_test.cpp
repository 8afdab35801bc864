#include "gainsmith/other_program.h"

#include <gtest/gtest.h>

#include <csignal>

namespace gainsmith::app {
namespace {

TEST(OtherProgram, ItsExitCodeIsToldAndNoneAfterASignal) {
  EXPECT_EQ(run_program({"sh", "-c", "exit 7"}), 7);
  EXPECT_EQ(run_program({"sh", "-c", "kill -INT $$; exit 7"}), std::nullopt);
  EXPECT_EQ(run_program({"gainsmith-has-no-such-program"}), std::nullopt);
}

/// One thread of this program waits for Ctrl-C, which all block.
TEST(OtherProgram, CtrlCEndsItWhereThisProgramBlocksIt) {
  sigset_t interrupt, before;
  sigemptyset(&interrupt);
  sigaddset(&interrupt, SIGINT);
  ASSERT_EQ(pthread_sigmask(SIG_BLOCK, &interrupt, &before), 0);
  EXPECT_EQ(run_program({"sh", "-c", "kill -INT $$; exit 7"}), std::nullopt);
  ASSERT_EQ(pthread_sigmask(SIG_SETMASK, &before, nullptr), 0);
}

}  // namespace
}  // namespace gainsmith::app
