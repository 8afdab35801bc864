#include "sdp/solver.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "base/number.h"
#include "base/scalars.h"
#include "base/stop.h"
#include "sdp/core/face.h"
#include "sdp/core/forecast.h"
#include "sdp/core/ipm.h"
#include "sdp/core/nearby.h"
#include "sdp/core/presolve.h"
#include "sdp/core/report.h"
#include "sdp/core/variant.h"

namespace gainsmith::sdp {
namespace {

using Clock = std::chrono::steady_clock;

/// The digits that `precision` asks for; 0 for "auto".
int digits_of(const std::string& precision) {
  if (precision == "auto") return 0;
  if (precision == "double") return kDoubleDigits;
  if (precision == "quad") return kQuadDigits;
  int digits = 0;
  const char* const last = precision.data() + precision.size();
  const auto [end, error] = std::from_chars(precision.data(), last, digits);
  if (error != std::errc() || end != last || digits < 1 || digits > kWideDigits)
    throw std::invalid_argument(
        "sdp: precision must be auto, double, quad or a number of digits from 1 to " +
        std::to_string(kWideDigits) + ", not '" + precision + "'");
  return digits;
}

/// What the run showed, judged on the raw problem alone: a certificate only where its residual on
/// the raw data is within certificate_tolerance, an optimum only where all DIMACS errors are within
/// tolerance.
template <typename T>
Solution conclude(const Problem& problem, const Presolved& presolved, const Options& options,
                  const Ipm<T>& ipm, Cause cause) {
  const Iterate<T>& end = ipm.point();
  const bool certificate = cause == Cause::certificate;
  Point<T> point =
      restore<T>(problem, presolved, end.x, end.X, end.Y, certificate ? T(1) : end.tau);
  Solution solution;
  solution.cause = cause;
  measure(problem, point, solution);
  if (certificate) {
    const bool primal = ipm.residuals().primal_certificate <= ipm.residuals().dual_certificate;
    solution.certificate =
        primal ? check_primal_infeasible(problem, point, options.certificate_tolerance)
               : check_dual_infeasible(problem, point, options.certificate_tolerance);
    if (solution.certificate.checked)
      solution.status = primal ? Status::primal_infeasible : Status::dual_infeasible;
  } else if (cause == Cause::converged && worst(solution) <= options.tolerance) {
    solution.status = Status::optimal;
  }
  const bool refuted = certificate || cause == Cause::converged;
  if (refuted && solution.status == Status::undecided) solution.cause = Cause::stalled;
  store(point, solution);
  return solution;
}

/// One solve: runs of the loop in wider and wider arithmetic until one decides.
class WideningSolve {
 public:
  WideningSolve(const Problem& problem, const Presolved& presolved, const Options& options,
                int iterations = 0)
      : problem_(problem), presolved_(presolved), options_(options), iterations_(iterations) {}

  /// From the point `from`, where there is one, or from a far point.
  Solution run_all(int digits, const Iterate<double>* from = nullptr) {
    try {
      widen(digits, from);
      finish();
      if (!from) go_nearby();
    } catch (const Stopped&) {
      best_.cause = Cause::interrupted;
      finish();
    }
    return std::move(best_);
  }

 private:
  /// With more digits than double's asked for: one run in that arithmetic. Else double from `from`
  /// or a far point, the program on a face (for "auto"), and the homogeneous model. For "auto" 31
  /// and 100 digits follow as far as their cost permits.
  void widen(int digits, const Iterate<double>* from) {
    strict_ = digits > kDoubleDigits;
    if (digits > kQuadDigits) return solve_in<Decimal100>(kFarthest);
    if (digits > kDoubleDigits) return solve_in<DoubleDouble>(kFarther);
    Ipm<double> narrow(problem_, presolved_, options_);
    wider_ = digits == 0 && cost() <= kQuadCost;
    if (from) {
      narrow.start_from(*from);
      run(narrow, Model::fixed);
    }
    if (!from || !over()) attempt(narrow, 1);
    if (digits == 0) descend(narrow);
    if (!narrow.left()) search_in_both_directions(narrow);
    if (over() || !wider_) return;

    Ipm<DoubleDouble> wide(problem_, presolved_, options_);
    reason_ = reason("double");
    strict_ = best_error_ > kIllPosed * options_.tolerance;
    if (!strict_) {
      wide.start_from(narrow.point());
      run(wide, Model::fixed);
    }
    if (!over() && !hand_over(narrow, Leave::imprecise, wide, kFarther)) attempt(wide, kFarther);
    search_in_both_directions(narrow);
    if (over() || cost() > kWideCost) return;
    reason_ = reason(name_of<DoubleDouble>());
    Ipm<Decimal100> widest(problem_, presolved_, options_);
    // 100 digits are dear: only for what 31 digits bring as near as kInSight.
    hand_over(wide, Leave::never, widest, kFarthest);
  }

