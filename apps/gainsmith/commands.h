// The subcommands: the options of each, and the work that they are for.
#pragma once

#include "gainsmith/command_line.h"

namespace gainsmith::app {

Command synth_command();
Command bisect_command();
Command scan_command();
Command optimize_command();
Command explain_command();
Command verify_command();
Command merge_command();
Command simulate_command();
Command plot_command();
Command run_command();
Command report_command();
Command check_command();
Command certify_command();
Command export_command();
Command solve_command();
Command methods_command();
Command init_command();
Command schema_command();
Command completions_command();
Command manual_command();

/// "gainsmith 0.1.0".
std::string version();

/// gainsmith with all of them.
Program all_commands();

}  // namespace gainsmith::app
