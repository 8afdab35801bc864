#include "sdp/core/nearby.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/scalars.h"
#include "sdp/core/ipm.h"
#include "sdp/core/report.h"

namespace gainsmith::sdp {
namespace {

/// Parts of the tolerance that w and S take, and that the program is solved to.
constexpr double kShare = 0.8, kShareSolved = 0.2;
/// The errors of centres, in tolerances; the primal infeasibility that x of one may have.
constexpr double kCentres[] = {10000, 3000, 1000, 500};
constexpr double kFeasible = 1e-18;
/// How many programs are solved: with another S, or where S can be no larger, around another
/// centre.
constexpr int kPrograms = 4;

constexpr const char* kByErrorsAlone =
    "by its errors alone: rounding of the data moves the optimum by more than the tolerance";

/// c_i and what it was rounded by.
DoubleDouble coefficient_of(const Problem& problem, std::size_t i) {
  return {problem.c[i], problem.c_rest.empty() ? 0 : problem.c_rest[i]};
}

/// One more unknown with the cost c and the matrix f.
void append(Problem& program, const DoubleDouble& c, std::vector<Entry> f) {
  program.c.push_back(c.hi());
  program.c_rest.push_back(c.lo());
  program.f.push_back(std::move(f));
}

/// The unknown a: its matrix is sum x^_i F_i.
void append_ray(const Problem& problem, const std::vector<DoubleDouble>& centre, Problem& program) {
  Problem linear = problem;
  linear.f[0].clear();
  const auto sum = slack(linear, centre);
  std::vector<Entry> f;
  for (std::size_t b = 0; b < sum.size(); ++b) {
    const Block& block = problem.blocks[b];
    for (int j = 0; j < block.size; ++j)
      for (int i = block.diagonal ? j : 0; i <= j; ++i) {
        const auto at = static_cast<std::size_t>(block.diagonal ? i : i + block.size * j);
        const DoubleDouble& v = sum[b][at];
        if (v.hi() != 0) f.push_back({static_cast<int>(b), i, j, v.hi(), v.lo(), 0});
      }
  }
  DoubleDouble c(0);
  for (std::size_t i = 0; i < centre.size(); ++i) c += centre[i] * coefficient_of(problem, i);
  append(program, c, std::move(f));
}

/// The unknowns a, then p, then q, with x = a x^ + p - q and p, q >= 0 as a last, diagonal block.
Problem program_around(const Problem& problem, const std::vector<DoubleDouble>& centre,
                       double weight, const std::vector<Entry>& shift) {
  Problem program;
  program.blocks = problem.blocks;
  program.finer = problem.finer;
  const auto m = problem.c.size();
  const auto last = static_cast<int>(program.blocks.size());
  program.blocks.push_back({static_cast<int>(2 * m), true});
  program.f.push_back(problem.f[0]);
  program.f[0].insert(program.f[0].end(), shift.begin(), shift.end());
  append_ray(problem, centre, program);
  for (const int sign : {1, -1})
    for (std::size_t i = 0; i < m; ++i) {
      auto f = problem.f[i + 1];
      for (Entry& e : f) {
        e.value *= sign;
        e.rest *= sign;
        e.finer = 0;
      }
      const int row = static_cast<int>(sign > 0 ? i : m + i);
      f.push_back({last, row, row, 1, 0, 0});
      append(program, coefficient_of(problem, i) * sign + DoubleDouble(weight), std::move(f));
    }
  return program;
}

/// The point a = 1, p = q = mu / w of the program, with X and Y of `point`.
Point<DoubleDouble> point_around(const Problem& problem, const Point<DoubleDouble>& point,
                                 double weight) {
  DoubleDouble product(0);
  double order = 0;
  for (std::size_t b = 0; b < point.X.size(); ++b) {
    order += problem.blocks[b].size;
    for (std::size_t k = 0; k < point.X[b].size(); ++k) product += point.X[b][k] * point.Y[b][k];
  }
  const DoubleDouble part = product / DoubleDouble(order * weight);
  const std::size_t m = point.x.size();
  Point<DoubleDouble> around{{DoubleDouble(1)}, point.X, point.Y};
  around.x.resize(2 * m + 1, part);
  around.X.emplace_back(2 * m, part);
  around.Y.emplace_back(2 * m, DoubleDouble(weight));
  return around;
}

/// x, X and Y of the raw problem.
Point<DoubleDouble> back(const std::vector<DoubleDouble>& centre, Point<DoubleDouble> around) {
  const std::size_t m = centre.size();
  Point<DoubleDouble> point{centre, std::move(around.X), std::move(around.Y)};
  for (std::size_t i = 0; i < m; ++i)
    point.x[i] = around.x[0] * centre[i] + (around.x[1 + i] - around.x[1 + m + i]);
  point.X.pop_back();
  point.Y.pop_back();
  return point;
}

/// Y / ||Y||, and ||Y||.
struct Direction {
  Direction(const Problem& problem, const Point<DoubleDouble>& point) {
    for (const auto& block : point.Y)
      for (const DoubleDouble& v : block) norm += v.hi() * v.hi();
    norm = std::sqrt(norm);
    for (std::size_t b = 0; b < point.Y.size(); ++b) {
      const Block& block = problem.blocks[b];
      for (int j = 0; j < block.size; ++j)
        for (int i = block.diagonal ? j : 0; i <= j; ++i) {
          const auto at = static_cast<std::size_t>(block.diagonal ? i : i + block.size * j);
          entries.push_back({static_cast<int>(b), i, j, point.Y[b][at].hi() / norm, 0, 0});
        }
    }
  }
  std::vector<Entry> times(double size) const {
    std::vector<Entry> scaled;
    if (!(size > 0)) return scaled;
    scaled = entries;
    for (Entry& e : scaled) e.value *= size;
    return scaled;
  }
  double norm = 0;
  std::vector<Entry> entries;
};

/// Is no more to be done?
bool stopped(Cause cause) { return cause == Cause::iteration_limit || cause == Cause::interrupted; }

/// Points of one run whose x is feasible, but for kFeasible, those with the least errors first; and
/// why it ended.
struct Centres {
  std::vector<Point<DoubleDouble>> points;
  Cause cause = Cause::stalled;
};
Centres centres_of(const Problem& problem, const Presolved& presolved, const Options& options,
                   int& iterations) {
  Centres centres;
  Ipm<double> narrow(problem, presolved, options);
  Ipm<DoubleDouble> wide(problem, presolved, options);
  Run near{.aim = kInSight, .feasibility = kInSight, .first_iteration = iterations};
  narrow.start_far(1);
  narrow.run(near);
  near.first_iteration = narrow.iterations();
  wide.start_from(narrow.point());
  for (const double errors : kCentres) {
    near.aim = near.feasibility = errors * options.tolerance;
    centres.cause = wide.run(near);
    near.first_iteration = iterations = wide.iterations();
    if (centres.cause != Cause::converged) break;
    if (wide.residuals().primal_infeasibility > kFeasible) continue;
    const Iterate<DoubleDouble>& end = wide.point();
    centres.points.insert(centres.points.begin(),
                          restore<DoubleDouble>(problem, presolved, end.x, end.X, end.Y, end.tau));
  }
  return centres;
}

}  // namespace

// The nearer to the runaway the centre is, the nearer is the value to where the digits end; but
// from the nearest ones nothing may be found.
Solution solve_nearby(const Problem& problem, const Presolved& presolved, const Options& options,
                      int& iterations) {
  const Centres centres = centres_of(problem, presolved, options, iterations);
  Solution solution;
  solution.cause = centres.cause;
  if (stopped(centres.cause)) return solution;
  for (const Point<DoubleDouble>& point : centres.points) {
    solution = solve_around(problem, options, point, iterations);
    if (solution.status == Status::optimal || stopped(solution.cause)) break;
  }
  return solution;
}

Solution solve_around(const Problem& problem, const Options& options, Point<DoubleDouble> point,
                      int& iterations) {
  double largest_c = 0, largest_f0 = 0;
  for (const double c : problem.c) largest_c = std::max(largest_c, std::abs(c));
  for (const Entry& e : problem.f[0]) largest_f0 = std::max(largest_f0, std::abs(e.value));
  const double share = kShare * options.tolerance;
  // ||A(Y) - c|| <= sqrt(m) w is `share` of error 1, and |S| <= share (1 + max|F_0|) of error 3.
  const double weight = share * (1 + largest_c) / std::sqrt(static_cast<double>(problem.m()));
  const Direction direction(problem, point);
  const double most = share * (1 + largest_f0);
  Point<DoubleDouble> around = point_around(problem, point, weight);
  double shift = 0;
  Solution solution;
  for (int k = 0; k < kPrograms; ++k) {
    const Problem program = program_around(problem, point.x, weight, direction.times(shift));
    const Presolved presolved = presolve(program);
    Ipm<DoubleDouble> ipm(program, presolved, options);
    Iterate<DoubleDouble> start(presolved.data);
    reduce(program, presolved, around, start.x, start.X, start.Y);
    ipm.start_from(start);
    const Cause cause = ipm.run({.aim = kShareSolved * options.tolerance,
                                 .feasibility = options.tolerance,
                                 .first_iteration = iterations});
    iterations = ipm.iterations();
    const Iterate<DoubleDouble>& end = ipm.point();
    const auto found =
        back(point.x, restore<DoubleDouble>(program, presolved, end.x, end.X, end.Y, end.tau));
    solution = {};
    measure(problem, found, solution);
    solution.cause = cause;
    if (worst(solution) <= options.tolerance) {
      solution.status = Status::optimal;
      solution.cause = Cause::converged;
      solution.precision = name_of<DoubleDouble>();
      solution.message = kByErrorsAlone;
      store(found, solution);
      break;
    }
    if (cause != Cause::converged) break;
    solution.cause = Cause::stalled;
    // A multiple of Y / ||Y|| as S moves the gap by that multiple of ||Y||.
    const double gap = solution.dual_objective - solution.primal_objective;
    const double next = std::clamp(shift + gap / direction.norm, 0.0, most);
    if (next == shift) {
      point = found;
      around = point_around(problem, point, weight);
    }
    shift = next;
  }
  return solution;
}

}  // namespace gainsmith::sdp
