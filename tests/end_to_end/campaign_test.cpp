// Campaigns whose truth is known by hand, from a problem's text to the exit code.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/file.h"
#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

/// The report of `verify`, after `synth` of the problem; its exit code is checked.
Json verified(const std::string& problem, int exit) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  const Outcome made = gainsmith({"synth", folder.file("problem.yaml", problem), "-o", gains});
  EXPECT_TRUE(has(made.out, "verdict     yes")) << made.out << made.err;
  const Outcome outcome = gainsmith({"verify", gains, "--json", "--threads", "2"});
  EXPECT_EQ(outcome.exit, exit) << outcome.out << outcome.err;
  const Outcome one = gainsmith({"verify", gains, "--json", "--threads", "1"});
  EXPECT_EQ(outcome.out, one.out);
  return outcome.json();
}

/// A plant z' = a z with the observer zh' = a zh + b (z - zh): the error has e' = (a - b) e.
std::string scalar_observer(const std::string& a, const std::string& b, const std::string& horizon,
                            const std::string& size = "1") {
  return "problem: scalar-observer\n"
         "method:\n"
         "  method: scalar-observer\n"
         "  data: {a: scalar, b: scalar}\n"
         "  unknowns: {x: scalar}\n"
         "  require: {some: x > 1}\n"
         "  gains: {L: x}\n"
         "  plant: {state: {z: scalar}, output: {y: z}, flow: {z: a*z}}\n"
         "  observer: {state: {zh: scalar}, flow: {zh: (a - b)*zh + b*y}}\n"
         "  timer: {tau: {reset: [0.3, 0.7]}}\n"
         "  signals: {e: z - zh}\n"
         "  claims: {lyapunov: {nonincreasing: e^2}, error: {shrinks: norm(e), to: 1}}\n"
         "data: {a: " +
         a + ", b: " + b +
         "}\n"
         "campaign:\n"
         "  runs: 20\n"
         "  horizon: " +
         horizon + "\n  initial: {z: {box: [" + size + ", 2*" + size + "]}, zh: 0.5*z}\n";
}

std::string reset_observer(const std::string& A, const std::string& more) {
  return "problem: reset\nmethod: reset-observer\ndata:\n  A: " + A +
         "\n  C: [1, 0]\n  T1: 0.5\n  T2: 1\nsynthesis: {forall: exchange}\ncampaign: {runs: 30, " +
         more + "}\n";
}

/// The campaign of pendulum-ekf on a machine that is said to be an older one.
Outcome pendulum_on(const std::string& machine, const Folder& folder) {
  setenv("GAINSMITH_ISA", machine.c_str(), 1);
  const std::string gains = folder.path("gains.json");
  gainsmith({"synth", problem("own-systems/pendulum-ekf.yaml"), "-o", gains});
  Outcome outcome = gainsmith({"verify", gains, "--runs", "300", "--json"});
  unsetenv("GAINSMITH_ISA");
  return outcome;
}

TEST(CampaignTest, HasTheSameBytesOnMachinesWithFusedProducts) {
  const Folder folder;
  const Outcome v3 = pendulum_on("v3", folder);
  const Outcome v4 = pendulum_on("v4", folder);
  const Outcome v2 = pendulum_on("v2", folder);
  ASSERT_EQ(v2.exit, 0) << v2.err;
  EXPECT_EQ(v2.json()["verdict"], "held");
  if (v3.exit != 0 || v4.exit != 0) GTEST_SKIP() << "this machine is not x86-64-v4: " << v4.err;
  EXPECT_EQ(v3.out, v4.out);
  EXPECT_EQ(v3.json()["worst_run"], v2.json()["worst_run"]);
}

TEST(CampaignTest, AsManyRunsAsAProbabilityNeeds) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  gainsmith({"synth", problem("own-systems/pendulum-ekf.yaml"), "-o", gains});
  const Outcome outcome =
      gainsmith({"verify", gains, "--probability", "0.01", "--confidence", "0.99", "--json"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  const Json report = outcome.json();
  EXPECT_EQ(report["runs"], 459);
  EXPECT_EQ(report["confidence"], 0.99);
  EXPECT_LE(report["violation_probability_at_most"].get<double>(), 0.01);
  const Outcome both = gainsmith({"verify", gains, "--probability", "0.01", "--runs", "5"});
  EXPECT_EQ(both.exit, 2);
  EXPECT_NE(both.err.find("either --runs or --probability"), std::string::npos) << both.err;
}

TEST(CampaignTest, AnUnknownMachineIsNamed) {
  const Folder folder;
  const Outcome outcome = pendulum_on("v9", folder);
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("GAINSMITH_ISA=v9: expected v2, v3 or v4"), std::string::npos)
      << outcome.err;
}

