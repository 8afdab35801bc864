#include "lmi/release.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "lmi/formulation.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

std::string problem_with(const std::string& minimize, const std::string& extra = "") {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n"
         "  unknowns: {P: symmetric n, g: scalar, h: scalar}\n"
         "  require:\n    positive: P > I\n    bound: \"[P, A; *, g*I] > 0\"\n    below: \"[P, A; "
         "*, -h*I] > 0\"\n" +
         extra + "  minimize: " + minimize + "\ndata: {A: [[0, 1], [3, 1]]}\n";
}

TEST(ReleaseTest, ScalarsWithoutAPriceAreReleasedWithTheirRows) {
  const tests::YamlProblem yaml(problem_with("trace(P)"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const Releases releases = find_releases(lmi, {});
  ASSERT_EQ(releases.list.size(), 2U);
  EXPECT_TRUE(releases.released(4));
  EXPECT_EQ(releases.list[0].sign, 1);
  EXPECT_EQ(releases.list[1].sign, -1);
  EXPECT_EQ(releases.kept[0], (std::vector<int>{0, 1}));
  EXPECT_EQ(releases.kept[1], (std::vector<int>{0, 1}));
}

TEST(ReleaseTest, APriceOrAnotherUseKeepsThem) {
  const tests::YamlProblem priced(problem_with("trace(P) + g - h"));
  EXPECT_TRUE(find_releases(compile(Inequalities(priced.instance)), {}).list.empty());
  const tests::YamlProblem capped(problem_with("trace(P) - h", "    cap: g <= 100\n"));
  EXPECT_TRUE(find_releases(compile(Inequalities(capped.instance)), {}).list.empty());
}

/// g1 and g2 have no price and would take both rows of one block.
TEST(ReleaseTest, NoBlockLosesAllItsRowsToSeveralScalars) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {g1: scalar, g2: scalar, t: scalar}\n"
      "  require:\n    both: \"[g1, 1; *, g2] > 0\"\n    price: t > 1\n  minimize: t\n");
  const Releases releases = find_releases(compile(Inequalities(yaml.instance)), {});
  EXPECT_EQ(releases.list.size(), 1U);
  for (const std::vector<int>& rows : releases.kept) EXPECT_EQ(rows.size(), 1U);
}

TEST(ReleaseTest, RestoredScalarsSatisfyTheWholeBlocks) {
  const tests::YamlProblem yaml(problem_with("trace(P)"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const Releases releases = find_releases(lmi, {});
  std::vector<double> x = {2, 0, 2, 0, 0};
  const std::vector<double> required = {0.5, 0.5, 0.5};
  restore(lmi, releases, required, x);
  EXPECT_GT(x[3], 0);
  EXPECT_LT(x[4], 0);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_GE(
        Eigen::SelfAdjointEigenSolver<numbers::Matrix>(lmi.blocks[k].value(x)).eigenvalues()(0),
        0.995 * required[k]);
}

}  // namespace
}  // namespace gainsmith::lmi
