#include "design/synthesize.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

#include "base/number.h"
#include "base/version.h"
#include "design/gain_values.h"
#include "lmi/centres.h"
#include "lmi/formulation.h"
#include "lmi/margins.h"
#include "lmi/vertex_gains.h"

namespace gainsmith::design {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

model::SolverRecord record_of(const sdp::Solution& solution) {
  model::SolverRecord record;
  const bool infeasible = solution.status == sdp::Status::primal_infeasible;
  record.status = infeasible                                ? "infeasible"
                  : solution.status == sdp::Status::optimal ? "optimal"
                                                            : "undecided";
  record.cause = to_string(solution.cause);
  record.message = solution.message;
  record.iterations = solution.iterations;
  record.relative_gap = solution.relative_gap;
  record.primal_infeasibility = solution.dimacs[2];
  record.dual_infeasibility = solution.dimacs[0];
  record.precision = solution.precision;
  return record;
}

/// One synthesis: the steps in the order in which they are taken.
class Synthesis {
 public:
  Synthesis(const model::Instance& instance, const sdp::Options& options)
      : instance_(lmi::with_vertex_gains(instance)),
        options_(options),
        choices_(instance.problem->synthesis),
        plan_(lmi::make_plan(instance_)),
        lmi_(lmi::compile(instance_, plan_)) {
    bounds_ = lmi::gain_bounds(instance_, lmi_.unknowns, choices_.gain_bound);
    gains_.problem_name = instance.problem->name;
    gains_.version = kVersion;
    gains_.statement = model::statement_of(*instance.problem);
    gains_.searched = instance.overrides;
    for (const auto& parameter : instance.method->parameters)
      gains_.parameters.emplace_back(parameter.name, instance.parameters.at(parameter.name));
    refuse_zero_solution();
    options_.certificate_tolerance = std::min(options_.certificate_tolerance, kCertificateResidual);
    compile_seconds_ = seconds_since(start_);
  }

  model::Gains run() {
    constexpr int kMostRounds = 60;
    for (round_ = 1;; ++round_) {
      may_grow_ = round_ < kMostRounds;
      if (solve_and_judge() == Outcome::decided) break;
      const auto start = Clock::now();
      lmi_ = lmi::compile(instance_, plan_);
      compile_seconds_ += seconds_since(start);
    }
    report_ways();
    add_gains();
    gains_.timings = {
        {"compile", compile_seconds_}, {"solve", solve_seconds_}, {"total", seconds_since(start_)}};
    return std::move(gains_);
  }

 private:
  enum class Outcome { decided, more_points };

  Outcome solve_and_judge() {
    solve(lmi::goal_of(lmi_, bounds_));
    if (solution_.status == sdp::Status::optimal) return accept_point();
    if (solution_.status == sdp::Status::primal_infeasible) {
      decide_infeasible(formulation_.goal);
    } else if (solution_.status == sdp::Status::dual_infeasible) {
      gains_.solver.status = "undecided";
      gains_.solver.message =
          "the objective is unbounded below: some direction of the unknowns lowers it without end";
    }
    return Outcome::decided;
  }

  /// Adds the worst points at which the solution fails to the exchanges, and those where their
  /// points draw together; false when there is none.
  bool grow(const std::vector<lmi::Violation>& violations) {
    constexpr std::size_t kMostAtOnce = 24;  // the worst come first
    std::map<std::size_t, std::vector<lmi::Point>> fresh;
    for (const lmi::Violation& violation : violations)
      if (plan_.requirements[violation.requirement].way == model::Way::exchange &&
          fresh[violation.requirement].size() < kMostAtOnce)
        fresh[violation.requirement].push_back(violation.point);
    bool grown = false;
    for (auto& [k, points] : fresh) {
      const model::Requirement& requirement = instance_.method->require[k];
      const auto domain = lmi::domain_of(instance_, requirement);
      lmi::Imposed& imposed = plan_.requirements[k];
      const auto sizes = lmi::multiplier_sizes(lmi_, formulation_, solution_, requirement.name,
                                               imposed.points.size());
      for (lmi::Point& centre : lmi::centres(imposed, domain, sizes))
        points.push_back(std::move(centre));
      for (const lmi::Point& point : points) grown |= lmi::add_point(imposed, domain, point);
    }
    return grown;
  }

