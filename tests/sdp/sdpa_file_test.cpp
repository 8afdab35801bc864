#include "sdp/files/sdpa_file.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace gainsmith::sdp {
namespace {

const char* const kExample =
    "\"A comment\n"
    "* another\n"
    "2 = mDIM\n"
    "2 =nBLOCK\n"
    "(2, -2) = bLOCKsTRUCT\n"
    "{10.0, +2e1}\n"
    "0 1 1 1 1\n"
    "1.0 1 2 1 -3.5\n"
    "\n"
    "2 2 2 2 0\n"
    "2 2 1 1 4";

TEST(SdpaFile, ReadsCommentsRemarksBracesAndMirroredEntries) {
  const Problem problem = read_sdpa(kExample, "example");
  EXPECT_EQ(problem.blocks, (std::vector<Block>{{2, false}, {2, true}}));
  EXPECT_EQ(problem.c, (std::vector<double>{10, 20}));
  ASSERT_EQ(problem.f.size(), 3U);
  EXPECT_EQ(problem.f[0], (std::vector<Entry>{{0, 0, 0, 1}}));
  EXPECT_EQ(problem.f[1], (std::vector<Entry>{{0, 0, 1, -3.5}}));
  EXPECT_EQ(problem.f[2], (std::vector<Entry>{{1, 0, 0, 4}}));
}

/// The place of the error that `text` gives.
std::string error_of(const std::string& text) {
  try {
    read_sdpa(text, "f");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SdpaFile, NamesThePlaceOfEveryFault) {
  const std::string head = "1\n1\n2\n1.0\n";
  EXPECT_EQ(error_of(""), "f:1:1: expected the number of variables, found the end of the file");
  EXPECT_EQ(error_of("x\n"), "f:1:1: expected the number of variables, found 'x'");
  EXPECT_EQ(error_of("1\n1\n2\n"), "f:4:1: expected a cost, found the end of the file");
  EXPECT_EQ(error_of("1\n1\n2"), "f:3:2: expected a cost, found the end of the file");
  EXPECT_EQ(error_of("1.5\n"), "f:1:1: the number of variables must be a whole number, not '1.5'");
  EXPECT_EQ(error_of("1\n1\n0\n1\n"), "f:3:1: a block has no rows");
  EXPECT_EQ(error_of("1\n1\n2\nnan\n"), "f:4:1: a cost is not finite");
  EXPECT_EQ(error_of(head + "0 1 1\n"), "f:5:6: expected a column, found the end of the line");
  EXPECT_EQ(error_of(head + "0 1 1 3 1\n"), "f:5:7: a column must be from 1 to 2, not 3");
  EXPECT_EQ(error_of(head + "2 1 1 1 1\n"),
            "f:5:1: the number of a matrix must be from 0 to 1, not 2");
  EXPECT_EQ(error_of(head + "1 2 1 1 1\n"),
            "f:5:3: the number of a block must be from 1 to 1, not 2");
  EXPECT_EQ(error_of(head + "1 1 1 1 inf\n"), "f:5:9: a value is not finite");
  EXPECT_EQ(error_of(head + "1 1 1 1 1 1\n"),
            "f:5:11: more than five numbers on the line of an entry");
  EXPECT_EQ(error_of(head + "1e88 1 1 1 1\n"),
            "f:5:1: the number of a matrix must be from 0 to 1, not 1e+88");
  EXPECT_EQ(error_of(head + "1 1 1 1 1e999\n"), "f:5:9: a value is out of the range of a double");
  EXPECT_EQ(error_of(head + "1 1 1 1 0x1\n"), "f:5:9: expected a value, found '0x1'");
  EXPECT_EQ(error_of("1\n1\n-2\n1\n1 1 1 2 1\n"),
            "f:5:7: an off-diagonal entry in a diagonal block");
}

TEST(SdpaFile, KeepsWhatRoundingTakesFromADecimal) {
  const std::string head = "1\n1\n5\n0.1\n";
  const Problem problem =
      read_sdpa(head +
                    "1 1 1 1 0.1\n1 1 2 2 -1.00000000000000000001\n"
                    "1 1 3 3 12.5e-1\n1 1 4 4 123456789012345678\n1 1 5 5 1e25\n",
                "f");
  const auto& f = problem.f[1];
  // The double nearest to 0.1 is 0.1000000000000000055511151231257827...
  EXPECT_DOUBLE_EQ(f[0].rest, -5.551115123125783e-18);
  EXPECT_DOUBLE_EQ(problem.c_rest[0], f[0].rest);
  EXPECT_DOUBLE_EQ(f[1].rest, -1e-20);
  EXPECT_EQ(f[2].rest, 0);
  EXPECT_EQ(f[3].rest, 123456789012345678LL - static_cast<long long>(f[3].value));
  EXPECT_EQ(f[4].rest, -905969664.0);  // the double nearest to 1e25 is 10000000000000000905969664
}

TEST(SdpaFile, AZeroMayHaveAnyExponent) {
  const Problem problem = read_sdpa("1\n1\n-1\n0.0e-2147483648\n1 1 1 1 2\n", "f");
  EXPECT_EQ(problem.c, (std::vector<double>{0}));
  EXPECT_EQ(problem.c_rest, (std::vector<double>{0}));
}

TEST(SdpaFile, RefusesTheSamePlaceTwiceAndBothTriangles) {
  const std::string head = "1\n1\n2\n1.0\n";
  EXPECT_NE(error_of(head + "1 1 1 2 1\n1 1 1 1 1\n1 1 1 2 1\n")
                .find("f:7:1: matrix 1, block 1: entry (1, 2)"),
            std::string::npos);
  EXPECT_NE(error_of(head + "1 1 1 2 1\n1 1 2 1 1\n").find("given on line 5 already"),
            std::string::npos);
}

}  // namespace
}  // namespace gainsmith::sdp
