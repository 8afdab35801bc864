#include "design/sums_of_squares.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/number.h"
#include "design/sos_records.h"
#include "numbers/dense/definite.h"
#include "numbers/dense/dense.h"
#include "sos/counterexample.h"
#include "sos/moments.h"
#include "verdict/rational_blocks.h"

namespace gainsmith::design {

namespace {

using sos::Equation;

/// c'u + c_0 as a sum over columns.
Equation objective_of(const sos::Polynomial& objective) {
  Equation result;
  for (const auto& [term, c] : objective.terms())
    if (term.unknown == 0)
      result.value -= c;
    else
      result.terms[term.unknown - 1] = c;
  return result;
}

sos::Program posed(const lmi::Inequalities& inequalities, const SosStatements& stated) {
  try {
    return sos::pose(stated.statements, inequalities.unknowns.size());
  } catch (const std::length_error&) {
    throw InputError(inequalities.statements.front().stated->place,
                     "the inequalities have more than 20,000 monomials of their degree");
  }
}

/// InputError where the program that is solved has a number that double has not.
void within_double(const lmi::Inequalities& inequalities, const std::function<void()>& solve) {
  try {
    solve();
  } catch (const std::overflow_error&) {
    throw InputError(inequalities.statements.front().stated->place,
                     "the coefficients of the inequalities are too large, or too far apart, for "
                     "numbers in double: choose other units");
  }
}

/// The path to a verdict: equations alone, the least value, any point; all in fractions
/// (sos/decide.h).
class Solving {
 public:
  Solving(const lmi::Inequalities& inequalities, const sdp::Options& options, SosStatements stated,
          model::Gains& gains)
      : inequalities_(inequalities),
        options_(options),
        gains_(gains),
        stated_(std::move(stated)),
        program_(posed(inequalities, stated_)) {}

  void run() {
    gains_.verdict = model::Verdict::undecided;
    gains_.solver.status = "undecided";
    gains_.solver.cause = model::kNothingToSolve;
    gains_.solver.precision = "double";
    if (inequalities_.design().synthesis.gain_bound_stated)
      gains_.solver.add_message("synthesis.gain_bound is not imposed beside sums of squares");
    if (const auto contradiction = sos::reduce(program_)) return exclude(contradiction, {});
    if (stated_.objective && minimise(program_)) return;
    sos::Decision decision = decided(program_, std::nullopt);
    if (decision.excluded) return exclude(decision.contradiction, decision.moments);
    // What is 1e-9 from singular, as the value of a minimum is, needs the last digits of double.
    if (!decision.u) decision = decided(program_, Equation{});
    if (!decision.u) return note_open();
    accept(decision);
    if (!stated_.objective || (decision.on_face && minimise(decision.program))) return;
    gains_.solver.add_message(
        gains_.solver.unbounded
            ? "the objective is that of a point inside: the solver finds it unbounded below"
            : "the objective is that of a point inside, not its minimum: the minimum was not "
              "found");
  }

 private:
  /// With `level` that equation is one more, and one program in double is solved.
  sos::Decision decided(const sos::Program& program, const std::optional<Equation>& level) {
    sos::Decision decision = sos::decide(program, options_, level);
    note(decision.solution, decision.iterations);
    return decision;
  }

  void note(const sdp::Solution& solution, int iterations) {
    if (iterations == 0) return;
    gains_.solver.iterations += iterations;
    gains_.solver.cause = to_string(solution.cause);
    gains_.solver.relative_gap = solution.relative_gap;
    gains_.solver.primal_infeasibility = solution.dimacs[2];
    gains_.solver.dual_infeasibility = solution.dimacs[0];
    gains_.solver.precision = solution.precision;
  }

  /// The least value, and then a point inside a little above it; whether there is one.
  bool minimise(const sos::Program& program) {
    gains_.solver.status = "feasible";
    const Equation cost = objective_of(*stated_.objective);
    const sos::Eliminated eliminated = eliminate(program, equations_of(program));
    if (eliminated.contradiction) return false;
    const auto sum = eliminated.without_free(cost);
    gains_.solver.unbounded = !sum;
    if (!sum || eliminated.equations.empty()) return false;
    const sos::Semidefinite posed = semidefinite_program(program, eliminated, sum);
    const sdp::Solution least = sdp::solve(posed.problem, options_);
    note(least, least.iterations);
    gains_.solver.unbounded = least.status == sdp::Status::primal_infeasible;
    if (least.x.empty() || least.status != sdp::Status::optimal) return false;
    const double optimum = -least.dual_objective - nearest_double(sum->value);
    // Parts of the least value by which the point may be above it.
    for (const double paid : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
      Equation level = cost;
      level.value += Rational(optimum + paid * std::max(std::abs(optimum), 1.0));
      const sos::Decision near = decided(program, level);
      if (!near.u) continue;
      accept(near);
      if (&program == &program_) add_lower_bound(eliminated, posed, *sum, least);
      note_bracket();
      return true;
    }
    return false;
  }

