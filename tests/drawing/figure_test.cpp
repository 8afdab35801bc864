#include "drawing/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/number.h"
#include "base/random.h"
#include "drawing/extremes.h"
#include "drawing/xml.h"

namespace gainsmith::drawing {
namespace {

/// A decaying oscillation and its estimate that jumps towards it `jumps` times.
std::vector<Curve> state_and_estimate(std::size_t jumps) {
  Curve state{"x", {}, {}, {}, false, 1}, estimate{"x\xCC\x82", {}, {}, {}, true, 1};
  double error = 2;
  for (std::size_t j = 0; j <= jumps; ++j) {
    for (std::size_t k = 0; k <= 20; ++k) {
      const double t = static_cast<double>(j) + static_cast<double>(k) / 20;
      state.t.push_back(t);
      state.value.push_back(std::exp(-0.05 * t) * std::cos(t));
      estimate.t.push_back(t);
      estimate.value.push_back(state.value.back() + error);
    }
    error *= -0.6;
    if (j == jumps) break;
    for (Curve* curve : {&state, &estimate}) curve->jumps.push_back(curve->t.size() - 1);
  }
  return {state, estimate};
}

Curve plain(std::vector<double> t, std::vector<double> value) {
  return {"c", std::move(t), std::move(value), {}, false, 0};
}

std::vector<Figure> odd_figures() {
  std::vector<Figure> figures = {
      {}, {"only a title", "t", {}}, {"a & b < c", "\"t\" > 0", {{"<panel>", "&", false, {}}}}};
  for (const bool logarithmic : {false, true})
    for (const Curve& shown :
         {plain({}, {}), plain({1}, {2}), plain({nan}, {nan}), plain({0, 1}, {infinite, -infinite}),
          plain({0, 1}, {0, 0}), plain({0, 1}, {5, 5}), plain({0, 1}, {-1, -2}),
          plain({0, 1}, {-largest, largest}), plain({0, 1}, {5e-324, largest}),
          plain({-largest, largest}, {1, 2}), plain({0, 5e-324}, {5e-324, 1e-323}),
          plain({1e9, 1e9 + 1e-6}, {1e9, 1e9 + 1e-6}),
          plain({0, infinite, 2, nan, 4}, {1, 1, nan, 1, 3}), plain({3, 3, 3}, {1, 2, 3})})
      figures.push_back(
          {"odd",
           "t",
           {{"panel", "y", logarithmic, {shown}}, {"", "", !logarithmic, {shown, shown}}}});
  return figures;
}

std::vector<test::Element> elements(const Figure& figure) {
  const auto found = test::read_xml(svg(figure));
  EXPECT_TRUE(found) << svg(figure);
  return found.value_or(std::vector<test::Element>());
}

std::size_t count(const std::vector<test::Element>& all, const std::string& name) {
  return static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(), [&](const test::Element& e) { return e.name == name; }));
}

TEST(Figure, IsWellFormedWhateverItShows) {
  for (const Figure& figure : odd_figures()) {
    const auto all = elements(figure);
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all[0].name, "svg");
    EXPECT_EQ(all[0].attributes.at("width"), "900");
    for (const test::Element& element : all)
      for (const auto& [key, value] : element.attributes) {
        EXPECT_EQ(value.find("nan"), std::string::npos) << value;
        EXPECT_EQ(value.find("inf"), std::string::npos) << value;
        if (key == "x" || key == "cx") {
          EXPECT_GE(parse_decimal(value).value(), 0);
          EXPECT_LE(parse_decimal(value).value(), 900);
        }
        if (key == "y" || key == "cy") {
          EXPECT_GE(parse_decimal(value).value(), 0);
          EXPECT_LE(parse_decimal(value).value(),
                    parse_decimal(all[0].attributes.at("height")).value());
        }
      }
  }
}

TEST(Figure, AFieldIsArrowsInsideOfItsPlane) {
  Figure figure{"f", "", {{"p", "y", false, {plain({-1, 1}, {-1, 1})}}}};
  figure.panels[0].across = "x";
  const std::size_t before = count(elements(figure), "path");
  figure.panels[0].field = [](double x, double y) { return std::pair(y, -x); };
  const auto all = elements(figure);
  EXPECT_EQ(count(all, "path"), before + 1);
  const auto arrows = std::ranges::find_if(all, [](const test::Element& element) {
    const auto stroke = element.attributes.find("stroke");
    return stroke != element.attributes.end() && stroke->second == "#b8b8b8";
  });
  ASSERT_NE(arrows, all.end());
  // A shaft and a head of two lines for each.
  const std::string& path = arrows->attributes.at("d");
  EXPECT_EQ(std::ranges::count(path, 'M') % 2, 0);
  EXPECT_GT(std::ranges::count(path, 'M'), 600);
  // Nothing where the rates have no value.
  figure.panels[0].field = [](double, double) { return std::pair(nan, 1.0); };
  EXPECT_EQ(count(elements(figure), "path"), before);
}

