#include "design/synthesize.h"

#include <algorithm>
#include <chrono>

#include "base/version.h"
#include "design/exchange.h"
#include "design/gain_values.h"
#include "design/ladder.h"

namespace gainsmith::design {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// InputError when x = 0 satisfies everything because nothing is strict and nothing is constant.
void refuse_zero_solution(const model::Design& design, const lmi::Lmi& lmi) {
  const bool strict = std::any_of(lmi.blocks.begin(), lmi.blocks.end(),
                                  [](const lmi::Block& block) { return block.strict; });
  if (strict || !lmi::is_homogeneous(lmi.blocks)) return;
  throw InputError(design.inequalities.front().place,
                   "every inequality is <= or >= without constant data, so 0 is a solution; make "
                   "one strict (<, >)");
}

/// What a result states before anything is solved.
model::Gains stated(const model::Instance& instance) {
  model::Gains gains;
  gains.problem_name = instance.design->name;
  gains.version = kVersion;
  gains.statement = instance.design->statement;
  gains.searched = instance.overrides;
  for (const model::Design::Datum& parameter : instance.design->parameters)
    gains.parameters.emplace_back(parameter.name, instance.values.at(parameter.name));
  return gains;
}

void add_message(model::Gains& gains, const std::string& text) {
  std::string& message = gains.solver.message;
  message += (message.empty() ? "" : "; ") + text;
}

/// What the verdict rests on where an inequality holds for all values of a variable.
void report_ways(const forall::Plan& plan, int rounds, bool searched, model::Gains& gains) {
  if (plan.uses_exchange()) {
    std::string text = "exchange: " + std::to_string(plan.points()) + " points in " +
                       std::to_string(rounds) + (rounds == 1 ? " round" : " rounds");
    if (gains.verdict == model::Verdict::yes)
      text += !searched ? ", bounded between them" : ", searched between them";
    add_message(gains, text);
  }
  const bool exact = std::all_of(plan.inequalities.begin(), plan.inequalities.end(),
                                 [](const forall::Imposed& imposed) { return imposed.exact; });
  if (gains.verdict != model::Verdict::no || exact) return;
  gains.certificate->about = plan.uses_vertex_gains() ? "vertices" : "hull";
  add_message(gains, plan.uses_vertex_gains()
                         ? "the certificate is about the test at the vertices of the box, which is "
                           "only sufficient; the way exchange with a polynomial may still find a "
                           "solution"
                         : "the certificate is about the hull, which is larger than what the "
                           "variables reach; the way exchange or more slices may still find a "
                           "solution");
}

/// Gains whose formulas use nothing but data are known in any case, the others when the verdict is
/// yes.
void add_gains(const lmi::Inequalities& inequalities, model::Gains& gains) {
  numbers::Values values = inequalities.instance.values;
  if (gains.verdict == model::Verdict::yes)
    for (const auto& [name, matrix] : gains.unknowns) values[name] = matrix;
  for (const model::Function& function : inequalities.functions)
    gains.functions.push_back({function.signature(), function.text(), function.body().program});
  add_gain_values(inequalities, values, gains);
  add_report(inequalities.instance, gains);
}

/// A certificate excludes solutions with entries below 1/residual in size: only far beyond what can
/// be built does that count as infeasible.
sdp::Options with_sharp_certificates(sdp::Options options) {
  constexpr double kCertificateResidual = 1e-12;
  options.certificate_tolerance = std::min(options.certificate_tolerance, kCertificateResidual);
  return options;
}

}  // namespace

model::Gains synthesize(const model::Instance& instance, const sdp::Options& options) {
  constexpr int kMostRounds = 60;
  const auto start = Clock::now();
  const lmi::Inequalities inequalities(instance);
  forall::Plan plan = forall::make_plan(inequalities.design());
  lmi::Lmi lmi = lmi::compile(inequalities, plan);
  const auto bounds = lmi::gain_bounds(inequalities, inequalities.design().synthesis.gain_bound);
  model::Gains gains = stated(instance);
  refuse_zero_solution(inequalities.design(), lmi);
  const sdp::Options solver = with_sharp_certificates(options);
  double compile_seconds = seconds_since(start);
  double solve_seconds = 0;
  for (int round = 1;; ++round) {
    Climb climb({inequalities, plan, lmi}, bounds,
                [&](const sdp::Problem& problem) { return sdp::solve(problem, solver); });
    climb.to_answer();
    if (climb.own().point && round < kMostRounds && grow(plan, inequalities, lmi, climb.own())) {
      solve_seconds += climb.seconds();
      gains.margins = climb.own().margins.margins;
      const auto again = Clock::now();
      lmi = lmi::compile(inequalities, plan);
      compile_seconds += seconds_since(again);
      continue;
    }
    climb.from_point();
    solve_seconds += climb.seconds();
    conclude(climb, gains);
    const Attempt* point = climb.point();
    report_ways(plan, round, point != nullptr && point->margins.searched, gains);
    break;
  }
  add_gains(inequalities, gains);
  gains.timings = {
      {"compile", compile_seconds}, {"solve", solve_seconds}, {"total", seconds_since(start)}};
  return gains;
}

model::Gains synthesize_at(const model::DesignPtr& design, const model::Overrides& overrides,
                           const sdp::Options& options) {
  return synthesize(model::evaluate(design, overrides), options);
}

sdp::Problem semidefinite_program(const model::Instance& instance) {
  const lmi::Inequalities inequalities(instance);
  const model::SynthesisOptions& choices = inequalities.design().synthesis;
  const lmi::Lmi lmi = lmi::compile(inequalities);
  const lmi::GainBounds bounds = lmi::gain_bounds(inequalities, choices.gain_bound);
  return lmi::formulate(lmi, bounds, choices, lmi::goal_of(lmi, bounds)).problem;
}

}  // namespace gainsmith::design
