// The methods built into the program and the problems of the repository parse and check.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "bind/bind.h"
#include "io/problem_text.h"
#include "io/starting_problem.h"
#include "io/yaml/method_yaml.h"

namespace gainsmith::io {
namespace {

namespace fs = std::filesystem;

TEST(BuiltInMethods, ParseUnderTheirOwnName) {
  ASSERT_GE(methods::all().size(), 5U);
  for (const methods::Text& text : methods::all()) {
    const model::Method method = parse_method(std::string(text.text), std::string(text.name));
    EXPECT_EQ(method.name, text.name);
    EXPECT_FALSE(method.source.empty()) << text.name;
    EXPECT_FALSE(method.summary.empty()) << text.name;
    EXPECT_FALSE(method.task.empty()) << text.name;
    EXPECT_FALSE(text.example.empty()) << text.name;
  }
}

std::vector<fs::path> problem_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(GAINSMITH_PROBLEMS))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  return files;
}

/// Scalars without quotation marks that YAML 1.1 takes for true or false.
void find_booleans(const YAML::Node& node, std::vector<std::string>& found) {
  static const std::set<std::string> kWords = {"yes", "no", "on", "off", "true", "false"};
  if (node.IsScalar()) {
    std::string word = node.Scalar();
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (node.Tag() == "?" && kWords.contains(word)) found.push_back(node.Scalar());
    return;
  }
  for (const auto& entry : node)
    if (node.IsMap()) {
      find_booleans(entry.first, found);
      find_booleans(entry.second, found);
    } else {
      find_booleans(entry, found);
    }
}

std::vector<std::string> booleans_of(const std::string& text) {
  std::vector<std::string> found;
  find_booleans(YAML::Load(text), found);
  return found;
}

TEST(OurFiles, AreReadAlikeByToolsOfYaml11) {
  using Words = std::vector<std::string>;
  ASSERT_EQ(booleans_of("{verdict: no, shape: \"no\", on: [Yes]}"), (Words{"no", "on", "Yes"}));
  for (const fs::path& path : problem_files())
    EXPECT_EQ(booleans_of(read_text(path)), Words{}) << path;
  for (const methods::Text& text : methods::all())
    EXPECT_EQ(booleans_of(std::string(text.text)), Words{}) << text.name;
}

TEST(Problems, OfTheRepositoryParseAndCheck) {
  const auto files = problem_files();
  ASSERT_GE(files.size(), 11U);
  for (const fs::path& path : files) {
    SCOPED_TRACE(path.filename().string());
    const model::Problem problem = parse_problem(read_text(path), path.string(), library());
    EXPECT_NO_THROW(bind::bind(problem));
    const fs::path named = problem.name + ".yaml";
    EXPECT_EQ(named, fs::relative(path, GAINSMITH_PROBLEMS)) << "the name is the path";
    EXPECT_TRUE(problem.expect) << "a problem of the repository says what is expected";
  }
}

/// Its comments name all that the method takes; its values are those of the example.
TEST(Problems, EveryBuiltInMethodHasOneToBeginWith) {
  for (const methods::Text& built_in : methods::all()) {
    SCOPED_TRACE(built_in.name);
    const model::Method method = parse_method(std::string(built_in.text), "method");
    const std::string text = starting_problem(method, std::string(built_in.example));
    const model::Problem example = read_problem(std::string(built_in.example));
    // The example may have a method of its own, like this one.
    if (example.method_name != method.name) {
      EXPECT_NE(built_in.example.find("like: " + method.name), std::string::npos);
    }
    EXPECT_EQ(example.name, method.example);
    const model::Problem problem = read_problem(text);
    const model::Instance instance = bind::bind(problem);
    EXPECT_EQ(instance.values, bind::bind(example).values);
    EXPECT_EQ(problem.campaign.runs, example.campaign.runs);
    EXPECT_FALSE(problem.expect);
    for (const model::Declaration& datum : method.data)
      EXPECT_NE(text.find("\n  # " + datum.shape.text), std::string::npos) << datum.name;
    for (const model::Parameter& parameter : method.parameters)
      EXPECT_TRUE(text.find("\n  " + parameter.name + ": ") != std::string::npos ||
                  text.find("\n  # " + parameter.name + ": ") != std::string::npos)
          << parameter.name;
  }
}

TEST(Problems, EveryBuiltInMethodIsUsableWithItsDefaults) {
  for (const std::string& name : methods::names()) {
    SCOPED_TRACE(name);
    const model::Method method = parse_method(*methods::find(name), name);
    std::string text = "problem: a\nmethod: " + name + "\ndata:\n";
    for (const model::Declaration& datum : method.data)
      if (!datum.arguments.empty()) {
        std::string arguments;
        for (const model::Argument& argument : datum.arguments)
          arguments += (arguments.empty() ? "" : ", ") + argument.name;
        text += "  " + datum.name + "(" + arguments + "): " + datum.arguments.front().name + "\n";
      } else if (!datum.fallback || datum.name == "S0")
        // With Hc = 0 flows show nothing: that is what the methods for hidden parts are for.
        text += "  " + datum.name + ": " +
                (datum.name == "T2"       ? "2"
                 : datum.name == "outer"  ? "9"
                 : datum.name == "low"    ? "-1"
                 : datum.name == "Hc"     ? "0"
                 : !datum.indices.empty() ? "[[[1]], [[1]]]"
                                          : "1") +
                "\n";
    text += "parameters: {";
    for (const model::Parameter& parameter : method.parameters)
      if (!parameter.fallback || parameter.name == "rho") text += parameter.name + ": 1, ";
    text += "}\n";
    if (method.has_dynamics && method.no_campaign.empty()) text += "campaign: {horizon: 1}\n";
    const model::Problem problem = read_problem(text);
    std::size_t unknowns = 0;
    bool has_polynomials = false;  // an unknown for each of their terms
    for (const model::UnknownDeclaration& unknown : method.unknowns) {
      unknowns += unknown.indices.empty() ? 1 : 2;
      has_polynomials = has_polynomials || !unknown.arguments.empty();
    }
    try {
      const auto design = bind::bind(problem).design;
      const std::size_t bound = design->unknowns.size() + design->necessary.unknowns.size();
      if (has_polynomials)
        EXPECT_GE(bound, unknowns);
      else
        EXPECT_EQ(bound, unknowns);
    } catch (const InputError& error) {
      // All is read; these numbers are not those of a plant that the method is for.
      EXPECT_NE(error.message().find("the assumption"), std::string::npos) << error.message();
    }
  }
}

}  // namespace
}  // namespace gainsmith::io