TEST(Figure, IsTheSameBytesTwice) {
  for (const Figure& figure : odd_figures()) EXPECT_EQ(svg(figure), svg(Figure(figure)));
  const Figure figure{"f", "t", {{"p", "", false, state_and_estimate(40)}}};
  EXPECT_EQ(svg(figure), svg(Figure(figure)));
}

TEST(Figure, StartsWithAWhiteGround) {
  const auto all = elements({"f", "t", {{"p", "", false, state_and_estimate(3)}}});
  EXPECT_EQ(all[1].name, "rect");
  EXPECT_EQ(all[1].attributes.at("fill"), "white");
  EXPECT_EQ(all[1].attributes.at("height"), all[0].attributes.at("height"));
}

TEST(Figure, EscapesTexts) {
  Figure figure{"1 < 2 & 3", "t > \"0\"", {{"<p>", "a&b", false, state_and_estimate(3)}}};
  figure.panels[0].curves[0].label = "</svg>";
  const auto all = elements(figure);
  for (const char* text : {"1 < 2 & 3", "t > \"0\"", "<p>", "a&b", "</svg>"})
    EXPECT_TRUE(has_text(all, text)) << text;
  EXPECT_EQ(all[0].attributes.at("aria-label"), "1 < 2 & 3");
}

TEST(Figure, StateIsSolidAndItsEstimateDashedInTheSameColour) {
  const auto all = elements({"", "t", {{"", "", false, state_and_estimate(3)}}});
  std::vector<test::Element> lines;
  for (const test::Element& element : all)
    if (element.attributes.contains("stroke-linejoin")) lines.push_back(element);
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[0].attributes.at("stroke"), lines[1].attributes.at("stroke"));
  EXPECT_FALSE(lines[0].attributes.contains("stroke-dasharray"));
  EXPECT_TRUE(lines[1].attributes.contains("stroke-dasharray"));
}

TEST(Figure, FewJumpsHaveCirclesAndManyHaveNone) {
  EXPECT_EQ(count(elements({"", "t", {{"", "", false, state_and_estimate(3)}}}), "circle"), 6);
  EXPECT_EQ(count(elements({"", "t", {{"", "", false, state_and_estimate(61)}}}), "circle"), 0);
  EXPECT_GT(count(elements({"", "t", {{"", "", false, state_and_estimate(60)}}}), "circle"), 0);
}

TEST(Figure, PanelsStandOneBelowTheOtherOverOneTimeAxis) {
  for (std::size_t panels = 1; panels <= 6; ++panels) {
    Figure figure{"f", "t", {}};
    for (std::size_t k = 0; k < panels; ++k)
      figure.panels.push_back({"p", "y", k % 2 == 1, state_and_estimate(k)});
    const auto all = elements(figure);
    double bottom = 0;
    std::size_t frames = 0;
    for (const test::Element& element : all)
      if (element.name == "rect" && element.attributes.contains("y")) {
        const auto number = [&](const char* key) {
          return parse_decimal(element.attributes.at(key)).value();
        };
        EXPECT_GT(number("y"), bottom + 12);
        EXPECT_EQ(number("x") + number("width"), 876);
        bottom = number("y") + number("height");
        ++frames;
      }
    EXPECT_EQ(frames, panels);
    EXPECT_GT(parse_decimal(all[0].attributes.at("height")).value(), bottom + 20);
  }
}

TEST(Figure, EmptyPanelsSaySo) {
  EXPECT_TRUE(has_text(elements({"", "", {{"p", "", false, {}}}}), "no data"));
  EXPECT_TRUE(has_text(elements({"", "", {{"p", "", true, {plain({0, 1}, {0, -1})}}}}), "no data"));
  EXPECT_FALSE(has_text(elements({"", "", {{"p", "", false, {plain({0}, {0})}}}}), "no data"));
}

TEST(Figure, DenseCurvesStaySmall) {
  RandomStream draw(1, 0);
  Curve noise = plain({}, {});
  for (int k = 0; k < 500000; ++k) {
    noise.t.push_back(k * 1e-3);
    noise.value.push_back(draw.uniform());
  }
  EXPECT_LT(svg({"", "t", {{"", "", false, {noise}}}}).size(), 50000);
  EXPECT_LT(svg({"", "t", {{"", "", false, state_and_estimate(40)}}}).size(), 20000);
  EXPECT_LT(svg({"", "t", {{"", "", false, state_and_estimate(20000)}}}).size(), 120000);
}

TEST(Figure, ACurveWithMoreTimesThanValuesIsAFault) {
  EXPECT_THROW(svg({"", "", {{"", "", false, {plain({0, 1}, {0})}}}}), std::logic_error);
}

