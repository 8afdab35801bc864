#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

TEST(CommandLineTest, HelpIsAlsoAWord) {
  EXPECT_EQ(gainsmith({"help"}).out, gainsmith({"--help"}).out);
  EXPECT_EQ(gainsmith({"help", "help"}).out, gainsmith({"--help"}).out);
  const Outcome synth = gainsmith({"help", "synth"});
  EXPECT_EQ(synth.exit, 0) << synth.err;
  EXPECT_EQ(synth.out, gainsmith({"synth", "--help"}).out);
  const Outcome unknown = gainsmith({"help", "synt"});
  EXPECT_EQ(unknown.exit, 2);
  EXPECT_NE(unknown.err.find("did you mean 'synth'?"), std::string::npos) << unknown.err;
}

TEST(CommandLineTest, HelpHasExamplesForEverySubcommand) {
  for (const char* command : {"synth", "bisect", "scan", "optimize", "explain", "verify",
                              "simulate", "solve", "check", "run", "report", "methods", "init"}) {
    const Outcome outcome = gainsmith({command, "--help"});
    EXPECT_EQ(outcome.exit, 0) << command;
    EXPECT_NE(outcome.out.find("Example"), std::string::npos) << command;
    EXPECT_NE(outcome.out.find("--json"), std::string::npos) << command;
  }
}

TEST(CommandLineTest, WrongCommandLinesExitWithTwo) {
  const std::string good = problem("ferrante-seuret-2021/t2-0.70.yaml");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"synt"},
                                             {"synth"},
                                             {"--bogus"},
                                             {"synth", good, "--bogus"},
                                             {"synth", good, "-o", "x", "--sdpa", "x"},
                                             {"verify", "x", "--runs", "0"},
                                             {"verify", "x", "--runs", "many"},
                                             {"methods", "sampled-data-hibrid"}}) {
    const Outcome outcome = gainsmith(arguments);
    EXPECT_EQ(outcome.exit, 2) << outcome.err;
    EXPECT_NE(outcome.err, "");
  }
}

