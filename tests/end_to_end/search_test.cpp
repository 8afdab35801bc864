// Searches over scalars and explanations, as a person runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

const std::string kPublishedTheorem = "ferrante-seuret-2021/published-theorem.yaml";

/// The smallest x is (a - 2)^2 + 1; a is left open. A gain to verify, a cheap problem.
const std::string kOpen = R"(problem: open
method:
  method: open
  parameters: {a: {default: 1, search: [0, 9]}}
  unknowns: {x: scalar}
  require: {floor: "x > (a - 2)^2 + 1", ceiling: x < 6}
  minimize: x
  gains: {K: 2*x}
)";

/// synth finds a weight b with gains; at the end of its range there are none.
TEST(SearchTest, ANoAtAHeldScalarIsNoNoOfTheProblem) {
  const Folder folder;
  const std::string file = folder.file(
      "servo.yaml",
      "problem: servo\nmethod: static-output-feedback\ndata:\n  A: [[0, 1], [0, 0]]\n  B: "
      "[[0], [1]]\n  C: [1, 1]\nparameters: {alpha: 1.91}\n");
  EXPECT_EQ(gainsmith({"synth", file}).exit, 0);
  const Outcome explained = gainsmith({"explain", file});
  EXPECT_EQ(explained.exit, 3);
  EXPECT_NE(explained.out.find(
                "verdict     no at b = 100, infeasible by a checked certificate; synth also "
                "searches b\n"),
            std::string::npos)
      << explained.out;
  EXPECT_EQ(gainsmith({"explain", file, "--json"}).json()["held"]["b"], 100);
  EXPECT_EQ(gainsmith({"explain", file, "--set", "b=1e-6"}).exit, 1);
  const Outcome bisected =
      gainsmith({"bisect", file, "--largest", "alpha", "--in", "1.91", "1.95"});
  EXPECT_EQ(bisected.exit, 3);
  EXPECT_NE(bisected.out.find("values tried in [1.91, 1.95] at b = 100; each is infeasible"),
            std::string::npos)
      << bisected.out;
}

/// The same two masses with outputs and inputs in other units, near the largest decay rate.
TEST(SearchTest, OutputFeedbackHasItsAnswerInAllUnits) {
  const Folder folder;
  for (const auto& [input, output] : {std::pair("1", "1"), std::pair("1", "1e6"),
                                      std::pair("1e-6", "1"), std::pair("1e4", "1e-9")}) {
    const std::string file = folder.file(
        "masses.yaml",
        "problem: masses\nmethod: static-output-feedback\ndata:\n  A: [[0, 0, 1, 0], [0, 0, 0, 1], "
        "[-200, 100, 0, 0], [100, -200, 0, 0]]\n  B: [[0], [0], [" +
            std::string(input) + "], [0]]\n  C: [0, 0, " + output +
            ", 0]\nparameters: {alpha: 1.95}\n");
    const std::string gains = folder.path("gains.json");
    EXPECT_EQ(gainsmith({"synth", file, "-o", gains}).exit, 0) << input << ", " << output;
    EXPECT_EQ(gainsmith({"certify", gains}).exit, 0) << input << ", " << output;
  }
}

/// Beyond what the regulator alone reaches: the gain to begin with knows the decay rate.
TEST(SearchTest, OutputFeedbackComesNearItsLimit) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml",
                  "problem: p\nmethod: discrete-static-output-feedback\ndata:\n"
                  "  A: \"[-0.18, 0.15, -0.95, 1.14; 0.07, -0.85, -1.2, -0.2; -0.06, -0.5, 0.06, "
                  "-0.45; 0.39, -0.51, -0.03, 0.69]\"\n"
                  "  B: [[2.57], [-1.01], [-0.46], [-0.84]]\n  C: [[0.78, -1.15, -0.48, -0.03], "
                  "[-0.98, -0.96, -0.48, -2.1]]\n"
                  "parameters: {rho: 0.7}\n");
  EXPECT_EQ(gainsmith({"synth", file}).exit, 0);
  EXPECT_EQ(gainsmith({"synth", file, "--set", "rho=0.3"}).exit, 1);
}

