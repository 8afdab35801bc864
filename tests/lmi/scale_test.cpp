// Homogeneous inequalities whose solutions all have one scalar of one sign.
#include "lmi/scale.h"

#include <gtest/gtest.h>

#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

struct Stated {
  explicit Stated(const std::string& method)
      : yaml("problem: p\nmethod:\n  method: m\n" + method), of(yaml.instance), lmi(compile(of)) {}
  tests::YamlProblem yaml;
  Inequalities of;
  Lmi lmi;
  std::optional<Scale> scale() const { return find_scale(lmi, of.unknowns); }
};

TEST(ScaleTest, IsANumberThatADiagonalElementOfAStrictBlockHasAlone) {
  const Stated bounded(
      "  unknowns: {P: symmetric 2, q: scalar}\n"
      "  require: {b: \"[P - q*eye(2), ones(2, 1)*q; *, -3*q] < 0\"}\n");
  const auto scale = bounded.scale();
  ASSERT_TRUE(scale);
  EXPECT_EQ(scale->unknown, 4);
  EXPECT_EQ(scale->sign, 1);
  EXPECT_EQ(scale->block, 0U);
  EXPECT_EQ(scale->row, 2);

  const Lmi one = scaled(bounded.lmi, *scale);
  EXPECT_EQ(one.unknowns, 3);
  EXPECT_FALSE(is_homogeneous(one.blocks));
  const std::vector<double> P = {0.5, -0.25, 2};
  std::vector<double> x = P;
  x.push_back(1);
  EXPECT_EQ(one.blocks[0].value(P), bounded.lmi.blocks[0].value(x));
}

TEST(ScaleTest, MayBeNegative) {
  const Stated below("  unknowns: {q: scalar, r: scalar}\n  require: {a: q < 0, b: q + r > 0}\n");
  const auto scale = below.scale();
  ASSERT_TRUE(scale);
  EXPECT_EQ(scale->unknown, 1);
  EXPECT_EQ(scale->sign, -1);
  const Lmi one = scaled(below.lmi, *scale);
  EXPECT_EQ(one.blocks[0].value({7}), below.lmi.blocks[0].value({-1, 7}));
  EXPECT_EQ(one.blocks[1].value({7}), below.lmi.blocks[1].value({-1, 7}));
}

TEST(ScaleTest, IsNoneBesideConstantsOfMatricesAndWhereZeroIsAllowed) {
  EXPECT_FALSE(Stated("  unknowns: {q: scalar}\n  require: {a: q > 0, b: q < 1}\n").scale());
  EXPECT_FALSE(Stated("  unknowns: {P: symmetric 2}\n  require: {a: P > 0}\n").scale());
  EXPECT_FALSE(
      Stated("  unknowns: {q: scalar, r: scalar}\n  require: {a: q >= 0, b: q + r > 0}\n").scale());
}

}  // namespace
}  // namespace gainsmith::lmi