  void add_message(const std::string& text) {
    std::string& message = gains_.solver.message;
    message += (message.empty() ? "" : "; ") + text;
  }

  /// What the verdict rests on where an inequality holds for all values of a variable.
  void report_ways() {
    if (plan_.uses_exchange()) {
      std::string text = "exchange: " + std::to_string(plan_.points()) + " points in " +
                         std::to_string(round_) + (round_ == 1 ? " round" : " rounds");
      if (gains_.verdict == model::Verdict::yes)
        text += !searched_ ? ", proved between them" : ", searched between them";
      add_message(text);
    }
    const bool exact = std::all_of(plan_.requirements.begin(), plan_.requirements.end(),
                                   [](const lmi::Imposed& imposed) { return imposed.exact; });
    if (gains_.verdict != model::Verdict::no || exact) return;
    gains_.certificate->about = plan_.uses_vertex_gains() ? "vertices" : "hull";
    add_message(plan_.uses_vertex_gains()
                    ? "the certificate is about the test at the vertices of the box, which is only "
                      "sufficient; the way exchange with a polynomial may still find a solution"
                    : "the certificate is about the hull, which is larger than what the variables "
                      "reach; the way exchange or more slices may still find a solution");
  }

  /// A certificate excludes solutions with entries below 1/residual in size: only far beyond what
  /// can be built does that count as infeasible.
  static constexpr double kCertificateResidual = 1e-12;

  /// InputError when x = 0 satisfies everything because nothing is strict and nothing is constant.
  void refuse_zero_solution() const {
    const bool strict = std::any_of(lmi_.blocks.begin(), lmi_.blocks.end(),
                                    [](const lmi::Block& block) { return block.strict; });
    if (strict || !lmi::is_homogeneous(lmi_.blocks)) return;
    const model::Requirement& first = instance_.method->require.front();
    throw InputError(first.place,
                     "every inequality is <= or >= without constant data, so 0 is a solution; make "
                     "one strict (<, >)");
  }

  /// The gain bounds must not decide: without them either there is a certificate too, or that is
  /// said.
  void decide_infeasible(lmi::Goal goal) {
    if (goal == lmi::Goal::feasibility) {
      // Its certificate may rest on the limits on x.
      solve(lmi::Goal::certificate);
      if (solution_.status == sdp::Status::primal_infeasible)
        return decide_infeasible(lmi::Goal::certificate);
      gains_.solver.status = "undecided";
      gains_.solver.message = "solutions, if any, are far larger than the data suggest";
      return;
    }
    if (bounds_.list.empty()) return accept_certificate();
    const lmi::GainBounds bounds = std::exchange(bounds_, {});
    const lmi::Formulation formulation = formulation_;
    const sdp::Solution solution = solution_;
    const model::SolverRecord record = gains_.solver;
    solve(goal);
    if (solution_.status == sdp::Status::primal_infeasible) return accept_certificate();
    bounds_ = bounds;
    formulation_ = formulation;
    solution_ = solution;
    gains_.solver = record;
    accept_certificate();
    gains_.solver.message = "no gains within the gain bound " + brief(bounds_.beta) +
                            ": the certificate needs it; raise synthesis.gain_bound";
  }

  void solve(lmi::Goal goal, double backoff = 0) {
    const auto start = Clock::now();
    formulation_ = lmi::formulate(lmi_, bounds_, choices_, goal, backoff);
    solution_ = sdp::solve(formulation_.problem, options_);
    gains_.solver = record_of(solution_);
    solve_seconds_ += seconds_since(start);
  }

