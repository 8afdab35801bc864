// The search for worst runs, and bisection on the verdict of campaigns, as a person uses them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

/// Repeats the run that is given for a claim; the text about it.
std::string repeated(const std::string& gains, const Json& claim) {
  const Folder folder;
  const Outcome outcome = gainsmith({"simulate", gains, "--given", claim["given"].dump(), "--judge",
                                     "-o", folder.path("run.csv")});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  return outcome.out + outcome.err;
}

TEST(Worst, OnlyTheSearchFindsLengthsThatTakeTurns) {
  const std::string file = problem("own-systems/uneven-samples.yaml");
  const Outcome sampled = gainsmith({"verify", file, "--runs", "20000"});
  EXPECT_EQ(sampled.exit, 0) << sampled.out;
  const Outcome searched = gainsmith({"verify", file, "--worst"});
  EXPECT_EQ(searched.exit, 1) << searched.err;
  EXPECT_TRUE(has(searched.out, "worst       violated")) << searched.out;
  EXPECT_TRUE(has(searched.out, "grows by a factor of 1.3068")) << searched.out;
  EXPECT_TRUE(has(searched.out, R"("lengths":{"sample":[0.1,1.1]})")) << searched.out;
  const Json report = gainsmith({"verify", file, "--worst", "--json"}).json();
  EXPECT_EQ(report["verdict"], "violated");
  const std::string text = repeated(file, report["claims"][0]);
  EXPECT_TRUE(has(text, "bounded      violated: ")) << text;
  EXPECT_TRUE(has(text, "the run satisfies the texts")) << text;
}

TEST(Worst, TheRowThatIsMisprintedIsUnstableToBoth) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  gainsmith({"synth", problem("ferrante-seuret-2021/row-3.yaml"), "-o", gains});
  EXPECT_EQ(gainsmith({"verify", gains}).exit, 1);
  const Outcome searched = gainsmith({"verify", gains, "--worst", "--json"});
  EXPECT_EQ(searched.exit, 1) << searched.err;
  const Json report = searched.json();
  EXPECT_EQ(report["linear_part"]["lengths"], Json({1.1}));
  EXPECT_NEAR(report["linear_part"]["growth"].get<double>(), 1.2062, 1e-4);
  EXPECT_TRUE(has(repeated(gains, report["claims"][0]), "error        violated: "));
}

TEST(Worst, NothingFoundShowsNothingAndTheThreadsDoNotMatter) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  gainsmith({"synth", problem("ferrante-seuret-2021/t2-0.70.yaml"), "-o", gains});
  const std::vector<std::string> search = {"verify", gains, "--worst",
                                           "--runs", "300", "--threads"};
  auto with = [&](const std::string& threads) {
    std::vector<std::string> words = search;
    words.push_back(threads);
    return gainsmith(words);
  };
  const Outcome one = with("1");
  EXPECT_EQ(one.exit, 0) << one.out << one.err;
  EXPECT_TRUE(has(one.out, "no violation found")) << one.out;
  EXPECT_TRUE(has(one.out, "that nothing was found shows nothing")) << one.out;
  EXPECT_EQ(one.out, with("3").out);
}

TEST(Worst, WhatDoesNotFitIsSaid) {
  const Folder folder;
  const std::string file = problem("own-systems/uneven-samples.yaml");
  const Outcome probability = gainsmith({"verify", file, "--worst", "--probability", "0.1"});
  EXPECT_EQ(probability.exit, 2);
  EXPECT_TRUE(has(probability.err, "runs at random")) << probability.err;
  const Outcome length =
      gainsmith({"simulate", file, "--given", R"({"lengths": {"sample": [3]}})"});
  EXPECT_EQ(length.exit, 2);
  EXPECT_TRUE(has(length.err, "outside its range [0.1, 1.1]")) << length.err;
  const Outcome several = gainsmith(
      {"simulate", file, "--given", "{}", "--runs", "0:3", "--plot", folder.path("p.svg")});
  EXPECT_EQ(several.exit, 2);
  const Outcome nothing = gainsmith({"verify", problem("own-systems/thermostat.yaml"), "--worst"});
  EXPECT_EQ(nothing.exit, 2);
  EXPECT_TRUE(has(nothing.err, "nothing is drawn")) << nothing.err;
}

/// x' = x/2 - k x falls to a tenth within 10 from k = 0.5 + log(10)/10 on.
TEST(Worst, TheSmallestGainForWhichTheClaimsHoldIsBisected) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", R"(problem: p
method:
  data: {k: {shape: scalar, default: 1}}
  plant: {state: {x: scalar}, flow: {x: x/2 - k*x}}
  claims: {decays: {shrinks: abs(x), to: 0.1}}
campaign: {runs: 10, horizon: 10, initial: {x: {box: [1, 2]}}}
)");
  const std::string gains = folder.path("gains.json");
  const Outcome found = gainsmith(
      {"bisect", file, "--smallest", "k", "--in", "0", "2", "--claims", "-o", gains, "--json"});
  EXPECT_EQ(found.exit, 0) << found.err;
  const double k = found.json()["result"]["searched"]["k"].get<double>();
  const double exact = 0.5 + std::log(10) / 10;
  EXPECT_GE(k, exact);
  EXPECT_LE(k, exact + 2e-4);
  EXPECT_EQ(gainsmith({"verify", gains}).exit, 0);
  const Outcome none =
      gainsmith({"bisect", file, "--smallest", "k", "--in", "0", "0.5", "--claims"});
  EXPECT_EQ(none.exit, 3);
  EXPECT_TRUE(has(none.out, "violated claims")) << none.out;
  const Outcome text = gainsmith({"bisect", file, "--smallest", "k", "--in", "0", "2", "--claims"});
  EXPECT_TRUE(has(text.out, "held in 10 runs")) << text.out;
  EXPECT_TRUE(has(text.out, "violated in 10 of 10 runs")) << text.out;
}

}  // namespace
}  // namespace gainsmith::tests
