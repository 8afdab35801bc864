// `gainsmith solve` on files in SDPA format.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// min x1 + x2 with [x1 1; 1 x2] >= 0: the optimum is 2.
constexpr const char* kSmall =
    "\"a comment\n2 = m\n1 = blocks\n{2}\n1.0 1.0\n0 1 1 2 -1.0\n1 1 1 1 1.0\n2 1 2 2 1.0\n";

TEST(SolveTest, ASmallProblemFromStandardInput) {
  const Outcome outcome = gainsmith({"solve", "-", "--json"}, kSmall);
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto document = outcome.json();
  for (const char* key :
       {"status", "cause", "primal_objective", "dual_objective", "relative_gap",
        "primal_infeasibility", "dual_infeasibility", "iterations", "precision", "seconds"})
    EXPECT_TRUE(document.contains(key)) << key;
  EXPECT_EQ(document["status"], "optimal");
  EXPECT_NEAR(document["primal_objective"].get<double>(), 2, 1e-7);
  EXPECT_NEAR(document["dual_objective"].get<double>(), 2, 1e-7);
}

TEST(SolveTest, AnInfeasibleProblemExitsWithOne) {
  // x1 >= 1 and -x1 >= 0.
  const Outcome outcome =
      gainsmith({"solve", "-", "--json"}, "1\n1\n-2\n1\n0 1 1 1 1\n1 1 1 1 1\n1 1 2 2 -1\n");
  EXPECT_EQ(outcome.exit, 1) << outcome.err;
  EXPECT_EQ(outcome.json()["status"], "primal-infeasible");
  EXPECT_TRUE(outcome.json()["certificate"]["checked"]);
}

/// The point that is found on a machine that is said to be an older one; empty where this one is no
/// such machine.
std::string solved_on(const std::string& machine, const std::string& file,
                      const std::string& precision, const Folder& folder) {
  setenv("GAINSMITH_ISA", machine.c_str(), 1);
  const std::string point = folder.path("point.json");
  const Outcome outcome =
      gainsmith({"solve", file, "-q", "-o", point, "--precision", precision, "--threads", "2"});
  unsetenv("GAINSMITH_ISA");
  return outcome.exit == 2 ? "" : text_of(point);
}

TEST(SolveTest, HasTheSameBytesOnMachinesWithFusedProducts) {
  const Folder folder;
  const std::string file = folder.path("p.dat-s");
  gainsmith({"synth", problem("classics/hinf-norm.yaml"), "--sdpa", file});
  for (const char* precision : {"double", "quad"}) {
    const std::string v2 = solved_on("v2", file, precision, folder);
    const std::string v3 = solved_on("v3", file, precision, folder);
    const std::string v4 = solved_on("v4", file, precision, folder);
    const auto older = nlohmann::ordered_json::parse(v2);
    EXPECT_EQ(older["status"], "optimal");
    if (v4.empty()) GTEST_SKIP() << "this machine is not x86-64-v4";
    EXPECT_EQ(v3, v4);
    const auto newer = nlohmann::ordered_json::parse(v3);
    EXPECT_EQ(newer["status"], "optimal");
    // Each has its own kernels; 31 digits do not show it in 17.
    if (std::string(precision) == "double") {
      EXPECT_NE(v2, v3);
    }
  }
}

TEST(SolveTest, AnIterationLimitIsUndecidedWithItsCause) {
  const Outcome outcome = gainsmith({"solve", "-", "--json", "--iterations", "2"}, kSmall);
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_EQ(outcome.json()["status"], "undecided");
  EXPECT_EQ(outcome.json()["cause"], "iteration-limit");
}

TEST(SolveTest, TheSolutionIsWrittenInThreeLayouts) {
  const Folder folder;
  for (const char* format : {"json", "csdp", "sdpa"}) {
    const std::string file = folder.path(format);
    ASSERT_EQ(gainsmith({"solve", "-", "-q", "-o", file, "--format", format}, kSmall).exit, 0);
    EXPECT_FALSE(text_of(file).empty());
  }
  const auto document = nlohmann::ordered_json::parse(text_of(folder.path("json")));
  // X = [x1, 1; 1, x2] and Y = [1, -1; -1, 1].
  EXPECT_NEAR(document["x"][0].get<double>(), 1, 1e-3);
  EXPECT_NEAR(document["X"][0][0][1].get<double>(), 1, 1e-6);
  EXPECT_NEAR(document["Y"][0][1][0].get<double>(), -1, 1e-3);
}

TEST(SolveTest, PrecisionIsChosenOnTheCommandLine) {
  const Outcome wide =
      gainsmith({"solve", "-", "--json", "--precision", "quad", "--tolerance", "1e-20"}, kSmall);
  ASSERT_EQ(wide.exit, 0) << wide.out << wide.err;
  EXPECT_NE(wide.json()["precision"], "double");
  EXPECT_DOUBLE_EQ(wide.json()["primal_objective"].get<double>(), 2);
  EXPECT_EQ(gainsmith({"solve", "-", "--precision", "octuple"}, kSmall).exit, 2);
}

