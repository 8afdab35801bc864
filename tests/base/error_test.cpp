#include "base/error.h"

#include <gtest/gtest.h>

namespace gainsmith {
namespace {

TEST(Place, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_string(Place{"a.yaml", 3, 7}), "a.yaml:3:7");
  EXPECT_EQ(to_string(Place{"a.yaml", 3, 0}), "a.yaml:3");
  EXPECT_EQ(to_string(Place{"a.yaml", 0, 0}), "a.yaml");
  EXPECT_EQ(to_string(Place{"a.yaml", 0, 7}), "a.yaml");
  EXPECT_EQ(to_string(Place{}), "");
}

TEST(InputError, ShowsPlaceAndMessage) {
  const InputError error({"a.yaml", 3, 7}, "no such thing");
  EXPECT_STREQ(error.what(), "a.yaml:3:7: no such thing");
  EXPECT_EQ(error.place(), (Place{"a.yaml", 3, 7}));
  EXPECT_EQ(error.message(), "no such thing");
}

TEST(InputError, WithoutPlaceIsTheMessageAlone) {
  EXPECT_STREQ(InputError({}, "no such thing").what(), "no such thing");
}

}  // namespace
}  // namespace gainsmith
