// The program: names the subcommands and turns what happens into exit codes.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/version.h"
#include "gainsmith/commands.h"
#include "gainsmith/optimizers.h"

namespace {

namespace app = gainsmith::app;
using gainsmith::ExitCode;

int report(ExitCode code, const char* message) {
  fmt::print(stderr, "gainsmith: {}\n", message);
  return static_cast<int>(code);
}

app::Program program() {
  return {
      "gainsmith",
      "gainsmith: observer gains by linear matrix inequalities, verified by simulation",
      std::string("gainsmith ") + gainsmith::kVersion,
      "Exit codes of every subcommand: 0 done and the answer is yes; 1 done and the answer is no;\n"
      "2 the command line or a file is wrong; 3 undecided; 70 a fault of the program.\n"
      "Each subcommand has --help with examples.",
      {app::synth_command(), app::bisect_command(), app::scan_command(), app::optimize_command(),
       app::explain_command(), app::verify_command(), app::simulate_command(), app::run_command(),
       app::check_command(), app::solve_command(), app::methods_command()}};
}

/// Runs the command line; the exit code.
int run(int argc, char** argv) {
  try {
    return static_cast<int>(app::run(program(), argc, argv));
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
  } catch (const app::OptimizersNeeded& need) {
    try {
      app::continue_with_optimizers(argv, need);
    } catch (const gainsmith::InputError& error) {
      return report(ExitCode::bad_input, error.what());
    }
  }
}
