// The problems that come with the program give what they expect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// The problem files below problems/FOLDER, by their path below problems/.
std::vector<std::string> problems_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(problem(folder)))
    if (entry.path().extension() == ".yaml")
      files.push_back(entry.path().lexically_relative(problem("")).string());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(ProblemsTest, EveryProblemIsValid) {
  std::vector<std::string> arguments = {"check"};
  for (const std::string& file : problems_in("")) arguments.push_back(problem(file));
  const Outcome outcome = gainsmith(arguments);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  std::size_t valid = 0;
  for (std::size_t at = outcome.out.find(": valid: "); at != std::string::npos;
       at = outcome.out.find(": valid: ", at + 1))
    ++valid;
  EXPECT_EQ(valid, arguments.size() - 1);
}

/// One test a file below problems/, with all runs of its campaign: together they are what a person
/// gets of `run problems/`. The files are those that there are when the tests are linked.
class Problems : public ::testing::TestWithParam<std::string> {};

/// The texts of a problem file, of the one that it is like, and of the built-in method that it names.
std::string texts_of(const std::string& file) {
  std::string text = text_of(problem(file));
  std::smatch name;
  if (std::regex_search(text, name, std::regex("\\nlike: (\\S+)\\n"))) {
    const std::filesystem::path other = std::filesystem::path(file).parent_path() / name[1].str();
    return text + texts_of(other.lexically_normal().string());
  }
  if (std::regex_search(text, name, std::regex("\\nmethod: ([a-z0-9-]+)\\n")))
    text += gainsmith({"methods", name[1]}).out;
  return text;
}

/// A line of `run` ends with what the campaign found, or with why there is none in the words of the
/// problem or its method.
void expect_campaign_or_reason(const std::string& line, const std::string& file) {
  const std::string none = "; no campaign: ";
  const std::size_t at = line.find(none);
  if (at == std::string::npos) {
    EXPECT_TRUE(std::regex_search(line, std::regex("; (held|violated|undecided)"))) << line;
    return;
  }
  const std::string reason = line.substr(at + none.size(), line.find('\n') - at - none.size());
  if (reason == "no gains") return;  // after a no
  EXPECT_NE(texts_of(file).find("\nno campaign: \"" + reason + "\"\n"), std::string::npos) << line;
}

bool has_events(const std::string& file) {
  return std::regex_search(text_of(problem(file)), std::regex("\n *(events|observers):"));
}

/// Its first run satisfies the texts. Few rows of it are printed.
void judge_first_run(const std::string& gains) {
  const Outcome outcome = gainsmith({"simulate", gains, "--judge", "--step", "1"});
  EXPECT_NE((outcome.out + outcome.err).find("judged: the run satisfies the texts"),
            std::string::npos)
      << outcome.err;
}

/// A second program, which shares nothing with the first, proves the same.
void certify_gains(const std::string& gains, const std::string& file) {
  // Inequalities over a box of four variables take it minutes.
  if (file.find("arm-observer") != std::string::npos) return;
  const Outcome outcome = gainsmith({"certify", gains, "--claims"});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
}

TEST_P(Problems, IsAsExpected) {
  const Folder folder;
  const Outcome outcome = gainsmith({"run", problem(GetParam()), "-o", folder.path("out")});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out.substr(0, 3), "ok ") << outcome.out;
  expect_campaign_or_reason(outcome.out, GetParam());
  const std::string name = std::filesystem::path(GetParam()).stem().string();
  EXPECT_NE(text_of(folder.path("out/" + name + "/summary.txt")).find("all as expected"),
            std::string::npos);
  const auto gains = nlohmann::json::parse(text_of(folder.path("out/" + name + "/gains.json")),
                                           nullptr, /*allow_exceptions=*/false);
  // Files of data are beside the problem.
  const bool reads_data = text_of(problem(GetParam())).find(".csv") != std::string::npos;
  if (has_events(GetParam()))
    judge_first_run(reads_data ? problem(GetParam()) : folder.path("out/" + name + "/gains.json"));
  certify_gains(folder.path("out/" + name + "/gains.json"), GetParam());
  if (!gains.contains("objective_lower_bound")) return;
  // Of detectability the objective chooses among solutions with unknowns of very different sizes;
  // its bound, which allows for unknowns twice as large, is loose there.
  const std::string method = gains["statement"].dump();
  if (method.find("method: detectability") != std::string::npos) return;
  const double least = gains["objective_lower_bound"];
  const double found = gains["objective"];
  EXPECT_LE(found - least, 1e-6 * std::abs(found)) << "what the margins cost";
}

/// The file's path in the signs that a test's name may have.
std::string test_name(const ::testing::TestParamInfo<std::string>& file) {
  std::string name = std::filesystem::path(file.param).replace_extension().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Files, Problems, ::testing::ValuesIn(problems_in("")), test_name);

TEST(ProblemsTest, AFolderIsRunWithALineAProblem) {
  const Folder folder;
  const std::string classics = problem("classics");
  const Outcome outcome = gainsmith({"run", classics, "-o", folder.path("out"), "--runs", "100",
                                     "--junit", folder.path("junit.xml")});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  const std::size_t count = problems_in("classics").size();
  EXPECT_EQ(static_cast<std::size_t>(std::count(outcome.out.begin(), outcome.out.end(), '\n')),
            count + 1)
      << "and their number";
  const std::string junit = text_of(folder.path("junit.xml"));
  EXPECT_NE(junit.find("tests=\"" + std::to_string(count) + "\" failures=\"0\" errors=\"0\""),
            std::string::npos)
      << junit;
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/hinf-norm/gains.json")));
}

