#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/stop.h"
#include "bind/instance.h"
#include "design/excluded_inequalities.h"
#include "design/optimize.h"
#include "design/semidefinite_program.h"
#include "design/synthesize.h"
#include "gainsmith/advice.h"
#include "gainsmith/certify.h"
#include "gainsmith/commands.h"
#include "gainsmith/explain_text.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/search_wanted.h"
#include "gainsmith/summary.h"
#include "gainsmith/terminal.h"
#include "sdp/files/sdpa_file.h"
#include "sdp/solution.h"

namespace gainsmith::app {

namespace {

struct SynthOptions {
  std::string problem;
  std::vector<std::string> set;
  std::string effort;
  std::string output;
  std::string sdpa;
  bool only_write = false;
  unsigned threads = 0;
  bool json = false;
  bool certify = false;
};

/// Why there are no gains, in one line; `spent`: the work of finding that there are none.
std::string reason(const model::Instance& instance, const model::Gains& gains, double spent) {
  constexpr double kLeast = 0.1, kMost = 1, kTimes = 1.5;
  const double seconds = std::clamp(kTimes * spent, kLeast, kMost);
  // A search says no of what it does not change alone.
  const auto excluded =
      design::held_scalars(instance).empty()
          ? std::nullopt
          : design::excluded_inequalities(instance, design::request_of(instance), {});
  const auto conflict =
      excluded ? design::guess_conflict(excluded->inequalities, excluded->gains, {}, seconds)
               : design::guess_conflict(instance, gains, {}, seconds);
  return explanation_line(conflict.value(), design::find_reaches(instance, {}));
}

/// Below the result: why, what to try next, where gains go.
void say_more(const SynthOptions& options, const model::Instance& instance,
              const model::Gains& gains, double spent) {
  const bool to_stdout = options.output == "-";
  if (gains.verdict == model::Verdict::no) {
    const std::string why = reason(instance, gains, spent);
    check_stop();
    print_report("why         " + why + "\n", to_stdout);
  }
  print_report(advice(instance, gains, options.problem), to_stdout);
  if (gains.verdict == model::Verdict::yes && options.output.empty() && is_terminal())
    say("no gain file was written: -o GAINS.json writes one\n");
}

void write_program(const std::string& path, const model::Instance& instance) {
  const design::SemidefiniteProgram program = design::semidefinite_program(instance);
  write_atomically(path, sdp::write_sdpa(program.problem, program.remarks));
}

/// The exit code of a synthesis, undecided where the second program does not agree.
ExitCode certified(const SynthOptions& options, const model::Gains& gains, ExitCode exit) {
  if (!options.certify || gains.verdict == model::Verdict::undecided) return exit;
  return certify({options.output}) == ExitCode::yes ? exit : ExitCode::undecided;
}

ExitCode synth(const SynthOptions& options) {
  prepare_outputs(options.problem, {options.output, options.sdpa});
  if (options.only_write && options.sdpa.empty())
    throw InputError({"--no-solve"}, "nothing to do: --sdpa FILE says where the program goes");
  if (options.certify && (options.output.empty() || options.output == "-"))
    throw InputError({"--certify"},
                     "it reads the gain file, which -o GAINS.json writes: -o is missing");
  if (options.certify) require_certify();
  const model::Instance instance =
      load_problem(options.problem, options.set, effort(options.effort));
  const design::SearchRequest request = wanted_search(instance);
  // What is searched has no values before the search.
  const bool write_first = !options.sdpa.empty() && (request.empty() || options.only_write);
  if (write_first) write_program(options.sdpa, instance);
  if (options.only_write) return ExitCode::yes;
  double spent = 0;
  const model::Gains gains = [&] {
    const Allowance work(std::numeric_limits<double>::infinity());
    model::Gains found = design::synthesize_searched(instance, request, options.threads, {});
    spent = work.spent();
    find_error(instance, found);
    return found;
  }();
  {
    const Telling telling;
    if (!options.sdpa.empty() && !write_first)
      write_program(options.sdpa, bind::evaluate(instance.design, gains.searched));
    write_result(
        gains, options.output,
        options.json ? io::to_text(json_without_statement(gains)) : synthesis_summary(gains),
        options.json);
  }
  try {
    if (!options.json) say_more(options, instance, gains, spent);
  } catch (const Stopped&) {
    // The result is there.
  }
  if (gains.solver.cause == to_string(sdp::Cause::interrupted)) return ExitCode::undecided;
  return certified(options, gains, gains.search ? exit_of_search(gains) : exit_of_synthesis(gains));
}

}  // namespace

Command synth_command() {
  auto options = std::make_shared<SynthOptions>();
  return {
      "synth",
      "Synthesize gains from a problem file",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       set_option(options->set),
       Option("-o,--output", options->output, "write the gain file here; - for standard output"),
       Option("--sdpa", options->sdpa,
              "write the semidefinite program here, for other solvers, before it is solved"),
       Option("--no-solve", options->only_write, "write that program and do not solve it"),
       Option(
           "--threads", options->threads,
           "threads of a search, 0: as many as cores it may use; the result does not depend on it")
           .within(0, 1024),
       Option("--effort", options->effort,
              "what double does not decide: ordinary (an allowance of work) or full (any)")
           .one_of({"ordinary", "full"}),
       Option("--json", options->json, "print the result as JSON"),
       Option("--certify", options->certify,
              "prove the gain file by the second program too; exit code 3 unless it agrees")
           .excludes({"--json"})},
      "Exit code: 0 gains found, 1 infeasible by a checked certificate, 2 wrong input, 3 "
      "undecided, stopped, or the optimum is not known to 1e-6.\n"
      "Examples:\n"
      "  gainsmith synth problems/ferrante-seuret-2021/t2-0.70.yaml -o gains.json\n"
      "  gainsmith synth problem.yaml --json | jq .gains",
      [options] { return synth(*options); }};
}

}  // namespace gainsmith::app