  /// How much farther than far_X, far_Y a run in wide arithmetic starts: problems that need it tend
  /// to have solutions of great norm, and it can afford the cancellation.
  static constexpr double kFarther = 1e4, kFarthest = 1e10;
  /// Where double ends farther than kIllPosed tolerances from an answer, the problem may be so ill
  /// posed that points which satisfy its equations to 1e-15 miss the optimum by any amount: then
  /// they must hold to kWideFeasibility in wide arithmetic.
  static constexpr double kIllPosed = 100;
  static constexpr double kWideFeasibility = 1e-18;
  /// Part of the tolerance that runs aim at: both objectives then have as many digits as the
  /// tolerance, relative to the larger of 1 and their size.
  static constexpr double kAim = 0.4;
  /// Part of the tolerance by which X of a solution on a face may miss its equation.
  static constexpr double kShift = 0.1;
  /// Multiplications an iteration up to which a wider arithmetic is tried unasked, and the program
  /// of nearby.h.
  static constexpr double kQuadCost = 1e9, kWideCost = 6e4, kNearbyCost = 2e6;

  template <typename T>
  void solve_in(double factor) {
    Ipm<T> ipm(problem_, presolved_, options_);
    attempt(ipm, factor);
  }

  /// Data that are rounded may have no Y at all for their equations, or one that has nothing to do
  /// with the data before rounding: then residuals stop falling at the rounding of the data. Where
  /// all errors are below the tolerance there, they decide.
  void finish() {
    if (over() || !strict_ || best_error_ > options_.tolerance) return;
    if (worst(best_) > options_.tolerance) return;
    best_.status = Status::optimal;
    best_.cause = Cause::converged;
  }

  template <typename T>
  void attempt(Ipm<T>& ipm, double factor) {
    ipm.start_far(factor);
    run(ipm, Model::fixed);
  }

  /// Where every arithmetic ends undecided, but at a feasible x: what nearby.h makes of it.
  void go_nearby();

  /// Where the equations force a face: the program on it, and its solution here.
  void descend(const Ipm<double>& narrow);

  /// Where no solution is in sight: the homogeneous model, which is slower but finds infeasibility
  /// on any problem, once.
  void search_in_both_directions(Ipm<double>& narrow) {
    if (over() || best_error_ <= kInSight || searched_) return;
    searched_ = true;
    narrow.start_at_identity();
    run(narrow, Model::homogeneous);
  }

  /// From a far point: `narrow` comes as near as kInSight, well before its digits run out, or to
  /// where it leaves, and `wide` goes on from there. False when `narrow` comes to nothing: what it
  /// cannot get through, more digits rarely can.
  template <typename Narrow, typename Wide>
  bool hand_over(Ipm<Narrow>& narrow, Leave leave, Ipm<Wide>& wide, double factor) {
    narrow.start_far(factor);
    const Cause cause = narrow.run({.model = Model::fixed,
                                    .aim = kInSight,
                                    .feasibility = kInSight,
                                    .leave = leave,

                                    .first_iteration = iterations_});
    iterations_ = best_.iterations = narrow.iterations();
    if (cause != Cause::converged && !narrow.left()) {
      best_.cause = cause == Cause::certificate ? Cause::stalled : cause;
      return false;
    }
    wide.start_from(narrow.point());
    run(wide, Model::fixed);
    return true;
  }

  template <typename T>
  void run(Ipm<T>& ipm, Model model);

  /// Decided, or ended from outside.
  bool over() const { return best_.status != Status::undecided || stopped(best_.cause); }
  static bool stopped(Cause cause) {
    return cause == Cause::iteration_limit || cause == Cause::interrupted || cause == Cause::enough;
  }
  std::string reason(const std::string& arithmetic) const {
    return arithmetic + " " + to_string(best_.cause);
  }
  double cost() const;

