#include "base/progress.h"

#include <gtest/gtest.h>

namespace gainsmith {
namespace {

TEST(Progress, SaysTheInnermostOrWhatIsCounted) {
  EXPECT_EQ(Doing::now(), "");
  const Doing outer("a search");
  EXPECT_EQ(Doing::now(), "a search");
  {
    const Doing counted("points", 12);
    const Doing inner("31 digits");
    EXPECT_EQ(Doing::now(), "points 0/12");
    Doing::step();
    Doing::step(2);
    EXPECT_EQ(Doing::now(), "points 3/12");
  }
  EXPECT_EQ(Doing::now(), "a search");
  {
    const Doing inner("31 digits");
    EXPECT_EQ(Doing::now(), "31 digits");
  }
  EXPECT_EQ(Doing::now(), "a search");
}

TEST(Progress, SaysHowLongTheRestTakes) {
  EXPECT_EQ(time_left(10, 20, 100), ", about 40 s left");
  EXPECT_EQ(time_left(1, 20, 100), "");
  EXPECT_EQ(time_left(10, 0, 100), "");
  EXPECT_EQ(time_left(10, 100, 100), "");
  EXPECT_EQ(time_left(10, 101, 100), "");
}

}  // namespace
}  // namespace gainsmith
