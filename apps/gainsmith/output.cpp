#include "gainsmith/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/file.h"
#include "base/stop.h"
#include "gainsmith/terminal.h"
#include "io/json/gains_json.h"

namespace gainsmith::app {

namespace {

void make_folder_of(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError({file.string()}, "this is a folder; expected the name of a file");
  const std::filesystem::path folder = file.parent_path();
  if (folder.empty() || std::filesystem::is_directory(folder, error)) return;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError({file.string()},
                     "cannot make the folder '" + folder.string() + "': " + error.message());
}

}  // namespace

void prepare_outputs(const std::string& input, const std::vector<std::string>& outputs) {
  std::error_code ignored;
  for (const std::string& path : outputs)
    for (const char* spreadsheet : {".xlsx", ".xls", ".ods"})
      if (path.ends_with(spreadsheet))
        throw InputError({path}, "spreadsheets are not written; a CSV file, which they open, is");
  for (const std::string& path : outputs)
    if (!path.empty() && path != "-" && input != "-" &&
        std::filesystem::equivalent(path, input, ignored))
      throw InputError({path}, "this is the input file; choose another output");
  for (auto path = outputs.begin(); path != outputs.end(); ++path)
    if (!path->empty() && std::find(outputs.begin(), path, *path) != path)
      throw InputError({*path}, "two outputs cannot go here; choose another for one");
  for (const std::string& path : outputs)
    if (!path.empty() && path != "-") make_folder_of(path);
}

void write_result(const model::Gains& gains, const std::string& output, const std::string& report,
                  bool quiet) {
  const bool to_stdout = output == "-";
  if (to_stdout) {
    fmt::print("{}", io::gains_text(gains));
  } else if (!output.empty()) {
    write_atomically(output, io::gains_text(gains));
  }
  print_report(report, to_stdout);
  if (!output.empty() && !to_stdout && !quiet) {
    const bool empty = gains.gains.empty() && gains.gain_functions.empty();
    say("wrote " + output +
        (empty && gains.verdict != model::Verdict::yes ? ", without gains" : "") + "\n");
  }
}

void print_report(const std::string& text, bool results_on_stdout) {
  if (results_on_stdout) return say(text);
  fmt::print("{}", text);
}

io::Json json_without_statement(const model::Gains& gains) {
  io::Json document = io::to_json(gains);
  document.erase("statement");
  return document;
}

ExitCode exit_of(model::Verdict verdict) {
  switch (verdict) {
    case model::Verdict::yes:
      return ExitCode::yes;
    case model::Verdict::no:
      return ExitCode::no;
    case model::Verdict::undecided:
      break;
  }
  return ExitCode::undecided;
}

ExitCode exit_of_synthesis(const model::Gains& gains) {
  const bool open = gains.verdict == model::Verdict::yes && gains.objective &&
                    gains.solver.status == "feasible" && !gains.solver.unbounded;
  return open ? ExitCode::undecided : exit_of(gains.verdict);
}

ExitCode exit_of_search(const model::Gains& gains) {
  const bool finished = gains.search && gains.search->finished;
  const bool known = !gains.search || std::isfinite(gains.search->error.value_or(0));
  return (stop_requested && !finished) || !known ? ExitCode::undecided : exit_of(gains.verdict);
}

}  // namespace gainsmith::app
