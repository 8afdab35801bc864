// A problem is read once and bound once in a process, whatever a command does with it.
#include "expr/text/work.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "gainsmith/commands.h"

namespace gainsmith::app {
namespace {

const std::string kProblem = std::string(GAINSMITH_PROBLEMS) + "/ferrante-seuret-2021/t2-0.70.yaml";

/// What a command line does, as a difference of counts.
expr::Work work_of(std::vector<std::string> words) {
  words.insert(words.begin(), "gainsmith");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const expr::Work before = expr::work_done();
  testing::internal::CaptureStdout();
  run(all_commands(), static_cast<int>(arguments.size()), arguments.data());
  testing::internal::GetCapturedStdout();
  const expr::Work after = expr::work_done();
  return {after.parsed - before.parsed, after.bound - before.bound,
          after.problems - before.problems, after.designs - before.designs};
}

expr::Work scan(const std::string& count) {
  return work_of({"scan", kProblem, "--over", "T2=0.6:0.75:" + count, "--show", "trace(P1)"});
}

class Work : public testing::Test {
 protected:
  void expect_once(const expr::Work& work) const {
    EXPECT_EQ(work.problems, 1U);
    EXPECT_EQ(work.designs, 1U);
  }
  const expr::Work check_ = work_of({"check", kProblem});
};

TEST_F(Work, ACheckReadsAndBindsOnce) {
  expect_once(check_);
  EXPECT_GT(check_.parsed, 10U);
  EXPECT_GT(check_.bound, 10U);
}

TEST_F(Work, AScanOf200PointsDoesNoMoreThanOneOf2) {
  const expr::Work few = scan("2");
  const expr::Work many = scan("200");
  expect_once(many);
  EXPECT_EQ(many, few);
  // The ends of the range and the column are what the command line adds.
  EXPECT_EQ(many.parsed, check_.parsed + 3);
  EXPECT_EQ(many.bound, check_.bound + 3);
}

TEST_F(Work, RunAddsNothing) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "gainsmith-work-test";
  const expr::Work work = work_of({"run", kProblem, "--runs", "3", "-o", folder.string()});
  EXPECT_TRUE(std::filesystem::exists(folder / "t2-0.70" / "campaign.json"));
  std::filesystem::remove_all(folder);
  EXPECT_EQ(work, check_);
}

TEST_F(Work, ABisectionAddsItsRange) {
  const expr::Work work =
      work_of({"bisect", kProblem, "--largest", "T2", "--in", "0.5", "1.1", "--tolerance", "1e-4"});
  expect_once(work);
  EXPECT_EQ(work.parsed, check_.parsed + 2);
  EXPECT_EQ(work.bound, check_.bound + 2);
}

TEST_F(Work, AnOptimisationAddsItsRange) {
  const expr::Work work = work_of({"optimize", kProblem, "--over", "delta=1e-2:1", "--minimize",
                                   "trace(P1)", "--evaluations", "8"});
  expect_once(work);
  EXPECT_EQ(work.parsed, check_.parsed + 3);
  EXPECT_EQ(work.bound, check_.bound + 3);
}

TEST_F(Work, AnExplanationChangesDesignsAndNoTexts) {
  const std::string infeasible =
      std::string(GAINSMITH_PROBLEMS) + "/ferrante-seuret-2021/published-theorem.yaml";
  const expr::Work checked = work_of({"check", infeasible});
  EXPECT_EQ(work_of({"explain", infeasible}), checked);
}

}  // namespace
}  // namespace gainsmith::app