TEST(CampaignTest, AFastPoleThatExpmMagnifiesIsHeld) {
  // Poles -60 and 0.1: expm(-A*s) magnifies the rounding of e by exp(60 s), the claim does not.
  const Json report = verified(reset_observer("[[0, 1], [6, -59.9]]", "horizon: 100"), 0);
  EXPECT_EQ(report["verdict"], "held");
  EXPECT_EQ(report["status"], "held");
  EXPECT_EQ(report["undecided"], 0);
}

TEST(CampaignTest, APoleWhoseExponentialOverflowsIsHeld) {
  // Poles -1000 and 0.1: expm(-A) is beyond the range of double.
  EXPECT_EQ(verified(reset_observer("[[0, 1], [100, -999.9]]", "horizon: 50"), 0)["verdict"],
            "held");
}

TEST(CampaignTest, SlowPolesAreHeld) {
  EXPECT_EQ(verified(reset_observer("[[0, 1], [-0.01, 0.1]]", "horizon: 100"), 0)["verdict"],
            "held");
}

TEST(CampaignTest, AConstantStateOfAnySizeExcusesNothing) {
  // e' = 0.003 e: e(100) = exp(0.3) e(0). w is constant and in no claim.
  const Json report = verified(
      "problem: held-diverging\nmethod:\n  method: grows\n  unknowns: {x: scalar}\n"
      "  require: {some: x > 1}\n  gains: {L: x}\n"
      "  plant: {state: {e: scalar, w: scalar}, flow: {e: 0.003*e}, jump: {e: e}}\n"
      "  timer: {tau: {reset: [1, 1]}}\n"
      "  claims: {lyapunov: {nonincreasing: e^2}, error: {shrinks: norm(e), to: 1}}\n"
      "campaign: {runs: 20, horizon: 100, initial: {e: {box: [0.5, 1]}, w: 1e13}}\n",
      1);
  EXPECT_EQ(report["verdict"], "violated");
  EXPECT_EQ(report["violations"], 20);
  const Json& worst = report["checks"][1]["worst"];
  EXPECT_NEAR(worst["value"].get<double>() / worst["bound"].get<double>(), std::exp(0.3), 1e-12);
  EXPECT_FALSE(report["confirmed"].empty());
}

TEST(CampaignTest, ADivergingPlantIsJudgedOnItsError) {
  // z grows by exp(120) while e dies down by exp(-180): nothing of e is left of z - zh in any
  // digits.
  EXPECT_EQ(verified(scalar_observer("2", "5", "60"), 0)["verdict"], "held");
  // z leaves the range of double altogether.
  EXPECT_EQ(verified(scalar_observer("5", "5.5", "200"), 0)["verdict"], "held");
}

TEST(CampaignTest, DecimalsThatAreNoDoublesLeaveNoRest) {
  // a - b is 0.1 - 0.3; with doubles the error would be driven by 1e-17 z, z = exp(0.1 t) 1e8.
  EXPECT_EQ(verified(scalar_observer("0.1", "0.3", "300", "1e8"), 0)["verdict"], "held");
}

TEST(CampaignTest, SlowErrorsAreToldApart) {
  for (const char* horizon : {"1", "60", "3000"}) {
    EXPECT_EQ(verified(scalar_observer("0.5", "0.501", horizon), 0)["verdict"], "held") << horizon;
    const Json report = verified(scalar_observer("0.5", "0.499", horizon), 1);
    EXPECT_EQ(report["verdict"], "violated") << horizon;
    EXPECT_EQ(report["violations"], 20);
  }
  EXPECT_EQ(verified(scalar_observer("0.5", "0.499999999", "10"), 1)["verdict"], "violated");
  EXPECT_EQ(verified(scalar_observer("0.5", "0.500000001", "10"), 0)["verdict"], "held");
}

TEST(CampaignTest, UnitsOfTheStatesDoNotMatter) {
  // A rotation that shrinks by exp(-0.01 t), its states in units 1e6 apart; P is that of the
  // rotation. With +0.001 it grows.
  const auto problem = [](const std::string& rate) {
    return "problem: units\nmethod:\n  method: units\n  data: {A: n x n, P: symmetric n}\n"
           "  unknowns: {x: scalar}\n  require: {some: x > 1}\n  gains: {L: x}\n"
           "  plant: {state: {z: n}, flow: {z: A*z}}\n"
           "  observer: {state: {zh: n}, flow: {zh: A*zh}}\n"
           "  timer: {tau: {reset: [0.5, 1]}}\n"
           "  claims: {lyapunov: {nonincreasing: (z - zh)'*P*(z - zh)}}\n"
           "data: {A: [[" +
           rate + ", 1e-6], [-1e6, " + rate +
           "]], P: [[1, 0], [0, 1e-12]]}\n"
           "campaign: {runs: 20, horizon: 50, initial: {z: {box: [[1, 1e6], [2, 2e6]]}, zh: 0}}\n";
  };
  EXPECT_EQ(verified(problem("-0.01"), 0)["verdict"], "held");
  EXPECT_EQ(verified(problem("0.001"), 1)["verdict"], "violated");
}

