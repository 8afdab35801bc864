#include "base/sine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gainsmith {
namespace {

TEST(Sine, IsThatOfTheLibraryToRounding) {
  std::mt19937 random(1);
  for (const double range : {1e-8, 1.0, 10.0, 1e3, 1e6}) {
    std::uniform_real_distribution<double> number(-range, range);
    for (int k = 0; k < 5000; ++k) {
      const double x = number(random);
      EXPECT_NEAR(sine(x), std::sin(x), 4e-16 + 1e-15 * std::abs(std::sin(x))) << x;
    }
  }
  for (int k = -40; k <= 40; ++k) {
    const double x = k * 1.5707963267948966;
    EXPECT_NEAR(sine(x), std::sin(x), 4e-16) << k;
  }
}

}  // namespace
}  // namespace gainsmith
