// A solver that answers from a script, and attempts with it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "design/attempts.h"
#include "support/yaml_problem.h"

namespace gainsmith::design::testing {

/// A problem with its blocks.
struct Case {
  tests::YamlProblem yaml;
  lmi::Inequalities inequalities;
  forall::Plan plan;
  lmi::Lmi lmi;
  lmi::GainBounds bounds;

  explicit Case(const std::string& method)
      : yaml("problem: p\nmethod:\n  method: m\n" + method),
        inequalities(yaml.instance),
        plan(forall::make_plan(inequalities.design())),
        lmi(lmi::compile(inequalities, plan)),
        bounds(lmi::gain_bounds(inequalities, inequalities.design().synthesis.gain_bound)) {}

  Posed posed() const { return {inequalities, plan, lmi, true, {}}; }

  /// The first round of a question, with the bounds that a program has by its blocks.
  lmi::Formulation formulation(lmi::Goal goal, const sdp::Problem& problem) const {
    const bool interior = goal == lmi::Goal::interior;
    const std::size_t others =
        lmi.blocks.size() +
        (interior ? 1U + (lmi::formulate_interior(lmi, {}, {}).homogenised ? 1U : 0U) : 0U);
    const lmi::GainBounds of = problem.blocks.size() > others ? bounds : lmi::GainBounds{};
    if (interior) return lmi::formulate_interior(lmi, of, {});
    const double shift = posed().choices().margin;
    const lmi::Formulation found = lmi::formulate_objective(lmi, of, shift);
    if (found.problem.f == problem.f) return found;
    return lmi::formulate_objective(lmi, lmi::gain_bounds(inequalities, bounds.beta / 10), shift);
  }
};

/// Answers one program.
using Answer = std::function<sdp::Solution(const sdp::Problem&)>;

inline sdp::Solution ended(sdp::Status status, const sdp::Problem& problem) {
  sdp::Solution solution;
  solution.status = status;
  solution.cause = status == sdp::Status::optimal     ? sdp::Cause::converged
                   : status == sdp::Status::undecided ? sdp::Cause::stalled
                                                      : sdp::Cause::certificate;
  solution.relative_gap = status == sdp::Status::optimal ? 0 : 1;
  solution.x.assign(static_cast<std::size_t>(problem.m()), 0.0);
  // Y = 1 I, 2 I, ...: each block is recognised.
  for (const sdp::Block& block : problem.blocks) {
    const auto n = static_cast<std::size_t>(block.size);
    std::vector<double> values(block.diagonal ? n : n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      values[block.diagonal ? i : i * n + i] = static_cast<double>(solution.Y.values.size() + 1);
    solution.Y.values.push_back(std::move(values));
  }
  return solution;
}

inline Answer ending(sdp::Status status) {
  return [status](const sdp::Problem& problem) { return ended(status, problem); };
}
inline Answer undecided() { return ending(sdp::Status::undecided); }
inline Answer unbounded() { return ending(sdp::Status::dual_infeasible); }
inline Answer infeasible() { return ending(sdp::Status::primal_infeasible); }

/// The minimum, at these unknowns.
inline Answer minimum(const Case& of, const std::vector<double>& x) {
  return [&of, x](const sdp::Problem& problem) {
    sdp::Solution solution = ended(sdp::Status::optimal, problem);
    EXPECT_EQ(x.size(), solution.x.size()) << "the script does not fit the program";
    const lmi::Balance units = of.formulation(lmi::Goal::objective, problem).balance;
    solution.x = x;
    for (std::size_t i = 0; i < x.size(); ++i) solution.x[i] /= units.unit(static_cast<int>(i) + 1);
    return solution;
  };
}

/// A point inside, at these unknowns with x_0 = 1/2 where constants stand.
inline Answer inside(const Case& of, const std::vector<double>& x, double margin = 0.25) {
  return [&of, x, margin](const sdp::Problem& problem) {
    sdp::Solution solution = ended(sdp::Status::optimal, problem);
    const lmi::Formulation asked = of.formulation(lmi::Goal::interior, problem);
    const double one = asked.homogenised ? 0.5 : 1;
    solution.x.clear();
    for (std::size_t i = 0; i < x.size(); ++i)
      solution.x.push_back(one * x[i] / asked.balance.unit(static_cast<int>(i) + 1));
    if (asked.homogenised) solution.x.push_back(one);
    solution.x.push_back(margin);
    EXPECT_EQ(static_cast<int>(solution.x.size()), problem.m())
        << "the script does not fit the program";
    return solution;
  };
}

/// The largest margin is 0, with these multipliers of 1 x 1 blocks (in the units of the data).
inline Answer refuting(const Case& of, const std::vector<double>& Y) {
  return [&of, Y](const sdp::Problem& problem) {
    sdp::Solution solution = ended(sdp::Status::optimal, problem);
    const lmi::Balance units = of.formulation(lmi::Goal::interior, problem).balance;
    for (std::size_t k = 0; k < Y.size(); ++k)
      solution.Y.values[k] = {Y[k] / (units.row(k, 0) * units.row(k, 0))};
    return solution;
  };
}

/// Whether it is a minimum in other units, or with a weight, which a script leaves unanswered: then the
/// minimum as it was counts.
inline bool is_asked_again(const Case& of, const sdp::Problem& problem) {
  if (problem.c.empty() || problem.c.back() == -1) return false;
  const double shift = of.posed().choices().margin;
  const auto is_plain = [&](const lmi::GainBounds& bounds) {
    const sdp::Problem plain = lmi::formulate_objective(of.lmi, bounds, shift).problem;
    return plain.c == problem.c && plain.f == problem.f;
  };
  return !is_plain(of.bounds) && !is_plain({}) &&
         !is_plain(lmi::gain_bounds(of.inequalities, of.bounds.beta / 10));
}

inline constexpr AttemptKind kKinds[] = {AttemptKind::minimum,       AttemptKind::inside,
                                         AttemptKind::large_minimum, AttemptKind::blended,
                                         AttemptKind::free_minimum,  AttemptKind::free_inside,
                                         AttemptKind::in_31_digits,  AttemptKind::tighter};

/// Attempts with a script, and what holds for all of them: each kind is tried once, in their
/// order, and a record stays as it was.
class Scripted {
 public:
  Scripted(const Case& of, const std::vector<Answer>& script)
      : Scripted(
            [&of, script, at = std::size_t{0}](const sdp::Problem& problem) mutable {
              if (is_asked_again(of, problem)) return ended(sdp::Status::undecided, problem);
              if (at == script.size()) ADD_FAILURE() << "more is asked than the script has";
              return at == script.size() ? ended(sdp::Status::undecided, problem)
                                         : script[at++](problem);
            },
            of) {
    EXPECT_EQ(asked.size(), script.size()) << "less is asked than the script has";
  }

  Scripted(const Answer& answer, const Case& of)
      : attempts(of.posed(), of.bounds,
                 [this, &of, answer](const sdp::Problem& problem, const Effort& effort) {
                   (is_asked_again(of, problem) ? again : asked).push_back(problem);
                   if (!is_asked_again(of, problem)) efforts.push_back(effort);
                   return answer(problem);
                 }) {
    attempts.to_point();
    const auto before = records();
    attempts.to_end();
    const auto after = records();
    for (const Record& record : before)
      EXPECT_NE(std::find(after.begin(), after.end(), record), after.end())
          << "a record has changed";
    conclude(attempts, {}, gains);
    const std::size_t programs = asked.size();
    attempts.to_point();
    attempts.to_end();
    EXPECT_TRUE(records() == after);
    EXPECT_EQ(asked.size(), programs) << "a kind was tried twice";
    for (const AttemptKind kind : tried) {
      const sdp::Problem& posed = attempts.find(kind)->formulation.problem;
      const auto is_posed = [&](const sdp::Problem& problem) {
        return posed.blocks == problem.blocks && posed.c == problem.c && posed.f == problem.f;
      };
      EXPECT_TRUE(std::ranges::any_of(asked, is_posed) || std::ranges::any_of(again, is_posed));
    }
  }

  const Attempt& at(AttemptKind kind) const { return *attempts.find(kind); }
  const std::string& message() const { return gains.solver.message; }
  bool says(const std::string& text) const { return message().find(text) != std::string::npos; }
  double unknown(const std::string& name) const { return (*gains.find(name))(0, 0); }

  std::vector<sdp::Problem> asked, again;  ///< again: in other units
  std::vector<Effort> efforts;
  std::vector<AttemptKind> tried;
  model::Gains gains;
  Attempts attempts;

 private:
  using Record = std::tuple<AttemptKind, lmi::Goal, double, sdp::Status, bool, std::vector<double>,
                            std::vector<double>, std::vector<double>>;

  std::vector<Record> records() {
    std::vector<Record> list;
    tried.clear();
    for (const AttemptKind kind : kKinds) {
      const Attempt* attempt = attempts.find(kind);
      if (attempt == nullptr) continue;
      tried.push_back(kind);
      std::vector<double> reached;
      for (const model::Margin& margin : attempt->margins.margins)
        reached.push_back(margin.reached);
      list.emplace_back(kind, attempt->question.goal, attempt->question.bounds.beta,
                        attempt->solution.status, attempt->point, attempt->solution.x, attempt->x,
                        reached);
    }
    return list;
  }
};

}  // namespace gainsmith::design::testing
