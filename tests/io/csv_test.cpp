#include "io/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace gainsmith::io {
namespace {

TEST(Csv, HasALineOfNamesAndALineForEachRow) {
  const std::vector<std::string> names = {"t", "j", "z1"};
  const numbers::Matrix table{{0, 0, 1.5}, {0.25, 1, -2}};
  EXPECT_EQ(to_csv(names, table), "t,j,z1\n0,0,1.5\n0.25,1,-2\n");
}

TEST(Csv, NumbersReadBackToTheSameDoubles) {
  const std::vector<std::string> names = {"a"};
  numbers::Matrix table(4, 1);
  table << 0.1, std::nextafter(1, 2), std::numeric_limits<double>::denorm_min(), -1e300 / 3;
  std::istringstream lines(to_csv(names, table));
  std::string line;
  std::getline(lines, line);
  for (double expected : table.reshaped()) {
    std::getline(lines, line);
    EXPECT_EQ(std::strtod(line.c_str(), nullptr), expected) << line;
  }
}

TEST(Csv, CellsThatNeedItAreQuoted) {
  const std::vector<std::string> cells = {"a", "Y(1, 2)", "say \"x\"", "two\nlines", ""};
  std::string text;
  add_csv_line(cells, text);
  EXPECT_EQ(text, "a,\"Y(1, 2)\",\"say \"\"x\"\"\",\"two\nlines\",\n");
}

TEST(Csv, TableWithoutRowsIsItsNames) {
  const std::vector<std::string> names = {"t", "j"};
  EXPECT_EQ(to_csv(names, numbers::Matrix(0, 2)), "t,j\n");
}

}  // namespace
}  // namespace gainsmith::io
