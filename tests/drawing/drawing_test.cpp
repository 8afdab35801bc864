#include "drawing/drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "base/number.h"
#include "base/random.h"

namespace gainsmith::drawing {
namespace {

TEST(Pixels, HaveAtMostOneDecimal) {
  EXPECT_EQ(pixels(0), "0");
  EXPECT_EQ(pixels(120), "12");
  EXPECT_EQ(pixels(-3), "-0.3");
  EXPECT_EQ(pixels(12.34), "12.3");
  EXPECT_EQ(pixels(-0.04), "0");
  for (int tenths = -3000; tenths <= 3000; ++tenths)
    ASSERT_EQ(parse_decimal(pixels(tenths)), tenths / 10.0);
}

/// The points of "M1,2l3,4 5-6": numbers one after the other, with differences behind the first
/// pair.
Polyline read_path(const std::string& text) {
  std::vector<int> tenths;
  for (std::size_t k = 0; k < text.size();) {
    const bool negative = text[k] == '-';
    if (!negative && std::isdigit(static_cast<unsigned char>(text[k])) == 0) {
      ++k;
      continue;
    }
    std::size_t end = k + 1;
    while (end < text.size() &&
           (text[end] == '.' || std::isdigit(static_cast<unsigned char>(text[end])) != 0))
      ++end;
    tenths.push_back(static_cast<int>(std::lround(10 * *parse_decimal(text.substr(k, end - k)))));
    k = end;
  }
  Polyline line;
  for (std::size_t k = 0; k + 1 < tenths.size(); k += 2)
    line.push_back(line.empty() ? Point{tenths[0], tenths[1]}
                                : Point{line.back().x + tenths[k], line.back().y + tenths[k + 1]});
  return line;
}

TEST(Path, LeadsThroughThePoints) {
  EXPECT_EQ(path({{10, 25}, {20, 5}, {15, 5}}), "M1,2.5l1-2-0.5,0");
  RandomStream draw(1, 0);
  for (int k = 0; k < 500; ++k) {
    Polyline line;
    for (int i = 0; i < 20; ++i)
      line.push_back(
          {static_cast<int>(9000 * draw.uniform()), static_cast<int>(100 * draw.uniform())});
    ASSERT_EQ(read_path(path(line)), line);
  }
}

TEST(Colours, AreDistinct) {
  std::set<std::string> names;
  constexpr int most = 100;  // runs of one picture
  for (int colour = 0; colour < most; ++colour) names.insert(colour_name(colour));
  EXPECT_EQ(names.size(), most);
  for (const std::string& name : names) EXPECT_EQ(name.size(), 7U) << name;
  EXPECT_EQ(colour_name(-1), colour_name(0));
}

}  // namespace
}  // namespace gainsmith::drawing