  /// By moments in fractions near the solver's, moved towards a point inside where they need it.
  void add_lower_bound(const sos::Eliminated& eliminated, const sos::Semidefinite& posed,
                       const Equation& sum, const sdp::Solution& least) {
    auto bound = lower_bound(program_, eliminated, posed, sum, least.x, {});
    if (!bound)
      bound = lower_bound(program_, eliminated, posed, sum, least.x,
                          decided(program_, std::nullopt).inside);
    if (!bound) return;
    const double below =
        std::nextafter(nearest_double(*bound), -std::numeric_limits<double>::infinity());
    gains_.objective_lower_bound = std::min(*gains_.objective, below);
  }

  /// A minimum is one that a bound brackets to 1e-5 of its size.
  void note_bracket() {
    constexpr double kNear = 1e-5;
    const auto& least = gains_.objective_lower_bound;
    if (least && *gains_.objective - *least <= kNear * std::abs(*gains_.objective)) {
      gains_.solver.status = "optimal";
      return;
    }
    gains_.solver.add_message(
        least ? "the optimum is between the lower bound " + brief_below(*least, 10) +
                    " and the objective"
              : std::string("how near the objective is to the optimum is not shown"));
  }

  /// A yes: unknowns as decimals or fractions, the identities, the objective at the point.
  void accept(const sos::Decision& decision) {
    const std::vector<Rational>& u = *decision.u;
    gains_.verdict = model::Verdict::yes;
    if (!stated_.objective) gains_.solver.status = "optimal";
    std::vector<double> x;
    for (const Rational& value : u) x.push_back(nearest_double(value));
    const numbers::Values values = inequalities_.unknowns.values(x);
    gains_.unknowns.clear();
    for (const lmi::Unknown& unknown : inequalities_.unknowns.list()) {
      gains_.unknowns.emplace_back(unknown.name, values.at(unknown.name));
      keep_decimals(unknown, u);
    }
    gains_.sums_of_squares = identity_records(decision, stated_);
    if (stated_.objective)
      gains_.objective = nearest_double(with_unknowns(*stated_.objective, u).number());
    add_margins(decision);
  }

  /// Of unknowns whose decimals no double prints.
  void keep_decimals(const lmi::Unknown& unknown, const std::vector<Rational>& u) {
    std::vector<std::string> texts(static_cast<std::size_t>(unknown.shape.size()), "0.0");
    bool is_printed = true;
    for (int k = 0; k < unknown.count; ++k) {
      const Rational& value = u[static_cast<std::size_t>(unknown.first + k) - 1];
      const double nearest = nearest_double(value);
      const bool is_same = verdict::printed_fraction(nearest) == value;
      is_printed = is_printed && is_same;
      for (const auto& [row, column] : unknown.places(k))
        texts[static_cast<std::size_t>(row * unknown.shape.cols + column)] =
            is_same ? model::printed(nearest) : exact_text(value);
    }
    if (!is_printed) gains_.decimals["unknowns." + unknown.name] = std::move(texts);
  }

  /// Of each Gram matrix Q of the inequalities themselves: its unit-free margin, after the
  /// identity.
  void add_margins(const sos::Decision& decision) {
    gains_.margins.clear();
    for (std::size_t g = 0; g < decision.program.grams.size(); ++g) {
      const sos::Gram& gram = decision.program.grams[g];
      if (gram.multiplier != 0) continue;
      const numbers::Matrix Q =
          decision.identity.grams[g].unaryExpr([](const Rational& x) { return nearest_double(x); });
      const sos::Statement& statement = program_.statements[gram.statement];
      model::Margin margin;
      margin.name = statement.name;
      margin.strict = statement.strict;
      margin.reached = Q.size() == 0 ? 0 : numbers::margin(Q);
      margin.smallest_eigenvalue = Q.size() == 0 ? 0 : numbers::smallest_eigenvalue(Q);
      margin.holds = true;
      gains_.margins.push_back(margin);
    }
  }

  std::string place_of(const sos::Key& key) const {
    const sos::Statement& statement = stated_.statements[key.statement];
    const std::string monomial = to_string(key.monomial, stated_.variables[key.statement]);
    std::string text = "'" + statement.name + "': the coefficient of " + monomial;
    if (statement.matrix.rows() > 1)
      text += " of the element (" + std::to_string(key.row + 1) + ", " +
              std::to_string(key.column + 1) + ")";
    return text;
  }

  /// "'decrease' leaves one value of V_2_0; then ".
  std::string told_by_others(const sos::Contradiction& contradiction) const {
    std::map<std::string, std::string> names;  // of unknowns, by the inequality that tells them
    for (const auto& [k, key] : contradiction.told)
      if (key.statement != contradiction.key.statement)
        (names[stated_.statements[key.statement].name] += ", ") +=
            stated_.unknowns[static_cast<std::size_t>(k)];
    std::string text;
    for (const auto& [inequality, list] : names)
      text +=
          (text.empty() ? "'" : " and '") + inequality + "' leaves one value of " + list.substr(2);
    return text.empty() ? "" : text + "; then ";
  }

