// The words of control as a person uses them: designs by formula, poles, modes, tables.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

/// A double integrator: X = [sqrt(2), 1; 1, sqrt(2)], K = [1, sqrt(2)], poles (-1 +- i)/sqrt(2).
const std::string kRegulator = R"yaml(problem: regulator
method:
  method: regulator
  data: {A: n x n, B: n x m}
  let:
    X: care(A, B, diag([1, 0]), eye(m))
    D: c2d(A, B, 0.5)
  gains:  {K: B'*X}
  report:
    poles: eig(A - B*K)
    controllable: rank(ctrb(A, B))
    Bd: D(:, n+1:end)
  plant:
    state: {x: {shape: n, start: "[1; 1]"}}
    flow:  {x: (A - B*K)*x}
  signals: {V: x'*X*x}
  claims:
    falls: {nonincreasing: V}
    rests: {shrinks: norm(x), to: 0.01}
data: {A: [[0, 1], [0, 0]], B: [[0], [1]]}
campaign: {runs: 1, horizon: 12}
)yaml";

TEST(ControlWordsTest, ARegulatorByFormulaShowsItsPoles) {
  const Folder folder;
  const std::string problem = folder.file("regulator.yaml", kRegulator);
  const std::string gains = folder.path("gains.json");
  const Outcome outcome = gainsmith({"synth", problem, "-o", gains});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::string shown = outcome.out + outcome.err;
  EXPECT_NE(shown.find("poles = -0.707107 +- 0.707107i\n"), std::string::npos) << shown;
  EXPECT_NE(shown.find("controllable = 2\n"), std::string::npos) << shown;
  EXPECT_NE(shown.find("Bd = [0.125; 0.5]\n"), std::string::npos) << shown;
  const Json document = Json::parse(text_of(gains));
  EXPECT_NEAR(document["gains"]["K"][0][0].get<double>(), 1, 1e-15);
  EXPECT_NEAR(document["gains"]["K"][0][1].get<double>(), std::sqrt(2), 1e-15);
  EXPECT_EQ(gainsmith({"verify", problem}).exit, 0);
}

TEST(ControlWordsTest, WithoutAStabilisingSolutionTheModeIsNamed) {
  const Folder folder;
  const std::string text = with(kRegulator, "[[0, 1], [0, 0]]", "[[2, 0], [0, 0]]");
  const Outcome outcome = gainsmith({"synth", folder.file("regulator.yaml", text)});
  const std::string shown = outcome.out + outcome.err;
  EXPECT_NE(shown.find("B does not reach the mode of A at 2, which is not stable"),
            std::string::npos)
      << shown;
}

/// What has no error bound cannot stand in a proof.
TEST(ControlWordsTest, AnInequalityWithASolutionOfRiccatiIsUndecided) {
  const Folder folder;
  const std::string text =
      "problem: bound\n"
      "method:\n"
      "  method: bound\n"
      "  data: {A: n x n}\n"
      "  unknowns: {P: symmetric n}\n"
      "  let: {X: \"care(A, I*eye(n), I, I)\"}\n"
      "  require: {above: P > X}\n"
      "  minimize: trace(P)\n"
      "data: {A: [[0, 1], [0, 0]]}\n";
  const Outcome outcome = gainsmith({"synth", folder.file("bound.yaml", text)});
  const std::string shown = outcome.out + outcome.err;
  EXPECT_NE(shown.find("the care has no error bound, so nothing is proved with it"),
            std::string::npos)
      << shown;
  EXPECT_EQ(shown.find("verdict     yes"), std::string::npos) << shown;
}

/// A solution of Lyapunov has one.
TEST(ControlWordsTest, AnInequalityWithASolutionOfLyapunovIsProved) {
  const Folder folder;
  const std::string text =
      "problem: bound\n"
      "method:\n"
      "  method: bound\n"
      "  data: {A: n x n}\n"
      "  unknowns: {P: symmetric n}\n"
      "  let: {X: \"lyap(A', I)\"}\n"
      "  require: {both: P > X and P < 2*X}\n"
      "data: {A: [[-1, 1], [0, -2]]}\n";
  const Outcome outcome = gainsmith({"synth", folder.file("bound.yaml", text)});
  const std::string shown = outcome.out + outcome.err;
  EXPECT_EQ(outcome.exit, 0) << shown;
  EXPECT_NE(shown.find("verdict     yes"), std::string::npos) << shown;
  EXPECT_NE(shown.find("\nboth.1 "), std::string::npos) << shown;
  EXPECT_NE(shown.find("\nboth.2 "), std::string::npos) << shown;
}

TEST(ControlWordsTest, ChainsOfMatricesHaveOneInequalityForEachSign) {
  const Folder folder;
  const std::string text =
      "problem: chain\n"
      "method:\n"
      "  method: chain\n"
      "  data: {A: n x n}\n"
      "  unknowns: {P: symmetric n}\n"
      "  require: {box: 0 < P < I, flow: He(P*A) < 0}\n"
      "  assume: {both: n > 1 and n < 3}\n"
      "data: {A: [[-1, 1], [0, -2]]}\n";
  const Outcome outcome = gainsmith({"synth", folder.file("chain.yaml", text)});
  const std::string shown = outcome.out + outcome.err;
  EXPECT_EQ(outcome.exit, 0) << shown;
  EXPECT_NE(shown.find("\nbox.1 "), std::string::npos) << shown;
  EXPECT_NE(shown.find("\nbox.2 "), std::string::npos) << shown;
}

/// p is a dimension where P is the unknown.
TEST(ControlWordsTest, ADimensionInThePlaceOfAnUnknownIsNamed) {
  const Folder folder;
  const std::string text =
      "problem: case\n"
      "method:\n"
      "  method: case\n"
      "  data: {A: n x n, C: p x n}\n"
      "  unknowns: {P: symmetric n}\n"
      "  require: {flow: He(p*A) < 0}\n"
      "data: {A: [[-1, 1], [0, -2]], C: [1, 0]}\n";
  const Outcome outcome = gainsmith({"synth", folder.file("case.yaml", text)});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE((outcome.out + outcome.err).find("'p' in 'flow' is another name, as case counts"),
            std::string::npos)
      << outcome.out << outcome.err;
}

/// Rotations by pi/2 a unit of time, then growth: x(3) by exponentials that are known.
const std::string kSwitched = R"yaml(problem: switched
method:
  method: switched
  data:
    A: {shape: n x n, for: i in 1..N}
  events: {switch: {every: 1}}
  plant:
    state: {x: {shape: n, start: "[1; 0]"}}
    mode:  {q: 1}
    flow:  {x: A(q)*x}
    at:    {switch: {q: q + 1}}
data:
  A: ["[0, -pi/2; pi/2, 0]", "log(2)*eye(2)", "[0, -pi/2; pi/2, 0]"]
campaign: {runs: 1, horizon: 2.5}
)yaml";

