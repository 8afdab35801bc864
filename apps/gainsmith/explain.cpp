#include "design/explain.h"
#include "design/hautus.h"

#include <fmt/format.h>

#include <algorithm>
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

/// The hidden mode, unless it is shown above: without a conflict the message of the solver is.
std::string plant_line(const model::Instance& instance, const design::Explanation& explanation) {
  const std::string hidden = design::hidden_mode_text(instance);
  const bool stands =
      !explanation.conflict && explanation.gains.solver.message.find(hidden) != std::string::npos;
  return stands ? "" : hidden_line(instance);
}

/// How to find out which element of a matrix limits an optimum, where some are plain numbers.
std::string matrices_line(const model::Design& design) {
  const auto is_varied = [](const model::Design::Datum& datum) {
    const bool is_scalar = datum.shape.rows == 1 && datum.shape.cols == 1;
    // A formula follows the scalars in it.
    return is_scalar || !datum.value || !datum.value->program.inputs.empty();
  };
  if (std::ranges::all_of(design.data, is_varied)) return "";
  return fmt::format(
      "{:<12}{}\n", "matrices",
      "only scalars are varied: to see what an element of a matrix costs, give it a name\n"
      "            under 'data', such as a: 2 with A: \"[0, a; 1, 0]\"");
}

/// What is said of gains that could be better.
std::string better_lines(const model::Instance& instance, const design::Explanation& explanation) {
  if (explanation.gains.verdict != model::Verdict::yes) return "";
  std::string text;
  for (const std::string& fixed : design::fixed_mode_texts(instance))
    text += fmt::format("{:<12}{}\n", "plant", fixed);
  if (explanation.limits) return text + matrices_line(*instance.design);
  if (!explanation.reaches.empty()) return text;
  if (explanation.gains.objective)
    return text + "limited by  not known: the least objective was not found\n";
  const std::vector<std::string> scalars = design::scalars_in_use(*instance.design);
  text +=
      "limited by  nothing is minimised, so one solution is as good as another; state what is to "
      "be\n"
      "            best, 'minimize', or how far a scalar goes, 'negotiable: {NAME: [low, high]}'";
  for (std::size_t k = 0; k < scalars.size(); ++k)
    text += (k == 0 ? ";\n            the scalars are " : ", ") + scalars[k];
  return text + "\n";
}

ExitCode explain(const ExplainOptions& options) {
  const model::Instance instance =
      load_problem(options.problem, options.set, effort(options.effort));
  const design::Explanation explanation = design::explain(instance, {});
  const Telling telling;
  const bool no =
      explanation.gains.verdict == model::Verdict::no;  // then its line says what is held
  fmt::print("{}", options.json
                       ? io::to_text(explanation_json(explanation))
                       : explanation_text(explanation) + plant_line(instance, explanation) +
                             better_lines(instance, explanation) + (no ? "" : held_line(instance)));
  if (!explanation.finished) {
    say("not finished: what is undecided or missing here was not examined to its end\n");
    return ExitCode::undecided;
  }
  // Other values of what synth searches may have gains.
  if (no && !explanation.held.empty()) return ExitCode::undecided;
  return exit_of(explanation.gains.verdict);
}

}  // namespace

Command explain_command() {
  auto options = std::make_shared<ExplainOptions>();
  return {
      "explain",
      "Say why a problem has no solution, or why it has no better one",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       set_option(options->set),
       Option("--effort", options->effort,
              "what double does not decide: ordinary (an allowance of work) or full (any)")
           .one_of({"ordinary", "full"}),
       Option("--json", options->json, "print as JSON")},
      "The problem is taken at its own values: what synth searches is held, and a no at these\n"
      "values is undecided.\n"
      "Of a problem with gains it says what limits the optimum: what each requirement, each bound\n"
      "and each scalar costs, and how far the scalars under 'negotiable' go.\n"
      "Exit code: 0 feasible, 1 infeasible, 2 wrong input, 3 undecided.\n"
      "Examples:\n"
      "  gainsmith explain problems/ferrante-seuret-2021/published-theorem.yaml\n"
      "  gainsmith explain problem.yaml --json | jq .conflict.requirements",
      [options] { return explain(*options); }};
}

}  // namespace gainsmith::app
