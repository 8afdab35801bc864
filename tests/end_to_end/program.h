// Runs the built program as a person does.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gainsmith::tests {

struct Outcome {
  int exit = -1;
  std::string out;
  std::string err;

  nlohmann::ordered_json json() const { return nlohmann::ordered_json::parse(out); }
};

/// The program that is tested: what GAINSMITH_TEST_PROGRAM names in the environment, else that of
/// this build.
std::string program();

/// Runs gainsmith with the arguments; `input` is its standard input.
Outcome gainsmith(const std::vector<std::string>& arguments, const std::string& input = "");

/// Starts gainsmith and gives its process. Standard output and standard error go into the files `out` and `err`.
pid_t start(std::vector<std::string> arguments, const std::string& out, const std::string& err);

/// Waits until a process that was started has ended, or `when` holds. However busy the machine is: no time is a limit.
void wait_for(pid_t child, const std::function<bool()>& when);

/// The processor time that a process has used, in seconds.
double seconds_of(pid_t child);

struct Interrupted : Outcome {
  double seconds = 0;  ///< of processor time between the signal and the end
};

/// Runs gainsmith until it has used so many seconds of processor time, and `when` holds, and gives it the signal of Ctrl-C
/// or another one.
Interrupted interrupted(
    const std::vector<std::string>& arguments, double seconds = 1, int signal = SIGINT,
    const std::function<bool()>& when = [] { return true; });

/// A folder of its own for a test, empty at the start and removed at the end.
class Folder {
 public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();

  std::string path(const std::string& name) const { return (root_ / name).string(); }
  /// Writes a file and gives its path.
  std::string file(const std::string& name, const std::string& text) const;
  std::vector<std::string> names() const;

 private:
  std::filesystem::path root_;
};

/// A file below problems/.
std::string problem(const std::string& name);

std::string text_of(const std::string& path);

/// A text with something else in the place of a part of it.
std::string with(std::string text, const std::string& old, const std::string& fresh);

/// The numbers of the last row that `simulate` prints.
std::vector<double> last_row(const std::string& csv);

/// Whether a text has a part.
inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The document without its timings.
std::string without_timings(const std::string& text);

}  // namespace gainsmith::tests
