#include "design/explain.h"
#include "design/hautus.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "gainsmith/advice.h"
#include "gainsmith/commands.h"
#include "gainsmith/explain_text.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/terminal.h"

namespace gainsmith::app {

namespace {

struct ExplainOptions {
  std::string problem;
  std::vector<std::string> set;
  std::string effort;
  bool json = false;
};

/// The hidden mode, unless it stands above: without a conflict the message of the solver does.
std::string plant_line(const model::Instance& instance, const design::Explanation& explanation) {
  const std::string hidden = design::hidden_mode_text(instance);
  const bool stands =
      !explanation.conflict && explanation.gains.solver.message.find(hidden) != std::string::npos;
  return stands ? "" : hidden_line(instance);
}

ExitCode explain(const ExplainOptions& options) {
  const model::Instance instance =
      load_problem(options.problem, options.set, effort(options.effort));
  const design::Explanation explanation = design::explain(instance, {});
  const Telling telling;
  fmt::print("{}", options.json ? io::to_text(explanation_json(explanation))
                                : explanation_text(explanation) +
                                      plant_line(instance, explanation) + held_line(instance));
  if (!explanation.finished) {
    say("not finished: what is undecided or missing here was not examined to its end\n");
    return ExitCode::undecided;
  }
  return exit_of(explanation.gains.verdict);
}

}  // namespace

Command explain_command() {
  auto options = std::make_shared<ExplainOptions>();
  return {
      "explain",
      "Say why a problem has no solution and what would have to give",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       set_option(options->set),
       Option("--effort", options->effort,
              "what double does not decide: ordinary (an allowance of work) or full (any)")
           .one_of({"ordinary", "full"}),
       Option("--json", options->json, "print as JSON")},
      "The problem is taken at its own values: what it wants searched is not searched.\n"
      "Exit code: 0 there is nothing to explain: it is feasible, 1 infeasible, 2 wrong input,\n"
      "3 undecided.\n"
      "Examples:\n"
      "  gainsmith explain problems/ferrante-seuret-2021/published-theorem.yaml\n"
      "  gainsmith explain problem.yaml --json | jq .conflict.requirements",
      [options] { return explain(*options); }};
}

}  // namespace gainsmith::app
