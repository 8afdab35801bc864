#include <gtest/gtest.h>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

TEST(CommandLineTest, HelpHasExamplesForEverySubcommand) {
  for (const char* command : {"synth", "bisect", "scan", "optimize", "explain", "verify",
                              "simulate", "solve", "check", "run", "methods"}) {
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
                                             {"synth", good, "--bogus"},
                                             {"verify", "x", "--runs", "0"},
                                             {"verify", "x", "--runs", "many"},
                                             {"methods", "sampled-data-hibrid"}}) {
    const Outcome outcome = gainsmith(arguments);
    EXPECT_EQ(outcome.exit, 2) << outcome.err;
    EXPECT_NE(outcome.err, "");
  }
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

}  // namespace
}  // namespace gainsmith::tests
