#include "design/in_matrices.h"

#include <memory>
#include <utility>

#include "lmi/matrix_program.h"
#include "sdp/schur/matrix_solver.h"

namespace gainsmith::design {

namespace {

/// Scalars from which on this solver is the faster one: a point inside takes it five iterations, a
/// minimum many more steps of conjugate gradients.
constexpr int kManyForAPoint = 200, kManyForAMinimum = 400;
/// What conjugate gradients reach as a rule, and seven digits of an objective.
constexpr double kGap = 1e-7;

}  // namespace

Enough enough_for(const Posed& posed, const Question& asked, const lmi::Formulation& formulation,
                  const lmi::Round& round) {
  constexpr double kRoom = 2;  // between double and the exact check of the decimals
  constexpr double kGrows = 2;
  if (asked.goal != lmi::Goal::interior || asked.largest || posed.lmi.has_objective ||
      posed.plan.uses_exchange())
    return {};
  const double margin = kRoom * posed.choices().margin;
  return [&posed, &asked, &formulation, &round, margin,
          last = std::make_shared<double>(0)](const std::vector<double>& x) {
    const double s = x.back();
    const bool grows = s > kGrows * std::exchange(*last, s);
    if (!(s > 0) || (grows && round.diagonals.empty())) return false;
    const auto next = lmi::next_round(posed.lmi, asked.bounds, formulation, x);
    return next && next->margin >= margin;
  };
}

std::optional<sdp::Solution> solve_in_matrices(const Posed& posed, const Question& asked,
                                               const lmi::Formulation& formulation,
                                               const lmi::Round& round, const Enough& enough) {
  const bool minimum = asked.goal == lmi::Goal::objective;
  if (posed.lmi.unknowns < (minimum ? kManyForAMinimum : kManyForAPoint)) return std::nullopt;
  if (!round.diagonals.empty()) return std::nullopt;
  const auto program = lmi::matrix_program(posed.lmi, asked.bounds, formulation, round);
  if (!program) return std::nullopt;
  sdp::MatrixOptions options;
  options.tolerance = kGap;
  if (!minimum) {
    // s = -1 and all else 0: S_k = D_k.
    options.start.assign(program->c.size(), 0);
    options.start.back() = -1;
  }
  if (enough)
    options.enough = [&](const std::vector<double>& x) {
      return x.back() > 0 && enough(lmi::balanced_variables(formulation, *program, x));
    };
  sdp::Solution solution = sdp::solve(*program, options);
  solution.x = lmi::balanced_variables(formulation, *program, solution.x);
  return solution;
}

}  // namespace gainsmith::design
