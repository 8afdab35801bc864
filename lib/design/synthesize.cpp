#include "design/synthesize.h"
#include "design/convexity.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "base/number.h"
#include "base/stop.h"
#include "base/version.h"
#include "bind/instance.h"
#include "design/attempts.h"
#include "design/elastic.h"
#include "design/exchange.h"
#include "design/gain_values.h"
#include "design/hautus.h"
#include "design/limits.h"
#include "design/quotient.h"
#include "design/sos_statements.h"
#include "design/sums_of_squares.h"
#include "forall/faults.h"
#include "numbers/dense/dense.h"

namespace gainsmith::design {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// InputError when x = 0 satisfies everything because nothing is strict and nothing is constant.
void refuse_zero_solution(const model::Design& design, const lmi::Lmi& lmi) {
  const bool strict = std::ranges::any_of(lmi.blocks, &lmi::Block::strict);
  // Between the points of a domain there may be constant parts that are 0 at these points.
  const bool has_domains = std::any_of(design.inequalities.begin(), design.inequalities.end(),
                                       [](const auto& one) { return !one.domain.empty(); });
  if (has_domains || strict || !lmi::is_homogeneous(lmi.blocks)) return;
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
  for (const model::Design::Datum& datum : instance.design->data)
    if (datum.chosen) gains.bases.emplace_back(datum.name, instance.values.at(datum.name));
  return gains;
}

/// A certificate of the very inequalities that is not sharp enough to say no.
std::string blunt_text(double backward_error, bool to_the_end) {
  return std::string("a certificate in double speaks against any solution, ") +
         (to_the_end ? "but more digits do not confirm it"
                     : "and whether more digits confirm it is open") +
         ": solutions, if any, do not survive a relative change of " + brief(backward_error, 2) +
         " of the coefficients";
}

/// What the verdict rests on where an inequality holds for all values of a variable.
void report_plans(const forall::Plan& plan, int rounds, model::Gains& gains) {
  if (plan.uses_exchange()) {
    std::string text = "exchange: " + std::to_string(plan.points()) + " points in " +
                       std::to_string(rounds) + (rounds == 1 ? " round" : " rounds");
    if (gains.verdict == model::Verdict::yes) text += ", checked between them";
    gains.solver.add_message(text);
  }
  if (!gains.certificate || gains.certificate->is_about_problem()) return;
  const bool exact = std::ranges::all_of(plan.inequalities, &forall::Imposed::exact);
  if (exact) {
    gains.solver.add_message(
        blunt_text(gains.certificate->backward_error, !gains.solver.out_of_allowance));
    gains.certificate.reset();
    return;
  }
  gains.certificate->about = plan.uses_vertex_gains() ? "vertices" : "hull";
  gains.solver.add_message(
      plan.uses_vertex_gains()
          ? "no solution of the test at the vertices of the box, which is only "
            "sufficient; synthesis.forall: exchange with a polynomial may find one"
          : "no solution for the hull, which is larger than what the variables reach; "
            "synthesis.forall: exchange, or more synthesis.slices, may find one");
}

/// `doing`: what the stop ended; empty before the first program.
void note_stop(const std::string& doing, int iterations, model::Gains& gains) {
  if (gains.verdict == model::Verdict::undecided) gains.solver.status = "undecided";
  gains.solver.cause = to_string(sdp::Cause::interrupted);
  gains.solver.iterations = iterations;
  gains.solver.add_message(doing.empty() ? "stopped before anything was solved"
                                         : "stopped while searching for " + doing);
}

verdict::CheckOptions check_options(Depth depth) {
  // Of one check over a domain (forall/proof.h).
  constexpr std::size_t kQuickPieces = 1000;
  verdict::CheckOptions check;
  check.describe = depth != Depth::verdict;
  if (depth == Depth::quick) check.most_pieces = kQuickPieces;
  return check;
}

/// Names the gains that are larger than a bound that the problem states: a bound is imposed on
/// products with an inverse, and only where these are affine otherwise.
void note_larger_gains(const model::Design& design, const model::SynthesisOptions& asked,
                       model::Gains& gains) {
  if (!asked.gain_bound_stated || !asked.gain_bound) return;
  std::string larger;
  for (const auto& [name, gain] : gains.gains) {
    const auto share = asked.share_of_bound(name);
    if (!share || gain.size() == 0) continue;
    const double norm = numbers::singular_values(gain)[0];
    if (norm > *share * *asked.gain_bound)
      larger += (larger.empty() ? "" : ", ") + name + " has the norm " + brief(norm, 3);
  }
  if (larger.empty()) return;
  const std::vector<std::string> used = scalars_in_use(design);
  std::string parameters;
  for (const model::Design::Datum& parameter : design.parameters)
    if (std::find(used.begin(), used.end(), parameter.name) != used.end())
      parameters += (parameters.empty() ? "" : ", ") + parameter.name;
  gains.solver.add_message(
      "the gain bound " + brief(*asked.gain_bound) + " is not kept: " + larger +
      ", and no condition imposes it on all of such a formula" +
      (parameters.empty() ? "" : "; a parameter of the inequalities may: " + parameters));
}

/// Gains whose formulas use nothing but data are known in any case, the others when the verdict is
/// yes.
void add_gains(const lmi::Inequalities& inequalities, model::Gains& gains) {
  numbers::Values values = inequalities.instance.values;
  if (gains.verdict == model::Verdict::yes)
    for (const auto& [name, matrix] : gains.unknowns) values[name] = matrix;
  for (const model::Function& function : inequalities.functions)
    gains.functions.push_back({function.signature(), function.text(), function.body().program});
  for (const auto& [signature, text] : inequalities.design().polynomials)
    gains.functions.push_back({signature, text, std::nullopt});
  try {
    add_gain_values(inequalities, values, gains);
    note_larger_gains(inequalities.design(), inequalities.design().synthesis, gains);
    add_report(inequalities.instance, gains);
  } catch (const expr::EvaluationError& error) {
    // A point that holds and whose gains have no value in double is of no use.
    if (gains.verdict != model::Verdict::yes) throw;
    gains.verdict = model::Verdict::undecided;
    gains.gains.clear();
    gains.gain_functions.clear();
    gains.report.clear();
    gains.solver.add_message("every inequality holds, but " + std::string(error.what()));
  }
}

/// One synthesis: attempts on a plan of points, which grows.
class Synthesis {
 public:
  Synthesis(const model::Instance& instance, const sdp::Options& options, Depth depth)
      : inequalities_(instance), options_(options), depth_(depth) {}

