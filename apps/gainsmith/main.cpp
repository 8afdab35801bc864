// The program: declares the subcommands and turns what happens into exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/nearest.h"
#include "base/version.h"
#include "gainsmith/commands.h"
#include "gainsmith/optimizers.h"

namespace {

using gainsmith::ExitCode;

int report(ExitCode code, const char* message) {
  fmt::print(stderr, "gainsmith: {}\n", message);
  return static_cast<int>(code);
}

/// CLI11 takes an unknown first word for a missing subcommand.
void refuse_unknown_word(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  throw gainsmith::InputError({}, "unknown subcommand '" + std::string(argv[1]) + "'" +
                                      gainsmith::suggestion(argv[1], names));
}

/// Runs the command line; the exit code.
int run(int argc, char** argv) {
  ExitCode exit = ExitCode::yes;
  CLI::App program(
      "gainsmith: observer gains by linear matrix inequalities, verified by simulation",
      "gainsmith");
  program.set_version_flag("--version", std::string("gainsmith ") + gainsmith::kVersion);
  program.require_subcommand(1);
  program.footer(
      "Exit codes of every subcommand: 0 done and the answer is yes; 1 done and the answer is no;\n"
      "2 the command line or a file is wrong; 3 undecided; 70 a fault of the program.\n"
      "Each subcommand has --help with examples.");
  try {
    gainsmith::app::add_synth(program, exit);
    gainsmith::app::add_bisect(program, exit);
    gainsmith::app::add_scan(program, exit);
    gainsmith::app::add_optimize(program, exit);
    gainsmith::app::add_explain(program, exit);
    gainsmith::app::add_verify(program, exit);
    gainsmith::app::add_simulate(program, exit);
    gainsmith::app::add_run(program, exit);
    gainsmith::app::add_check(program, exit);
    gainsmith::app::add_solve(program, exit);
    gainsmith::app::add_methods(program, exit);
    refuse_unknown_word(program, argc, argv);
    program.parse(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      return report(ExitCode::bad_input, "cannot write to standard output");
    return static_cast<int>(exit);
  } catch (const CLI::CallForHelp& request) {
    return program.exit(request);
  } catch (const CLI::CallForAllHelp& request) {
    return program.exit(request);
  } catch (const CLI::CallForVersion& request) {
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    program.exit(error);
    return static_cast<int>(ExitCode::bad_input);
  } catch (const gainsmith::InputError& error) {
    return report(ExitCode::bad_input, error.what());
  } catch (const std::system_error& error) {
    return report(ExitCode::bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::fault, "out of memory");
  } catch (const std::exception& error) {
    return report(ExitCode::fault, (std::string("internal error: ") + error.what()).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const gainsmith::app::OptimizersNeeded& need) {
    try {
      gainsmith::app::continue_with_optimizers(argv, need);
    } catch (const gainsmith::InputError& error) {
      return report(ExitCode::bad_input, error.what());
    }
  }
}