TEST(CommandLineTest, WhatIsWrongIsSaidInOneLineWithTheCure) {
  const std::string good = problem("ferrante-seuret-2021/t2-0.70.yaml");
  struct Case {
    std::vector<std::string> arguments;
    const char* message;
  };
  for (const Case& wrong : std::vector<Case>{
           {{"synth", good, "--thread", "3"},
            "unknown option '--thread'; did you mean '--threads'?"},
           {{"synth", good, "--thread=3"}, "unknown option '--thread'; did you mean '--threads'?"},
           {{"synth", good, "more"}, "unexpected argument 'more'"},
           {{"synth"}, "problem is missing: problem file (YAML)"},
           {{"verify", "x", "--seed", "18446744073709551616"}, "2^64 - 1"},
           {{"verify", "x", "--seed", "-1"}, "whole number"},
           {{"simulate", "x", "--run", "18446744073709551616"}, "2^64 - 1"}}) {
    const Outcome outcome = gainsmith(wrong.arguments);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.err.find(wrong.message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("see 'gainsmith " + wrong.arguments[0] + " --help'"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST(CommandLineTest, ATimeIsAPositiveNumberOfSeconds) {
  for (const char* command : {"synth", "bisect", "scan", "optimize", "explain", "verify",
                              "simulate", "solve", "check", "run"}) {
    if (gainsmith({command, "--help"}).out.find("--time") == std::string::npos) continue;
    for (const std::string text :
         {"-1", "0", "-0", "nan", "inf", "1e400", "1e-400", "soon", "5s", "0x10", "", " 5"}) {
      const Outcome outcome = gainsmith({command, "x", "--time", text});
      EXPECT_EQ(outcome.exit, 2) << text;
      EXPECT_NE(outcome.err.find(std::string(command) +
                                 ": --time: expected a positive number of seconds, such as 60 or "
                                 "0.5, not '" +
                                 text + "'"),
                std::string::npos)
          << outcome.err;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
  }
}

/// Of [cos, -sin; sin, cos] diag(0.3, -1) [cos, sin; -sin, cos] in 17 digits C shows only the
/// second mode, up to rounding: undecided.
TEST(CommandLineTest, ExplainNamesAHiddenModeOnce) {
  const Folder folder;
  const std::string file = folder.file(
      "hidden.yaml",
      "problem: hidden\nmethod:\n  method: m\n  data: {A: n x n, C: p x n}\n"
      "  unknowns: {P: symmetric n, Y: n x p}\n  require: {positive: P > 0, decrease: He(P*A - "
      "Y*C) "
      "< 0}\n  gains: {L: inv(P)*Y}\n  plant: {state: {x: n}, output: {y: C*x}, flow: {x: A*x}}\n"
      "  observer: {state: {xh: n}, flow: {xh: A*xh + L*(y - C*xh)}}\n"
      "data:\n  A: [[-0.2395213571148433, 0.6405423244924991], [0.6405423244924991, "
      "-0.4604786428851567]]\n  C: [[0.644217687237691, -0.7648421872844885]]\n"
      "no campaign: static\n");
  const Outcome outcome = gainsmith({"explain", file});
  const std::size_t first = outcome.out.find("(Hautus)");
  ASSERT_NE(first, std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("(Hautus)", first + 1), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("eigenvalue 0.3 "), std::string::npos) << outcome.out;
}

TEST(CommandLineTest, RangesOfNumbersAreNamedShortly) {
  const Outcome outcome = gainsmith({"solve", "x", "--tolerance", "1"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("expected a number from 1e-30 to 0.01, not '1'"), std::string::npos)
      << outcome.err;
}

TEST(CommandLineTest, TheLargestSeedIsTaken) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", problem("ferrante-seuret-2021/t2-0.70.yaml"), "-o", gains}).exit,
            0);
  const Outcome outcome =
      gainsmith({"verify", gains, "--runs", "2", "--seed", "18446744073709551615", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["seed"].get<std::uint64_t>(), 18446744073709551615U);
}

TEST(CommandLineTest, MethodsAreListedAndPrintedAsText) {
  const Outcome list = gainsmith({"methods", "--json"});
  ASSERT_EQ(list.exit, 0);
  EXPECT_GE(list.json().size(), 5U);
  for (const auto& method : list.json()) {
    const Outcome text = gainsmith({"methods", method["method"].get<std::string>()});
    EXPECT_EQ(text.exit, 0);
    EXPECT_EQ(text.out.find("method: " + method["method"].get<std::string>()), 0U);
  }
}

TEST(CommandLineTest, AGainFileDoesNotReplaceItsProblem) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", text_of(problem("classics/quadratic-stability.yaml")));
  EXPECT_EQ(gainsmith({"synth", file, "-o", file}).exit, 2);
  EXPECT_EQ(text_of(file), text_of(problem("classics/quadratic-stability.yaml")));
}

TEST(CommandLineTest, RunTakesAMethodThatCannotBeSimulated) {
  const Folder folder;
  const std::string file = folder.file(
      "sf.yaml",
      "problem: sf\nmethod:\n  method: state-feedback\n  data: {A: n x n, B: n x m}\n  unknowns: "
      "{P: symmetric n, Y: m x n}\n"
      "  require: {p: P > I, s: He(A*P + B*Y) < 0}\n  minimize: trace(P)\n  gains: {K: Y*inv(P)}\n"
      "data: {A: [[0, 1], [2, 1]], B: [[0], [1]]}\n");
  const Outcome outcome = gainsmith({"run", file, "-o", folder.path("out")});
  EXPECT_EQ(outcome.exit, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("no campaign"), std::string::npos);
}

TEST(CommandLineTest, TheVersionIsPrinted) {
  const Outcome outcome = gainsmith({"--version"});
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_EQ(outcome.out.find("gainsmith "), 0U);
}

TEST(CommandLineTest, TheProgramForOtherSolversIsWrittenWithoutSolving) {
  const std::string good = problem("ferrante-seuret-2021/t2-0.70.yaml");
  const Folder folder;
  const std::string alone = folder.path("alone.dat-s");
  const std::string beside = folder.path("beside.dat-s");
  const Outcome outcome = gainsmith({"synth", good, "--sdpa", alone, "--no-solve"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(gainsmith({"synth", good, "--sdpa", beside}).exit, 0);
  EXPECT_EQ(text_of(alone), text_of(beside));
  EXPECT_EQ(gainsmith({"solve", alone, "--json"}).exit, 0);
  EXPECT_EQ(gainsmith({"synth", good, "--no-solve"}).exit, 2);
}

TEST(CommandLineTest, TheVersionIsOneLine) {
  const Outcome outcome = gainsmith({"--version"});
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_TRUE(outcome.out.starts_with("gainsmith ")) << outcome.out;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
}

}  // namespace
}  // namespace gainsmith::tests
