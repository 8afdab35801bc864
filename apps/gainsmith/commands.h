// The subcommands. Each add_* declares its options and sets a callback that does the work and
// stores the exit code.
#pragma once

#include "base/error.h"

namespace CLI {
class App;
}

namespace gainsmith::app {

void add_synth(CLI::App& program, ExitCode& exit);
void add_bisect(CLI::App& program, ExitCode& exit);
void add_scan(CLI::App& program, ExitCode& exit);
void add_optimize(CLI::App& program, ExitCode& exit);
void add_explain(CLI::App& program, ExitCode& exit);
void add_verify(CLI::App& program, ExitCode& exit);
void add_simulate(CLI::App& program, ExitCode& exit);
void add_run(CLI::App& program, ExitCode& exit);
void add_check(CLI::App& program, ExitCode& exit);
void add_solve(CLI::App& program, ExitCode& exit);
void add_methods(CLI::App& program, ExitCode& exit);

}  // namespace gainsmith::app
