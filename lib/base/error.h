// Errors that a person can act upon, and the exit codes of the program.
//
// What a person can mend is an InputError with its place; a std::logic_error is a fault of the
// program. Stopping and allowances of work are exceptions of stop.h.
#pragma once

#include <stdexcept>
#include <string>

namespace gainsmith {

/// Exit codes of every subcommand (docs/conventions.md).
enum class ExitCode : int {
  yes = 0,        ///< done, and the answer is yes
  no = 1,         ///< done, and the answer is no
  bad_input = 2,  ///< the command line or a file is wrong
  undecided = 3,  ///< stopped without an answer
  fault = 70      ///< a fault of the program
};

/// A place in a text that a person wrote. Lines and columns count from 1 and columns count
/// characters (code points), not bytes; 0 means "not known".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;

  bool operator==(const Place&) const = default;
};

/// "file:line:column", leaving out what is not known.
std::string to_string(const Place& place);

/// The input is wrong (exit code 2). `what()` is "file:line:column: message": what was found, what
/// was expected and, where there is one, the nearest valid spelling.
class InputError : public std::runtime_error {
 public:
  InputError(Place place, const std::string& message);

  const Place& place() const { return place_; }
  const std::string& message() const { return message_; }

 private:
  Place place_;
  std::string message_;
};

}  // namespace gainsmith