/// The plant of Ferrante and Seuret with its output in units of 1e9, and with a state in units 1e9
/// apart: gains and the flow of the errors have elements that far apart.
TEST(CampaignTest, UnitsOfOutputsAndGainsDoNotMatter) {
  const auto problem = [](const std::string& plant) {
    return "problem: units\nmethod: sampled-data-hybrid\ndata: {" + plant +
           ", T1: 0.5, T2: 0.7, QF: I, QJ: 0.01*I}\n"
           "parameters: {delta: 0.03, eta: 1e-4, a1: 100, a2: 1}\n"
           "campaign: {runs: 20, horizon: 100, initial: {z: {box: [-10, 10]}, zh: 0, th: C*z}}\n";
  };
  for (const char* plant : {"A: [[0.2, -1.01], [1, 0]], C: [[5e-10, -1e-9]]",
                            "A: [[0.2, -1.01e-9], [1e9, 0]], C: [[5e4, -1e-4]]"}) {
    const Json report = verified(problem(plant), 0);
    EXPECT_EQ(report["verdict"], "held") << plant;
    EXPECT_EQ(report["undecided"], 0) << plant;
  }
}

TEST(CampaignTest, WhatIsNotCertainIsUndecided) {
  // e' = (0.5 - 0.5) e is exactly 0: the claim that e^2 does not rise holds, bound 0.
  const Json still = verified(scalar_observer("0.5", "0.5", "10"), 3);
  EXPECT_EQ(still["checks"][0]["undecided"], 0);
  // That the error at the end is at most 1 times that at the start is an equation of rounded
  // numbers.
  EXPECT_EQ(still["checks"][1]["undecided"], 20);
  const auto rotation = [](const std::string& rate) {
    return "problem: rotation\nmethod:\n  method: rotation\n  unknowns: {x: scalar}\n"
           "  require: {some: x > 1}\n  gains: {L: x}\n"
           "  plant: {state: {z: 2}, flow: {z: '" +
           rate +
           "'}}\n"
           "  timer: {tau: {reset: [1, 1]}}\n  claims: {norm: {nonincreasing: z'*z}}\n"
           "campaign: {runs: 5, horizon: 10}\n";
  };
  // A rotation keeps |z|: a matrix inequality says so of a linear one, and no digits of another.
  EXPECT_EQ(verified(rotation("[0, 1; -1, 0]*z"), 0)["status"], "held");
  const Json report = verified(rotation("(1 + z''*z)*[0, 1; -1, 0]*z"), 3);
  EXPECT_EQ(report["status"], "undecided");
  EXPECT_EQ(report["undecided"], 5);
  EXPECT_EQ(report["repeated"], 5);
}

/// A plant that is sampled, with a jump or a claim that has no error bound.
std::string without_bounds(const std::string& jump, const std::string& value) {
  return "problem: p\nmethod:\n  method: m\n"
         "  plant:\n"
         "    state: {x: {shape: 2, start: '[3; 4]'}, P: {shape: 2 x 2, start: '[2, 0; 0, 1]'}}\n"
         "    flow: {x: '[0, -1; 1, 0]*x'}\n"
         "    at: {j: {x: \"" +
         jump +
         "\", P: 0.9*P + 0.1*x*x'}}\n"
         "  events: {j: {every: [0.3, 0.7]}}\n"
         "  claims: {c: {below: \"" +
         value + "\", bound: 30}}\ncampaign: {runs: 20, horizon: 5}\n";
}

TEST(CampaignTest, TextsWithoutErrorBoundsAreJudgedLikeOthers) {
  for (const char* jump :
       {"project_polytope(x, eye(2), [1, 0], 2)", "project_ellipsoid(x, eye(2), [0; 0], eye(2), 4)",
        "project_convex(x, eye(2), x'*x - 4)", "pinv(P)*x", "flow_map(-x, x, 1)"})
    EXPECT_EQ(verified(without_bounds(jump, "norm(x)"), 0)["undecided"], 0) << jump;
  for (const char* value : {"max(eig(P)(:, 1))", "det(P)", "norm(pinv(P))"})
    EXPECT_EQ(verified(without_bounds("0.9*x", value), 0)["undecided"], 0) << value;
}

