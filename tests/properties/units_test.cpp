// The same problem in other units of its states, outputs, data and time has the same answer: with
// powers of two the same verdict with the same margins to the last digit, otherwise the same
// verdict.
#include <gtest/gtest.h>

#include <optional>

#include "design/synthesize.h"
#include "properties/families.h"
#include "support/yaml_problem.h"

namespace gainsmith::tests::properties {
namespace {

constexpr std::uint64_t kSeed = 0xC1C1C1;
constexpr std::uint64_t kCases = 12;

model::Gains solved(const std::string& family, std::uint64_t index,
                    std::optional<OtherUnits> others) {
  const Case made = make_case(kSeed, index, family, others);
  return design::synthesize(YamlProblem(made.text).instance, {});
}

class UnitsTest : public testing::TestWithParam<std::string> {};

TEST_P(UnitsTest, PowersOfTwoChangeNoDigit) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    if (!make_case(kSeed, index, GetParam()).easy) continue;
    const model::Gains one = solved(GetParam(), index, {});
    const model::Gains other = solved(GetParam(), index, OtherUnits{7, true});
    ASSERT_EQ(one.verdict, other.verdict) << GetParam() << " " << index;
    // Beyond double the coefficients are those of the decimals, which differ in their last digits.
    if (one.solver.precision == "double") {
      EXPECT_EQ(one.solver.iterations, other.solver.iterations) << GetParam() << " " << index;
    }
    ASSERT_EQ(one.margins.size(), other.margins.size());
    for (std::size_t k = 0; k < one.margins.size(); ++k)
      EXPECT_EQ(one.margins[k].reached, other.margins[k].reached) << GetParam() << " " << index;
  }
}

TEST_P(UnitsTest, OtherFactorsChangeNoVerdict) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    if (!make_case(kSeed, index, GetParam()).easy) continue;
    EXPECT_EQ(solved(GetParam(), index, {}).verdict,
              solved(GetParam(), index, OtherUnits{7, false}).verdict)
        << GetParam() << " " << index;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, UnitsTest,
                         testing::Values("lyapunov", "stein", "bounded-real", "observer",
                                         "discrete-observer", "common", "diagonal", "pair", "kink"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace gainsmith::tests::properties