  const Problem& problem_;
  const Presolved& presolved_;
  const Options& options_;
  Solution best_;
  double best_error_ = std::numeric_limits<double>::infinity();
  int iterations_ = 0;
  std::string reason_;
  bool wider_ = false;     ///< wider arithmetic may follow
  bool strict_ = false;    ///< ask for kWideFeasibility
  bool searched_ = false;  ///< the homogeneous model had its turn
};

/// One run, measured on the raw problem. best_ becomes its result where that decides or has the
/// least error so far.
template <typename T>
void WideningSolve::run(Ipm<T>& ipm, Model model) {
  const double feasibility =
      strict_ ? std::min(kWideFeasibility, options_.tolerance) : options_.tolerance;
  const Cause cause = ipm.run({.model = model,
                               .aim = kAim * options_.tolerance,
                               .feasibility = feasibility,
                               .leave = wider_ ? Leave::exhausted : Leave::never,
                               .first_iteration = iterations_,
                               .early = std::is_same_v<T, double>});
  iterations_ = ipm.iterations();
  const Concluding concluding;
  Solution found = conclude(problem_, presolved_, options_, ipm, cause);
  const double error = ipm.residuals().worst();
  const bool decided = found.status != Status::undecided;
  if (decided || cause == Cause::enough || error < best_error_ || !std::isfinite(best_error_)) {
    best_ = std::move(found);
    best_error_ = error;
    best_.precision = name_of<T>();
    best_.precision_reason = reason_;
  } else {
    best_.cause = found.cause;
  }
  best_.iterations = iterations_;
}

/// The program over Z is solved like any other, from the projection of the point. What it found
/// counts only where it is optimal for the raw problem too.
void WideningSolve::descend(const Ipm<double>& narrow) {
  if (over()) return;
  const auto face = find_face(problem_, presolved_, narrow.point());
  if (!face) return;
  const Problem restricted = restrict_to(*face, problem_);
  if (restricted.blocks.empty()) return;
  const Presolved presolved = presolve(restricted);
  if (presolved.free_descent >= 0) return;
  const Iterate<double>& end = narrow.point();
  const Iterate<double> from = restrict_to(
      *face, problem_, restore<double>(problem_, presolved_, end.x, end.X, end.Y, end.tau),
      restricted, presolved);
  const Solution found =
      WideningSolve(restricted, presolved, options_, iterations_).run_all(0, &from);
  iterations_ = best_.iterations = found.iterations;
  if (stopped(found.cause)) best_.cause = found.cause;
  if (found.status != Status::optimal) return;
  const auto point = lift(*face, problem_, found, kShift * options_.tolerance);
  if (!point) return;
  Solution lifted;
  measure(problem_, *point, lifted);
  if (!(worst(lifted) <= options_.tolerance)) return;
  lifted.status = Status::optimal;
  lifted.cause = Cause::converged;
  lifted.precision = found.precision;
  lifted.precision_reason = found.precision_reason;
  lifted.iterations = iterations_;
  store(*point, lifted);
  best_ = std::move(lifted);
}

void WideningSolve::go_nearby() {
  if (over() || !wider_ || cost() > kNearbyCost) return;
  Solution found = solve_nearby(problem_, presolved_, options_, iterations_);
  best_.iterations = found.iterations = iterations_;
  if (stopped(found.cause)) best_.cause = found.cause;
  if (found.status != Status::optimal) return;
  found.precision_reason = reason_;
  best_ = std::move(found);
}

/// Multiplications of one iteration: products, factors and the Schur complement.
double WideningSolve::cost() const {
  const Layout& layout = presolved_.data.layout;
  const double m = presolved_.data.m();
  double sum = m * m * m / 6;
  for (int b = 0; b < layout.blocks(); ++b) {
    const double n = layout.size[static_cast<std::size_t>(b)];
    const BlockData& block = presolved_.data.dense[static_cast<std::size_t>(b)];
    const auto entries = static_cast<double>(block.terms.size());
    sum += 12 * n * n * n + std::min(block.lists() * n * n * n, 4 * entries * n + m * entries);
  }
  return sum;
}

/// F_i = 0 with c_i != 0: x = -e_i / c_i.
Solution free_descent(const Problem& problem, const Presolved& presolved, const Options& options) {
  Solution solution;
  const Iterate<double> zero(presolved.data);
  Point<double> point = restore<double>(problem, presolved, zero.x, zero.X, zero.Y, 1.0);
  const auto i = static_cast<std::size_t>(presolved.free_descent);
  point.x[i] = -1 / problem.c[i];
  solution.certificate = check_dual_infeasible(problem, point, options.certificate_tolerance);
  store(point, solution);
  solution.status = Status::dual_infeasible;
  solution.cause = Cause::certificate;
  return solution;
}

/// One sentence for a person about a point that decides nothing, or less than it seems to.
std::string explain(const Solution& solution) {
  if (solution.status != Status::undecided) return solution.message;
  return "stopped (" + to_string(solution.cause) + ") with the objectives in [" +
         decimal17(std::min(solution.dual_objective, solution.primal_objective)) + ", " +
         decimal17(std::max(solution.dual_objective, solution.primal_objective)) +
         "] and the worst error " + brief(worst(solution), 2);
}

}  // namespace

Solution solve_here(const Problem& problem, const Options& options) {
  const Clock::time_point start = Clock::now();
  const int digits = digits_of(options.precision);
  validate(problem);
  const Presolved presolved = presolve(problem);
  require_memory(presolved.data.m(), bytes_of_iterates<double>(presolved.data));
  std::optional<Iterate<double>> from;
  if (options.from) {
    from.emplace(presolved.data);
    const Solution& near = *options.from;
    reduce(problem, presolved, {near.x, near.X.values, near.Y.values}, from->x, from->X, from->Y);
  }
  Solution solution =
      presolved.free_descent >= 0
          ? free_descent(problem, presolved, options)
          : WideningSolve(problem, presolved, options).run_all(digits, from ? &*from : nullptr);
  solution.message = explain(solution);
  solution.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return solution;
}

}  // namespace gainsmith::sdp
