// The main job: a problem becomes gains, gains hold in simulation, runs replay.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "base/file.h"
#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

const std::string kTheorem = "ferrante-seuret-2021/t2-0.70.yaml";

/// A gain file of a problem.
std::string synthesized(const Folder& folder, const std::string& name) {
  std::string path = folder.path("gains.json");
  const Outcome outcome = gainsmith({"synth", problem(name), "-o", path});
  EXPECT_LE(outcome.exit, 1) << outcome.err;
  return path;
}

TEST(SynthTest, JsonHasTheDocumentedKeys) {
  const Outcome outcome = gainsmith({"synth", problem(kTheorem), "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const Json document = outcome.json();
  for (const char* key :
       {"verdict", "status", "cause", "objective", "gains", "margins", "parameters"})
    EXPECT_TRUE(document.contains(key)) << key;
  EXPECT_EQ(document["verdict"], "yes");
  EXPECT_EQ(document["status"], "optimal");
  EXPECT_NEAR(document["objective"], 1742.425, 5e-4 * 1742.425);
  EXPECT_LE(document["objective_lower_bound"].get<double>(), document["objective"].get<double>());
}

/// (23): H = inv(P2) X - C inv(P1) Y.
TEST(SynthTest, TheWrittenGainsAreThoseOfTheWrittenUnknowns) {
  const Folder folder;
  const Json gains = Json::parse(text_of(synthesized(folder, kTheorem)));
  const double P2 = gains["unknowns"]["P2"];
  const double X = gains["unknowns"]["X"];
  const double H = gains["gains"]["H"];
  const auto& L = gains["gains"]["L"];
  const double CL = 0.5 * L[0][0].get<double>() - L[1][0].get<double>();
  EXPECT_NEAR(P2 * (H + CL), X, 1e-9 * std::abs(X));
}

TEST(SynthTest, AnInfeasibleProblemExitsWithOneAndItsCertificate) {
  const Folder folder;
  const std::string path = folder.path("gains.json");
  const Outcome outcome =
      gainsmith({"synth", problem("ferrante-seuret-2021/published-theorem.yaml"), "-o", path});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_NE(outcome.out.find("checked"), std::string::npos);
  const Json gains = Json::parse(text_of(path));
  EXPECT_EQ(gains["status"], "infeasible");
  EXPECT_EQ(gains["verdict"], "no");
  const Outcome again = gainsmith({"explain", path});
  EXPECT_EQ(again.exit, 2);
  EXPECT_NE(again.err.find("this is a gain file; expected a problem"), std::string::npos)
      << again.err;
  EXPECT_EQ(gains["certificate"]["about"], "problem");
  EXPECT_TRUE(gains["certificate"]["exact"] || gains["certificate"]["backward_error"] <= 1e-30);
  EXPECT_TRUE(gains["gains"].empty());
  EXPECT_FALSE(gains["certificate"]["multipliers"].empty());
}

/// A certificate says what it shows: an eigenvalue of A is irrational and positive, so its
/// multipliers are in no digits exact; with a diagonal A they are.
TEST(SynthTest, ANoSaysWhetherNoSolutionExistsOrNoneSurvivesASmallChange) {
  const Folder folder;
  const std::string text =
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > I, decrease: He(P*A) < 0}\ndata: {A: ";
  for (const char* A : {"[[0, 1], [1, -1]]", "[[1, 0], [0, 2]]"}) {
    const std::string path = folder.file("unstable.yaml", text + A + "}\n");
    const Outcome said = gainsmith({"synth", path});
    const Json certificate = gainsmith({"synth", path, "--json"}).json()["certificate"];
    const bool exact = certificate["exact"];
    const std::string shows = certificate["shows"];
    EXPECT_EQ(shows.find("no solution exists") == 0, exact) << shows;
    EXPECT_EQ(shows.find("no solution survives a relative change of ") == 0, !exact) << shows;
    EXPECT_NE(said.out.find(shows), std::string::npos) << said.out;
    EXPECT_EQ(said.out.find("exclude"), std::string::npos) << said.out;
    EXPECT_EQ(gainsmith({"explain", path, "--json"}).json()["conflict"].contains("shows"), true);
  }
}

/// No decimals are 1/3: a solution near the unknowns is, and that is said.
TEST(SynthTest, AYesMayBeAboutASolutionNearTheDecimals) {
  const Folder folder;
  const std::string path =
      folder.file("third.yaml",
                  "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar, k: scalar}\n"
                  "  require: {third: 3*x == 1, below: x < k}\n  gains: {K: k}\n  minimize: k\n");
  const std::string gains = folder.path("gains.json");
  const Outcome said = gainsmith({"synth", path, "-o", gains});
  ASSERT_EQ(said.exit, 0) << said.out;
  EXPECT_NE(said.out.find("solution    within "), std::string::npos) << said.out;
  const Json document = Json::parse(text_of(gains));
  const double within = document["solution_within"];
  EXPECT_LE(std::abs(std::fma(3, document["unknowns"]["x"].get<double>(), -1)), 3 * within);
  EXPECT_LT(within, 1e-15);
  // Another program may read the file.
  EXPECT_EQ(gainsmith({"export", gains, "--to", "json"}).exit, 0);
}

TEST(SynthTest, WithoutUnknownsTheDataDecide) {
  const std::string text =
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  require: {short: A'*A < I}\n";
  EXPECT_EQ(gainsmith({"synth", "-"}, text + "data: {A: [[0, 0.9], [0, 0]]}\n").exit, 0);
  const Outcome no = gainsmith({"synth", "-"}, text + "data: {A: [[0, 1.1], [0, 0]]}\n");
  EXPECT_EQ(no.exit, 1);
  EXPECT_NE(no.out.find("an exact certificate lies near"), std::string::npos) << no.out;
}

TEST(SynthTest, TwiceTheSameBytesApartFromTimings) {
  const Folder folder;
  const std::string first = synthesized(folder, kTheorem);
  const std::string text = text_of(first);
  EXPECT_EQ(without_timings(text), without_timings(text_of(synthesized(folder, kTheorem))));
}

TEST(SynthTest, TheGainFileGoesToStandardOutputOnRequest) {
  const Outcome outcome = gainsmith({"synth", problem(kTheorem), "-o", "-"});
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_TRUE(outcome.json().contains("statement"));
  EXPECT_NE(outcome.err.find("verdict"), std::string::npos);
}

TEST(SynthTest, AProblemMayComeFromStandardInput) {
  const Outcome outcome = gainsmith({"synth", "-", "--json"}, text_of(problem(kTheorem)));
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
}

TEST(VerifyTest, TheReportDoesNotDependOnThreads) {
  const Folder folder;
  const std::string gains = synthesized(folder, kTheorem);
  const Outcome one = gainsmith({"verify", gains, "--runs", "200", "--threads", "1", "--json"});
  const Outcome two = gainsmith({"verify", gains, "--runs", "200", "--threads", "2", "--json"});
  EXPECT_EQ(one.exit, 0) << one.err;
  EXPECT_EQ(one.out, two.out);
  const Json document = one.json();
  for (const char* key : {"verdict", "runs", "violations", "worst_run", "checks"})
    EXPECT_TRUE(document.contains(key)) << key;
  EXPECT_EQ(document["runs"], 200);
}

TEST(VerifyTest, AViolationReplaysFromItsSeedAndRun) {
  const Folder folder;
  const std::string gains = synthesized(folder, "ferrante-seuret-2021/row-3.yaml");
  const Outcome verified = gainsmith({"verify", gains, "--runs", "100", "--json"});
  EXPECT_EQ(verified.exit, 1);
  const Json report = verified.json();
  EXPECT_EQ(report["verdict"], "violated");
  EXPECT_GT(report["violations"].get<int>(), 0);
  const std::string csv = folder.path("run.csv");
  const Outcome replayed = gainsmith(
      {"simulate", gains, "--run", std::to_string(report["worst_run"].get<int>()), "-o", csv});
  ASSERT_EQ(replayed.exit, 0) << replayed.err;
  // The last line's claim column is the value that the campaign reported.
  std::istringstream lines(text_of(csv));
  std::string header;
  std::string last;
  std::getline(lines, header);
  for (std::string line; std::getline(lines, line);) last = line;
  EXPECT_EQ(header.substr(0, 10), "t,j,event,");
  const auto column = [](const std::string& line, std::size_t at) {
    std::istringstream fields(line);
    std::string field;
    for (std::size_t i = 0; i <= at; ++i) std::getline(fields, field, ',');
    return field;
  };
  std::size_t at = 0;
  while (!column(header, at).empty() && column(header, at) != "error") ++at;
  double worst = 0;
  for (const auto& check : report["checks"])
    if (check["claim"] == "error") worst = check["worst"]["value"].get<double>();
  EXPECT_NEAR(std::stod(column(last, at)), worst, 1e-9 * worst);
}

TEST(VerifyTest, AYesWithoutItsMatricesIsRefused) {
  const Folder folder;
  Json gains = Json::parse(text_of(synthesized(folder, kTheorem)));
  Json stripped = gains;
  stripped["unknowns"].erase("P2");
  const Outcome missing = gainsmith({"verify", folder.file("stripped.json", stripped.dump())});
  EXPECT_EQ(missing.exit, 2);
  EXPECT_NE(missing.err.find("P2 is missing"), std::string::npos) << missing.err;
  gains["parameters"]["shrink"] = 1e9;
  const Outcome changed = gainsmith({"verify", folder.file("changed.json", gains.dump())});
  EXPECT_EQ(changed.exit, 2);
  EXPECT_NE(changed.err.find("parameters.shrink"), std::string::npos) << changed.err;
}

/// Over so long a horizon the plant grows until rounding hides the error: that is not "held".
TEST(VerifyTest, AnUnstableObserverIsNotHeldByRounding) {
  const Folder folder;
  const std::string longer = folder.file(
      "long.yaml", "problem: long\nlike: " + problem("ferrante-seuret-2021/row-3.yaml") +
                       "\ncampaign: {horizon: 500}\n");
  const std::string path = folder.path("long.json");
  ASSERT_EQ(gainsmith({"synth", longer, "-o", path}).exit, 1);
  EXPECT_EQ(gainsmith({"verify", path, "--runs", "10"}).exit, 1);
}

TEST(VerifyTest, AFileWithoutGainsIsRefused) {
  const Folder folder;
  const std::string gains = synthesized(folder, "ferrante-seuret-2021/published-theorem.yaml");
  for (const char* command : {"verify", "simulate"}) {
    const Outcome without = gainsmith({command, gains});
    EXPECT_EQ(without.exit, 2) << command;
    EXPECT_NE(without.err.find("the verdict is no: the file has no gains"), std::string::npos)
        << without.err;
  }
}

}  // namespace
}  // namespace gainsmith::tests