  Outcome accept_point() {
    const bool has_margin_variable = formulation_.goal == lmi::Goal::feasibility;
    if (has_margin_variable && solution_.x.back() < choices_.margin) {
      const double largest_margin = solution_.x.back();
      solve(lmi::Goal::certificate);
      if (solution_.status == sdp::Status::primal_infeasible) {
        decide_infeasible(lmi::Goal::certificate);
        return Outcome::decided;
      }
      gains_.solver.status = "undecided";
      gains_.solver.message =
          "the largest margin is " + brief(largest_margin) + ", below the one asked for";
      return Outcome::decided;
    }
    const auto violations = read_margins();
    if (may_grow_ && grow(violations)) return Outcome::more_points;
    if (const double short_by = shortfall(); short_by > 0) {
      constexpr double kSafety = 4;
      const sdp::Solution first = solution_;
      const lmi::Formulation first_formulation = formulation_;
      solve(formulation_.goal, kSafety * short_by);
      if (solution_.status != sdp::Status::optimal) {
        solution_ = first;
        formulation_ = first_formulation;
      }
      gains_.solver = record_of(solution_);
      read_margins();
    }
    for (const auto& unknown : lmi_.unknowns.list())
      gains_.unknowns.emplace_back(unknown.name, lmi_.unknowns.values(x_).at(unknown.name));
    gains_.bounds = lmi::reached_bounds(bounds_, x_);
    set_objective();
    decide();
    find_free_gains();
    return Outcome::decided;
  }

  /// A gain that the objective does not determine is limited by its bound alone, wherever between
  /// them the solver stops: with a bound ten times smaller the objective stays and the gain
  /// shrinks.
  void find_free_gains() {
    constexpr double kNear = 0.01;  // of the bound; a gain far below it is not limited by it
    constexpr double kTighter = 0.1;
    constexpr double kSameObjective = 1e-6;
    constexpr double kShrunk = 0.5;
    const bool near =
        std::any_of(gains_.bounds.begin(), gains_.bounds.end(), [&](const model::GainBound& bound) {
          return !bound.active && bound.reached > kNear * bound.bound;
        });
    if (!near || !gains_.objective || gains_.verdict != model::Verdict::yes) return;
    const auto start = Clock::now();
    const auto tighter = lmi::gain_bounds(instance_, lmi_.unknowns, kTighter * bounds_.beta);
    const auto formulation = lmi::formulate(lmi_, tighter, choices_, formulation_.goal);
    const sdp::Solution solution = sdp::solve(formulation.problem, options_);
    solve_seconds_ += seconds_since(start);
    if (solution.status != sdp::Status::optimal) return;
    const auto x = lmi::read_back(lmi_, formulation, solution);
    if (std::abs(objective_at(x) - *gains_.objective) >
        kSameObjective * std::abs(*gains_.objective))
      return;
    const auto reached = lmi::reached_bounds(tighter, x);
    for (std::size_t i = 0; i < reached.size(); ++i)
      gains_.bounds[i].active |= gains_.bounds[i].reached > kNear * bounds_.beta &&
                                 reached[i].reached < kShrunk * gains_.bounds[i].reached;
  }

  double objective_at(const std::vector<double>& x) const {
    double objective = lmi_.objective_constant;
    for (std::size_t i = 0; i < x.size(); ++i) objective += lmi_.objective[i] * x[i];
    return objective;
  }

  std::vector<lmi::Violation> read_margins() {
    x_ = lmi::read_back(lmi_, formulation_, solution_);
    lmi::Check check = lmi::check_margins(instance_, lmi_, plan_, formulation_.scales,
                                          formulation_.homogeneous(), choices_.margin, x_);
    gains_.margins = std::move(check.margins);
    open_ = std::move(check.open);
    searched_ = check.searched;
    return std::move(check.violations);
  }

  /// How much the worst inequality is short of its margin, relative to its scale, when that is no
  /// more than the solver's tolerance explains; 0 when none is, or when it is worse than that.
  double shortfall() const {
    constexpr double kExplained = 1e-6;
    double worst = 0;
    for (const model::Margin& margin : gains_.margins)
      if (!lmi::is_kept(margin))
        worst = std::max(worst, (margin.strict ? margin.required : 0.0) - margin.reached);
    return worst < kExplained ? worst : 0;
  }

