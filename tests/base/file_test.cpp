#include "base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "support/input_error.h"

namespace gainsmith {
namespace {

namespace fs = std::filesystem;
using tests::input_error;

class File : public testing::Test {
 protected:
  File() {
    std::string pattern = (fs::temp_directory_path() / "gainsmith-test.XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  ~File() override {
    std::error_code ignored;
    fs::permissions(folder, fs::perms::owner_all, ignored);
    fs::remove_all(folder, ignored);
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
  }
  fs::path folder;
};

TEST_F(File, WhatIsWrittenIsReadBack) {
  std::string text =
      "line\nanother\r\n\0 zero"
      "\xFF";
  text += std::string(300000, 'x');
  write_atomically(folder / "a", text);
  EXPECT_EQ(read_text(folder / "a"), text);
  EXPECT_EQ(entries(), 1U) << "a temporary file was left behind";
}

TEST_F(File, WritingReplacesAndAnEmptyTextIsAnEmptyFile) {
  write_atomically(folder / "a", "long old text");
  write_atomically(folder / "a", "new");
  EXPECT_EQ(read_text(folder / "a"), "new");
  write_atomically(folder / "a", "");
  EXPECT_EQ(read_text(folder / "a"), "");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(File, NewFilesHaveThePermissionsOfOrdinaryOnes) {
  std::ofstream(folder / "ordinary") << "text";
  write_atomically(folder / "ours", "text");
  EXPECT_EQ(fs::status(folder / "ours").permissions(),
            fs::status(folder / "ordinary").permissions());
}

TEST_F(File, WritingIntoAMissingFolderNamesTheFile) {
  const fs::path path = folder / "missing" / "a";
  const InputError error = input_error([&] { write_atomically(path, "text"); });
  EXPECT_EQ(error.place(), (Place{path.string(), 0, 0}));
  EXPECT_NE(error.message().find("No such file or directory"), std::string::npos) << error.what();
  EXPECT_EQ(entries(), 0U);
}

TEST_F(File, WritingOverAFolderFailsAndLeavesNothingBehind) {
  fs::create_directory(folder / "a");
  input_error([&] { write_atomically(folder / "a", "text"); });
  EXPECT_EQ(entries(), 1U);
  EXPECT_TRUE(fs::is_directory(folder / "a"));
}

// /proc refuses new files even to the superuser, whom permissions do not hold back.
TEST_F(File, WritingIntoAReadOnlyFolderFails) {
  const InputError error = input_error([] { write_atomically("/proc/gainsmith", "text"); });
  EXPECT_EQ(error.place(), (Place{"/proc/gainsmith", 0, 0}));
  if (::geteuid() == 0) return;
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  input_error([&] { write_atomically(folder / "a", "text"); });
  EXPECT_EQ(entries(), 0U);
}

TEST_F(File, ALinkKeepsPointingToTheFileThatIsReplaced) {
  write_atomically(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  write_atomically(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_text(folder / "target"), "new");
  EXPECT_EQ(entries(), 2U);
}

TEST_F(File, APipeIsWrittenDirectly) {
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_text(pipe); });
  write_atomically(pipe, "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_EQ(entries(), 1U);
}

// /dev/stdout of a process whose output goes to a file leads to that file: it must be written, not
// replaced by another file under its name, or what was written before would be lost.
TEST_F(File, AnOpenDescriptorThatLeadsToAFileIsWrittenDirectly) {
  const fs::path path = folder / "output";
  std::FILE* output = std::fopen(path.c_str(), "w");
  ASSERT_NE(output, nullptr);
  std::fputs("before\n", output);
  std::fflush(output);
  const int number = ::fileno(output);
  write_atomically("/dev/fd/" + std::to_string(number), "text\n");
  std::fclose(output);
  EXPECT_EQ(read_text(path), "before\ntext\n");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(File, ReadingAMissingFileNamesIt) {
  const fs::path path = folder / "missing.yaml";
  const InputError error = input_error([&] { read_text(path); });
  EXPECT_EQ(error.place(), (Place{path.string(), 0, 0}));
  EXPECT_NE(error.message().find("No such file or directory"), std::string::npos) << error.what();
}

TEST_F(File, ReadingAFolderFails) {
  const InputError error = input_error([&] { read_text(folder); });
  EXPECT_NE(error.message().find("folder"), std::string::npos) << error.what();
}

}  // namespace
}  // namespace gainsmith
