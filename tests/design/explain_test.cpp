#include "design/explain.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "design/synthesize.h"
#include "support/stop.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using tests::YamlProblem;

/// x >= c and x <= 1 conflict for c > 1; y has nothing to do with it.
const std::string kGap = R"(problem: gap
method:
  method: gap
  data: {c: scalar, d: {shape: scalar, default: 1}}
  unknowns: {x: scalar, y: symmetric 2}
  require:
    other: y > d*I
    floor: x > c
    middle: x > -7
    ceiling: {forall: "s in {1, 2}", that: "s*x < s"}
  minimize: trace(y)
data: {c: 3}
negotiable: {c: [-2, 5], d: [0, 9]}
)";

TEST(Explain, NamesTheConflictWhatItTakesAndHowFar) {
  const YamlProblem problem(kGap);
  const Explanation found = explain(problem.instance, {});
  ASSERT_EQ(found.gains.verdict, model::Verdict::no);
  ASSERT_TRUE(found.conflict);
  EXPECT_EQ(found.conflict->names, (std::vector<std::string>{"floor", "ceiling"}));
  EXPECT_TRUE(found.conflict->undecided.empty());
  EXPECT_TRUE(found.conflict->certificate.exact ||
              found.conflict->certificate.backward_error <= 1e-30);
  EXPECT_FALSE(found.conflict->gain_bound);
  ASSERT_EQ(found.relaxations.size(), 4U);
  for (const Relaxation& relaxation : found.relaxations) {
    const bool helps = relaxation.name == "floor" || relaxation.name == "ceiling";
    EXPECT_EQ(relaxation.alone.has_value(), helps) << relaxation.name;
    ASSERT_TRUE(relaxation.together);
    EXPECT_TRUE(helps || *relaxation.together == 0) << relaxation.name;
  }
  // x > 3 must give 2; s x < s must give 2 s, so 4 at its harder point.
  EXPECT_NEAR(*found.relaxations[1].alone * found.relaxations[1].scale, 2, 1e-4);
  EXPECT_NEAR(*found.relaxations[3].alone * found.relaxations[3].scale, 4, 1e-4);
  ASSERT_EQ(found.reaches.size(), 2U);
  EXPECT_TRUE(found.reaches[0].at_most);
  EXPECT_EQ(found.reaches[0].value, 3);
  EXPECT_NEAR(*found.reaches[0].feasible, 1, 1e-4);
  EXPECT_LE(*found.reaches[0].feasible, 1);
  EXPECT_TRUE(found.reaches[0].certificate.value().exact);
  EXPECT_GE(*found.reaches[0].beyond, 1 - 1e-6);
  EXPECT_EQ(found.reaches[1].name, "d");
  EXPECT_FALSE(found.reaches[1].feasible);
}

/// The solver's guess is checked: the same names in little work, and all of them without any.
TEST(Explain, AGuessedConflictIsCheckedOrSaysWhatIsOpen) {
  const YamlProblem problem(kGap);
  const model::Gains gains = synthesize(problem.instance, {});
  const auto found = find_conflict(problem.instance, gains, {});
  const auto guessed = guess_conflict(problem.instance, gains, {}, 10);
  ASSERT_TRUE(found && guessed);
  EXPECT_EQ(guessed->names, found->names);
  EXPECT_TRUE(guessed->undecided.empty());
  EXPECT_TRUE(guessed->certificate.exact || guessed->certificate.backward_error <= 1e-30);
  const auto none = guess_conflict(problem.instance, gains, {}, 0);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->names.size(), 4U);
  EXPECT_EQ(none->undecided.size(), 4U);
  const YamlProblem feasible(std::string(kGap).replace(kGap.find("{c: 3}"), 6, "{c: 0}"));
  EXPECT_FALSE(guess_conflict(feasible.instance, synthesize(feasible.instance, {}), {}, 10));
}

/// A chain is one requirement with one slack.
TEST(Explain, AChainAloneCanConflict) {
  const YamlProblem problem(
      "problem: chain\nmethod:\n  method: m\n  unknowns: {x: scalar}\n"
      "  require: {range: 2 < x < 1}\ndata: {}\n");
  const Explanation found = explain(problem.instance, {});
  ASSERT_TRUE(found.conflict);
  EXPECT_EQ(found.conflict->names, std::vector<std::string>{"range"});
  EXPECT_NEAR(*found.relaxations[0].alone * found.relaxations[0].scale, 0.5, 1e-4);
}

/// trace(y) falls by 2 t with y > I - t I; x has nothing to do with it, and c may rise to 1.
TEST(Explain, AFeasibleProblemSaysWhatLimitsItAndHowFarItsScalarsGo) {
  const YamlProblem feasible(std::string(kGap).replace(kGap.find("{c: 3}"), 6, "{c: 0}"));
  const Explanation found = explain(feasible.instance, {});
  EXPECT_EQ(found.gains.verdict, model::Verdict::yes);
  EXPECT_FALSE(found.conflict);
  EXPECT_TRUE(found.relaxations.empty());
  ASSERT_TRUE(found.limits);
  ASSERT_EQ(found.limits->active.size(), 1U);
  EXPECT_EQ(found.limits->active[0].name, "other");
  EXPECT_NEAR(found.limits->active[0].price, 2, 1e-5);
  EXPECT_EQ(found.limits->inactive, (std::vector<std::string>{"floor", "middle", "ceiling"}));
  ASSERT_GE(found.reaches.size(), 2U);
  EXPECT_TRUE(found.reaches[0].at_most);
  EXPECT_NEAR(*found.reaches[0].feasible, 1, 1e-3);
  EXPECT_LE(*found.reaches[0].feasible, 1);
  ASSERT_TRUE(found.reaches[0].conflict);
  EXPECT_EQ(found.reaches[0].conflict->names, (std::vector<std::string>{"floor", "ceiling"}));
  EXPECT_FALSE(found.reaches[1].at_most);
  EXPECT_EQ(found.reaches[1].feasible, -2);
  EXPECT_FALSE(found.reaches[1].conflict);
}