TEST(SearchTest, WhatIsNecessaryIsCheckedLikeWhatIsRequired) {
  const Folder folder;
  for (const auto& [text, message] : {std::pair("{test: x*y > 1}", "not affine"),
                                      std::pair("{low: y > 1}", "under 'require' already"),
                                      std::pair("{test: y > q}", "unknown name 'q'")}) {
    const std::string file = folder.file(
        "p.yaml",
        "problem: p\nmethod:\n  method: m\n  data: {h: {shape: scalar, default: 2}}\n"
        "  unknowns: {x: scalar, y: scalar}\n  require: {low: x > h}\n  necessary: " +
            std::string(text) + "\n  no campaign: static\nsearch: {over: {h: [1, 10]}}\n");
    for (const char* command : {"check", "synth"}) {
      const Outcome outcome = gainsmith({command, file});
      EXPECT_EQ(outcome.exit, 2) << command << text;
      EXPECT_TRUE(has(outcome.err, message)) << command << outcome.err;
      EXPECT_TRUE(has(outcome.err, "p.yaml:7:")) << outcome.err;
    }
  }
}

/// Position feedback adds no damping, whatever b is.
TEST(SearchTest, ANoForAllSearchedValuesIsExplainedAsOne) {
  const Folder folder;
  const std::string file = folder.file("mass.yaml",
                                       "problem: mass\nmethod: static-output-feedback\ndata:\n"
                                       "  A: [[0, 1], [-1, 0]]\n  B: [[0], [1]]\n  C: [1, 0]\n");
  const std::string gains = folder.path("no.json");
  const Outcome found = gainsmith({"synth", file, "-o", gains});
  EXPECT_EQ(found.exit, 1);
  EXPECT_TRUE(has(found.out, "no b has gains")) << found.out;
  EXPECT_FALSE(has(found.out, "\nsearched")) << found.out;
  EXPECT_TRUE(has(gainsmith({"check", gains}).err, "'gainsmith certify' proves a no"));
  const Outcome explained = gainsmith({"explain", file});
  EXPECT_EQ(explained.exit, 1);
  EXPECT_TRUE(has(explained.out, "verdict     no, infeasible")) << explained.out;
  EXPECT_TRUE(has(explained.out, "conflict    trace cannot hold")) << explained.out;
}

