#include "drawing/map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "base/number.h"
#include "drawing/xml.h"

namespace gainsmith::drawing {
namespace {

std::vector<CellKind> kinds() {
  return {{"feasible", "#8fd0b6", Mark::dot}, {"infeasible", "#e4e4e4", Mark::cross}};
}

/// Feasible where the first scalar is below `border`, with the product as the value.
MapFigure figure(std::size_t width, std::size_t height, double border, bool values) {
  MapFigure made{"title", {"a", {}, false}, {"b", {}, true}, kinds(), {{"product", {}}}};
  for (std::size_t k = 0; k < width; ++k) made.across.values.push_back(static_cast<double>(k));
  double power = 1;
  for (std::size_t k = 0; k < height; ++k, power *= 10) made.up.values.push_back(power);
  for (const double b : made.up.values)
    for (const double a : made.across.values) {
      Cell cell{a < border ? std::size_t{0} : std::size_t{1}, std::nullopt};
      if (values && a < border) cell.value = a * b;
      made.maps[0].cells.push_back(cell);
    }
  return made;
}

std::vector<test::Element> elements(const MapFigure& map) {
  const auto found = test::read_xml(svg(map));
  EXPECT_TRUE(found) << svg(map);
  return found.value_or(std::vector<test::Element>());
}

std::ptrdiff_t with_fill(const std::vector<test::Element>& all, const std::string& fill) {
  return std::count_if(all.begin(), all.end(), [&](const test::Element& element) {
    return element.name == "path" && element.attributes.contains("fill") &&
           element.attributes.at("fill") == fill;
  });
}

TEST(Map, NeighboursOfOneColourAreOneRectangle) {
  const auto all = elements(figure(8, 3, 5, false));
  EXPECT_EQ(with_fill(all, "#8fd0b6"), 3);
  EXPECT_EQ(with_fill(all, "#e4e4e4"), 3);
  for (const char* text : {"title", "a", "b", "product", "feasible", "infeasible"})
    EXPECT_TRUE(has_text(all, text)) << text;
}

TEST(Map, ExplainsTheKindsThatOccurAlone) {
  EXPECT_FALSE(has_text(elements(figure(8, 3, 100, false)), "infeasible"));
  EXPECT_FALSE(has_text(elements(figure(8, 3, 5, true)), "feasible"));
}

TEST(Map, ValuesHaveColoursFromTheLeastToTheGreatest) {
  const auto all = elements(figure(4, 1, 100, true));  // 0, 1, 2, 3
  EXPECT_EQ(with_fill(all, "#440154"), 1);
  EXPECT_EQ(with_fill(all, "#fde725"), 1);
}

TEST(Map, IsWellFormedWhateverItsSize) {
  for (const auto& [width, height] :
       std::vector<std::pair<std::size_t, std::size_t>>{{1, 1}, {1, 7}, {7, 1}, {900, 5}}) {
    for (const bool values : {false, true}) {
      const auto all = elements(figure(width, height, 3, values));
      for (const test::Element& element : all)
        for (const auto& [key, value] : element.attributes) {
          EXPECT_EQ(value.find("nan"), std::string::npos) << value;
          EXPECT_EQ(value.find("inf"), std::string::npos) << value;
        }
    }
    EXPECT_EQ(svg(figure(width, height, 3, true)), svg(figure(width, height, 3, true)));
  }
}

TEST(Map, StaysSmall) {
  MapFigure large = figure(1000, 1, 3, false);
  large.up.values.clear();
  for (int k = 1; k <= 600; ++k) large.up.values.push_back(k);
  large.maps[0].cells.clear();
  for (std::size_t k = 0; k < 600000; ++k)
    large.maps[0].cells.push_back({0, static_cast<double>(k % 7)});
  EXPECT_LT(svg(large).size(), 8000000U);
}

TEST(Map, OfAnotherSizeThanItsGridIsAFault) {
  MapFigure wrong = figure(3, 2, 1, false);
  wrong.maps[0].cells.pop_back();
  EXPECT_THROW(svg(wrong), std::logic_error);
}

}  // namespace
}  // namespace gainsmith::drawing
