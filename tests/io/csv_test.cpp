#include "io/matrix/csv.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gainsmith::io {
namespace {

TEST(Csv, CellsThatNeedItAreQuoted) {
  const std::vector<std::string> cells = {"a", "Y(1, 2)", "say \"x\"", "two\nlines", ""};
  std::string text;
  add_csv_line(cells, text);
  EXPECT_EQ(text, "a,\"Y(1, 2)\",\"say \"\"x\"\"\",\"two\nlines\",\n");
}

}  // namespace
}  // namespace gainsmith::io
