// What a job of CI and its scripts do: pipes, results that are replaced, expectations, exports.
#include <gtest/gtest.h>

#include <filesystem>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

const std::string kLqr =
    "problem: motor\nmethod: lqr\ndata: {A: [[0, 1], [0, 0]], B: [[0], [1]]}\n"
    "no campaign: a number\n";

TEST(Ci, AGainFileComesThroughAPipe) {
  const Folder folder;
  const std::string gains = gainsmith({"synth", folder.file("p.yaml", kLqr), "-o", "-"}).out;
  EXPECT_EQ(gainsmith({"check", "-"}, gains).exit, 0);
  const std::string named = folder.file("g.json", gains);
  EXPECT_EQ(gainsmith({"export", "-", "--to", "json"}, gains).out,
            gainsmith({"export", named, "--to", "json"}).out);
  const std::string run = folder.path("run.json");
  ASSERT_EQ(gainsmith({"synth", problem("designs/observer.yaml"), "-o", run}).exit, 0);
  const Outcome outcome = gainsmith({"verify", "-", "--runs", "5"}, text_of(run));
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out, with(gainsmith({"verify", run, "--runs", "5"}).out, run, "-"));
}

TEST(Ci, WhatGetsBetterIsAsExpected) {
  const Folder folder;
  // trace(P) = 2 sqrt(3) = 3.46, K = [-1, -sqrt(3)], by hand.
  const auto exit = [&](const std::string& values) {
    return gainsmith({"run", folder.file("p.yaml", kLqr + "expect: {values: {" + values + "}}\n"),
                      "-o", folder.path("out")});
  };
  EXPECT_EQ(exit("objective: {below: 3.5, above: 3}, K: {below: [[0, 0]]}").exit, 0);
  const Outcome worse = exit("objective: {below: 3}");
  EXPECT_EQ(worse.exit, 1);
  EXPECT_TRUE(has(worse.out, "objective: expected at most 3, found 3.46")) << worse.out;
  const Outcome element = exit("K: {above: [[-1.5, -1.5]]}");
  EXPECT_TRUE(has(element.out, "expected at least [-1.5, -1.5]")) << element.out;
  EXPECT_TRUE(has(element.out, "farthest from it at (1, 2)")) << element.out;
  EXPECT_TRUE(has(exit("objective: {relative: 1}").out, "expected a 'value' with its tolerance"));
  EXPECT_TRUE(has(exit("objective: {below: 3, relative: 1}").out, "a tolerance is of a 'value'"));
  EXPECT_TRUE(has(exit("objective: {value: 3}").out, "expected a tolerance"));
}

TEST(Ci, GainsThatWereChangedForTheWorseAreNotExported) {
  const Folder folder;
  const std::string gains = gainsmith({"synth", folder.file("p.yaml", kLqr), "-o", "-"}).out;
  auto edited = nlohmann::ordered_json::parse(gains);
  edited["gains"]["K"] = {{1.0, 1.0}};
  const std::string file = folder.file("edited.json", edited.dump());
  EXPECT_EQ(gainsmith({"check", file}).exit, 1);
  const Outcome outcome = gainsmith({"export", file, "--to", "c", "-o", folder.path("k.h")});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(has(outcome.err, "the inequalities do not hold at these gains")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("k.h")));
}

TEST(Ci, AnEmptyFolderStopsNothingElse) {
  const Folder folder;
  std::filesystem::create_directories(folder.path("empty"));
  std::filesystem::create_directories(folder.path("all/.hidden"));
  folder.file("all/motor.yaml", kLqr);
  folder.file("all/.gitlab-ci.yaml", "stages: [test]\n");
  folder.file("all/.hidden/other.yaml", "stages: [test]\n");
  const std::string junit = folder.path("junit.xml");
  const Outcome outcome = gainsmith({"run", folder.path("all"), folder.path("empty"), "-o",
                                     folder.path("out"), "--junit", junit});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.out, "2 problems: 1 ok, 1 ERROR")) << outcome.out;
  EXPECT_TRUE(has(text_of(junit), "tests=\"2\" failures=\"0\" errors=\"1\"")) << text_of(junit);
}

TEST(Ci, StandardOutputIsNoFolderAndNoReport) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kLqr);
  EXPECT_TRUE(has(gainsmith({"run", file, "-o", "-"}).err, "expected a folder for the results"));
  EXPECT_TRUE(has(gainsmith({"run", file, "--junit", "-"}).err, "--junit: expected a file"));
}

TEST(Ci, AProblemThatIsStoppedLeavesNoOlderResult) {
  const Folder folder;
  const std::string out = folder.path("out");
  const std::string file = problem("own-systems/pendulum-ekf.yaml");
  ASSERT_EQ(gainsmith({"run", file, "-o", out, "--runs", "1"}).exit, 0);
  ASSERT_TRUE(std::filesystem::exists(out + "/pendulum-ekf/result.json"));
  const Outcome outcome =
      gainsmith({"run", file, "-o", out, "--runs", "1000000000", "--time", "1"});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_TRUE(has(outcome.err, "with --resume the same command keeps the others")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(out + "/pendulum-ekf/result.json"));
}

TEST(Ci, APathWithABlankIsQuotedInCommands) {
  const Folder folder;
  std::filesystem::create_directories(folder.path("my plant"));
  const std::string gains = folder.path("my plant/gains.json");
  ASSERT_EQ(gainsmith({"synth", problem("designs/observer.yaml"), "-o", gains}).exit, 0);
  const Outcome outcome = gainsmith({"verify", gains, "--runs", "3"});
  EXPECT_TRUE(has(outcome.out, "gainsmith simulate '" + gains + "' --run")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "-o run.csv")) << outcome.out;
}

TEST(Ci, AViolationStaysOneWhenACampaignIsStopped) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml",
                  "problem: p\nmethod:\n  plant: {state: {x: 1}, flow: {x: -x^3}}\n"
                  "  claims: {small: {below: x, bound: 0.5}}\n"
                  "campaign: {horizon: 1, initial: {x: {box: [0, 1]}}}\n");
  const Outcome outcome = interrupted({"verify", file, "--runs", "1000000000"});
  EXPECT_EQ(outcome.exit, 1) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "violated: interrupted after ")) << outcome.out;
}

TEST(Ci, ControlCharactersDoNotBreakTheReport) {
  const Folder folder;
  const std::string junit = folder.path("j.xml");
  gainsmith({"run", folder.file("p.yaml", kLqr + "let: {a: \"\\e1\"}\n"), "-o", folder.path("out"),
             "--junit", junit});
  const std::string text = text_of(junit);
  EXPECT_TRUE(has(text, "\\x1b")) << text;
  EXPECT_FALSE(has(text, "\x1b")) << text;
}

}  // namespace
}  // namespace gainsmith::tests
