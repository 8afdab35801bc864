// Ctrl-C: what is known is said, the exit code is 3, and nothing is half-written.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <regex>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

const std::string kGood = "ferrante-seuret-2021/t2-0.70.yaml";

/// Of processor time, of all threads.
constexpr double kSoon = 2;

void expect_stopped(const Interrupted& ended) {
  EXPECT_EQ(ended.exit, 3) << ended.out << ended.err;
  EXPECT_LT(ended.seconds, kSoon);
  EXPECT_NE(ended.err.find("interrupted"), std::string::npos) << ended.err;
}

/// A dense A with eigenvalues on both sides, "[[...], ...]"; the same for the same n.
std::string random_matrix(int n, double diagonal) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> hundredths(-40, 40);
  std::string text = "[";
  for (int i = 0; i < n; ++i) {
    text += i == 0 ? "[" : ",\n  [";
    for (int j = 0; j < n; ++j) {
      const double value = hundredths(random) / 100.0 + (i == j ? diagonal : 0);
      text += (j == 0 ? "" : ", ") + std::to_string(value);
    }
    text += "]";
  }
  return text + "]";
}

/// He(P*A) + shift*P < 0, P > 0: large enough to last, whatever the answer.
std::string lyapunov(int n, double diagonal) {
  return "problem: lyapunov\nmethod:\n  method: lyapunov\n  data: {A: n x n, shift: scalar}\n"
         "  unknowns: {P: symmetric n}\n"
         "  require: {positive: P > 0, decrease: \"He(P*A) + shift*P < 0\"}\n"
         "data:\n  shift: 0\n  A: " +
         random_matrix(n, diagonal) + "\n";
}

TEST(InterruptTest, ACampaignSaysHowFarItCame) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", gains}).exit, 0);
  const Interrupted ended = interrupted({"verify", gains, "--runs", "100000000", "--json"});
  expect_stopped(ended);
  const auto report = nlohmann::json::parse(ended.out);
  EXPECT_EQ(report["verdict"], "undecided");
  EXPECT_NE(report["message"].get<std::string>().find("of 100000000 runs"), std::string::npos);
  EXPECT_EQ(report["runs_asked"], 100000000);
  EXPECT_GT(report["runs"], 0);
  EXPECT_LT(report["runs"], 100000000);
}

TEST(InterruptTest, ASchedulerMayEndIt) {
  const Folder folder;
  const std::string gains = folder.path("gains.json"), kept = folder.path("kept");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", gains}).exit, 0);
  const Interrupted ended =
      interrupted({"verify", gains, "--runs", "100000000", "--resume", kept}, 0.5, SIGTERM,
                  [&] { return std::filesystem::exists(kept + "/kept-0.json"); });
  expect_stopped(ended);
  EXPECT_TRUE(has(ended.err, "the same command goes on from there")) << ended.err;
}

TEST(InterruptTest, ASearchForTheWorstRunTellsTheWorstSoFar) {
  const Interrupted ended =
      interrupted({"verify", problem("own-systems/dc-motor.yaml"), "--worst", "--runs", "1000000"});
  expect_stopped(ended);
  EXPECT_TRUE(has(ended.out, "worst       interrupted (")) << ended.out;
  EXPECT_TRUE(has(ended.out, "held so far    worst: ")) << ended.out;
  EXPECT_TRUE(has(ended.out, "--given ")) << ended.out;
}

/// The runs that the words count are those of a campaign of so many runs that was not interrupted.
TEST(InterruptTest, ACampaignTalliesTheRunsThatAreDone) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", gains}).exit, 0);
  const Interrupted ended = interrupted({"verify", gains, "--threads", "1", "--runs", "100000000"});
  expect_stopped(ended);
  const std::string& text = ended.out;
  const std::regex tally("interrupted after ([0-9]+) of 100000000 runs: ([0-9]+) held;");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(text, found, tally)) << text;
  EXPECT_EQ(found[1], found[2]);
  EXPECT_NE(text.find("lyapunov"), std::string::npos) << text;
  const auto whole = gainsmith({"verify", gains, "--runs", found[1].str(), "--json"});
  EXPECT_EQ(whole.exit, 0);
  EXPECT_EQ(nlohmann::json::parse(whole.out)["violations"], 0);
}

TEST(InterruptTest, ARunKeepsWhatIsFinishedAndWritesNoHalves) {
  const Folder folder;
  const std::string quick = problem("classics/hinf-norm.yaml");
  const std::string junit = folder.path("junit.xml");
  const std::string summary = folder.path("out/hinf-norm/summary.txt");
  const Interrupted ended =
      interrupted({"run", quick, problem(kGood), "--threads", "1", "--runs", "100000000", "-o",
                   folder.path("out"), "--junit", junit},
                  1, SIGINT, [&] { return std::filesystem::exists(summary); });
  expect_stopped(ended);
  EXPECT_TRUE(std::filesystem::exists(summary));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/t2-0.70")));
  EXPECT_NE(ended.err.find("interrupted: 1 of 2 problems have no answer"), std::string::npos)
      << ended.err;
  EXPECT_NE(text_of(junit).find("of 100000000 runs"), std::string::npos);
}

TEST(InterruptTest, ASynthesisSaysWhatItKnows) {
  const Folder folder;
  // Whatever the answer is, at this size it takes longer.
  for (const double diagonal : {0.0, -0.5}) {
    const std::string file = folder.file("large.yaml", lyapunov(120, diagonal));
    const Interrupted ended = interrupted({"synth", file, "--json"});
    expect_stopped(ended);
    const auto document = nlohmann::json::parse(ended.out);
    EXPECT_EQ(document["verdict"], "undecided");
    EXPECT_EQ(document["solver"]["cause"], "interrupted");
  }
}

