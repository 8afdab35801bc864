#include "end_to_end/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

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

pid_t start(std::vector<std::string> arguments, const std::string& out, const std::string& err) {
  arguments.insert(arguments.begin(), program());
  std::vector<char*> words;
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  const auto open = [](const std::string& name, int as) {
    ::dup2(::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600), as);
  };
  open(out, STDOUT_FILENO);
  open(err, STDERR_FILENO);
  ::execv(words[0], words.data());
  ::_exit(127);
}

void wait_for(pid_t child, const std::function<bool()>& when) {
  for (siginfo_t ended{}; ended.si_pid == 0 && !when();) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
  }
}

double seconds_of(pid_t child) {
  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(child, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

namespace {

bool catches(pid_t child, int signal) {
  std::ifstream status("/proc/" + std::to_string(child) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:"))
      return ((std::stoull(line.substr(7), nullptr, 16) >> (signal - 1)) & 1U) != 0;
  return false;
}

}  // namespace

Interrupted interrupted(const std::vector<std::string>& arguments, double seconds, int signal,
                        const std::function<bool()>& when) {
  const Folder folder;
  const pid_t child = start(arguments, folder.path("out"), folder.path("err"));
  wait_for(child, [&] { return catches(child, signal) && seconds_of(child) >= seconds && when(); });
  ::kill(child, signal);
  const double before = seconds_of(child);
  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  const auto in_seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  Interrupted result;
  result.seconds = in_seconds(used.ru_utime) + in_seconds(used.ru_stime) - before;
  result.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out = text_of(folder.path("out"));
  result.err = text_of(folder.path("err"));
  return result;
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