TEST(BisectTest, TheLargestT2OfThePublishedExampleIsProvedOnBothSides) {
  const Folder folder;
  const std::string path = folder.path("gains.json");
  const Outcome outcome =
      gainsmith({"bisect", problem(kPublishedTheorem), "--largest", "T2", "--in", "0.5", "1.1",
                 "--tolerance", "1e-4", "-o", path, "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const Json document = outcome.json();
  EXPECT_EQ(document["goal"], "largest");
  const Json& search = document["result"]["search"];
  EXPECT_NEAR(search["value"].get<double>(), 0.7683, 2e-4);
  EXPECT_NEAR(search["beyond"].get<double>(), 0.7683, 2e-4);
  EXPECT_LT(search["value"].get<double>(), search["beyond"].get<double>());
  EXPECT_TRUE(search["certificate"]["exact"] || search["certificate"]["backward_error"] <= 1e-30);
  EXPECT_TRUE(search["open"].empty());
  EXPECT_TRUE(search["breaks"].empty());
  for (const Json& margin : document["result"]["margins"]) EXPECT_TRUE(margin["holds"]);
  EXPECT_GE(document["samples"].size(), 9U);

  // The gain file is verified with the value that was found, not with the T2 of its statement.
  const Json gains = Json::parse(text_of(path));
  EXPECT_EQ(gains["searched"]["T2"], search["value"]);
  EXPECT_NE(gains["statement"]["problem_text"].get<std::string>().find("T2: 1.1"),
            std::string::npos);
  const Outcome verified = gainsmith({"verify", path, "--runs", "20", "--json"});
  EXPECT_EQ(verified.exit, 0) << verified.err;
  const double horizon = verified.json()["horizon"];
  EXPECT_NEAR(horizon, 40 * search["value"].get<double>(), 1e-9);
}

/// Feasible exactly for 0.29 < k < 0.31, which the values of the spread miss.
const std::string kWindow = R"(problem: window
method:
  method: window
  data: {k: scalar}
  assume: {valid: k >= 0}
  unknowns: {P: scalar}
  require: {pos: P > 1, win: "P*(1e-4 - (k - 0.3)^2) > 0"}
data: {k: 0.9}
)";

/// Ranges of the command line are a part of the statement.
TEST(BisectTest, WhatTheCommandLineSearchesIsCertified) {
  const Folder folder;
  const std::string problem = tests::problem("designs/static-output-feedback.yaml");
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(
      gainsmith({"bisect", problem, "--largest", "alpha", "--in", "1.5", "2.5", "-o", gains}).exit,
      0);
  EXPECT_EQ(nlohmann::json::parse(text_of(gains))["statement"]["set"]["search"],
            "{largest: {alpha: [1.5, 2.5]}}");
  const Outcome certified = gainsmith({"certify", gains});
  EXPECT_EQ(certified.exit, 0) << certified.out << certified.err;
  EXPECT_NE(certified.out.find("no solution at alpha"), std::string::npos) << certified.out;
  EXPECT_EQ(gainsmith({"verify", gains}).exit, 0);
  ASSERT_EQ(gainsmith({"bisect", problem, "--largest", "alpha", "--in", "max(1, 1.5)", "2.5", "-o",
                       gains})
                .exit,
            0);
  EXPECT_EQ(gainsmith({"check", gains}).exit, 0);
  EXPECT_EQ(gainsmith({"certify", gains}).exit, 0);
  ASSERT_EQ(gainsmith({"optimize", problem, "--over", "b=1:1000", "-o", gains}).exit, 0);
  EXPECT_EQ(gainsmith({"certify", gains}).exit, 0);
  const Outcome other = gainsmith({"synth", problem, "--set", "search={largest: {alfa: [1, 2]}}"});
  EXPECT_EQ(other.exit, 2);
  EXPECT_NE(other.err.find("--set search:1:12"), std::string::npos) << other.err;
}

TEST(BisectTest, NothingFeasibleAmongTheValuesTriedIsNoProof) {
  const Folder folder;
  const std::string file = folder.file("window.yaml", kWindow + "search: {largest: {k: [0, 1]}}\n");
  for (const char* command : {"bisect", "synth"}) {
    const Outcome outcome = gainsmith({command, file});
    EXPECT_EQ(outcome.exit, 3) << outcome.out;
    EXPECT_NE(outcome.out.find("no feasible k among the 10 values tried"), std::string::npos)
        << outcome.out;
    EXPECT_EQ(outcome.out.find("certificate multipliers"), std::string::npos);
    EXPECT_EQ(outcome.out.find("searched "), std::string::npos);
  }
}

TEST(ExplainTest, ARangeThatTheAssumptionsCutIsNoError) {
  const Folder folder;
  const std::string file = folder.file("window.yaml", kWindow + "negotiable: {k: [-0.3, 0.9]}\n");
  const Outcome synth = gainsmith({"synth", file});
  EXPECT_EQ(synth.exit, 1) << synth.err;
  EXPECT_NE(synth.out.find("k at most 0.3"), std::string::npos) << synth.out;
  const Outcome refused = gainsmith({"bisect", file, "--largest", "k", "--in", "-2", "-1"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.err.find("k >= 0"), std::string::npos) << refused.err;
}

TEST(BisectTest, ASearchedValueThatIsNoScalarIsRefused) {
  const Folder folder;
  const std::string file = folder.file("open.yaml", kOpen + "parameters: {a: 1}\n");
  const std::string path = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"bisect", file, "--largest", "a", "--in", "1", "9", "-o", path}).exit, 0);
  Json gains = Json::parse(text_of(path));
  EXPECT_NEAR(gains["searched"]["a"].get<double>(), 2 + std::sqrt(5.0), 1e-3);
  gains["searched"] = {{"aa", 1}};
  const Outcome outcome = gainsmith({"verify", folder.file("edited.json", gains.dump())});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("did you mean 'a'?"), std::string::npos) << outcome.err;
}

