#include "sos/decide.h"

#include <cmath>
#include <utility>

#include "base/number.h"
#include "sos/face.h"
#include "sos/moments.h"

namespace gainsmith::sos {

namespace {

/// The decimals of u that a gain file prints.
std::optional<std::vector<Rational>> decimals_of(const Program& program, const Point& point) {
  const std::vector<double> u(point.free.begin(), point.free.begin() + program.unknowns);
  const auto conditions = conditions_on_unknowns(program);
  if (!conditions.empty()) return decimals_near(u, conditions);
  std::vector<Rational> result;
  for (const double value : u) {
    if (!std::isfinite(value)) return std::nullopt;
    result.push_back(*parse_rational(shortest(value)));
  }
  return result;
}

/// The tolerance of the solver for a solution that lies a little above a minimum.
constexpr double kTight = 1e-12;

class Deciding {
 public:
  Deciding(Program program, const sdp::Options& options, const std::optional<Equation>& level)
      : options_(options), level_(level) {
    result_.program = std::move(program);
  }

  /// With a level: one solve in double. Else the program as it is, and then on the face of the last
  /// point, until an identity is shown, solutions are excluded or no smaller face is found.
  Decision take() {
    if (level_) {
      sdp::Options narrow = options_;
      narrow.precision = "double";
      narrow.tolerance = kTight;
      if (const auto point = solve(true, narrow)) is_shown(*point);
      return std::move(result_);
    }
    // Programs that are solved: the whole one, and faces of faces.
    constexpr int kMostFaces = 5;
    for (int face = 0; face < kMostFaces; ++face) {
      const auto point = solve(face == 0, options_);
      if (!point || result_.excluded || is_shown(*point)) break;
      auto next = restricted_to_faces(result_.program, *point);
      if (!next) next = restricted_in_more_digits();
      if (!next) break;
      result_.program = std::move(*next);
      result_.on_face = true;
    }
    return std::move(result_);
  }

 private:
  /// A point of the program as it is; `is_whole`: on no face, so that moments exclude all
  /// solutions.
  std::optional<Point> solve(bool is_whole, const sdp::Options& options) {
    std::vector<Equation> equations = equations_of(result_.program);
    if (level_) equations.push_back(*level_);
    const Eliminated eliminated = eliminate(result_.program, std::move(equations));
    if (eliminated.contradiction) {
      if (is_whole && !level_) {
        result_.contradiction = eliminated.contradiction;
        result_.excluded = true;
      }
      return std::nullopt;
    }
    const Semidefinite posed = semidefinite_program(result_.program, eliminated);
    result_.solution = sdp::solve(posed.problem, options);
    result_.iterations += result_.solution.iterations;
    if (result_.solution.x.empty()) return std::nullopt;
    const bool is_out = result_.solution.status == sdp::Status::dual_infeasible;
    std::vector<double> x = result_.solution.x;
    x.resize(posed.equations.size());
    if (is_whole && !level_) {
      result_.inside = x;
      const bool may_exclude = is_out || margin_of(result_.solution) < 0;
      if (const auto y = may_exclude ? excluding_moments(result_.program, eliminated, posed, x)
                                     : std::nullopt) {
        result_.excluded = true;
        result_.moments = of_monomials(equations_of(result_.program), eliminated, posed, *y);
      }
    }
    if (is_out || result_.excluded) return std::nullopt;
    return point_of(result_.program, eliminated, posed, result_.solution);
  }

  /// Is there an identity near the point, with decimals for u? Keeps it.
  bool is_shown(const Point& point) {
    const auto u = decimals_of(result_.program, point);
    if (!u) return false;
    auto identity = identity_near(result_.program, point, *u);
    if (!identity) return false;
    result_.u = *u;
    result_.identity = std::move(*identity);
    return true;
  }

  /// The face of a point in 31 digits, which shows kernels of longer fractions. Not of programs
  /// with many equations, where that would take long.
  std::optional<Program> restricted_in_more_digits() {
    // With more of them 31 digits take too long.
    constexpr int kMostEquations = 400;
    sdp::Options wide = options_;
    wide.precision = "quad";
    wide.tolerance = 1e-20;
    if (wide.precision == options_.precision ||
        static_cast<int>(equations_of(result_.program).size()) > kMostEquations)
      return std::nullopt;
    const auto point = solve(false, wide);
    if (!point) return std::nullopt;
    return restricted_to_faces(result_.program, *point);
  }

  const sdp::Options& options_;
  const std::optional<Equation>& level_;
  Decision result_;
};

}  // namespace

Decision decide(Program program, const sdp::Options& options,
                const std::optional<Equation>& level) {
  return Deciding(std::move(program), options, level).take();
}

}  // namespace gainsmith::sos
