#include "page/coarse.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/figure.h"

namespace gainsmith::page {
namespace {

TEST(Coarse, APointOnALineGoes) {
  EXPECT_EQ(coarse(R"(<path d="M0,0l10,0 10,0 0,10"/>)", 0.5), R"(<path d="M0,0l20,0 0,10"/>)");
}

TEST(Coarse, APeakHigherThanTheToleranceStays) {
  const std::string peak = R"(<path d="M0,0l10,1 10-1"/>)";
  EXPECT_EQ(coarse(peak, 0.5), peak);
  EXPECT_EQ(coarse(peak, 1.5), R"(<path d="M0,0l20,0"/>)");
}

TEST(Coarse, OtherPathsAndTextsStay) {
  for (const char* same :
       {R"(<path d="M0,0h10v3"/>)", R"(<path d="M0,0l10"/>)", R"(<path d="M0,0")", R"(<path d=")",
        R"(<path d="M0,0l1e9,0 1,1"/>)", "<text> d=&quot;M0,0l1,0 1,0&quot;</text>", ""})
    EXPECT_EQ(coarse(same, 1), same);
}

/// The formats of drawing.h and of this reader are one.
TEST(Coarse, AFigureHasFewerPoints) {
  report::Curve curve;
  for (int k = 0; k <= 2000; ++k) {
    curve.t.push_back(0.01 * k);
    curve.value.push_back(std::sin(0.05 * k));
  }
  report::Figure figure;
  figure.panels = {{"p", "", false, {curve}}};
  const std::string fine = report::svg(figure);
  const std::string rough = coarse(fine, 1);
  EXPECT_LT(rough.size(), 0.7 * static_cast<double>(fine.size()));
  EXPECT_EQ(coarse(fine, 0).size(), fine.size());
}

}  // namespace
}  // namespace gainsmith::page
