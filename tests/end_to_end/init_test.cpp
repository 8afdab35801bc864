// The methods by task, and a problem to begin with for each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// Of the files, in order: to ask the program takes a while, and each test would.
std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(GAINSMITH_METHODS))
    if (file.path().extension() == ".yaml") names.push_back(file.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

class Init : public ::testing::TestWithParam<std::string> {};

/// As it is written it checks and has a solution.
TEST_P(Init, WritesAProblemThatHasASolution) {
  const Outcome written = gainsmith({"init", GetParam()});
  ASSERT_EQ(written.exit, 0) << written.err;
  const Folder folder;
  const std::string file = folder.file("mine.yaml", written.out);
  const Outcome checked = gainsmith({"check", file});
  EXPECT_EQ(checked.exit, 0) << checked.err;
  const Outcome found = gainsmith({"synth", file, "-o", folder.path("gains.json")});
  EXPECT_EQ(found.exit, 0) << found.out << found.err;
}

/// With the method's text in it, it is the same problem.
TEST_P(Init, WritesTheMethodsTextWhereItIsToBeChanged) {
  const Outcome written = gainsmith({"init", GetParam(), "--own"});
  ASSERT_EQ(written.exit, 0) << written.err;
  EXPECT_EQ(written.out.find("method: " + GetParam()), std::string::npos);
  EXPECT_NE(written.out.find("\nmethod:\n  source:"), std::string::npos) << written.out;
  const Folder folder;
  const auto checked = [&](const std::string& name, const std::string& text) {
    const Outcome outcome = gainsmith({"check", folder.file(name, text)});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    return outcome.out.substr(outcome.out.find(", "));
  };
  EXPECT_EQ(checked("own.yaml", written.out),
            checked("named.yaml", gainsmith({"init", GetParam()}).out));
}

std::string method_name(const ::testing::TestParamInfo<std::string>& method) {
  std::string name = method.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

TEST(Methods, AreThoseOfTheFiles) {
  std::vector<std::string> listed;
  for (const auto& method : gainsmith({"methods", "--json"}).json())
    listed.push_back(method["method"]);
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, method_names());
}

INSTANTIATE_TEST_SUITE_P(Methods, Init, ::testing::ValuesIn(method_names()), method_name);

TEST(Init, AnUnknownMethodIsNamed) {
  const Outcome outcome = gainsmith({"init", "lqt"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("unknown method 'lqt'; did you mean 'lqr'?"), std::string::npos)
      << outcome.err;
}

/// Each method stands once, below the task that it names, with the file to begin with.
TEST(Methods, AreListedByTask) {
  const std::string list = gainsmith({"methods"}).out;
  for (const auto& method : gainsmith({"methods", "--json"}).json()) {
    const std::string name = method["method"];
    const std::size_t at = list.find("\n  " + name + " ");
    ASSERT_NE(at, std::string::npos) << name;
    const std::string line = list.substr(at + 1, list.find('\n', at + 1) - at - 1);
    EXPECT_NE(line.find("(problems/" + method["example"].get<std::string>() + ".yaml)"),
              std::string::npos)
        << line;
    std::size_t heading = list.rfind('\n', at - 1);
    while (heading != std::string::npos && list[heading + 1] == ' ')
      heading = list.rfind('\n', heading - 1);
    const std::size_t begin = heading == std::string::npos ? 0 : heading + 1;
    EXPECT_EQ(list.substr(begin, list.find('\n', begin) - begin), method["task"]) << name;
  }
}

}  // namespace
}  // namespace gainsmith::tests
