// The program: runs the command line and turns what happens into exit codes.
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "base/error.h"
#include "gainsmith/commands.h"
#include "gainsmith/optimizers.h"
#include "gainsmith/terminal.h"

namespace {

namespace app = gainsmith::app;
using gainsmith::ExitCode;

int report(ExitCode code, const std::string& message) {
  app::say("gainsmith: " + message + "\n");
  return static_cast<int>(code);
}

/// Runs the command line; the exit code.
int run(int argc, char** argv) {
  try {
    return static_cast<int>(app::run(app::all_commands(), argc, argv));
  } catch (const gainsmith::InputError& error) {
    return report(ExitCode::bad_input, error.what());
  } catch (const std::system_error& error) {
    return report(ExitCode::bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::fault, "out of memory");
  } catch (const std::exception& error) {
    return report(ExitCode::fault, std::string("internal error: ") + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  app::open_standard_files();
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
