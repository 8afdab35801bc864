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

}  // namespace
}  // namespace gainsmith
