// Dynamics with events, from the text to tables and pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// Two observers of a double integrator; some samples are lost.
const std::string kSampled = R"yaml(problem: sampled
method:
  method: sampled
  let:    {A: "[0, 1; 0, 0]", C: "[1, 0]"}
  events: {sample: {every: [0.1, 0.3], lost: {probability: 0.3, in_a_row: 2}}}
  plant:
    state:  {x: {shape: 2, start: "[1; 1]"}}
    output: {y: {value: C*x, at: sample}}
    flow:   {x: A*x}
  observers:
    fast:
      state: {xh: {shape: 2, start: 0}}
      let:   {L: "[1; 2]"}
      flow:  {xh: A*xh}
      at:    {sample: {xh: "xh + L*(y - C*xh)"}}
    slow: {like: fast, let: {L: "[0.5; 0.5]"}}
  signals: {e: x - xh}
  claims:  {small: {shrinks: norm(e), to: 0.1}}
campaign: {runs: 5, horizon: 10}
compare: [{settles: norm(e), below: 0.01}, {peak: norm(e)}]
expect: {campaign: held, run: [{ended: horizon}]}
)yaml";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::ptrdiff_t lines_with(const std::string& text, const std::string& word) {
  const auto lines = lines_of(text);
  return std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.find(word) != std::string::npos;
  });
}

TEST(Events, CheckNamesObserversAndEvents) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kSampled);
  const Outcome outcome = gainsmith({"check", file});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("a design by formula"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("fast, slow"), std::string::npos) << outcome.out;
  EXPECT_EQ(gainsmith({"check", "--json", file}).json()[0]["events"][0], "sample");
}

TEST(Events, TheTableHasARowForEachJump) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kSampled);
  const Outcome outcome = gainsmith({"simulate", file, "--run", "2", "--judge"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  EXPECT_EQ(lines.front().rfind("t,j,event,", 0), 0U) << lines.front();
  EXPECT_GT(lines_with(outcome.out, ",sample,"), 10);
  EXPECT_GT(lines_with(outcome.out, ",sample (lost),"), 2);
  EXPECT_NE(outcome.err.find("satisfies the texts"), std::string::npos) << outcome.err;
  EXPECT_EQ(gainsmith({"simulate", file, "--run", "2"}).out, outcome.out);
  EXPECT_NE(gainsmith({"simulate", file, "--run", "3"}).out, outcome.out);
}

TEST(Events, FiguresStandSideBySide) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kSampled);
  const Outcome outcome = gainsmith({"simulate", file, "--compare"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3U) << outcome.out;
  EXPECT_LT(lines[0].find("fast"), lines[0].find("slow"));
  EXPECT_NE(lines[1].find("settles norm(e)"), std::string::npos);
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--json"}, {"--judge"}, {"--step", "0.1"}}) {
    std::vector<std::string> arguments = {"simulate", file, "--compare"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(gainsmith(arguments).exit, 2) << more.front();
  }
}

TEST(Events, ThePictureIsWritten) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kSampled);
  const Outcome outcome = gainsmith({"simulate", file, "--plot", folder.path("run.svg")});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::string picture = text_of(folder.path("run.svg"));
  EXPECT_EQ(picture.rfind("<svg", 0), 0U) << picture.substr(0, 80);
  for (const char* name : {"fast.xh1", "slow.xh2", "|fast.e|", "size of the error"})
    EXPECT_NE(picture.find(name), std::string::npos) << name;
}

TEST(Events, CampaignsSayWhichObserverFails) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kSampled);
  const Outcome held = gainsmith({"verify", file});
  EXPECT_EQ(held.exit, 0) << held.out << held.err;
  EXPECT_EQ(gainsmith({"run", file, "-o", folder.path("out")}).exit, 0);

  std::string broken = kSampled;
  broken.replace(broken.find("[0.5; 0.5]"), 10, "[0; 0]");
  const Outcome violated = gainsmith({"verify", folder.file("q.yaml", broken)});
  EXPECT_EQ(violated.exit, 1) << violated.out << violated.err;
  EXPECT_NE(violated.out.find("slow"), std::string::npos) << violated.out;
  const Outcome run = gainsmith({"run", folder.path("q.yaml"), "-o", folder.path("out")});
  EXPECT_NE(run.exit, 0);
  EXPECT_NE((run.out + run.err).find("expected"), std::string::npos) << run.out << run.err;
}

TEST(Events, ExpectedFiguresAreCompared) {
  const Folder folder;
  std::string text = kSampled;
  text.replace(text.find("{ended: horizon}"), 16, "{ended: zeno}");
  const Outcome outcome = gainsmith({"run", folder.file("p.yaml", text), "-o", folder.path("out")});
  EXPECT_NE(outcome.exit, 0);
  EXPECT_NE((outcome.out + outcome.err).find("expected zeno, found horizon"), std::string::npos)
      << outcome.out << outcome.err;
}

}  // namespace
}  // namespace gainsmith::tests
