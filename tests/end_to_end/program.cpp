#include "end_to_end/program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace gainsmith::tests {

namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "gainsmith-test-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  root_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(root_, ignored);
}

std::string Folder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(root_))
    result.push_back(entry.path().filename().string());
  std::sort(result.begin(), result.end());
  return result;
}

std::string program() {
  const char* chosen = std::getenv("GAINSMITH_TEST_PROGRAM");
  return chosen == nullptr || *chosen == '\0' ? GAINSMITH_PROGRAM : chosen;
}

Outcome gainsmith(const std::vector<std::string>& arguments, const std::string& input) {
  const Folder folder;
  std::string command = quoted(program());
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  command += " < " + quoted(folder.file("in", input)) + " > " + quoted(folder.path("out")) +
             " 2> " + quoted(folder.path("err"));
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.out = text_of(folder.path("out"));
  outcome.err = text_of(folder.path("err"));
  return outcome;
}

std::string problem(const std::string& name) {
  return std::string(GAINSMITH_PROBLEMS) + "/" + name;
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string without_timings(const std::string& text) {
  auto document = nlohmann::ordered_json::parse(text);
  document.erase("timings");
  return document.dump();
}

std::string with(std::string text, const std::string& old, const std::string& fresh) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), fresh);
}

std::vector<double> last_row(const std::string& csv) {
  const std::size_t begin = csv.find_last_of('\n', csv.size() - 2) + 1;
  std::istringstream row(csv.substr(begin));
  std::vector<double> numbers;
  for (std::string field; std::getline(row, field, ',');)
    numbers.push_back(field.empty() ? 0 : std::stod(field));
  return numbers;
}

}  // namespace gainsmith::tests
