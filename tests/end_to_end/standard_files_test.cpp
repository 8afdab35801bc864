// Standard files that are closed or full: a message where one can be read, the exit code always.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

const std::string kGood = "ferrante-seuret-2021/t2-0.70.yaml";

/// The exit code of "gainsmith WORDS" in a shell, so that its files can be redirected; -1 after a
/// signal.
int shell(const std::string& words) {
  const int status = std::system(("'" + program() + "' " + words).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StandardFilesTest, AClosedOrFullStandardErrorChangesNoExitCode) {
  const Folder folder;
  for (const char* error : {"2>&-", "2>/dev/full"}) {
    EXPECT_EQ(shell("synth nothing.yaml " + std::string(error)), 2);
    const std::string path = folder.path("gains.json");
    EXPECT_EQ(shell("synth '" + problem(kGood) + "' -o '" + path + "' >/dev/null " + error), 0);
    EXPECT_EQ(shell("simulate '" + path + "' >/dev/null " + error), 0);
    // What belongs to standard error is not in the file that was opened next.
    EXPECT_EQ(nlohmann::json::parse(text_of(path))["verdict"], "yes");
  }
}

TEST(StandardFilesTest, AClosedOrFullStandardOutputIsAnError) {
  const Folder folder;
  const std::string error = folder.path("error");
  for (const char* output : {">&-", ">/dev/full"})
    for (const std::string& words :
         {std::string("--help"), std::string("--version"), std::string("synth --help"),
          std::string("methods"), "synth '" + problem(kGood) + "' -o -",
          "check '" + problem(kGood) + "' --json"}) {
      EXPECT_EQ(shell(words + " " + output + " 2>'" + error + "'"), 2) << words << output;
      EXPECT_NE(text_of(error).find("cannot write"), std::string::npos) << text_of(error);
    }
}

TEST(StandardFilesTest, AClosedStandardInputIsAFileThatCannotBeRead) {
  EXPECT_EQ(shell("check - <&- 2>/dev/null"), 2);
}

TEST(StandardFilesTest, AFullDiskIsNamedWithItsFile) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", gains}).exit, 0);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"synth", problem(kGood), "-o", "/dev/full"},
           {"synth", problem(kGood), "--sdpa", "/dev/full"},
           {"scan", problem(kGood), "--over", "T2=0.6:0.7:2", "-o", "/dev/full"},
           {"simulate", gains, "-o", "/dev/full"},
           {"run", problem(kGood), "--runs", "3", "-o", folder.path("out"), "--junit",
            "/dev/full"}}) {
    const Outcome outcome = gainsmith(words);
    EXPECT_EQ(outcome.exit, 2) << words[0];
    EXPECT_NE(outcome.err.find("/dev/full: cannot write this file"), std::string::npos)
        << outcome.err;
  }
}

}  // namespace
}  // namespace gainsmith::tests