  /// What is known, also when it was stopped.
  /// Rounds of attempts until the plan grows no more, then the verdict, gains and reasons.
  model::Gains run() {
    model::Gains gains = stated(inequalities_.instance);
    bool stopped = false;
    try {
      prepare();
      while (tries_again()) ++round_;
    } catch (const Stopped&) {
      stopped = true;
    } catch (const expr::EvaluationError&) {
      if (const auto fault = fault_in_a_domain())
        throw InputError(fault->place, fault->message + " at " + fault->point.label);
      throw;
    }
    const Concluding concluding;
    if (attempts_ && attempts_->has_begun()) {
      conclude(*attempts_, stopped || depth_ != Depth::thorough ? ExcludesObjective() : excludes(),
               gains);
      report_plans(plan_, round_, gains);
    }
    // A point inside, where a minimum was asked for, is not all that was to come.
    if (stopped &&
        (gains.verdict == model::Verdict::undecided || gains.solver.status == "feasible"))
      note_stop(attempts_ ? attempts_->doing() : "", iterations_, gains);
    add_gains(inequalities_, gains);
    if (gains.verdict != model::Verdict::yes) note_causes(gains);
    gains.timings = {
        {"compile", compile_seconds_}, {"solve", solve_seconds_}, {"total", seconds_since(start_)}};
    return gains;
  }

 private:
  /// The plan of points, the blocks at these points and the bounds on gains.
  void prepare() {
    plan_ = forall::make_plan(inequalities_.design());
    lmi_ = lmi::compile(inequalities_, plan_);
    bounds_ = lmi::gain_bounds(inequalities_, lmi_);
    refuse_zero_solution(inequalities_.design(), lmi_);
    compile_seconds_ = seconds_since(start_);
  }

  /// Where an inequality has no value on its domain.
  /// A search (forall/faults.h): none found does not say that there is none.
  std::optional<forall::Fault> fault_in_a_domain() const {
    for (const lmi::Statement& statement : inequalities_.statements)
      for (const expr::Program& difference : statement.differences)
        if (auto fault =
                forall::find_fault(difference, statement.domain, inequalities_.instance.values))
          return fault;
    return std::nullopt;
  }

  /// What keeps any gains from being found, where it can be detected.
  void note_causes(model::Gains& gains) const {
    std::string hidden = hidden_mode_text(inequalities_.instance);
    std::optional<forall::Fault> fault;
    try {
      if (depth_ == Depth::thorough) fault = fault_in_a_domain();
      for (const lmi::Statement& statement : inequalities_.statements)
        if (depth_ == Depth::thorough && !fault && hidden.empty())
          hidden = hidden_mode_text(inequalities_.instance, statement.domain);
    } catch (const Stopped&) {
    }
    if (!hidden.empty()) gains.solver.add_message(hidden);
    if (fault)
      gains.solver.add_message("an inequality has no value at " + fault->point.label + ": " +
                               to_string(fault->place) + ": " + fault->message);
  }

  /// A certificate against the inequalities with c'x <= value beside them.
  ExcludesObjective excludes() const {
    return [this](double value) -> std::optional<model::CertificateRecord> {
      const Concluding stops_at_once(0);
      try {
        const auto found = synthesize(with_objective_below(inequalities_.instance, value), options_,
                                      Depth::verdict);
        if (found.verdict == model::Verdict::no && found.certificate->is_about_problem())
          return found.certificate;
      } catch (const Stopped&) {
      }
      return std::nullopt;
    };
  }

