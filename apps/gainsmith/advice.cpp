#include "gainsmith/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "base/number.h"
#include "design/hautus.h"
#include "design/search_request.h"
#include "expr/program/program.h"
#include "model/stated_file.h"

namespace gainsmith::app {

namespace {

/// The name, where a formula is nothing but a scalar of the problem.
std::optional<std::string> scalar_of(const model::Formula& formula,
                                     const model::Instance& instance) {
  const expr::Program& program = formula.program;
  if (program.code.size() != 1 || program.code[0].op != expr::Op::input) return std::nullopt;
  const std::string& name = program.inputs[0].name;
  const auto value = instance.values.find(name);
  if (value == instance.values.end() || value->second.size() != 1) return std::nullopt;
  return name;
}

/// Whether an inequality holds the scalar, and not only its domain.
bool is_compared(const model::Design& design, const std::string& scalar) {
  return std::any_of(
      design.inequalities.begin(), design.inequalities.end(), [&](const auto& inequality) {
        return std::any_of(inequality.comparisons.begin(), inequality.comparisons.end(),
                           [&](const auto& each) { return each.difference.uses(scalar); });
      });
}

}  // namespace

std::vector<std::string> next_commands(const model::Instance& instance, const model::Gains& gains,
                                       const std::string& file) {
  constexpr double kShortest = 0.01;  // of an interval that begins at no scalar
  std::vector<std::string> commands;
  const std::string problem = model::problem_words(file, instance.design->statement.settings);
  if (gains.verdict == model::Verdict::yes) return commands;
  if (gains.verdict == model::Verdict::undecided && gains.solver.out_of_allowance)
    commands.push_back("gainsmith synth " + problem + " --effort full");
  // Each attempt at an undecided problem takes as long as the first.
  if (gains.verdict == model::Verdict::undecided)
    commands.push_back("gainsmith explain " + problem + " --time 60");
  if (gains.bound_only)
    commands.push_back("gainsmith bisect " + problem + " --smallest gain_bound");
  // What the output does not show no interval shows.
  if (!design::hidden_mode_text(instance).empty()) return commands;
  if (gains.verdict == model::Verdict::no) commands.push_back("gainsmith explain " + problem);
  std::set<std::string> ends;
  for (const model::Design::Inequality& inequality : instance.design->inequalities)
    for (const auto& variable : inequality.domain) {
      if (variable.over != model::Over::interval) continue;
      const auto end = scalar_of(variable.points[1], instance);
      if (!end || !ends.insert(*end).second) continue;
      // Of an input between -limit and limit a larger limit is no harder.
      if (variable.points[0].program.uses(*end) && is_compared(*instance.design, *end)) continue;
      const double high = instance.values.at(*end)(0, 0);
      const auto begin = scalar_of(variable.points[0], instance);
      const double low = begin ? instance.values.at(*begin)(0, 0) : kShortest * high;
      if (!(0 < low && low < high)) continue;
      const std::string from = model::printed(low);
      const std::string to = model::printed(high);
      commands.push_back(gains.search ? fmt::format("gainsmith optimize {} --largest {}={}:{}",
                                                    problem, *end, from, to)
                                      : fmt::format("gainsmith bisect {} --largest {} --in {} {}",
                                                    problem, *end, from, to));
    }
  return commands;
}

std::string advice(const model::Instance& instance, const model::Gains& gains,
                   const std::string& file) {
  std::string text;
  for (const std::string& command : next_commands(instance, gains, file))
    text += fmt::format("{:<12}{}\n", text.empty() ? "try" : "", command);
  return text;
}

std::string hidden_line(const model::Instance& instance) {
  const std::string hidden = design::hidden_mode_text(instance);
  return hidden.empty() ? "" : fmt::format("{:<12}{}\n", "plant", hidden);
}

std::string held_line(const model::Instance& instance, const std::vector<std::string>& varied) {
  const std::string held = design::held_text(design::held_scalars(instance, varied));
  if (held.empty()) return "";
  return fmt::format("{:<12}{}; synth and optimize search what this keeps\n", "held", held);
}

}  // namespace gainsmith::app
