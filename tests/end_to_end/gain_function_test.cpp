// A gain that depends on the time since the last sample, from the problem to the replay.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

/// An oscillator sampled at times tau in [0.5, 0.9] apart. A reset observer with Z(tau) of degree
/// d: post-sample form, with E(tau) written out.
std::string problem_text(int degree) {
  return R"yaml(problem: clocked
method:
  method: clocked-reset
  data: {C: p x n, T1: scalar, T2: scalar}
  parameters: {degree: 0}
  unknowns: {P: symmetric n, Z: {shape: n x p, of: tau, degree: degree}}
  let: {E(tau): "[cos(tau), sin(tau); -sin(tau), cos(tau)]"}
  require:
    contraction:
      forall: tau in [T1, T2]
      that: "[0.8*P, ((P - Z(tau)*C)*E(tau))'; *, P] > 0"
    size: P > I
  gains: {F(tau): inv(P)*Z(tau)}
  plant: {state: {z: n}, output: {y: C*z}, flow: {z: "[0, 1; -1, 0]*z"}}
  observer:
    state: {zh: n, s: {shape: scalar, start: 0}}
    flow: {zh: "[0, 1; -1, 0]*zh", s: 1}
    jump: {zh: zh + F(s)*(y - C*zh), s: 0}
  timer: {tau: {reset: [T1, T2]}}
  signals: {e: z - zh}
  claims: {error: {shrinks: norm(e), to: 1e-3}}
data: {C: [[1, 0]], T1: 0.5, T2: 0.9}
campaign: {runs: 50, horizon: 60}
parameters: {degree: )yaml" +
         std::to_string(degree) + "}\n";
}

/// Where a text names a coefficient, the degree is the one that is stated.
TEST(GainFunctionTest, CoefficientsMayBeNamed) {
  const Folder folder;
  const Outcome synth = gainsmith({"synth", folder.file("p.yaml", R"yaml(problem: p
method:
  method: p
  unknowns: {Z: {shape: scalar, of: s, in: [0, 1], degree: 20}}
  require: {b: {forall: "s in [0, 1]", that: "-2 < Z(s) - sin(3*s) < 2"}, c: Z_20 == 1}
  gains: {K: Z_20}
)yaml")});
  EXPECT_EQ(synth.exit, 0) << synth.out << synth.err;
  EXPECT_NE(synth.out.find("K = 1\n"), std::string::npos) << synth.out;
}

/// What the method reports of a gain has no value then.
TEST(GainFunctionTest, ANoLeavesItOutOfTheReport) {
  const Folder folder;
  const Outcome synth =
      gainsmith({"synth", folder.file("p.yaml",
                                      "problem: p\nmethod: {like: reset-observer, require: "
                                      "{impossible: P < 0}}\ndata: {A: [[0.2, -1.01], [1, 0]], C: "
                                      "[0.5, -1], T1: 0.5, T2: 0.7}\n")});
  EXPECT_EQ(synth.exit, 1) << synth.err;
  EXPECT_NE(synth.out.find("positive and impossible cannot hold together"), std::string::npos)
      << synth.out;
}

TEST(GainFunctionTest, IsStoredVerifiedAndReplayed) {
  const Folder folder;
  const std::string problem = folder.file("p.yaml", problem_text(1));
  const std::string path = folder.path("g.json");
  const Outcome synth = gainsmith({"synth", problem, "-o", path});
  ASSERT_EQ(synth.exit, 0) << synth.out << synth.err;
  EXPECT_NE(synth.out.find("F(tau) = ["), std::string::npos) << synth.out;

  const Json gains = Json::parse(text_of(path));
  const Json& gain = gains["gain_functions"]["F"];
  EXPECT_EQ(gain["kind"], "polynomial");
  EXPECT_EQ(gain["coefficients"].size(), 2U);
  EXPECT_EQ(gains["functions"]["Z(tau)"], "Z_0 + Z_1*tau");
  EXPECT_TRUE(gains["unknowns"].contains("Z_1"));

  EXPECT_EQ(gainsmith({"verify", path}).exit, 0);
  const Outcome replay = gainsmith({"simulate", path, "--run", "3"});
  EXPECT_EQ(replay.exit, 0) << replay.err;
}

TEST(GainFunctionTest, TheFilesCoefficientsAreWhatIsSimulated) {
  const Folder folder;
  const std::string path = folder.path("g.json");
  ASSERT_EQ(gainsmith({"synth", folder.file("p.yaml", problem_text(1)), "-o", path}).exit, 0);
  Json gains = Json::parse(text_of(path));
  for (Json& coefficient : gains["gain_functions"]["F"]["coefficients"])
    for (Json& row : coefficient)
      for (Json& element : row) element = 0;
  EXPECT_EQ(gainsmith({"verify", folder.file("zero.json", gains.dump())}).exit, 1)
      << "without gain the error does not shrink";
}

TEST(GainFunctionTest, OfDegree0IsAConstantThatIsStillCalled) {
  const Folder folder;
  const std::string path = folder.path("g.json");
  const Outcome synth = gainsmith({"synth", folder.file("p.yaml", problem_text(0)), "-o", path});
  ASSERT_EQ(synth.exit, 0) << synth.out << synth.err;
  const Json gains = Json::parse(text_of(path));
  EXPECT_FALSE(gains.contains("gain_functions"));
  EXPECT_TRUE(gains["gains"].contains("F"));
  EXPECT_EQ(gainsmith({"verify", path}).exit, 0);
}

TEST(GainFunctionTest, AFileThatDoesNotFitIsRefused) {
  const Folder folder;
  const std::string path = folder.path("g.json");
  ASSERT_EQ(gainsmith({"synth", folder.file("p.yaml", problem_text(1)), "-o", path}).exit, 0);
  const Json gains = Json::parse(text_of(path));
  const auto refused = [&](const Json& changed, const std::string& message) {
    const Outcome outcome = gainsmith({"verify", folder.file("c.json", changed.dump())});
    EXPECT_EQ(outcome.exit, 2) << message;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  Json changed = gains;
  changed["gain_functions"]["F"]["kind"] = "cubic";
  refused(changed, "expected polynomial, vertices or formula");
  changed = gains;
  changed.erase("gain_functions");
  refused(changed, "F is missing");
  changed = gains;
  changed["unknowns"].erase("Z_0");
  refused(changed, "lacks the coefficients Z_0");
  changed = gains;
  changed["functions"]["Z(tau)"] = "Z_0 + Z_1*tau + Q";
  refused(changed, "unknown name 'Q'");
}

}  // namespace
}  // namespace gainsmith::tests
