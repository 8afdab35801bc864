// The program: runs the command line and turns what happens into exit codes.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/visible.h"
#include "gainsmith/commands.h"
#include "gainsmith/terminal.h"

namespace {

namespace app = gainsmith::app;
using gainsmith::ExitCode;

int report(ExitCode code, const std::string& message) {
  app::say("gainsmith: " + gainsmith::visible(message) + "\n");
  return static_cast<int>(code);
}

/// Scripts ask for it often; no command is made ready for it.
int print_version() {
  std::puts(app::version().c_str());
  app::finish_output();
  return static_cast<int>(ExitCode::yes);
}

/// Runs the command line; the exit code.
int run(int argc, char** argv) {
  try {
    if (argc == 2 && std::string_view(argv[1]) == "--version") return print_version();
    return static_cast<int>(app::run(app::all_commands(), argc, argv));
  } catch (const gainsmith::InputError& error) {
    return report(ExitCode::bad_input, error.what());
  } catch (const std::system_error& error) {
    return report(ExitCode::bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::bad_input, "there is not enough memory for this problem");
  } catch (const std::exception& error) {
    return report(ExitCode::fault, std::string("internal error: ") + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  app::open_standard_files();
  return run(argc, argv);
}
