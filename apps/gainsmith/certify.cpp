#include "gainsmith/certify.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/number.h"
#include "gainsmith/commands.h"
#include "gainsmith/other_program.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPython = "python3";

/// Beside the program, as installed or as built.
std::string folder_of_certify() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"../share/gainsmith/scripts/certify", "../../../../scripts/certify"})
    if (const fs::path folder = here / place; fs::exists(folder / "__main__.py", error))
      return fs::weakly_canonical(folder, error).string();
  throw InputError({"certify"},
                   "its folder scripts/certify is not beside this program; "
                   "`python3 scripts/certify GAINS.json` of the source does the same");
}

struct CertifyOptions {
  std::vector<std::string> files;
  bool claims = false;
  bool json = false;
  double seconds = 60;
};

}  // namespace

void require_certify() {
  if (!is_installed(kPython))
    throw InputError({"certify"},
                     "it runs in Python 3, which is not installed (packages python3 and "
                     "python3-yaml in Debian)");
  static_cast<void>(folder_of_certify());
}

ExitCode certify(std::vector<std::string> arguments) {
  require_certify();
  arguments.insert(arguments.begin(), {kPython, folder_of_certify()});
  std::fflush(stdout);
  const auto code = run_program(std::move(arguments));
  if (!code) throw InputError({"certify"}, "python3 could not be run, or was stopped");
  const auto exit = static_cast<ExitCode>(*code);
  const auto known = {ExitCode::yes, ExitCode::no, ExitCode::undecided, ExitCode::fault};
  return std::ranges::find(known, exit) != known.end() ? exit : ExitCode::bad_input;
}

Command certify_command() {
  auto options = std::make_shared<CertifyOptions>();
  return {"certify",
          "Prove what gain files say by a second program, which shares no code with this one",
          {Option("gains", options->files, "gain files (JSON); - for standard input").required(),
           Option("--claims", options->claims, "a line for each claim"),
           Option("--json", options->json, "print the report as JSON"),
           Option("--time", options->seconds, "seconds of a file, after which it is open")
               .within(0.1, 1e6)},
          "The second program is Python with PyYAML: scripts/certify, described in docs/trust.md.\n"
          "Exit code: 0 all is proved, or there is nothing to prove, 1 something is refuted, 2 no "
          "gain file, 3 something is open.\n"
          "Examples:\n"
          "  gainsmith certify gains.json\n"
          "  gainsmith certify results/*/gains.json --claims",
          [options] {
            std::vector<std::string> arguments = {"--time", brief(options->seconds)};
            if (options->claims) arguments.emplace_back("--claims");
            if (options->json) arguments.emplace_back("--json");
            arguments.emplace_back("--");
            arguments.insert(arguments.end(), options->files.begin(), options->files.end());
            return certify(std::move(arguments));
          },
          false};
}

}  // namespace gainsmith::app