  /// All attempts on the plan; whether it has grown by what they showed.
  bool tries_again() {
    attempts_.emplace(
        Posed{inequalities_, plan_, lmi_, depth_ != Depth::quick, check_options(depth_)}, bounds_,
        [this](const auto&... asked) { return solve(asked...); });
    attempts_->to_point();
    // After so many rounds the points of an exchange draw together, and a point near the minimum
    // may end it.
    constexpr int kDrawsOn = 6;  // rounds after which an exchange does
    if (round_ >= kDrawsOn) {
      attempts_->to_near_minimum(std::move(inside_));
      inside_ = attempts_->inside();
    }
    bool again = grown();
    if (!again) {
      attempts_->to_end();
      again = grown();
    }
    const Attempt* point = attempts_->point();
    // Neither yes nor no.
    const bool undecided =
        attempts_->refutation() == nullptr && (point == nullptr || !point->holds());
    // What the hull's own expansion of the functions rounded away shows at points.
    if (!again && undecided) again = plan_.leave_hulls(inequalities_.design());
    solve_seconds_ += attempts_->seconds();
    if (!again) return false;
    attempts_.reset();
    const auto compiling = Clock::now();
    lmi_ = lmi::compile(inequalities_, plan_);
    compile_seconds_ += seconds_since(compiling);
    return true;
  }

  /// Whether an exchange has new points: those where the best point so far fails.
  bool grown() {
    // Rounds of an exchange.
    constexpr int kMostRounds = 60;
    const Attempt* point = attempts_->point();
    if (point == nullptr || point->holds() || attempts_->refutation() != nullptr ||
        round_ >= kMostRounds)
      return false;
    // What a minimum violates may be too little to be told; a point inside leads to one near it.
    const bool by_point = grown_by(point),
               by_inside = grown_by(attempts_->find(AttemptKind::inside));
    return by_point || by_inside;
  }

  bool grown_by(const Attempt* attempt) {
    return attempt != nullptr && attempt->point && !is_out_of_reach(*attempt) &&
           grow(plan_, inequalities_, lmi_, *attempt);
  }

  /// The solver with the caller's options, or the stricter tolerances of an effort.
  sdp::Solution solve(const sdp::Problem& problem, const Effort& effort) {
    sdp::Options solver = options_;
    if (effort.precision != "auto") solver.precision = effort.precision;
    solver.certificate_tolerance =
        std::min(solver.certificate_tolerance, effort.certificate_tolerance);
    solver.tolerance = std::min(solver.tolerance, effort.tolerance);
    solver.from = effort.from;
    solver.enough = effort.enough;
    sdp::Solution solution = sdp::solve(problem, solver);
    iterations_ += solution.iterations;
    return solution;
  }

  const Clock::time_point start_ = Clock::now();
  const lmi::Inequalities inequalities_;
  const sdp::Options& options_;
  const Depth depth_;
  forall::Plan plan_;
  lmi::Lmi lmi_;
  lmi::GainBounds bounds_;
  std::optional<Attempts> attempts_;
  std::optional<Attempt> inside_;  ///< a point that holds, of an exchange that draws on
  int round_ = 1;
  int iterations_ = 0;  ///< of the solver, in all
  double compile_seconds_ = 0;
  double solve_seconds_ = 0;
};

model::Gains by_sums_of_squares(const model::Instance& instance, const sdp::Options& options) {
  const auto start = Clock::now();
  const lmi::Inequalities inequalities(instance);
  model::Gains gains = stated(instance);
  bool stopped = false;
  try {
    solve_sums_of_squares(inequalities, options, gains);
  } catch (const Stopped&) {
    stopped = true;
  }
  const Concluding concluding;
  if (stopped && (gains.verdict == model::Verdict::undecided || gains.solver.status == "feasible"))
    note_stop("sums of squares", gains.solver.iterations, gains);
  add_gains(inequalities, gains);
  gains.timings = {{"total", seconds_since(start)}};
  return gains;
}

/// Gains of formulas alone: nothing is unknown and nothing required.
model::Gains evaluated(const model::Instance& instance) {
  model::Gains gains = stated(instance);
  gains.verdict = model::Verdict::yes;
  gains.solver.status = "feasible";
  gains.solver.cause = model::kNothingToSolve;
  add_gains(lmi::Inequalities(instance), gains);
  return gains;
}

}  // namespace

model::Gains synthesize(const model::Instance& instance, const sdp::Options& options, Depth depth) {
  const model::Design& design = *instance.design;
  if (design.inequalities.empty() && design.unknowns.empty()) return evaluated(instance);
  require_convex(instance);
  if (has_sums_of_squares(design)) return by_sums_of_squares(instance, options);
  if (instance.design->quotient) return smallest_quotient(instance, options, depth);
  return Synthesis(instance, options, depth).run();
}

model::Gains synthesize_at(const model::DesignPtr& design, const model::Overrides& overrides,
                           const sdp::Options& options, Depth depth) {
  return synthesize(bind::evaluate(design, overrides), options, depth);
}

}  // namespace gainsmith::design