TEST(BisectTest, WrongCommandLinesAreNamed) {
  const std::string file = problem(kPublishedTheorem);
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"bisect", file}, "nothing to bisect"},
      {{"bisect", file, "--largest", "T3", "--in", "1", "2"}, "did you mean 'T1'?"},
      {{"bisect", file, "--largest", "A", "--in", "1", "2"}, "is a matrix"},
      {{"bisect", file, "--largest", "T1"}, "no range for T1"},
      {{"bisect", file, "--largest", "T2", "--in", "2", "1"}, "low < high"},
      {{"bisect", file, "--largest", "T2", "--in", "0.1", "0.2"}, "expected 0 < T1 <= T2"},
      {{"bisect", file, "--largest", "T2", "--in", "nan", "1"}, "nan"},
      {{"scan", file, "--over", "T2"}, "expected NAME=LOW:HIGH"},
      {{"scan", file, "--over", "T2=1:2:3:4:5"}, "expected NAME=LOW:HIGH"},
      {{"scan", file, "--over", "T2=1:2:0"}, "number of points"},
      {{"scan", file, "--over", "T2=1:2", "--show", "norm(tau)"}, "unknown name 'tau'"},
      {{"scan", file, "--over", "T2=1:2:3:logg"}, "did you mean 'log'?"},
      {{"scan", file, "--over", "T2=0:2:3:log"}, "above 0"},
      {{"scan", file, "--over", "T2=1:2", "--over", "T2=1:2"}, "is given twice"},
      {{"scan", file, "--over", "delta=1:2:5000", "--over", "eta=1:2:5000"}, "1e7"},
      {{"optimize", file}, "nothing to optimise over"},
      {{"optimize", file, "--over", "dleta=1:2"}, "did you mean 'delta'?"},
      {{"optimize", file, "--over", "delta=1:2", "--minimize", "P3"}, "P3"},
      {{"bisect", file, "--largest", "T2", "--in", "0.5", "1", "--tolerance", "nan"},
       "expected a positive number"},
      {{"optimize", file, "--over", "delta=1:2", "--tolerance", "1"}, "belongs to --largest"},
      {{"optimize", file, "--over", "delta=1:2", "--over", "delta=1:2"}, "searched already"},
      {{"optimize", file, "--over", "delta=1:2", "--largest", "delta=1:2"}, "searched already"},
      {{"explain", file + ".none"}, "none"}};
  for (const auto& [arguments, message] : wrong) {
    const Outcome outcome = gainsmith(arguments);
    EXPECT_EQ(outcome.exit, 2) << message << "\n" << outcome.out;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(ScanTest, TheTableIsTheSameForAnyThreadsAndAsCsv) {
  const Folder folder;
  const std::string csv = folder.path("table.csv");
  const std::vector<std::string> arguments = {
      "scan",     problem("ferrante-seuret-2021/t2-0.70.yaml"),
      "--over",   "T2=0.4:0.8:3",
      "--over",   "delta=1e-2:1:2:log",
      "--show",   "trace(P1)",
      "--threads"};
  auto one = arguments;
  one.insert(one.end(), {"1", "-o", csv});
  auto three = arguments;
  three.push_back("3");
  const Outcome first = gainsmith(one);
  EXPECT_EQ(first.exit, 0) << first.err;
  EXPECT_EQ(first.out, gainsmith(three).out);
  // The problem may stand after the options.
  EXPECT_EQ(first.out,
            gainsmith({"scan", "--over", "T2=0.4:0.8:3", "--over", "delta=1e-2:1:2:log", "--show",
                       "trace(P1)", problem("ferrante-seuret-2021/t2-0.70.yaml")})
                .out);
  EXPECT_NE(first.out.find("refused"), std::string::npos) << first.out;
  const std::string text = text_of(csv);
  EXPECT_EQ(text.substr(0, text.find('\n')), "T2,delta,verdict,objective,trace(P1)");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7);
  EXPECT_NE(text.find("0.6000000000000001,0.01,yes,"), std::string::npos) << text;
}