  void set_objective() {
    if (!lmi_.has_objective) return;
    gains_.objective = objective_at(x_);
    if (formulation_.goal == lmi::Goal::bounded_objective)
      // The dual solution is feasible to the solver's tolerance only.
      gains_.objective_lower_bound =
          std::min(*gains_.objective, lmi::objective_lower_bound(lmi_, formulation_, solution_));
  }

  /// Whether what fails is short of its margin only, in a problem whose solutions have any size.
  bool needs_less_margin() const {
    return formulation_.homogeneous() &&
           std::all_of(gains_.margins.begin(), gains_.margins.end(), [](const auto& margin) {
             return lmi::is_kept(margin) || margin.reached > 0;
           });
  }

  /// The verdict comes from the margins as recomputed, never from the solver's word alone.
  void decide() {
    std::string failed;
    for (const model::Margin& margin : gains_.margins) {
      if (!lmi::is_kept(margin))
        failed += (failed.empty() ? "" : "; ") + margin.name + ": margin " + brief(margin.reached) +
                  ", asked for " + brief(margin.required);
    }
    const bool settled = failed.empty() && open_.empty();
    gains_.verdict = settled ? model::Verdict::yes : model::Verdict::undecided;
    if (settled) return;
    gains_.solver.status = "undecided";
    gains_.solver.message =
        failed.empty() ? "the solver converged, but for all values " + open_
                       : "the solver converged, but recomputed from the written decimals " + failed;
    if (!failed.empty() && needs_less_margin())
      add_message("a smaller synthesis.margin, or P > I instead of P > 0, may do");
  }

  void accept_certificate() {
    gains_.verdict = model::Verdict::no;
    const sdp::Certificate& certificate = solution_.certificate;
    gains_.certificate = model::CertificateRecord{
        certificate.value,          certificate.residual,
        certificate.min_eigenvalue, formulation_.unit * certificate.excluded_radius,
        certificate.checked,        lmi::multipliers(lmi_, bounds_, formulation_, solution_)};
  }

  /// Gains whose formulas use nothing but data are known in any case, the others when the verdict
  /// is yes.
  void add_gains() {
    numbers::Values values = instance_.known_values();
    if (gains_.verdict == model::Verdict::yes)
      for (const auto& [name, matrix] : gains_.unknowns) values[name] = matrix;
    for (const model::UnknownFunction& function : instance_.functions)
      gains_.functions.emplace_back(function.signature(), function.text);
    add_gain_values(instance_, values, gains_);
    add_report(instance_, gains_);
  }

  Clock::time_point start_ = Clock::now();
  const model::Instance instance_;
  sdp::Options options_;
  const model::SynthesisOptions& choices_;
  lmi::Plan plan_;
  lmi::Lmi lmi_;
  lmi::GainBounds bounds_;
  int round_ = 1;
  bool may_grow_ = true;
  lmi::Formulation formulation_;
  sdp::Solution solution_;
  std::vector<double> x_;
  std::string open_;  ///< see lmi::Check
  bool searched_ = false;
  model::Gains gains_;
  double compile_seconds_ = 0;
  double solve_seconds_ = 0;
};

}  // namespace

model::Gains synthesize(const model::Instance& instance, const sdp::Options& options) {
  return Synthesis(instance, options).run();
}

sdp::Problem semidefinite_program(const model::Instance& stated) {
  const model::Instance instance = lmi::with_vertex_gains(stated);
  const model::SynthesisOptions& choices = instance.problem->synthesis;
  const lmi::Lmi lmi = lmi::compile(instance);
  const lmi::GainBounds bounds = lmi::gain_bounds(instance, lmi.unknowns, choices.gain_bound);
  return lmi::formulate(lmi, bounds, choices, lmi::goal_of(lmi, bounds)).problem;
}

}  // namespace gainsmith::design
