#include "lmi/free_variables.h"

#include <gtest/gtest.h>

#include "lmi/correlation.h"
#include "lmi/formulation.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

std::string minimizing(const std::string& minimize, const std::string& extra = "") {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n"
         "  unknowns: {P: symmetric n, g: scalar, h: scalar}\n"
         "  require:\n    positive: P > I\n    bound: \"[P, A; *, g*I] > 0\"\n    below: \"[P, A; "
         "*, -h*I] > 0\"\n" +
         extra + "  minimize: " + minimize + "\ndata: {A: [[0, 1], [3, 1]]}\n";
}

TEST(ReleaseTest, ScalarsWithoutAPriceAreReleasedWithTheirRows) {
  const tests::YamlProblem yaml(minimizing("trace(P)"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const FreeVariables free_variables = find_free_variables(lmi, {}, true);
  ASSERT_EQ(free_variables.list.size(), 2U);
  EXPECT_TRUE(free_variables.contains(4));
  EXPECT_EQ(free_variables.list[0].sign, 1);
  EXPECT_EQ(free_variables.list[1].sign, -1);
  EXPECT_EQ(free_variables.kept[0], (std::vector<int>{0, 1}));
  EXPECT_EQ(free_variables.kept[1], (std::vector<int>{0, 1}));
}

TEST(ReleaseTest, APriceOrAnotherUseKeepsThem) {
  const tests::YamlProblem priced(minimizing("trace(P) + g - h"));
  EXPECT_TRUE(find_free_variables(compile(Inequalities(priced.instance)), {}, true).list.empty());
  const tests::YamlProblem capped(minimizing("trace(P) - h", "    cap: g <= 100\n"));
  EXPECT_TRUE(find_free_variables(compile(Inequalities(capped.instance)), {}, true).list.empty());
}

/// g1 and g2 have no price and would take both rows of one block.
TEST(ReleaseTest, NoBlockLosesAllItsRowsToSeveralScalars) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {g1: scalar, g2: scalar, t: scalar}\n"
      "  require:\n    both: \"[g1, 1; *, g2] > 0\"\n    price: t > 1\n  minimize: t\n");
  const FreeVariables free_variables =
      find_free_variables(compile(Inequalities(yaml.instance)), {}, true);
  EXPECT_EQ(free_variables.list.size(), 1U);
  for (const std::vector<int>& rows : free_variables.kept) EXPECT_EQ(rows.size(), 1U);
}

/// A price is none where the objective does not count.
TEST(ReleaseTest, WithoutTheObjectiveAPricedScalarIsFreeToo) {
  const tests::YamlProblem priced(minimizing("trace(P) + g - h"));
  const Lmi lmi = compile(Inequalities(priced.instance));
  const FreeVariables free_variables = find_free_variables(lmi, {}, false);
  EXPECT_TRUE(free_variables.contains(4));
  EXPECT_TRUE(free_variables.contains(5));
  // Another block that needs the scalar finite keeps it.
  const std::vector<Block> others = {lmi.blocks[1]};
  EXPECT_FALSE(find_free_variables(lmi, others, false).contains(4));
  EXPECT_TRUE(find_free_variables(lmi, others, false).contains(5));
}

TEST(ReleaseTest, RestoredScalarsSatisfyTheWholeBlocks) {
  const tests::YamlProblem yaml(minimizing("trace(P)"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const FreeVariables free_variables = find_free_variables(lmi, {}, true);
  std::vector<const Block*> blocks;
  for (const Block& block : lmi.blocks) blocks.push_back(&block);
  const Balance units = balance(blocks, lmi.unknowns, lmi.objective);
  std::vector<double> x = {2, 0.5, 3, 0, 0};
  const numbers::Matrix P = (numbers::Matrix(2, 2) << 2, 0.5, 0.5, 3).finished();
  restore(lmi, free_variables, units, x);
  EXPECT_GT(x[3], 0);
  EXPECT_LT(x[4], 0);
  // At least half of what the rows without g and h have.
  for (std::size_t k = 1; k < 3; ++k)
    EXPECT_GE(correlation_margin(lmi.blocks[k].value(x)), 0.5 * correlation_margin(P) - 1e-12);
}

/// The size that a scalar is given follows its unit.
TEST(ReleaseTest, RestoringDoesNotDependOnUnits) {
  const auto restored = [](const std::string& unit) {
    const tests::YamlProblem yaml(
        "problem: p\nmethod:\n  method: m\n  unknowns: {P: symmetric 2, g: scalar}\n  require:\n"
        "    bound: \"[P, [1; 3]; *, " +
        unit + "*g] > 0\"\n    size: P > I\n  minimize: trace(P)\n");
    const Lmi lmi = compile(Inequalities(yaml.instance));
    std::vector<const Block*> blocks;
    for (const Block& block : lmi.blocks) blocks.push_back(&block);
    std::vector<double> x = {2, 0.5, 3, 0};
    restore(lmi, find_free_variables(lmi, {}, true), balance(blocks, lmi.unknowns, lmi.objective),
            x);
    return x[3];
  };
  EXPECT_EQ(restored("1"), 1048576 * restored("1048576"));
}

}  // namespace
}  // namespace gainsmith::lmi
