#include "gainsmith/commands.h"

#include "base/version.h"

namespace gainsmith::app {

std::string version() { return std::string("gainsmith ") + kVersion; }

Program all_commands() {
  return {
      "gainsmith",
      "gainsmith: observer gains by linear matrix inequalities, verified by simulation",
      version(),
      "Exit codes of every subcommand: 0 done and the answer is yes; 1 done and the answer is no;\n"
      "2 the command line or a file is wrong; 3 undecided or stopped; 70 a fault of the program.\n"
      "Each subcommand has --help with examples.",
      {synth_command(), bisect_command(), scan_command(), optimize_command(), explain_command(),
       verify_command(), merge_command(), simulate_command(), plot_command(), run_command(), report_command(),
       check_command(), certify_command(), export_command(), solve_command(), methods_command(),
       init_command(), schema_command(), completions_command(), manual_command()}};
}

}  // namespace gainsmith::app
