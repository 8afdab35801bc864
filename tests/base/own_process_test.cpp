#include "base/own_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <string>

#include "support/input_error.h"

namespace gainsmith {
namespace {

TEST(OwnProcess, GivesATextOfAnyLength) {
  const std::string text(1000000, 'x');
  EXPECT_EQ(in_own_process([&] { return text; }), text);
  EXPECT_EQ(in_own_process([] { return std::string(); }), "");
}

TEST(OwnProcess, ChangesNothingHere) {
  int here = 1;
  EXPECT_EQ(in_own_process([&] { return std::to_string(++here); }), "2");
  EXPECT_EQ(here, 1);
}

TEST(OwnProcess, SaysNothingAfterACrash) {
  EXPECT_FALSE(in_own_process([]() -> std::string {
    std::raise(SIGSEGV);
    return "x";
  }));
  EXPECT_FALSE(in_own_process([]() -> std::string { throw std::runtime_error("x"); }));
}

TEST(OwnProcess, SaysNothingWithoutMemory) {
  EXPECT_FALSE(in_own_process([] {
    const std::string much(250'000'000, 'x');
    return much.substr(0, 1);
  }));
}

TEST(OwnProcess, PassesErrorsOn) {
  const InputError error = tests::input_error([] {
    in_own_process([]() -> std::string { throw InputError({"f", 2, 3}, "wrong"); });
  });
  EXPECT_EQ(error.place(), (Place{"f", 2, 3}));
  EXPECT_EQ(error.message(), "wrong");
}

}  // namespace
}  // namespace gainsmith