  void exclude(const std::optional<sos::Contradiction>& contradiction,
               const std::map<sos::Key, Rational>& moments) {
    gains_.verdict = model::Verdict::no;
    gains_.solver.status = "infeasible";
    gains_.certificate = model::CertificateRecord{true, 0, 0, {}, "sums of squares"};
    gains_.certificate->moments = moment_records(moments, stated_);
    const std::string none = "no sums of squares of these degrees";
    if (const auto text = counterexample(); !text.empty())
      gains_.solver.add_message(none + ": " + text);
    else if (contradiction)
      gains_.solver.add_message(none + ": " + told_by_others(*contradiction) +
                                place_of(contradiction->key) + " " + contradiction->why);
    else
      gains_.solver.add_message(none + ", by moments in fractions; higher degrees may have some");
  }

  /// Where an inequality is false itself; empty where no such point is found.
  std::string counterexample() const {
    for (std::size_t s = 0; s < stated_.statements.size(); ++s) {
      const auto found = find_counterexample(stated_.statements[s]);
      if (!found) continue;
      std::string point;
      for (std::size_t i = 0; i < found->x.size(); ++i)
        point += (i == 0 ? "" : ", ") + stated_.variables[s][i] + " = " + exact_text(found->x[i]);
      std::string form = "its sides differ by ";
      if (found->v.size() > 1) {
        std::string v;
        for (const Rational& value : found->v) v += (v.empty() ? "" : "; ") + exact_text(value);
        form = "the difference M of its sides has v'*M*v = ";
        point += ", v = [" + v + "]";
      }
      return "'" + stated_.statements[s].name + "' is false at " + point + ": " + form +
             brief(nearest_double(found->value));
    }
    return "";
  }

  /// Neither an identity nor moments in fractions.
  void note_open() {
    gains_.solver.add_message(
        gains_.solver.cause == "certificate"
            ? "the solver finds no sums of squares of these degrees, and no fractions that show it"
            : "no fractions were found near the solution of the solver");
  }

  const lmi::Inequalities& inequalities_;
  const sdp::Options& options_;
  model::Gains& gains_;
  const SosStatements stated_;
  sos::Program program_;
};

}  // namespace

void solve_sums_of_squares(const lmi::Inequalities& inequalities, const sdp::Options& options,
                           model::Gains& gains) {
  within_double(inequalities,
                [&] { Solving(inequalities, options, sos_statements(inequalities), gains).run(); });
}

void check_sums_of_squares(const lmi::Inequalities& inequalities, const std::vector<double>& x,
                           const sdp::Options& options, model::Gains& gains) {
  SosStatements stated = sos_statements(inequalities);
  stated.objective.reset();
  std::vector<Rational> u;
  for (const double value : x) u.push_back(verdict::printed_fraction(value));
  for (sos::Statement& statement : stated.statements)
    for (sos::Polynomial& p : statement.matrix.reshaped()) p = with_unknowns(p, u);
  within_double(inequalities,
                [&] { Solving(inequalities, options, std::move(stated), gains).run(); });
}

SemidefiniteProgram program_of_sums_of_squares(const lmi::Inequalities& inequalities) {
  const SosStatements stated = sos_statements(inequalities);
  sos::Program program = posed(inequalities, stated);
  const auto refuse = [&](const sos::Contradiction& contradiction) {
    throw InputError(inequalities.statements.front().stated->place,
                     "no semidefinite program: the coefficient of a monomial " + contradiction.why);
  };
  if (const auto contradiction = sos::reduce(program)) refuse(*contradiction);
  const sos::Eliminated eliminated = eliminate(program, equations_of(program));
  if (eliminated.contradiction) refuse(*eliminated.contradiction);
  std::optional<Equation> least;
  if (stated.objective) least = eliminated.without_free(objective_of(*stated.objective));
  SemidefiniteProgram result;
  within_double(inequalities,
                [&] { result.problem = semidefinite_program(program, eliminated, least).problem; });
  result.remarks = {
      "Written by gainsmith. The dual matrix Y has the Gram matrices of sums of squares "
      "as its blocks; each equation F_i . Y = c_i is that of a monomial.",
      "Unknowns without sign have been eliminated."};
  result.remarks.push_back(
      least
          ? "The objective of the problem = -(F_0 . Y) + " +
                brief(-nearest_double(least->value), 17) + "."
          : std::string("The last two blocks are s - t and t + 10, where Y >= t I and the solution "
                        "is Y/s: the largest t is wanted."));
  return result;
}

}  // namespace gainsmith::design
