// A few hundred problems with known answers. `verdict_generator` runs as many as one likes; its
// seeds are 1, 2, ...: those here were never looked at while the program was written.
#include <gtest/gtest.h>

#include "design/synthesize.h"
#include "properties/judge.h"
#include "support/yaml_problem.h"

namespace gainsmith::tests::properties {
namespace {

constexpr std::uint64_t kCases = 240;
constexpr std::uint64_t kEdgeCases = 60;

TEST(VerdictsTest, AreNeverWrong) {
  int undecided = 0;
  for (std::uint64_t index = 0; index < kCases; ++index) {
    const Case known = make_case(kSeed, index);
    const Answer answer = judge(known);
    EXPECT_NE(answer.outcome, Outcome::wrong) << record(known, answer);
    if (known.easy) {
      EXPECT_EQ(answer.outcome, Outcome::right) << record(known, answer);
    }
    undecided += answer.outcome == Outcome::undecided;
  }
  // Most of them are singular: pairs that only equality satisfies, and borders that are attained.
  EXPECT_LE(undecided, static_cast<int>(kCases / 20));
}

/// Thin, far and singular sets of solutions may be undecided.
TEST(VerdictsTest, AreNeverWrongAtTheEdges) {
  for (std::uint64_t index = 0; index < kEdgeCases; ++index) {
    const Case known = make_case(kSeed, index, "edges");
    const Answer answer = judge(known);
    EXPECT_NE(answer.outcome, Outcome::wrong) << record(known, answer);
  }
}

/// The certificate lives on the first two coordinates, those of the unstable modes 0.12 +- i; what
/// more digits leave elsewhere is noise. Solved again on them it is exact.
TEST(VerdictsTest, ACertificateOnFewCoordinatesIsExact) {
  const YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0, decrease: He(P*A) < 0}\ndata:\n"
      "  A: [[0.12, 1, -1, -2], [-1, 0.12, 0, -1], [0, 0, -0.5, 2], [0, 0, -2, -0.5]]\n");
  const model::Gains found = design::synthesize(yaml.instance, {});
  ASSERT_EQ(found.verdict, model::Verdict::no) << found.solver.message;
  ASSERT_TRUE(found.certificate);
  EXPECT_TRUE(found.certificate->exact);
  for (const auto& [name, Y] : found.certificate->multipliers) {
    EXPECT_EQ(Y.bottomRows(2).norm(), 0) << name;
    EXPECT_GT(Y.trace(), 0) << name;
  }
}

/// P = diag(10000, 1) solves it. The multipliers of the two blocks with >= cancel; none of P > 0.
TEST(VerdictsTest, MultipliersOfBlocksThatMayBeZeroExcludeNothing) {
  const YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0, least: He(P*A) >= 0, most: He(P*A) <= 0}\ndata:\n"
      "  A: [[0, 0.4], [-4000, 0]]\n");
  EXPECT_NE(design::synthesize(yaml.instance, {}).verdict, model::Verdict::no);
}

}  // namespace
}  // namespace gainsmith::tests::properties
