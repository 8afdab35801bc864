// Data from files, variants and --set, as a person uses them: from the file to the gain file and what
// is done with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Words = std::vector<std::string>;

/// The published problem with its matrices in files.
std::string with_files(const Folder& folder) {
  folder.file("A.csv", "0.2,-1.01\n1,0\n");
  std::filesystem::copy_file(GAINSMITH_TEST_DATA "/plant-v7.mat", folder.path("plant.mat"));
  return folder.file(
      "p.yaml",
      "problem: files\nmethod: sampled-data-hybrid\ndata:\n  A: {csv: A.csv}\n"
      "  C: {mat: plant.mat, name: C}\n  T1: {mat: plant.mat, name: T1}\n  T2: 0.7\n"
      "  QF: I\n  QJ: 0.01*I\nparameters: {delta: 0.03, eta: 1e-4, a1: 100, a2: 1}\n"
      "campaign: {runs: 5, horizon: 10, initial: {z: {box: [-10, 10]}, zh: 0, th: C*z}}\n");
}

/// The gains, from a gain file.
nlohmann::ordered_json gains(const std::string& file) {
  return nlohmann::ordered_json::parse(text_of(file))["gains"];
}

TEST(DataIn, FilesGiveTheGainsOfTheSameNumbers) {
  const Folder folder;
  const std::string file = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", with_files(folder), "-o", file}).exit, 0);
  const std::string plain = folder.path("plain.json");
  ASSERT_EQ(gainsmith({"synth", problem("ferrante-seuret-2021/t2-0.70.yaml"), "-o", plain}).exit,
            0);
  EXPECT_EQ(gains(file), gains(plain));
  EXPECT_EQ(gainsmith({"verify", file}).exit, 0);
  // The gain file stands alone.
  std::filesystem::create_directories(folder.path("far"));
  std::filesystem::copy_file(file, folder.path("far/gains.json"));
  EXPECT_EQ(gainsmith({"verify", folder.path("far/gains.json")}).exit, 0);
  // And it notices what changed beside it.
  folder.file("A.csv", "0.3,-1.01\n1,0\n");
  const Outcome changed = gainsmith({"verify", file});
  EXPECT_EQ(changed.exit, 2);
  EXPECT_NE(changed.err.find("A.csv has changed since these gains were made"), std::string::npos)
      << changed.err;
  EXPECT_EQ(gainsmith({"verify", folder.path("far/gains.json")}).exit, 0);
}

TEST(DataIn, RunWritesAGainFileThatStandsAlone) {
  const Folder folder;
  ASSERT_EQ(gainsmith({"run", with_files(folder), "-o", folder.path("out")}).exit, 0);
  EXPECT_EQ(gainsmith({"verify", folder.path("out/p/gains.json"), "--runs", "2"}).exit, 0);
}

TEST(DataIn, AVariantOfAPublishedProblemHasFiveLines) {
  const Folder folder;
  const std::string variant = folder.file(
      "v.yaml", "problem: shorter\nlike: " + problem("ferrante-seuret-2021/t2-0.70.yaml") +
                    "\ndata: {T2: 0.65}\ncampaign: {runs: 5}\n");
  const Outcome run = gainsmith({"run", variant, "-o", folder.path("out")});
  EXPECT_EQ(run.exit, 0) << run.out << run.err;
  const std::string file = folder.path("out/v/gains.json");
  EXPECT_EQ(gainsmith({"verify", file, "--runs", "2"}).exit, 0);
  const std::string set = folder.path("set.json");
  ASSERT_EQ(gainsmith({"synth", problem("ferrante-seuret-2021/t2-0.70.yaml"), "--set", "T2=0.65",
                       "-o", set})
                .exit,
            0);
  EXPECT_EQ(gains(file), gains(set));
  const Outcome verified = gainsmith({"verify", set, "--runs", "5"});
  EXPECT_EQ(verified.exit, 0) << verified.err;
}

