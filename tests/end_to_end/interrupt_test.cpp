// Ctrl-C: what is known is said, the exit code is 3, and nothing is half-written.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <regex>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

const std::string kGood = "ferrante-seuret-2021/t2-0.70.yaml";

/// The exit code of "gainsmith WORDS", which gets the signal of Ctrl-C after some seconds.
int interrupted(const std::string& words) {
  const int status =
      std::system(("timeout --preserve-status -s INT 3 '" GAINSMITH_PROGRAM "' " + words).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(InterruptTest, ACampaignSaysHowFarItCame) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  const std::string out = folder.path("out");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", gains}).exit, 0);
  EXPECT_EQ(interrupted("verify '" + gains + "' --runs 100000000 --json > '" + out + "'"), 3);
  const auto report = nlohmann::json::parse(text_of(out));
  EXPECT_EQ(report["verdict"], "undecided");
  EXPECT_NE(report["message"].get<std::string>().find("of 100000000 runs"), std::string::npos);
  EXPECT_EQ(report["runs_asked"], 100000000);
  EXPECT_GT(report["runs"], 0);
  EXPECT_LT(report["runs"], 100000000);
}

/// The runs that the words count are those of a campaign of so many runs that was not interrupted.
TEST(InterruptTest, ACampaignTalliesTheRunsThatAreDone) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  const std::string out = folder.path("out");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", gains}).exit, 0);
  EXPECT_EQ(interrupted("verify '" + gains + "' --threads 1 --runs 100000000 > '" + out + "'"), 3);
  const std::string text = text_of(out);
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
  EXPECT_EQ(interrupted("run '" + quick + "' '" + problem(kGood) +
                        "' --threads 1 --runs 100000000 -o '" + folder.path("out") + "' --junit '" +
                        junit + "' > '" + folder.path("text") + "' 2>&1"),
            3);
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/hinf-norm/summary.txt")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/t2-0.70")));
  const std::string text = text_of(folder.path("text"));
  EXPECT_NE(text.find("interrupted: 1 of 2 problems have no answer"), std::string::npos) << text;
  EXPECT_NE(text_of(junit).find("of 100000000 runs"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::tests
