#include "properties/judge.h"

#include <algorithm>
#include <chrono>
#include <exception>

#include "base/number.h"
#include "design/synthesize.h"
#include "support/yaml_problem.h"

namespace gainsmith::tests::properties {

Answer judge(const Case& known) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Answer answer;
  try {
    const YamlProblem yaml(known.text);
    const model::Gains found = design::synthesize(yaml.instance, {});
    const bool yes = found.verdict == model::Verdict::yes;
    if (found.verdict == model::Verdict::undecided)
      answer.outcome = Outcome::undecided;
    else if (yes != known.yes)
      answer.outcome = Outcome::wrong;
    answer.message = std::string(yes                                   ? "yes"
                                 : found.verdict == model::Verdict::no ? "no"
                                                                       : "undecided") +
                     ": " + found.solver.message;
  } catch (const std::exception& error) {
    answer = {Outcome::wrong, std::string("error: ") + error.what(), 0};
  }
  answer.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return answer;
}

std::string record(const Case& known, const Answer& answer) {
  std::string message = answer.message;
  std::replace(message.begin(), message.end(), '\n', ' ');
  return "# said " + message + " (" + brief(answer.seconds, 2) + " s)\n" + known.text;
}

}  // namespace gainsmith::tests::properties
