// Where results go: a gain file, standard output, or both.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "io/json/json_text.h"
#include "model/gains.h"

namespace gainsmith::app {

/// Makes the folders of the outputs, before the work that they wait for. InputError when an output
/// would replace the input file or another output, is a folder, or has none that can be made.
void prepare_outputs(const std::string& input, const std::vector<std::string>& outputs);

/// Writes the gain file to `output` (nowhere when empty, standard output for "-") and the report to
/// standard output, or to standard error when the gain file goes there. `quiet`: no line on where
/// the file went.
void write_result(const model::Gains& gains, const std::string& output, const std::string& report,
                  bool quiet);

/// Prints to standard output, or to standard error when the results go there.
void print_report(const std::string& text, bool results_on_stdout);

/// The gain file's document without the long texts of the statement.
io::Json json_without_statement(const model::Gains& gains);

/// 0, 1 or 3.
ExitCode exit_of(model::Verdict verdict);

/// That of the verdict, but 3 for a yes whose optimum is not known.
ExitCode exit_of_synthesis(const model::Gains& gains);

/// 3 for a search that was stopped, whatever it found; otherwise that of its verdict.
ExitCode exit_of_search(const model::Gains& gains);

}  // namespace gainsmith::app
