// The problems that come with the program give what they expect.
#include <gtest/gtest.h>

#include <algorithm>

#include <fstream>
#include <regex>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  return files;
}

TEST(ProblemsTest, EveryProblemIsValid) {
  std::vector<std::string> arguments = {"check"};
  for (const std::string& file : files_below(problem(""))) arguments.push_back(file);
  const Outcome outcome = gainsmith(arguments);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(static_cast<std::size_t>(std::count(outcome.out.begin(), outcome.out.end(), '\n')),
            arguments.size() - 1);
}

TEST(ProblemsTest, EveryProblemIsAsExpected) {
  const Folder folder;
  const Outcome outcome = gainsmith({"run", problem(""), "-o", folder.path("out"), "--runs", "100",
                                     "--junit", folder.path("junit.xml")});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  const std::size_t count = files_below(problem("")).size();
  EXPECT_EQ(static_cast<std::size_t>(std::count(outcome.out.begin(), outcome.out.end(), '\n')),
            count);
  const std::string junit = text_of(folder.path("junit.xml"));
  EXPECT_NE(junit.find("tests=\"" + std::to_string(count) + "\" failures=\"0\" errors=\"0\""),
            std::string::npos)
      << junit;
  const std::string summary = text_of(folder.path("out/ferrante-seuret-2021/t2-0.70/summary.txt"));
  EXPECT_NE(summary.find("all as expected"), std::string::npos) << summary;
}

/// An expectation that is wrong is found: the guard is no formality.
TEST(ProblemsTest, AWrongExpectationFailsTheRun) {
  const Folder folder;
  const std::string text = text_of(problem("ferrante-seuret-2021/t2-0.60.yaml"));
  const std::string wrong = folder.file(
      "wrong.yaml", std::regex_replace(text, std::regex("value: 688.572"), "value: 688.0"));
  const Outcome outcome = gainsmith(
      {"run", wrong, "-o", folder.path("out"), "--runs", "5", "--junit", folder.path("j.xml")});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_NE(outcome.out.find("objective: expected 688 within"), std::string::npos) << outcome.out;
  EXPECT_NE(text_of(folder.path("j.xml")).find("<failure"), std::string::npos);
}

TEST(ProblemsTest, TheWorstExitCodeWins) {
  const Folder folder;
  const std::string good = problem("classics/quadratic-stability.yaml");
  const std::string bad = folder.file("bad.yaml", "problem: bad\nmetod: x\n");
  const Outcome outcome = gainsmith({"run", good, bad, "-o", folder.path("out"), "--json"});
  EXPECT_EQ(outcome.exit, 2);
  const auto document = outcome.json();
  EXPECT_EQ(document["problems"].size(), 2U);
  EXPECT_EQ(document["problems"][0]["exit"], 0);
  EXPECT_EQ(document["problems"][1]["exit"], 2);
}

}  // namespace
}  // namespace gainsmith::tests