/// What the campaign of a sampled plant says of its claims, with more events.
std::vector<std::array<int, 2>> verdicts(const std::string& jump, const std::string& events) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  const std::string text =
      "problem: p\nmethod:\n  method: m\n"
      "  plant:\n"
      "    state: {x: {shape: 2}, P: {shape: 2 x 2, start: '[2, 0.3; 0.3, 1]'}, s: {shape: scalar, "
      "start: 0}}\n"
      "    flow: {x: '[-0.2, 1; -1, -0.2]*x', s: 1}\n"
      "    at: {j: {x: \"" +
      jump + "\", P: 0.9*P + 0.1*x*x', s: 0}}\n  events: {j: {every: [0.3, 0.7]}" + events +
      "}\n  claims:\n"
      "    falls: {nonincreasing: x'*x}\n    shrinks: {shrinks: norm(x), to: 0.5}\n"
      "    stays: {below: lambda_max(P), bound: 3}\n    cost: {cost: {flow: x'*x}, below: 20}\n"
      "campaign: {runs: 40, horizon: 4, initial: {x: {box: [-3, 3]}}}\n";
  EXPECT_EQ(gainsmith({"synth", folder.file("p.yaml", text), "-o", gains}).exit, 0) << jump;
  const Json report = gainsmith({"verify", gains, "--json"}).json();
  std::vector<std::array<int, 2>> all;
  for (const Json& check : report["checks"])
    all.push_back({check["violations"].get<int>(), check["undecided"].get<int>()});
  return all;
}

/// Sampled plants are judged with bounds, those of more clocks by the difference of two runs.
TEST(CampaignTest, AnEventThatNeverHappensChangesNoVerdict) {
  for (const char* jump : {"0.9*x", "clip(x, -2, 2)", "inv(P)*x", "where(x(1) > 0, 0.5*x, 0.9*x)",
                           "exp(-s)*x", "project_polytope(x, P, [1, 0], 1)", "x/(1 + s)",
                           "[tanh(x(1)); atan2(x(2), 1)]", "pinv(P)*x", "mod(x, 2)"})
    EXPECT_EQ(verdicts(jump, ""), verdicts(jump, ", never: {every: 1e6}")) << jump;
}

TEST(CampaignTest, ASaturationThatLeavesAStateAsItIsIsNoRise) {
  const Json report = verified(
      "problem: p\nmethod:\n  method: m\n"
      "  plant: {state: {x: 2}, flow: {x: -0.5*x}, at: {j: {x: 'clip(x, -2, 2)'}}}\n"
      "  events: {j: {every: [0.3, 0.7]}}\n  claims: {c: {nonincreasing: x'*x}}\n"
      "campaign: {runs: 20, horizon: 5, initial: {x: {box: [-3, 3]}}}\n",
      0);
  EXPECT_EQ(report["undecided"], 0);
}

TEST(CampaignTest, ARunThatEndsSaysWhy) {
  const Folder folder;
  const Outcome outcome = gainsmith(
      {"run",
       folder.file("p.yaml", without_bounds("project_polytope(x, -eye(2), [1, 0], 2)", "norm(x)")),
       "-o", folder.path("out")});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(has(outcome.out, "violated in 20 runs: run ")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "before its horizon; run 0: ")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "positive definite")) << outcome.out;
}

/// A fall that follows a rebound within one step, which starts below 0 by rounding: no bounce is missed.
TEST(CampaignTest, ABallOnAVibratingTableStaysAboveIt) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", R"yaml(problem: table
method:
  events: {hit: {falls: "h - 0.03*sin(20*t)"}}
  plant:
    state: {h: scalar, v: {shape: scalar, start: 0}}
    flow:  {h: v, v: -9.81}
    at:    {hit: {v: "-0.8*v + 1.08*cos(20*t)"}}
  claims: {above: {above: "h - 0.03*sin(20*t)", bound: -0.001}}
campaign: {runs: 24, horizon: 3, initial: {h: {box: [0.1, 0.5]}}}
)yaml");
  EXPECT_NE(gainsmith({"verify", file}).exit, 1);
  for (int run = 0; run < 24; ++run) {
    const Outcome one = gainsmith(
        {"simulate", file, "--run", std::to_string(run), "--judge", "-o", folder.path("run.csv")});
    EXPECT_FALSE(has(one.out, "crosses zero inside a flow")) << one.out;
  }
}

}  // namespace
}  // namespace gainsmith::tests
