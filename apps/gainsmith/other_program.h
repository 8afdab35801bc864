// Programs that this one may call where they are installed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gainsmith::app {

/// Whether a folder of PATH has it.
bool is_installed(const std::string& command);

/// Runs a program of PATH with its arguments, the first of which is its name, and waits for it; its
/// exit code. None when it could not be run, or ended by a signal. `environment`: "NAME=value" of
/// what is not set. Standard input, output and error are those of this program.
std::optional<int> run_program(std::vector<std::string> arguments,
                               std::vector<std::string> environment = {});

}  // namespace gainsmith::app