TEST(DataIn, EveryCommandTakesASetting) {
  const Folder folder;
  const std::string pendulum = folder.file(
      "p.yaml",
      "problem: p\nmethod:\n  plant: {state: {x: {shape: 1, start: 1}}, flow: {x: -k*x}}\n"
      "  claims: {small: {below: x, bound: bound}}\n  data: {k: 1, bound: 1}\n"
      "data: {k: 1, bound: 2}\ncampaign: {horizon: 1}\n");
  for (const Words& command : {Words{"check"}, {"verify"}, {"simulate"}, {"synth"}}) {
    Words words = command;
    words.insert(words.end(), {pendulum, "--set", "k=3"});
    EXPECT_EQ(gainsmith(words).exit, 0) << command[0];
    words.back() = "kk=3";
    const Outcome refused = gainsmith(words);
    EXPECT_EQ(refused.exit, 2) << command[0];
    EXPECT_NE(refused.err.find("did you mean 'k'?"), std::string::npos) << refused.err;
  }
  const Outcome violated = gainsmith({"verify", pendulum, "--set", "bound=0.5"});
  EXPECT_EQ(violated.exit, 1);
  EXPECT_NE(violated.out.find("simulate " + pendulum + " --set bound=0.5 --run "),
            std::string::npos)
      << violated.out;
  EXPECT_EQ(gainsmith({"run", pendulum, "-o", folder.path("out"), "--set", "bound=0.5"}).exit, 1);
  EXPECT_EQ(gainsmith({"check", pendulum, "--set", "k"}).exit, 2);
  const std::string t2 = problem("ferrante-seuret-2021/t2-0.70.yaml");
  EXPECT_EQ(gainsmith({"explain", t2, "--set", "T2=1.1"}).exit, 1);
  EXPECT_EQ(gainsmith({"bisect", t2, "--set", "delta=0.03", "--largest", "T2", "--in", "0.5", "0.7",
                       "--tolerance", "0.1"})
                .exit,
            0);
}

TEST(DataIn, ASettingIsNotSearched) {
  const std::string file = problem("switched-state-feedback/smallest-rho.yaml");
  const Outcome given = gainsmith({"synth", file, "--set", "rho=1.5"});
  EXPECT_EQ(given.exit, 0) << given.err;
  EXPECT_NE(given.out.find("rho = 1.5"), std::string::npos) << given.out;
  EXPECT_EQ(given.out.find("searched"), std::string::npos) << given.out;
  EXPECT_EQ(gainsmith({"synth", file, "--set", "rho=0.5"}).exit, 1);
  const Outcome nothing = gainsmith({"bisect", file, "--set", "rho=0.5"});
  EXPECT_EQ(nothing.exit, 2);
  EXPECT_NE(nothing.err.find("nothing to bisect"), std::string::npos) << nothing.err;
  EXPECT_EQ(gainsmith({"bisect", file, "--smallest", "rho", "--set", "rho=0.7"}).exit, 2);
}

TEST(DataIn, AGainFileKeepsItsProblem) {
  const Folder folder;
  const std::string file = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", with_files(folder), "-o", file}).exit, 0);
  const Outcome refused = gainsmith({"verify", file, "--set", "T2=0.8"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.err.find("stays as it was solved"), std::string::npos);
}

TEST(DataIn, AScanMayHaveOnePoint) {
  const std::string t2 = problem("ferrante-seuret-2021/t2-0.70.yaml");
  const auto one = gainsmith({"scan", t2, "--over", "T2=T1 + 0.15", "--json"}).json();
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0]["at"]["T2"], 0.65);
  EXPECT_EQ(one[0]["verdict"], "yes");
  const auto two =
      gainsmith({"scan", t2, "--over", "T2=0.65", "--over", "delta=0.02:0.03:2", "--json"}).json();
  EXPECT_EQ(two.size(), 2U);
  EXPECT_EQ(gainsmith({"scan", t2, "--over", "T2="}).exit, 2);
  EXPECT_EQ(gainsmith({"scan", t2, "--over", "T2=1/0"}).exit, 2);
  EXPECT_EQ(gainsmith({"optimize", t2, "--over", "T2=1"}).exit, 2);
}

