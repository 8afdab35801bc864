#include "drawing/legend.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/random.h"
#include "drawing/drawing.h"
#include "drawing/text.h"

namespace gainsmith::drawing {
namespace {

Panel panel(std::string title, const std::vector<std::string>& labels) {
  Panel made{std::move(title), "", false, {}};
  for (const std::string& label : labels) made.curves.push_back({label, {}, {}, {}, false, 0});
  return made;
}

TEST(Legend, StandsBesideTheTitleWhereItFits) {
  const Panel shown = panel("States", {"x1", "x2"});
  const Legend made = legend(shown, 800);
  ASSERT_EQ(made.entries.size(), 2);
  EXPECT_LT(made.height, 30);
  EXPECT_GT(made.entries[0].x, 600);
  EXPECT_EQ(made.entries[1].curve, &shown.curves[1]);
}

TEST(Legend, CurvesWithoutLabelAreNotInIt) {
  EXPECT_EQ(legend(panel("States", {"", "x2", ""}), 800).entries.size(), 1);
}

/// A measurement has gaps between its samples, or jumps.
TEST(Legend, SamplesThatNoLineJoinsAreADot) {
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const auto shown = [](const Curve& curve) {
    const Panel panel{"", "", false, {curve}};
    return drawn(legend(panel, 800), 0, 0);
  };
  EXPECT_NE(shown({"y", {0, 1, 2}, {1, gap, 2}, {}, false, 0}).find("<circle"), std::string::npos);
  EXPECT_NE(shown({"y", {0, 1}, {1, 2}, {0}, false, 0}).find("<circle"), std::string::npos);
  EXPECT_EQ(shown({"y", {0, 1}, {1, 2}, {}, false, 0}).find("<circle"), std::string::npos);
}

TEST(Legend, EntriesNeverOverlapAndStayWithin) {
  RandomStream draw(1, 0);
  for (int k = 0; k < 3000; ++k) {
    std::vector<std::string> labels;
    const int count = static_cast<int>(12 * draw.uniform());
    for (int i = 0; i < count; ++i) {
      const double size = draw.uniform() < 0.1 ? 200 * draw.uniform() : 20 * draw.uniform();
      labels.emplace_back(1 + static_cast<std::size_t>(size), 'x');
    }
    const Panel shown =
        panel(std::string(static_cast<std::size_t>(120 * draw.uniform()), 'T'), labels);
    const double width = 300 + 550 * draw.uniform();
    const Legend made = legend(shown, width);
    ASSERT_EQ(made.entries.size(), labels.size());
    const double title = text_width(made.title, panel_title_size * bold_widening);
    ASSERT_LE(title, width);
    for (std::size_t i = 0; i < made.entries.size(); ++i) {
      const LegendEntry& entry = made.entries[i];
      const double end = entry.x + 30 + text_width(entry.label, label_size);
      ASSERT_GE(entry.x, -1e-9);
      ASSERT_LE(end, width + 1e-9);
      ASSERT_LE(entry.y + 9, made.height);
      ASSERT_TRUE(entry.y >= 18 || made.title.empty() || entry.x > title);
      if (i + 1 < made.entries.size()) {
        const LegendEntry& next = made.entries[i + 1];
        ASSERT_TRUE(next.y >= entry.y + 18 || (next.y == entry.y && next.x > end));
      }
    }
  }
}

}  // namespace
}  // namespace gainsmith::drawing
