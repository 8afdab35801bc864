#include "lmi/unknowns.h"

#include <gtest/gtest.h>

#include "lmi/inequalities.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

constexpr const char* kUnknowns = R"(
problem: packing
method:
  method: packing
  data: {A: n x n, C: p x n}
  unknowns: {P: symmetric n, Y: n x p, D: diagonal n, g: scalar}
  require: {positive: P > 0, other: D > 0}
data: {A: [[1, 2, 3], [4, 5, 6], [7, 8, 9]], C: [[1, 0, 0], [0, 1, 0]]}
)";

TEST(UnknownsTest, PackingIsTheDocumentedOne) {
  const tests::YamlProblem yaml(kUnknowns);
  const Unknowns unknowns = Inequalities(yaml.instance).unknowns;
  ASSERT_EQ(unknowns.size(), 6 + 6 + 3 + 1);
  std::vector<double> x;
  for (int i = 1; i <= unknowns.size(); ++i) x.push_back(i);
  const numbers::Values values = unknowns.values(x);
  numbers::Matrix P(3, 3);
  P << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  EXPECT_EQ(values.at("P"), P);
  numbers::Matrix Y(3, 2);
  Y << 7, 10, 8, 11, 9, 12;
  EXPECT_EQ(values.at("Y"), Y);
  EXPECT_EQ(values.at("D"), numbers::Matrix(Eigen::Vector3d(13, 14, 15).asDiagonal()));
  EXPECT_EQ(values.at("g")(0, 0), 16);
}

TEST(UnknownsTest, ScalarsHaveNames) {
  const tests::YamlProblem yaml(kUnknowns);
  const Unknowns unknowns = Inequalities(yaml.instance).unknowns;
  EXPECT_EQ(unknowns.scalar_name(2), "P(2,1)");
  EXPECT_EQ(unknowns.scalar_name(10), "Y(1,2)");
  EXPECT_EQ(unknowns.scalar_name(16), "g");
}

}  // namespace
}  // namespace gainsmith::lmi