TEST(SolveTest, AnExportedProblemHasTheSameOptimum) {
  const Folder folder;
  const std::string file = folder.path("problem.dat-s");
  const Outcome synthesized =
      gainsmith({"synth", problem("classics/hinf-norm.yaml"), "--json", "--sdpa", file});
  const Outcome solved = gainsmith({"solve", file, "--json"});
  ASSERT_EQ(solved.exit, 0) << solved.err;
  const auto objective = solved.json()["primal_objective"].get<double>();
  EXPECT_NEAR(objective, solved.json()["dual_objective"].get<double>(), 1e-6 * std::abs(objective));
  ASSERT_EQ(synthesized.exit, 0);
  std::smatch unit;
  const std::string text = text_of(file);
  ASSERT_TRUE(std::regex_search(
      text, unit, std::regex("\\* Objective of the problem = \\(c'x\\)/([^ ]*)\\.\n")))
      << text.substr(0, 1000);
  const auto expected = synthesized.json()["objective"].get<double>();
  EXPECT_NEAR(objective / std::stod(unit[1]), expected, 1e-6 * expected);
}

/// An equation has no margin, and X >= 0 with X*1 == 0 has none: nothing in the file asks for one. -X(1, 1)
/// is least for a projection: -2/3.
TEST(SolveTest, AnExportedProblemWithEquationsIsFeasible) {
  const Folder folder;
  const std::string yaml = folder.file(
      "p.yaml",
      "problem: p\nmethod:\n  method: m\n  unknowns: {X: symmetric 3}\n  require: {psd: X >= 0, "
      "centred: \"X*ones(3, 1) == zeros(3, 1)\", total: trace(X) == 1}\n  minimize: -X(1, 1)\nno "
      "campaign: "
      "static\n");
  const std::string file = folder.path("p.dat-s");
  const Outcome synthesized = gainsmith({"synth", yaml, "--json", "--sdpa", file});
  ASSERT_EQ(synthesized.exit, 0) << synthesized.err;
  EXPECT_NEAR(synthesized.json()["objective"].get<double>(), -2.0 / 3, 1e-6);
  EXPECT_EQ(gainsmith({"solve", file}).exit, 0);
}

/// The comments of the file say how its x gives the scalars of the problem: here x > 4 and y <
/// -1e-3 with the least x/1000 - y + 7.
TEST(SolveTest, CommentsOfAnExportedProblemGiveItsUnknowns) {
  const Folder folder;
  const std::string yaml = folder.file(
      "p.yaml",
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar, y: scalar}\n  require: {a: x >= "
      "4000, b: y <= -1e-3}\n  minimize: x/1000 - y + 7\nno campaign: static\n");
  const std::string file = folder.path("p.dat-s");
  ASSERT_EQ(gainsmith({"synth", yaml, "--sdpa", file, "--no-solve"}).exit, 0);
  const Outcome solved = gainsmith({"solve", file, "-o", folder.path("x.json")});
  ASSERT_EQ(solved.exit, 0) << solved.out;
  const auto x = nlohmann::json::parse(text_of(folder.path("x.json")))["x"];
  const std::string text = text_of(file);
  const auto scalar = [&](const std::string& name) {
    std::smatch said;
    if (!std::regex_search(text, said,
                           std::regex("\\* " + name + "[^ ]* = ([^*]*)\\*x_([0-9]+)\n")))
      return std::nan("");
    return std::stod(said[1]) * x.at(std::stoul(said[2]) - 1).get<double>();
  };
  EXPECT_NEAR(scalar("x"), 4000, 4e-3) << text;
  EXPECT_NEAR(scalar("y"), -1e-3, 1e-6) << text;
}

TEST(SolveTest, GarbledFilesAreRefusedWithTheLine) {
  const Folder folder;
  const std::string file = folder.file("bad.dat-s", "2\n1\n2\n1 1\n0 1 1 2 abc\n");
  const Outcome outcome = gainsmith({"solve", file});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("bad.dat-s:5"), std::string::npos) << outcome.err;
}

TEST(SolveTest, SmallSdplibInstances) {
  if (!std::filesystem::exists(GAINSMITH_SDPLIB))
    GTEST_SKIP() << "no SDPLIB at " << GAINSMITH_SDPLIB;
  const std::map<std::string, double> optima = {{"truss1", -8.999996315286891},
                                                {"control1", 17.78462671752341},
                                                {"theta1", 23},
                                                {"truss4", -9.009996291004530}};
  for (const auto& [name, optimum] : optima) {
    const Outcome outcome =
        gainsmith({"solve", std::string(GAINSMITH_SDPLIB) + "/" + name + ".dat-s", "--json"});
    ASSERT_EQ(outcome.exit, 0) << name << outcome.err;
    for (const char* key : {"primal_objective", "dual_objective"})
      EXPECT_NEAR(outcome.json()[key].get<double>(), optimum, 1e-7 * std::abs(optimum)) << name;
  }
}

}  // namespace
}  // namespace gainsmith::tests
