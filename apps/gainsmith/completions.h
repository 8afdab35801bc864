// Completion of the command line in shells, made from the records of the commands.
#pragma once

#include <string>

#include "gainsmith/command_line.h"

namespace gainsmith::app {

/// The names of an option: "-o", "--output"; none for a positional argument.
std::vector<std::string> dashed_names(const Option& option);

/// Whether a value follows the option.
bool takes_value(const Option& option);

/// The words that its value is one of, or usually is; empty where it may be anything.
std::vector<std::string> offered_words(const Option& option);

/// Scripts that complete subcommands, options, words and names of files.
std::string bash_completions(const Program& program);
std::string zsh_completions(const Program& program);
std::string fish_completions(const Program& program);

}  // namespace gainsmith::app
