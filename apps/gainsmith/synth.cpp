#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/file.h"
#include "design/synthesize.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/summary.h"
#include "gainsmith/terminal.h"
#include "io/gains_json.h"
#include "sdp/sdpa_file.h"

namespace gainsmith::app {

namespace {

struct SynthOptions {
  std::string problem;
  std::string output;
  std::string sdpa;
  bool json = false;
};

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

/// The result without the long texts of the statement.
std::string json_text(const model::Gains& gains) {
  io::Json document = io::to_json(gains);
  document.erase("statement");
  return io::to_text(document);
}

/// The gain file must not replace the problem.
void refuse_overwriting(const SynthOptions& options) {
  std::error_code ignored;
  for (const std::string& path : {options.output, options.sdpa})
    if (!path.empty() && std::filesystem::equivalent(path, options.problem, ignored))
      throw InputError({path}, "this is the problem file; choose another output");
}

ExitCode synth(const SynthOptions& options) {
  refuse_overwriting(options);
  const Loaded loaded = load_problem(options.problem);
  if (!options.sdpa.empty())
    write_atomically(options.sdpa, sdp::write_sdpa(design::semidefinite_program(loaded.instance)));
  catch_interrupts();
  sdp::Options solver;
  solver.interrupted = interrupted;
  const model::Gains gains = design::synthesize(loaded.instance, solver);
  const bool file_to_stdout = options.output == "-";
  if (file_to_stdout) {
    fmt::print("{}", io::gains_text(gains));
  } else if (!options.output.empty()) {
    write_atomically(options.output, io::gains_text(gains));
  }
  fmt::print(file_to_stdout ? stderr : stdout, "{}",
             options.json ? json_text(gains) : synthesis_summary(gains));
  if (!options.output.empty() && !file_to_stdout && !options.json)
    fmt::print(stderr, "wrote {}\n", options.output);
  return exit_of(gains.verdict);
}

}  // namespace

void add_synth(CLI::App& program, ExitCode& exit) {
  auto options = std::make_shared<SynthOptions>();
  CLI::App* command = program.add_subcommand("synth", "Synthesize gains from a problem file");
  command->add_option("problem", options->problem, "problem file (YAML); - for standard input")
      ->required();
  command->add_option("-o,--output", options->output,
                      "write the gain file here; - for standard output");
  command->add_option("--sdpa", options->sdpa,
                      "write the semidefinite program here, for other solvers");
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Exit code: 0 gains found, 1 proved infeasible, 2 wrong input, 3 undecided.\n"
      "Examples:\n"
      "  gainsmith synth problems/ferrante-seuret-2021/t2-0.70.yaml -o gains.json\n"
      "  gainsmith synth problem.yaml --json | jq .gains");
  command->callback([options, &exit] { exit = synth(*options); });
}

}  // namespace gainsmith::app