TEST(OutputTest, NoCommandReplacesItsInput) {
  const Folder folder;
  const std::string file = folder.file("open.yaml", kOpen + "parameters: {a: 1}\n");
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", file, "-o", gains}).exit, 0);
  const std::vector<std::vector<std::string>> commands = {
      {"scan", file, "--over", "a=1:2:2", "-o", file},
      {"run", file, "-o", folder.path("out"), "--junit", file},
      {"simulate", gains, "-o", gains}};
  for (const auto& command : commands) {
    const std::string before = text_of(command[1]);
    const Outcome outcome = gainsmith(command);
    EXPECT_EQ(outcome.exit, 2) << command[0];
    EXPECT_NE(outcome.err.find("this is the input file"), std::string::npos) << outcome.err;
    EXPECT_EQ(text_of(command[1]), before);
  }
}

TEST(ScanTest, AllInfeasibleExitsWithOne) {
  const Outcome outcome =
      gainsmith({"scan", problem(kPublishedTheorem), "--over", "T2=0.9:1.1:2", "--json"});
  EXPECT_EQ(outcome.exit, 1);
  ASSERT_EQ(outcome.json().size(), 2U);
  EXPECT_EQ(outcome.json()[1]["verdict"], "no");
  EXPECT_EQ(outcome.json()[1]["at"]["T2"], 1.1);
}

TEST(OptimizeTest, AnOpenParameterIsFoundBySynthAndByOptimize) {
  const Folder folder;
  const std::string file = folder.file("open.yaml", kOpen);
  for (const char* command : {"synth", "optimize"}) {
    const std::string path = folder.path("gains.json");
    const Outcome outcome = gainsmith({command, file, "-o", path, "--threads", "2"});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("searched"), std::string::npos);
    const Json gains = Json::parse(text_of(path));
    EXPECT_NEAR(gains["searched"]["a"].get<double>(), 2, 0.02);
    EXPECT_NEAR(gains["objective"].get<double>(), 1, 1e-3);
    EXPECT_EQ(gains["search"]["figure"], "objective");
  }
  const Outcome piped = gainsmith({"synth", "-", "--json"}, kOpen);
  EXPECT_EQ(piped.exit, 0) << piped.err;
  EXPECT_NEAR(piped.json()["searched"]["a"].get<double>(), 2, 0.02);
}

/// Without a strict inequality no margin tells values apart; each that is feasible will do.
TEST(OptimizeTest, NothingToSearchForIsNoFault) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml",
                  "problem: p\nmethod: {parameters: {b: {search: [0, 3]}}, unknowns: {x: scalar}, "
                  "require: {c: x >= b}}\ndata: {}\n");
  const Outcome found = gainsmith({"synth", file, "--json", "-o", folder.path("g.json")});
  EXPECT_EQ(found.exit, 0) << found.err;
  EXPECT_EQ(found.json()["verdict"], "yes");
}

TEST(OptimizeTest, RunHonoursTheSearchAndItsExpectations) {
  const Folder folder;
  const std::string file =
      folder.file("open.yaml", kOpen +
                                   "expect: {values: {a: {value: 2, absolute: 0.02}, K: {value: 2, "
                                   "absolute: 1e-2}}}\n");
  const Outcome outcome = gainsmith({"run", file, "-o", folder.path("out")});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  const std::string wrong =
      folder.file("wrong.yaml", kOpen + "expect: {values: {a: {value: 3, absolute: 0.02}}}\n");
  EXPECT_EQ(gainsmith({"run", wrong, "-o", folder.path("out")}).exit, 1);
}