TEST(ControlWordsTest, AModePicksAMemberOfAFamily) {
  const Folder folder;
  const Outcome outcome =
      gainsmith({"simulate", folder.file("switched.yaml", kSwitched), "--judge"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::vector<double> last = last_row(outcome.out);
  EXPECT_NEAR(last[3], -std::sqrt(2), 1e-9) << outcome.out;
  EXPECT_NEAR(last[4], std::sqrt(2), 1e-9);
}

TEST(ControlWordsTest, AModeBeyondTheFamilyIsAnErrorOfTheRun) {
  const Folder folder;
  const std::string text = with(kSwitched, "horizon: 2.5", "horizon: 3.5");
  const Outcome outcome = gainsmith({"simulate", folder.file("switched.yaml", text)});
  EXPECT_NE(outcome.err.find("the family has the members 1 to 3, and 'q' is none of them"),
            std::string::npos)
      << outcome.err;
}

/// A valve with a measured curve: x' = f(t), f through (0, 0), (1, 2), (2, 0), constant after.
TEST(ControlWordsTest, ATableIsIntegratedFromKinkToKink) {
  const Folder folder;
  const std::string text =
      "problem: valve\n"
      "method:\n"
      "  method: valve\n"
      "  data: {points: k, values: k}\n"
      "  plant:\n"
      "    state: {x: {shape: scalar, start: 0}, s: {shape: scalar, start: 0}}\n"
      "    flow:  {x: \"interp1(points, values, s)\", s: 1}\n"
      "data: {points: [0, 1, 2], values: [0, 2, 0.5]}\n"
      "campaign: {runs: 1, horizon: 4}\n"
      "expect: {run: [{at: {t: 4}, value: x, is: 3.25, absolute: 1e-12}]}\n";
  const Outcome outcome =
      gainsmith({"run", folder.file("valve.yaml", text), "-o", folder.path("g.json")});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
}

TEST(ControlWordsTest, APoleOfTheTangentIsNamed) {
  const Folder folder;
  const std::string text =
      "problem: pole\n"
      "method: {method: pole, data: {a: scalar}, report: {k: tan(a)}}\n"
      "data: {a: pi/2}\n";
  const Outcome outcome = gainsmith({"synth", folder.file("pole.yaml", text)});
  EXPECT_NE((outcome.out + outcome.err).find("tan has a pole here"), std::string::npos)
      << outcome.out << outcome.err;
}

}  // namespace
}  // namespace gainsmith::tests
