#include "drawing/arrange.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gainsmith::drawing {
namespace {

/// A line of slope 1 from 0 to 2, which falls by 1 at t = 1, and a bound without samples between.
Figure figure() {
  Curve line{"x", {0, 1, 1, 2}, {0, 1, 0, 1}, {1}};
  Curve bound{"bound", {0, 2}, {3, 3}, {}};
  Figure made;
  made.panels = {{"states", "", false, {line, bound}}};
  made.panels.front().bands = {{"band", {0, 2}, {-1, 1}, {1, 3}, {}}};
  made.marks = {0.5, 1};
  return made;
}

TEST(Arrange, CutsLinesAtTheEnds) {
  Figure made = figure();
  cut(made, 0.25, 1.5);
  const Curve& line = made.panels[0].curves[0];
  EXPECT_EQ(line.t, (std::vector<double>{0.25, 1, 1, 1.5}));
  EXPECT_EQ(line.value, (std::vector<double>{0.25, 1, 0, 0.5}));
  EXPECT_EQ(line.jumps, (std::vector<std::size_t>{1}));
  EXPECT_EQ(made.panels[0].curves[1].t, (std::vector<double>{0.25, 1.5}));
  const Band& band = made.panels[0].bands[0];
  EXPECT_EQ(band.low, (std::vector<double>{-0.75, 0.5}));
  EXPECT_EQ(band.high, (std::vector<double>{1.25, 2.5}));
  EXPECT_EQ(made.marks, (std::vector<double>{0.5, 1}));
}

TEST(Arrange, BeginsAtAJump) {
  Figure made = figure();
  cut(made, 1, 2);
  EXPECT_EQ(made.panels[0].curves[0].t, (std::vector<double>{1, 1, 2}));
  EXPECT_EQ(made.panels[0].curves[0].jumps, (std::vector<std::size_t>{0}));
  Figure none = figure();
  cut(none, 5, 6);
  EXPECT_TRUE(none.panels[0].curves[0].t.empty());
  EXPECT_TRUE(svg(none).ends_with("</svg>\n"));
}

TEST(Arrange, CutsPlanesAcross) {
  Figure made;
  made.panels = {{"plane", "", false, {Curve{"c", {0, 4, 0}, {0, 4, 8}, {}}}}};
  made.panels.front().across = "x";
  cut(made, 1, 3);
  const Curve& curve = made.panels[0].curves[0];
  EXPECT_EQ(curve.t, (std::vector<double>{1, 3, 3, 3, 1, 1}));
  EXPECT_EQ(curve.value[1], 3);
  EXPECT_TRUE(std::isnan(curve.value[2]));
  EXPECT_EQ(curve.value[3], 5);
  EXPECT_EQ(curve.value[4], 7);
}

TEST(Arrange, SpreadsJumps) {
  Figure made = figure();
  spread_jumps(made, 0.5);
  EXPECT_EQ(made.panels[0].curves[0].t, (std::vector<double>{0, 1, 1.5, 2.5}));
  EXPECT_EQ(made.panels[0].curves[1].t, (std::vector<double>{0, 2.5}));
  EXPECT_TRUE(made.marks.empty());
}

TEST(Arrange, Renames) {
  Figure made = figure();
  EXPECT_TRUE(rename(made, "x", "position"));
  EXPECT_TRUE(rename(made, "states", "a panel"));
  EXPECT_FALSE(rename(made, "y", "z"));
  EXPECT_EQ(names_in(made), (std::vector<std::string>{"a panel", "position", "bound", "band"}));
}

TEST(Arrange, FiguresHaveTheSizeThatIsAskedFor) {
  Figure made = figure();
  made.panels.push_back(made.panels.front());
  for (const auto& [width, height] : {std::pair(500.0, 400.0), std::pair(1200.0, 900.0)}) {
    made.width = width;
    made.height = height;
    const std::string text = svg(made);
    EXPECT_NE(text.find("width=\"" + std::to_string(static_cast<int>(width)) + "\" height=\"" +
                        std::to_string(static_cast<int>(height)) + "\""),
              std::string::npos)
        << text.substr(0, 200);
  }
}

}  // namespace
}  // namespace gainsmith::drawing
