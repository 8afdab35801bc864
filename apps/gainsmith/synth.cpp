#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "base/file.h"
#include "design/optimize.h"
#include "design/synthesize.h"
#include "gainsmith/advice.h"
#include "gainsmith/commands.h"
#include "gainsmith/explain_text.h"
#include "gainsmith/load.h"
#include "gainsmith/optimizers.h"
#include "gainsmith/output.h"
#include "gainsmith/search_wanted.h"
#include "gainsmith/summary.h"
#include "gainsmith/terminal.h"
#include "sdp/sdpa_file.h"

namespace gainsmith::app {

namespace {

struct SynthOptions {
  std::string problem;
  std::string output;
  std::string sdpa;
  unsigned threads = 0;
  bool json = false;
};

/// Why there are no gains, in one line.
std::string reason(const model::Instance& instance, const model::Gains& gains,
                   const sdp::Options& solver) {
  const auto conflict = design::find_conflict(instance, gains, solver);
  return explanation_line(conflict.value(), design::find_reaches(instance, solver));
}

ExitCode synth(const SynthOptions& options) {
  refuse_overwriting(options.problem, {options.output, options.sdpa});
  const model::Instance instance = load_problem(options.problem);
  const design::SearchRequest request = wanted_search(instance);
  const search::Optimizers* optimizers = optimizers_for(request, *instance.design);
  catch_interrupts();
  sdp::Options solver;
  solver.interrupted = interrupted;
  const model::Gains gains =
      design::synthesize_searched(instance, request, optimizers, options.threads, solver);
  if (!options.sdpa.empty())
    write_atomically(options.sdpa, sdp::write_sdpa(design::semidefinite_program(
                                       model::evaluate(instance.design, gains.searched))));
  write_result(gains, options.output,
               options.json ? io::to_text(json_without_statement(gains)) : synthesis_summary(gains),
               options.json);
  if (gains.verdict == model::Verdict::no && !options.json && !interrupted())
    print_report("why         " + reason(instance, gains, solver) + "\n", options.output == "-");
  if (!options.json && !interrupted())
    print_report(advice(instance, gains, options.problem), options.output == "-");
  if (gains.verdict == model::Verdict::yes && options.output.empty() && !options.json &&
      progress_wanted())
    say("no gain file was written: -o GAINS.json writes one\n");
  return exit_of(gains.verdict);
}

}  // namespace

Command synth_command() {
  auto options = std::make_shared<SynthOptions>();
  return {
      "synth",
      "Synthesize gains from a problem file",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       Option("-o,--output", options->output, "write the gain file here; - for standard output"),
       Option("--sdpa", options->sdpa, "write the semidefinite program here, for other solvers"),
       Option("--threads", options->threads,
              "threads of a search, 0: one a core; the result does not depend on it")
           .within(0, 1024),
       Option("--json", options->json, "print the result as JSON")},
      "Exit code: 0 gains found, 1 infeasible by a checked certificate, 2 wrong input, 3 "
      "undecided.\n"
      "Examples:\n"
      "  gainsmith synth problems/ferrante-seuret-2021/t2-0.70.yaml -o gains.json\n"
      "  gainsmith synth problem.yaml --json | jq .gains",
      [options] { return synth(*options); }};
}

}  // namespace gainsmith::app