TEST(OptimizeTest, TheLargestScalarOverAnother) {
  const Folder folder;
  const std::string file = folder.file("open.yaml", kOpen);
  // x lies between (a - 2)^2 + 1 and c.
  const std::string ridge = folder.file(
      "ridge.yaml",
      std::regex_replace(std::regex_replace(kOpen, std::regex("x < 6"), "x < 6 - c"),
                         std::regex("  parameters:"), "  data: {c: scalar}\n  parameters:") +
          "data: {c: 0}\n");
  const Outcome outcome = gainsmith({"optimize", ridge, "--over", "a=0:9", "--largest", "c=0:20",
                                     "--json", "--tolerance", "1e-3", "--evaluations", "60"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_NEAR(outcome.json()["searched"]["c"].get<double>(), 5, 5e-3);
  EXPECT_NEAR(outcome.json()["searched"]["a"].get<double>(), 2, 0.1);
  EXPECT_GE(outcome.json()["search"]["beyond"].get<double>(), 5 - 1e-6);
}

/// The proof beyond a bracket holds at the values found for the other scalars.
TEST(OptimizeTest, AProvedEndNamesItsPlace) {
  const Folder folder;
  const std::string file = folder.file(
      "ridge.yaml",
      std::regex_replace(std::regex_replace(kOpen, std::regex("x < 6"), "x < 6 - c"),
                         std::regex("  parameters:"), "  data: {c: scalar}\n  parameters:") +
          "data: {c: 0}\n");
  const Outcome outcome = gainsmith({"optimize", file, "--over", "a=3:9", "--largest", "c=0:20",
                                     "--tolerance", "1e-3", "--evaluations", "40"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("by a checked certificate at a = 3"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("a was found at an end of its range"), std::string::npos)
      << outcome.out;
}

TEST(OptimizeTest, NothingFeasibleIsUndecided) {
  const Folder folder;
  const std::string file = folder.file("open.yaml", kOpen);
  const Outcome outcome = gainsmith({"optimize", file, "--over", "a=6:9", "--evaluations", "12"});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_NE(outcome.out.find("no feasible point was found"), std::string::npos) << outcome.out;
}

TEST(ExplainTest, ThePublishedDataConflictAndT2MustBeSmaller) {
  const Outcome outcome = gainsmith({"explain", problem(kPublishedTheorem)});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_NE(outcome.out.find("positive_P1 and flow cannot hold together"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("certificate of these alone"), std::string::npos);
  EXPECT_NE(outcome.out.find("T2 at most 0.7683"), std::string::npos) << outcome.out;
  const Json document = gainsmith({"explain", problem(kPublishedTheorem), "--json"}).json();
  EXPECT_EQ(document["conflict"]["requirements"], (Json{"positive_P1", "flow"}));
  EXPECT_NEAR(document["negotiable"][0]["feasible"].get<double>(), 0.7683, 2e-4);
  const Outcome synth = gainsmith({"synth", problem(kPublishedTheorem)});
  EXPECT_EQ(synth.exit, 1);
  EXPECT_TRUE(std::regex_search(
      synth.out, std::regex("why +positive_P1 and flow cannot hold together; T2 at most 0.7683")))
      << synth.out;
}

TEST(ExplainTest, AScalarThatDoesNotHelpIsSaid) {
  const Folder folder;
  const std::string file = folder.file(
      "more.yaml", std::regex_replace(text_of(problem(kPublishedTheorem)), std::regex("T1, 1.1\\]"),
                                      "T1, 1.1], delta: [1e-3, 10]"));
  const Outcome outcome = gainsmith({"explain", file});
  EXPECT_NE(outcome.out.find("delta does not help"), std::string::npos) << outcome.out;
  const Json reaches = gainsmith({"explain", file, "--json"}).json()["negotiable"];
  ASSERT_EQ(reaches.size(), 2U);
  EXPECT_EQ(reaches[1]["scalar"], "delta");
  EXPECT_TRUE(reaches[1]["feasible"].is_null());
  EXPECT_TRUE(std::regex_search(gainsmith({"synth", file}).out, std::regex("0.76831 would do\n")));
}

TEST(ExplainTest, AFeasibleProblemExitsWithZero) {
  const Outcome outcome = gainsmith({"explain", problem("classics/quadratic-stability.yaml")});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("conflict"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::tests