TEST(Figure, EstimatesThatAgreeAreAllSeen) {
  Figure figure{"", "t", {{"", "", false, state_and_estimate(3)}}};
  figure.panels[0].curves.push_back(figure.panels[0].curves[1]);
  figure.panels[0].curves.back().colour = 2;
  std::vector<test::Element> lines;
  for (const test::Element& element : elements(figure))
    if (element.attributes.contains("stroke-linejoin")) lines.push_back(element);
  ASSERT_EQ(lines.size(), 3);
  EXPECT_EQ(lines[0].attributes.at("stroke-width"), "3.4");
  EXPECT_EQ(lines[1].attributes.at("stroke-width"), "1.6");
  // As long a dash as a gap, the second begins where the first has its gap.
  EXPECT_EQ(lines[1].attributes.at("stroke-dasharray"), "6 6");
  EXPECT_FALSE(lines[1].attributes.contains("stroke-dashoffset"));
  EXPECT_EQ(lines[2].attributes.at("stroke-dashoffset"), "6");
}

TEST(Figure, LimitsAreNoEstimates) {
  Curve claim = plain({0, 1}, {1, 2}), limit = plain({0, 1}, {3, 3});
  limit.limit = true;
  limit.label.clear();
  std::vector<test::Element> lines;
  for (const test::Element& element : elements({"", "t", {{"", "", false, {claim, limit}}}}))
    if (element.attributes.contains("stroke-linejoin")) lines.push_back(element);
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[0].attributes.at("stroke-width"), "1.6");
  EXPECT_TRUE(lines[1].attributes.contains("stroke-dasharray"));
}

TEST(Figure, MarksStandAtTheirValuesWithRoomAtTheEnds) {
  Curve tried = plain({1, 10, 100}, {0, 1, 0});
  tried.mark = Mark::cross;
  tried.label.clear();
  tried.joined = false;
  Panel panel{"verdict", "", false, {tried}};
  panel.rows = {"feasible", "infeasible"};
  Figure figure{"", "alpha", {panel}};
  figure.logarithmic = true;
  const auto all = elements(figure);
  EXPECT_TRUE(has_text(all, "feasible") && has_text(all, "infeasible"));
  std::vector<double> x, y;
  for (const test::Element& element : all)
    if (element.name == "path" && element.attributes.at("d").ends_with("l-6,6")) {
      const std::string& d = element.attributes.at("d");
      x.push_back(parse_decimal(d.substr(1, d.find(',') - 1)).value());
      y.push_back(parse_decimal(d.substr(d.find(',') + 1, d.find('m') - d.find(',') - 1)).value());
    }
  ASSERT_EQ(x.size(), 3);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.2);
  EXPECT_LT(x[2], 870);
  EXPECT_LT(y[0], y[1]);  // the first row is the upper one
}

TEST(Figure, BandsGrowTheAxisByTheExtentOfTheCurvesAtMost) {
  Panel panel{"", "", false, {plain({0, 1}, {0, 1})}};
  panel.bands.push_back({"2 sigma", {0, 1}, {-1000, -0.1}, {1000, 1.1}, {}, 1});
  const auto all = elements({"", "t", {panel}});
  EXPECT_TRUE(has_text(all, "2 sigma"));
  EXPECT_TRUE(has_text(all, "2.0") || has_text(all, "2"));
  EXPECT_FALSE(has_text(all, "1000") || has_text(all, "500"));
  panel.curves.clear();
  EXPECT_TRUE(has_text(elements({"", "t", {panel}}), "1000"));
  panel.bands[0].high.pop_back();
  EXPECT_THROW(svg({"", "t", {panel}}), std::logic_error);
}

TEST(Figure, PlanesHaveAnAxisOfTheirOwn) {
  Panel plane{"x2 over x1", "x2", false, {plain({5, 9, 7}, {0, 1, 2})}};
  plane.across = "x1";
  const auto all = elements({"", "t", {{"", "", false, {plain({0, 1}, {0, 1})}}, plane}});
  for (const char* text : {"t", "x1", "x2", "x2 over x1", "9"})
    EXPECT_TRUE(has_text(all, text)) << text;
  EXPECT_EQ(count(all, "circle"), 2);  // where it begins and ends
}

TEST(Figure, BarsHaveAnAxisOfTheirOwnAndNoEnds) {
  Panel bars{"", "runs", false, {plain({1, 1, 2, 2, 9, 9}, {0, 3, 3, 7, 7, 0})}};
  bars.across = "peak";
  bars.bars = true;
  const auto all = elements({"", "", {bars, bars}});
  for (const char* text : {"peak", "runs", "9"}) EXPECT_TRUE(has_text(all, text)) << text;
  EXPECT_EQ(count(all, "circle"), 0);
  EXPECT_EQ(count(all, "rect"), 3);  // the ground and two frames
}

}  // namespace
}  // namespace gainsmith::drawing