/// Every file of the results by its name, without timings and without the name of the folder.
std::map<std::string, std::string> results(const std::string& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::filesystem::path& path = entry.path();
    if (!entry.is_regular_file()) continue;
    std::string text = text_of(path.string());
    if (path.extension() == ".json") text = without_timings(text);
    for (std::size_t at; (at = text.find(root)) != std::string::npos;) text.erase(at, root.size());
    files[path.lexically_relative(root).string()] = text;
  }
  return files;
}

/// Campaigns of several problems share the threads, loops within a loop.
TEST(ProblemsTest, TheResultsDoNotDependOnThreads) {
  const Folder folder;
  const auto run = [&](const std::string& threads) {
    const std::string out = folder.path(threads);
    const Outcome outcome =
        gainsmith({"run", problem("ferrante-seuret-2021/t2-0.60.yaml"),
                   problem("ferrante-seuret-2021/row-3.yaml"), problem("classics/hinf-norm.yaml"),
                   "-o", out, "--runs", "300", "--threads", threads});
    EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
    auto files = results(out);
    files["stdout"] = outcome.out;
    return files;
  };
  const auto one = run("1");
  EXPECT_EQ(one.count("row-3/campaign.json"), 1U);
  for (const char* threads : {"2", "5"}) EXPECT_EQ(run(threads), one) << threads;
}

/// An expectation that is wrong is found: the guard is no formality.
TEST(ProblemsTest, AWrongExpectationFailsTheRun) {
  const Folder folder;
  const std::string text = text_of(problem("ferrante-seuret-2021/t2-0.70.yaml"));
  const std::string wrong = folder.file(
      "wrong.yaml", std::regex_replace(text, std::regex("value: 1742.425"), "value: 1740"));
  const Outcome outcome = gainsmith(
      {"run", wrong, "-o", folder.path("out"), "--runs", "5", "--junit", folder.path("j.xml")});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_NE(outcome.out.find("objective: expected 1740 within"), std::string::npos) << outcome.out;
  EXPECT_NE(text_of(folder.path("j.xml")).find("<failure"), std::string::npos);
}

/// The message of a test case is what one would look for in the summary.
TEST(ProblemsTest, TheLogAndJUnitNameTheCause) {
  const Folder folder;
  const std::string like = "like: " + problem("ferrante-seuret-2021/t2-0.70.yaml");
  std::filesystem::create_directory(folder.path("p"));
  folder.file(
      "p/a-none.yaml",
      "problem: long\n" + like + "\ndata: {T2: 1.1}\nexpect: {verdict: \"yes\", campaign: held}\n");
  folder.file("p/b-hidden.yaml",
              "problem: hidden\n" + like + "\ndata: {A: [[1, 0], [0, -1]], C: [[0, 1]]}\n");
  folder.file(
      "p/c-violated.yaml",
      "problem: violated\nmethod:\n  plant: {state: {x: {shape: 1, start: 1}}, flow: {x: -x}}\n"
      "  claims: {big: {above: x, bound: 0.4}, small: {below: x, bound: 0.5}}\n"
      "campaign: {horizon: 1}\nexpect: {campaign: held}\n");
  const Outcome outcome = gainsmith({"run", folder.path("p"), "-o", folder.path("out"), "--junit",
                                     folder.path("j.xml"), "--json"});
  EXPECT_EQ(outcome.exit, 1);
  const std::string junit = text_of(folder.path("j.xml"));
  const std::string replay = "; replay: gainsmith simulate " +
                             folder.path("out/c-violated/gains.json") + " --run 0 --seed 1";
  const auto problems = outcome.json()["problems"];
  std::size_t at = 0;
  for (const std::string& cause :
       {std::string("infeasible: positive_P1 and flow cannot hold together"),
        std::string("infeasible: the output does not show a mode of the plant"),
        "claim small (stays below) violated in 1 run: 1 against 0.5 at (t, j) = (0, 0) of run 0" +
            replay}) {
    EXPECT_NE(junit.find("<failure message=\"NO: " + cause), std::string::npos) << junit;
    EXPECT_TRUE(problems[at++]["causes"][0].get<std::string>().starts_with(cause));
  }
  EXPECT_EQ(problems[0]["differences"].size(), 1U);
  EXPECT_EQ(problems[2]["causes"].size(), 2U);
  EXPECT_NE(
      text_of(folder.path("out/a-none/summary.txt")).find("why         infeasible: positive_P1"),
      std::string::npos);
}

/// s^3 + F s^2 + s + 1 + F has positive coefficients for F > 0, and no F with F > 1 + F.
TEST(ProblemsTest, AnUndecidedProblemSaysSoFirst) {
  const Folder folder;
  const std::string open =
      "problem: open\nmethod: {method: m, data: {h: {shape: scalar, default: 2}}, unknowns: {x: "
      "scalar}, require: {low: x > h, high: x < -1}}\nsearch: {over: {h: [1, 3]}}\n";
  std::filesystem::create_directory(folder.path("p"));
  folder.file("p/a.yaml", open + "expect: {verdict: \"yes\"}\n");
  folder.file("p/b.yaml", open);
  const Outcome outcome = gainsmith(
      {"run", folder.path("p"), "-o", folder.path("out"), "--junit", folder.path("j.xml")});
  const std::string junit = text_of(folder.path("j.xml"));
  EXPECT_NE(junit.find("<failure message=\"NO: undecided: "), std::string::npos) << junit;
  EXPECT_NE(junit.find("<error message=\"UNDECIDED: "), std::string::npos) << junit;
  EXPECT_EQ(outcome.exit, 3) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "\n2 problems: 1 NO, 1 UNDECIDED\n")) << outcome.out;
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
