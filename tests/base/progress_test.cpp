#include "base/progress.h"

#include <gtest/gtest.h>

namespace gainsmith {
namespace {

TEST(Progress, SaysTheInnermostOrWhatIsCounted) {
  EXPECT_EQ(to_text(Doing::now()), "");
  const Doing outer("a search");
  EXPECT_EQ(to_text(Doing::now()), "a search");
  {
    const Doing counted("points", 12);
    const Doing inner("31 digits");
    EXPECT_EQ(to_text(Doing::now()), "points 0/12");
    const Doing counted_within("runs", 1000);
    counted.step();
    counted_within.step(100);
    counted.step(2);
    EXPECT_EQ(to_text(Doing::now()), "points 3/12");
  }
  EXPECT_EQ(to_text(Doing::now()), "a search");
  {
    const Doing inner("31 digits");
    EXPECT_EQ(to_text(Doing::now()), "31 digits");
  }
  EXPECT_EQ(to_text(Doing::now()), "a search");
  const Doing goes_on("runs", 100, 40);
  EXPECT_EQ(to_text(Doing::now()), "runs 40/100");
}

TEST(Progress, SaysHowLongTheRestTakes) {
  EXPECT_EQ(to_text({"runs", 20, 100, 10}), "runs 20/100, 2 a second, about 40 s left");
  EXPECT_EQ(to_text({"runs", 60, 100, 10, 40}), "runs 60/100, 2 a second, about 20 s left");
  EXPECT_EQ(to_text({"runs", 20, 100, 1}), "runs 20/100");
  EXPECT_EQ(to_text({"runs", 0, 100, 10}), "runs 0/100");
  EXPECT_EQ(to_text({"runs", 100, 100, 10}), "runs 100/100");
  EXPECT_EQ(to_text({"runs", 3, 100, 10}), "runs 3/100, 0.3 a second, about 5 min left");
  EXPECT_EQ(to_text({"runs", 1234567, 1000000000, 10}),
            "runs 1234567/1000000000, 120000 a second, about 2.2 h left");
  EXPECT_EQ(to_text({"runs", 12, 10000000, 12}),
            "runs 12/10000000, 1 a second, about 116 days left");
}

}  // namespace
}  // namespace gainsmith