/// Without it nothing is left, and nothing bounds the objective; or what is left has the solution 0.
TEST(Explain, WithoutTheOnlyRequirementThereIsNoMinimum) {
  const YamlProblem one(
      "problem: p\nmethod:\n  method: m\n  unknowns: {P: symmetric 2, g: scalar}\n"
      "  require: {norm: \"blkdiag(P - I, g*I - P) > 0\"}\n  minimize: g\ndata: {}\n");
  const Explanation found = explain(one.instance, {});
  ASSERT_TRUE(found.limits);
  ASSERT_EQ(found.limits->active.size(), 1U);
  EXPECT_TRUE(found.limits->active[0].without->unbounded);
  const YamlProblem zero(
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n"
      "  require: {floor: x > 1, cone: x >= 0}\n  minimize: x\ndata: {}\n");
  const Explanation left = explain(zero.instance, {});
  ASSERT_TRUE(left.limits);
  ASSERT_EQ(left.limits->active.size(), 1U);
  EXPECT_TRUE(left.limits->active[0].without->homogeneous);
}

/// A solve that decides nothing does not make the gain bound the conflict.
TEST(Explain, AnUndecidedRestIsNotBlamedOnTheGainBound) {
  for (const bool with_gains : {false, true}) {
    const YamlProblem problem(
        std::string("problem: bound\nmethod:\n  method: m\n  unknowns: {x: scalar}\n"
                    "  require: {floor: x > 5, ceiling: x < 4}\n") +
        (with_gains ? "  gains: {K: x}\n" : ""));
    const model::Gains gains = synthesize(problem.instance, {});
    const tests::StopInTest stop;
    sdp::Options stopped;
    stopped.progress = [](const sdp::Progress&) { request_stop(); };
    const auto conflict = find_conflict(problem.instance, gains, stopped);
    ASSERT_TRUE(conflict);
    EXPECT_FALSE(conflict->gain_bound);
    EXPECT_EQ(conflict->names, (std::vector<std::string>{"floor", "ceiling"}));
    for (const std::string& name : conflict->names)
      EXPECT_EQ(std::count(conflict->undecided.begin(), conflict->undecided.end(), name), 1);
  }
}

/// K must be 5, the bound allows 1: that is no conflict of inequalities.
TEST(Explain, AGainBoundThatIsTooTightIsNamed) {
  const YamlProblem problem(
      "problem: bound\nmethod:\n  method: m\n  unknowns: {x: scalar}\n"
      "  require: {floor: x > 5}\n  minimize: x\n  gains: {K: x}\n"
      "synthesis: {gain_bound: 1}\n");
  const Explanation found = explain(problem.instance, {});
  ASSERT_EQ(found.gains.verdict, model::Verdict::undecided);
  EXPECT_GT(found.gains.bound_only.value(), 5);
  EXPECT_NE(found.gains.solver.message.find("raise synthesis.gain_bound"), std::string::npos);
  EXPECT_FALSE(found.conflict);
  EXPECT_TRUE(found.relaxations.empty());
}

/// Without an objective and homogeneous: P > 0 and He(P A) < 0 for an unstable A.
TEST(Explain, AHomogeneousConflict) {
  const YamlProblem problem(
      "problem: unstable\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0, decrease: He(P*A) < 0, weak: P >= 0}\n"
      "data: {A: [[1, 0], [0, -1]]}\n");
  const Explanation found = explain(problem.instance, {});
  ASSERT_TRUE(found.conflict);
  EXPECT_EQ(found.conflict->names, (std::vector<std::string>{"positive", "decrease"}));
}

/// What the test at the vertices excludes is no conflict of the inequalities, but how far one must
/// go for it is known.
TEST(Explain, GainsAtTheVertices) {
  const YamlProblem problem(R"yaml(problem: vertices
method:
  method: m
  data: {F: n x n, H: p x n, rho: scalar}
  unknowns: {Q: symmetric n, Y: {shape: n x p, of: s}}
  let: {S(t): "(Q - Y(t)*H)*expm(F*t)"}
  require:
    size: I <= Q <= 100*I
    step: {forall: "tau in [0.1, 1.4]", that: "[rho^2*Q, S(tau)'; *, Q] > 0"}
data: {F: [[0, -2], [2, 0]], H: [[1, 0]], rho: 0.2}
negotiable: {rho: [0.1, 1]}
synthesis: {forall: vertex_gains}
)yaml");
  const Explanation found = explain(problem.instance, {});
  ASSERT_EQ(found.gains.verdict, model::Verdict::undecided);
  EXPECT_EQ(found.gains.certificate.value().about, "vertices");
  EXPECT_FALSE(found.conflict);
  ASSERT_EQ(found.reaches.size(), 1U);
  EXPECT_FALSE(found.reaches[0].at_most);
  const model::Gains there =
      synthesize_at(problem.instance.design, {{"rho", *found.reaches[0].feasible}}, {});
  EXPECT_EQ(there.verdict, model::Verdict::yes);
}

}  // namespace
}  // namespace gainsmith::design
