// Dynamics with events, from the text to tables and pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
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
       std::vector<std::vector<std::string>>{{"--judge"}, {"--step", "0.1"}}) {
    std::vector<std::string> arguments = {"simulate", file, "--compare"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(gainsmith(arguments).exit, 2) << more.front();
  }
}

/// Run by run, and the least, middle and largest of them.
TEST(Events, FiguresOfSeveralRunsAreSummedUp) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kSampled);
  const auto numbers = [](const std::string& line) {
    std::istringstream stream(line.substr(line.find("norm(e)")));
    std::vector<double> found;
    for (std::string word; stream >> word;)
      if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) found.push_back(std::stod(word));
    return found;
  };
  const auto of_run = [&](double run) {
    const std::string number = std::to_string(static_cast<int>(run));
    return numbers(lines_of(gainsmith({"simulate", file, "--compare", "--run", number}).out)[1])
        .at(1);
  };
  std::vector<double> fast;
  for (int run = 0; run < 4; ++run) fast.push_back(of_run(run));
  std::sort(fast.begin(), fast.end());
  ASSERT_LT(fast[0], fast[3]);
  const Outcome outcome = gainsmith({"simulate", file, "--compare", "--runs", "0:3"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5U) << outcome.out;  // two figures of two observers
  EXPECT_LT(lines[0].find("least"), lines[0].find("largest"));
  EXPECT_NE(lines[1].find("fast"), std::string::npos) << outcome.out;
  EXPECT_NE(lines[2].find("slow"), std::string::npos) << outcome.out;
  EXPECT_EQ(numbers(lines[1]).at(1), fast[0]);
  EXPECT_NEAR(numbers(lines[1]).at(3), (fast[1] + fast[2]) / 2, 1e-5);
  EXPECT_EQ(numbers(lines[1]).at(4), fast[3]);
  EXPECT_EQ(of_run(numbers(lines[1]).at(2)), fast[0]);
  EXPECT_EQ(of_run(numbers(lines[1]).at(5)), fast[3]);
  EXPECT_EQ(gainsmith({"simulate", file, "--compare", "--runs", "0:3", "--run", "2"}).exit, 2);
  EXPECT_EQ(gainsmith({"simulate", file, "--runs", "0:3"}).exit, 2);
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

TEST(Events, CheckRefusesWhatRunsRefuse) {
  const Folder folder;
  const Outcome late =
      gainsmith({"check", folder.file("late.yaml", with(kSampled, "{shrinks: norm(e), to: 0.1}",
                                                        "{below: norm(e), bound: 1, after: 11}"))});
  EXPECT_EQ(late.exit, 2);
  EXPECT_NE(late.err.find("after"), std::string::npos) << late.err;
}

TEST(Events, AParameterThatNothingChoosesIsRefused) {
  const Folder folder;
  const std::string open =
      with(kSampled, "  events:", "  parameters: {k: {search: [0.1, 1]}}\n  events:");
  const std::string file = folder.file("p.yaml", with(open, "L: \"[1; 2]\"", "L: \"k*[1; 2]\""));
  const std::string gains = folder.path("gains.json");
  const Outcome synth = gainsmith({"synth", file, "-o", gains});
  EXPECT_EQ(synth.exit, 2) << synth.out;
  EXPECT_NE(synth.err.find("p.yaml:5:"), std::string::npos) << synth.err;
  EXPECT_NE(synth.err.find("which k is best"), std::string::npos) << synth.err;
  EXPECT_FALSE(std::filesystem::exists(gains));
  const Outcome simulate = gainsmith({"simulate", file});
  EXPECT_EQ(simulate.exit, 2);
  EXPECT_NE(simulate.err.find("not known yet"), std::string::npos) << simulate.err;
}

TEST(Events, AFigureWithoutAValueSaysSo) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", with(kSampled, "{peak: norm(e)}]", "{at: {t: 11}, value: norm(e)}]"));
  const Outcome outcome = gainsmith({"simulate", file, "--compare"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("-: no such event in this run, a time after its end"),
            std::string::npos)
      << outcome.out;
}

TEST(Events, InputsAreColumns) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", with(with(kSampled, "  events:", "  inputs: {u: sin(t)}\n  events:"),
                                 "flow:   {x: A*x}", "flow:   {x: \"A*x + [0; 1]*u\"}"));
  const Outcome outcome = gainsmith({"simulate", file});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_NE(lines_of(outcome.out).front().find(",u,"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace gainsmith::tests
