#include "design/elastic.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bind/instance.h"
#include "support/stop.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using tests::YamlProblem;

/// An interval [a, b] for x, empty by a - b when that is positive, and a block that has room.
const std::string kInterval = R"(problem: interval
method:
  method: interval
  data: {a: scalar, b: scalar}
  unknowns: {x: scalar, y: symmetric 2}
  require:
    room: y > I
    between: a < x < b
    again: x < b
data: {a: 3, b: 1}
)";

/// What a chain gives counts at both of its ends: a - t s < x < b + t s.
TEST(Elastic, TheSmallestSlacksCloseTheGap) {
  const YamlProblem problem(kInterval);
  const ByInequality scales = scales_of(problem.instance);
  ASSERT_EQ(scales.size(), 3U);
  // A slack of the chain alone leaves x < b: it gives a - b at its lower end.
  const auto alone = smallest_slacks(problem.instance, {{"between", scales.at("between")}}, {});
  ASSERT_EQ(alone.verdict, model::Verdict::yes);
  ASSERT_EQ(alone.by_inequality.size(), 1U);
  EXPECT_NEAR(alone.by_inequality.at("between") * scales.at("between"), 2, 1e-4);
  // The other inequalities alone cannot close the gap.
  EXPECT_EQ(smallest_slacks(problem.instance, {{"room", 1}, {"again", 1}}, {}).verdict,
            model::Verdict::no);
  {
    const tests::StopInTest stop;
    sdp::Options stopped;
    stopped.progress = [](const sdp::Progress&) { request_stop(); };
    EXPECT_EQ(smallest_slacks(problem.instance, {{"room", 1}}, stopped).verdict,
              model::Verdict::undecided);
  }
  // a - t < x < b + min(t, u) with the slacks t of the chain and u of the other needs t + u > a -
  // b.
  const auto all =
      smallest_slacks(problem.instance, {{"between", 1}, {"again", 1}, {"room", 1}}, {});
  ASSERT_EQ(all.verdict, model::Verdict::yes);
  EXPECT_NEAR(all.by_inequality.at("between") + all.by_inequality.at("again"), 2, 1e-4);
  EXPECT_EQ(all.by_inequality.at("room"), 0);
}

TEST(Elastic, AFeasibleProblemNeedsNoSlack) {
  const YamlProblem problem(kInterval);
  const model::Instance wider = bind::evaluate(problem.instance.design, {{"b", 5}});
  const auto slacks = smallest_slacks(wider, scales_of(wider), {});
  ASSERT_EQ(slacks.verdict, model::Verdict::yes);
  for (const auto& [inequality, slack] : slacks.by_inequality) EXPECT_EQ(slack, 0) << inequality;
}

/// Without constant parts slacks are measured against the room that strict inequalities keep.
TEST(Elastic, WithoutConstantPartsASlackIsAPartOfTheRoom) {
  const auto lyapunov = [](const std::string& A) {
    return YamlProblem(
        "problem: lyapunov\nmethod:\n  method: lyapunov\n  data: {A: n x n}\n"
        "  unknowns: {P: symmetric n}\n  require: {positive: P > 0, stable: He(P*A) < 0}\n"
        "data: {A: " +
        A + "}\n");
  };
  // p >= (1 - t) s, 2 a p <= (u - 1) q: one of t, u is 0, or all is given up.
  for (const double a : {1.0, 1000.0, 0.003}) {
    const YamlProblem problem = lyapunov("[[" + std::to_string(a) + "]]");
    const ByInequality scales = scales_of(problem.instance);
    const auto slacks = smallest_slacks(problem.instance, scales, {});
    ASSERT_EQ(slacks.verdict, model::Verdict::yes) << a;
    EXPECT_TRUE(slacks.smallest) << a;
    const double ratio = scales.at("stable") / (2 * a * scales.at("positive"));
    EXPECT_NEAR(slacks.by_inequality.at("positive") + slacks.by_inequality.at("stable"),
                1 + std::min(ratio, 1 / ratio), 1e-6)
        << a;
  }
  const YamlProblem stable = lyapunov("[[-1, 3], [0, -2]]");
  for (const auto& [name, slack] :
       smallest_slacks(stable.instance, scales_of(stable.instance), {}).by_inequality)
    EXPECT_EQ(slack, 0) << name;
}

/// Every comparison of a chain gives by the same slack, which is not negative.
TEST(Elastic, AChainBecomesOneInequalityForEachComparison) {
  const YamlProblem problem(kInterval);
  std::map<std::string, std::string> names;
  const model::Instance relaxed = elastic(problem.instance, {{"between", {2}}}, names);
  ASSERT_EQ(names.size(), 1U);
  std::vector<std::string> found;
  for (const model::Design::Inequality& inequality : relaxed.design->inequalities)
    found.push_back(inequality.name);
  EXPECT_EQ(found, (std::vector<std::string>{"room", "between.1", "between.2", names.at("between"),
                                             "again"}));
  EXPECT_EQ(relaxed.design->objective->text, names.at("between"));
}

}  // namespace
}  // namespace gainsmith::design