TEST(DataIn, AnElementIsRefused) {
  const Folder folder;
  const std::string t2 = problem("ferrante-seuret-2021/t2-0.70.yaml");
  const std::string variant =
      folder.file("v.yaml", "problem: v\nlike: " + t2 + "\ndata: {C(1): 0.5}\n");
  for (const auto& [command, says] :
       {std::pair<Words, const char*>{{"synth", t2, "--set", "C(1)=[0.5, 0]"}, "--set 'C=VALUE'"},
        {{"scan", t2, "--over", "C(1)=0.5"}, "'C(1)' is an element of 'C'"},
        {{"scan", t2, "--over", "T2(1)=0.5:0.7:2"}, "'T2(1)' is an element of 'T2'"},
        {{"bisect", t2, "--largest", "A(1,2)", "--in", "0.5", "0.7"}, "is an element of 'A'"},
        {{"check", variant}, "v.yaml:3:8: a datum is given as a whole"}}) {
    const Outcome refused = gainsmith(command);
    EXPECT_EQ(refused.exit, 2) << command[0];
    EXPECT_NE((refused.out + refused.err).find(says), std::string::npos)
        << refused.out << refused.err;
  }
}

TEST(DataIn, WhatIsWrongInAFileIsSaidWithItsPlace) {
  const Folder folder;
  const std::string path = with_files(folder);
  folder.file("A.csv", "0.2,-1.01\n1,zero\n");
  const Outcome word = gainsmith({"synth", path, "-o", folder.path("gains.json")});
  EXPECT_EQ(word.exit, 2);
  EXPECT_NE(word.err.find("A.csv:2:3: expected a finite decimal number, found 'zero'"),
            std::string::npos)
      << word.err;
  folder.file("A.csv", "0.2,-1.01\n1,0\n");
  const std::string whole = text_of(folder.path("plant.mat"));
  folder.file("plant.mat", whole.substr(0, whole.size() - 10));
  const Outcome cut = gainsmith({"check", path});
  EXPECT_EQ(cut.exit, 2);
  EXPECT_NE(cut.err.find("p.yaml:5:"), std::string::npos) << cut.err;
  EXPECT_NE(cut.err.find("the file is cut off within variable 3"), std::string::npos) << cut.err;
  const Words left = folder.names();
  EXPECT_EQ(std::count(left.begin(), left.end(), "gains.json"), 0);
}

/// The shortest decimal of a cell; what is no number is as it stands.
std::string shortest(const std::string& cell) {
  double value = 0;
  const auto end = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (end.ec != std::errc() || end.ptr != cell.data() + cell.size()) return cell;
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::size_t digits_of(const std::string& cell) {
  const std::string number = cell.substr(0, cell.find('e'));
  return static_cast<std::size_t>(
      std::count_if(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

TEST(DataIn, TablesHaveTheShortestDecimals) {
  const Folder folder;
  const std::string file = folder.path("table.csv");
  const std::string t2 = problem("ferrante-seuret-2021/t2-0.70.yaml");
  ASSERT_EQ(gainsmith({"scan", t2, "--over", "T2=0.6:0.7:5", "-o", file}).exit, 0);
  EXPECT_NE(text_of(file).find("\n0.625,yes"), std::string::npos) << text_of(file);
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", t2, "-o", gains}).exit, 0);
  const std::string run = folder.path("run.csv");
  ASSERT_EQ(gainsmith({"simulate", gains, "--step", "0.1", "-o", run}).exit, 0);
  EXPECT_NE(text_of(run).find("\n0.1,"), std::string::npos);
  std::size_t numbers = 0;
  for (const std::string& path : {file, run}) {
    std::istringstream lines(text_of(path));
    for (std::string line, cell; std::getline(lines, line);)
      for (std::istringstream cells(line); std::getline(cells, cell, ',');) {
        const std::string best = shortest(cell);
        // 100 and 1e+02 have the same value; a table may have the longer one.
        EXPECT_TRUE(best.find('e') != std::string::npos || digits_of(cell) == digits_of(best))
            << cell;
        ++numbers;
      }
  }
  EXPECT_GT(numbers, 1000U);
}

}  // namespace
}  // namespace gainsmith::tests
