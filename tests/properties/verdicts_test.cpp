// A few hundred problems with known answers. `verdict_generator` runs as many as one likes; its
// seeds are 1, 2, ...: those here were never looked at while the program was written.
#include <gtest/gtest.h>

#include "properties/judge.h"

namespace gainsmith::tests::properties {
namespace {

constexpr std::uint64_t kSeed = 0xC1C1C1;
constexpr std::uint64_t kCases = 240;

TEST(VerdictsTest, AreNeverWrong) {
  int undecided = 0;
  for (std::uint64_t index = 0; index < kCases; ++index) {
    const Case known = make_case(kSeed, index);
    const Answer answer = judge(known);
    EXPECT_NE(answer.outcome, Outcome::wrong) << record(known, answer);
    if (known.easy) {
      EXPECT_EQ(answer.outcome, Outcome::right) << record(known, answer);
    }
    undecided += answer.outcome == Outcome::undecided;
  }
  EXPECT_LE(undecided, static_cast<int>(kCases / 100));
}

}  // namespace
}  // namespace gainsmith::tests::properties
