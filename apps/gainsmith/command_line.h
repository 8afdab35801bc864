// The command line as records: what a subcommand takes, in the order in which its help shows it.
// command_line.cpp alone knows the library that reads them.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "gainsmith/terminal.h"

namespace gainsmith::app {

/// An option, flag or positional argument: where its value goes, and what the value may be.
struct Option {
  /// The type says how the value is read: bool is a flag; an optional stays empty when nothing is
  /// given, all else keeps its default, which help shows; a vector takes one value each time its
  /// option is given, or, as a positional argument, all that are left.
  using Target = std::variant<bool*, int*, unsigned*, std::uint64_t*, double*, std::string*,
                              std::vector<std::string>*, std::optional<int>*,
                              std::optional<std::uint64_t>*, std::optional<double>*>;
  template <typename Number>
  using Range = std::pair<Number, Number>;
  using Check = std::function<std::string(const std::string&)>;

  /// `in_name`: "-o,--output"; without dashes for a positional argument.
  template <typename Value>
  Option(std::string in_name, Value& value, std::string in_text)
      : name(std::move(in_name)), target(&value), text(std::move(in_text)) {}

  Option& required() { return is_required = true, *this; }
  /// Both ends are allowed; their type is the one that help names.
  template <typename Number>
  Option& within(Number low, Number high) {
    return range = Range<Number>(low, high), *this;
  }
  Option& one_of(std::vector<std::string> words) { return choices = std::move(words), *this; }
  /// `find_error` says what is wrong with a text; nothing when it is fine.
  Option& checked(Check find_error) { return check = std::move(find_error), *this; }
  /// This many values in a row, for a vector.
  Option& values(int number) { return count = number, *this; }
  /// What completion offers for a value that may be others too.
  Option& suggests(std::vector<std::string> words) {
    return choices_offered = std::move(words), *this;
  }
  /// What help calls the value.
  Option& named(std::string word) { return value_name = std::move(word), *this; }
  /// Not together with these options, which are above this one.
  Option& excludes(std::vector<std::string> names) { return excluded = std::move(names), *this; }

  std::string name;
  Target target;
  std::string text;
  bool is_required = false;
  std::variant<std::monostate, Range<int>, Range<std::uint64_t>, Range<double>> range;
  std::vector<std::string> choices;
  std::vector<std::string> choices_offered;
  std::string value_name;
  Check check;
  std::optional<int> count;
  std::vector<std::string> excluded;
};

struct Command {
  std::string name;
  std::string text;
  std::vector<Option> options;
  std::string footer;
  std::function<ExitCode()> work;  ///< holds what the options' targets point to
  bool computes = true;            ///< it may be stopped: --time, --progress
};

/// Its options and, where it may be stopped, those of all such commands.
std::vector<Option> options_of(const Command& command, Patience& patience);

struct Program {
  std::string name;
  std::string text;
  std::string version;
  std::string footer;
  std::vector<Command> commands;
};

/// Reads the command line and does the work of its subcommand, or prints help or the version; the
/// exit code. InputError for a wrong command line, with what was meant, and where the results could
/// not be printed; the rest is what the work throws.
ExitCode run(const Program& program, int argc, char** argv);

}  // namespace gainsmith::app