TEST(InterruptTest, AnExplanationSaysWhatItFound) {
  const Folder folder;
  const std::string file = folder.file("large.yaml", lyapunov(120, 0));
  const Interrupted ended = interrupted({"explain", file});
  expect_stopped(ended);
  EXPECT_NE(ended.out.find("verdict     undecided"), std::string::npos) << ended.out;
}

TEST(InterruptTest, ABisectionKeepsTheBestValue) {
  const Folder folder;
  const std::string file = folder.file("small.yaml", lyapunov(12, -4));
  const Interrupted ended = interrupted({"bisect", file, "--largest", "shift", "--in", "0", "1e3",
                                         "--tolerance", "1e-300", "--json"});
  expect_stopped(ended);
  EXPECT_EQ(nlohmann::json::parse(ended.out)["result"]["search"]["finished"], false);
}

TEST(InterruptTest, ATableHasTheRowsThatAreDone) {
  const Interrupted ended =
      interrupted({"scan", problem(kGood), "--over", "T2=0.6:0.7:100000", "--json"});
  expect_stopped(ended);
  const auto rows = nlohmann::json::parse(ended.out);
  EXPECT_EQ(rows.size(), 100'000U);
  EXPECT_EQ(rows.front()["verdict"], "yes");
  EXPECT_EQ(rows.back()["verdict"], "interrupted");
}

TEST(InterruptTest, ASearchKeepsTheBestGains) {
  const Interrupted ended =
      interrupted({"optimize", problem(kGood), "--over", "delta=1e-3:10", "--over", "eta=1e-6:1",
                   "--evaluations", "1000000", "--json"});
  expect_stopped(ended);
  const auto document = nlohmann::json::parse(ended.out);
  EXPECT_EQ(document["verdict"], "yes");
  EXPECT_EQ(document["search"]["finished"], false);
  EXPECT_FALSE(document["gains"].empty());
}

/// maximise trace(X) where X = I + ... in 100 digits: a second for each iteration at least.
TEST(InterruptTest, ASolveInManyDigitsShowsItsPoint) {
  const Folder folder;
  const std::string yaml = folder.file("program.yaml", lyapunov(24, -3));
  const std::string file = folder.path("program.dat-s");
  ASSERT_EQ(gainsmith({"synth", yaml, "--sdpa", file, "--no-solve"}).exit, 0);
  const Interrupted ended = interrupted({"solve", file, "--precision", "100"});
  expect_stopped(ended);
  EXPECT_NE(ended.out.find("undecided (interrupted)"), std::string::npos) << ended.out;
}

/// A proof over a box of four variables, with pieces without end.
TEST(InterruptTest, AProofWithManyPieces) {
  const Folder folder;
  const std::string file = folder.file(
      "box.yaml",
      "problem: box\nmethod:\n  method: box\n  unknowns: {g: scalar}\n  require:\n"
      "    bounded: {forall: [\"a in [0, 1]\", \"b in [0, 1]\", \"c in [0, 1]\", \"d in [0, "
      "1]\"],\n"
      "      that: \"sin(40*a*b) + cos(30*c*d) + sin(50*a*c) + cos(20*b*d) + exp(a*b*c*d) < g\"}\n"
      "  minimize: g\n");
  // The program for other solvers is written before it is solved.
  const std::string program = folder.path("program.dat-s");
  expect_stopped(interrupted({"synth", file, "--sdpa", program}));
  EXPECT_TRUE(std::filesystem::exists(program));
}

TEST(InterruptTest, AMaximumOverABoxOfManyDimensions) {
  const Folder folder;
  const std::string n = "60";
  std::string sum = "0";
  for (int i = 1; i <= 60; ++i)
    sum += " + sin(" + std::to_string(7 * i) + "*z(" + std::to_string(i) + ")*z(1))";
  const std::string file =
      folder.file("box.yaml",
                  "problem: box\nmethod:\n  method: box\n  data: {m: scalar}\n  report: {r: m}\n"
                  "data:\n  m: \"maximum(" +
                      sum + ", z in [-9*ones(" + n + ", 1), 9*ones(" + n + ", 1)])\"\n");
  expect_stopped(interrupted({"check", file}));
}

TEST(InterruptTest, ALongRunIsThereAsFarAsItCame) {
  const Folder folder;
  const std::string file = folder.file(
      "run.yaml",
      "problem: run\nmethod:\n  method: run\n  data: {k: scalar}\n"
      "  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: \"-k*x^3 + sin(t)\"}}\n"
      "data: {k: 1}\ncampaign: {horizon: 1e7}\n");
  const Interrupted ended = interrupted({"simulate", file});
  expect_stopped(ended);
  EXPECT_GT(ended.out.size(), 1000U);
  EXPECT_NE(ended.err.find("interrupted"), std::string::npos);
}

TEST(InterruptTest, AProblemThatNeverComes) {
  const Folder folder;
  const std::string pipe = folder.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int holder = ::open(pipe.c_str(), O_RDWR);
  const Interrupted ended = interrupted({"synth", pipe}, 0);
  ::close(holder);
  EXPECT_EQ(ended.exit, 3) << ended.err;
  EXPECT_LT(ended.seconds, kSoon);
}

TEST(InterruptTest, TimeIsALimitForEveryCommand) {
  const Folder folder;
  const std::string file = folder.file("large.yaml", lyapunov(120, 0));
  const std::vector<std::vector<std::string>> commands = {
      {"synth", file}, {"explain", file}, {"scan", file, "--over", "shift=0:1:1000"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--time", "0.5"});
    const Outcome outcome = gainsmith(words);
    EXPECT_EQ(outcome.exit, 3) << words[0] << outcome.out << outcome.err;
    EXPECT_NE(outcome.err.find("stopped after 0.5 s"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace gainsmith::tests
