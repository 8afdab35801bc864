#include "gainsmith/problem_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"

namespace gainsmith::app {
namespace {

namespace fs = std::filesystem;

class ProblemFiles : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(root_);
    fs::create_directories(root_ / "below");
    for (const char* name : {"b.yaml", "a.yml", "below/c.yaml", "notes.txt"})
      std::ofstream(root_ / name) << "x";
  }
  void TearDown() override { fs::remove_all(root_); }

  std::string path(const std::string& name) const { return (root_ / name).string(); }

  static std::vector<std::string> names(const std::vector<std::string>& paths) {
    std::vector<std::string> result;
    for (const ProblemFile& file : problem_files(paths)) result.push_back(file.name);
    return result;
  }

  const fs::path root_ = fs::path(testing::TempDir()) /
                         (std::string("gainsmith-problem-files-") +
                          testing::UnitTest::GetInstance()->current_test_info()->name());
};

using Names = std::vector<std::string>;

TEST_F(ProblemFiles, OfAFolderAreSortedAndNamedByTheirPathBelowIt) {
  EXPECT_EQ(names({root_.string()}), (Names{"a", "b", "below/c"}));
  EXPECT_EQ(names({root_.string() + "/"}), (Names{"a", "b", "below/c"}));
}

TEST_F(ProblemFiles, StandOnceWhateverLeadsToThem) {
  fs::create_symlink("b.yaml", root_ / "link.yaml");
  EXPECT_EQ(names({path("b.yaml"), path("below/../b.yaml"), path("link.yaml"), root_.string()}),
            (Names{"b", "a", "below/c"}));
  EXPECT_EQ(names({"no.yaml", "./no.yaml", "-", "-"}), (Names{"no", "standard-input"}));
}

TEST_F(ProblemFiles, LinksThatLeadNowhereStopNothing) {
  fs::create_symlink("loop-2", root_ / "loop-1");
  fs::create_symlink("loop-1", root_ / "loop-2");
  fs::create_symlink(".", root_ / "self");
  EXPECT_EQ(names({root_.string()}), (Names{"a", "b", "below/c"}));
  // One that looks like a problem is said to be broken, when it is read.
  fs::create_symlink("nothing", root_ / "lost.yaml");
  EXPECT_EQ(names({root_.string()}), (Names{"a", "b", "below/c", "lost"}));
}

TEST_F(ProblemFiles, OfOneNameAreToldApartByTheirFolders) {
  for (const char* folder : {"one/deep", "two/deep", "three"})
    fs::create_directories(root_ / folder);
  for (const char* name :
       {"one/deep/x.yaml", "two/deep/x.yaml", "three/x.yaml", "three/x.yml", "three/y.yaml"})
    std::ofstream(root_ / name) << "x";
  EXPECT_EQ(names({path("one/deep/x.yaml"), path("three/y.yaml"), path("three/x.yaml")}),
            (Names{"deep/x", "y", "three/x"}));
  EXPECT_EQ(names({path("one/deep/x.yaml"), path("two/deep/x.yaml")}),
            (Names{"one/deep/x", "two/deep/x"}));
  EXPECT_EQ(names({path("three/x.yaml"), path("three/x.yml")}), (Names{"x.yaml", "x.yml"}));
  // One that gets the name of a third.
  EXPECT_EQ(names({path("one"), path("two/deep/x.yaml"), path("three/x.yaml")}),
            (Names{"one/deep/x", "two/deep/x", "three/x"}));
}

TEST_F(ProblemFiles, AFolderWithoutThemIsOneThatCannotBeRead) {
  fs::create_directories(root_ / "empty");
  EXPECT_EQ(names({path("empty")}), (Names{"empty"}));
  EXPECT_EQ(problem_files({path("empty")})[0].path, path("empty/*.yaml"));
}

}  // namespace
}  // namespace gainsmith::app
