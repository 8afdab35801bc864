// Which files `run` and `check` take, and how often.
#include <gtest/gtest.h>

#include <algorithm>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

const std::string kProblem =
    "problem: small\nmethod:\n  method: small\n  unknowns: {x: scalar}\n  require: {above: x > "
    "1}\n";

std::ptrdiff_t count_lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(InputFilesTest, RunPrintsEachProblemOnce) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kProblem);
  std::filesystem::create_symlink("p.yaml", folder.path("again.yaml"));
  const Outcome outcome = gainsmith({"run", file, file, folder.path("./p.yaml"),
                                     folder.path("again.yaml"), "-o", folder.path("out")});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(count_lines(outcome.out), 1) << outcome.out;
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/p/gains.json")));
}

TEST(InputFilesTest, RunTakesStandardInput) {
  const Folder folder;
  const Outcome outcome = gainsmith({"run", "-", "-o", folder.path("out")}, kProblem);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/standard-input/gains.json")));
}

TEST(InputFilesTest, CheckTakesAFolder) {
  const Folder folder;
  folder.file("a.yaml", kProblem);
  folder.file("b.yaml", kProblem);
  std::filesystem::create_symlink("loop", folder.path("loop"));
  const Outcome good = gainsmith({"check", folder.path("")});
  EXPECT_EQ(good.exit, 0) << good.err;
  EXPECT_EQ(count_lines(good.out), 3);
  EXPECT_TRUE(good.out.ends_with("\n2 files: 2 good\n")) << good.out;
  folder.file("c.yaml", "problem: [\n");
  const Outcome bad = gainsmith({"check", folder.path("")});
  EXPECT_EQ(bad.exit, 2);
  EXPECT_EQ(count_lines(bad.out), 4);
  EXPECT_NE(bad.out.find("\n" + folder.path("c.yaml:")), std::string::npos) << bad.out;
  EXPECT_TRUE(bad.out.ends_with("\n3 files: 2 good, 1 wrong\n")) << bad.out;
  EXPECT_EQ(bad.err, "");
}

TEST(InputFilesTest, AFolderThatIsNoFileIsNamedSo) {
  const Folder folder;
  const Outcome outcome = gainsmith({"synth", folder.path("")});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("this is a folder; expected a file"), std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace gainsmith::tests
