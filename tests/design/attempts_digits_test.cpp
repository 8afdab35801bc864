// When attempts ask for more digits of large programs, and what waits for more points.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "design/attempts.h"
#include "design/scripted.h"

namespace gainsmith::design {
namespace {

using model::Verdict;
using testing::Case;
using testing::refuting;
using testing::Scripted;

using AttemptKinds = std::vector<AttemptKind>;

/// low < x < high.
std::string open_window(const std::string& low, const std::string& high) {
  return "  unknowns: {x: scalar}\n  require: {low: x > " + low + ", high: x < " + high + "}\n";
}

/// x > 1 and x < 1 + 1e-8, each 61 times: more than 120 rows, and multipliers that nearly exclude
/// x.
std::string large_window(const std::string& high) {
  std::string require;
  for (int k = 1; k <= 61; ++k) {
    const std::string name = std::to_string(k);
    require += (k > 1 ? ", " : "") + ("a" + name) + ": x > sqrt(1), b" + name + ": x < " + high;
  }
  return "  unknowns: {x: scalar}\n  require: {" + require + "}\n";
}

/// Of large programs 100 digits are asked for the certificate alone, where multipliers in double
/// speak for one.
TEST(Attempts, LargeProgramsAreTriedIn100DigitsWhereMultipliersExcludeThem) {
  const std::vector<double> nearly(122, 1.0);
  const Case near(large_window("1.00000001*sqrt(1)"));
  const Scripted run(refuting(near, nearly), near);
  EXPECT_EQ(run.tried, (AttemptKinds{AttemptKind::inside, AttemptKind::in_31_digits,
                                     AttemptKind::in_100_digits}));
  EXPECT_EQ(run.gains.verdict, Verdict::undecided);
  ASSERT_GE(run.efforts.size(), 3U);
  EXPECT_EQ(run.efforts[1].precision, "double") << "the least violation";
  EXPECT_EQ(run.efforts[2].precision, "100") << "before 31 digits";
  EXPECT_TRUE(run.at(AttemptKind::in_100_digits).question.single);
  EXPECT_EQ(std::count_if(run.efforts.begin(), run.efforts.end(),
                          [](const Effort& effort) { return effort.precision == "100"; }),
            1)
      << "one program alone";
  // Multipliers that exclude nothing.
  const Case far(large_window("2*sqrt(1)"));
  const Scripted none(refuting(far, nearly), far);
  EXPECT_EQ(none.tried, (AttemptKinds{AttemptKind::inside, AttemptKind::in_31_digits}));
  // Small programs have the largest margin in 100 digits, after 31.
  const Case small(open_window("sqrt(1)", "1.00000001*sqrt(1)"));
  const Scripted last(refuting(small, {1, 1}), small);
  EXPECT_EQ(last.tried, (AttemptKinds{AttemptKind::inside, AttemptKind::in_31_digits,
                                      AttemptKind::in_100_digits}));
  EXPECT_EQ(last.efforts[2].precision, "quad");
  EXPECT_FALSE(last.at(AttemptKind::in_100_digits).question.single);
}

/// More digits wait while points may be added, but for nothing else.
TEST(Attempts, DigitsWaitForPoints) {
  const Case near(large_window("1.00000001*sqrt(1)"));
  const Case far(large_window("2*sqrt(1)"));
  const Case small(open_window("sqrt(1)", "1.00000001*sqrt(1)"));
  const auto tried = [](const Case& of, bool thin) {
    Posed posed = of.posed();
    posed.thin = thin;
    const std::vector<double> Y(of.lmi.blocks.size(), 1.0);
    Climb climb(posed, of.bounds, [&](const sdp::Problem& problem, const Effort&) {
      return refuting(of, Y)(problem);
    });
    climb.to_end();
    return std::make_pair(climb.waits_for_points(),
                          climb.find(AttemptKind::in_31_digits) != nullptr);
  };
  EXPECT_EQ(tried(near, true), std::make_pair(true, false));
  EXPECT_EQ(tried(near, false), std::make_pair(false, true));
  EXPECT_EQ(tried(far, true), std::make_pair(false, true));
  EXPECT_EQ(tried(small, true), std::make_pair(false, true));
}

}  // namespace
}  // namespace gainsmith::design
