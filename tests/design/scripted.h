// A solver that answers from a script, and climbs over it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "design/ladder.h"
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

  Posed posed() const { return {inequalities, plan, lmi}; }
};

/// Answers one program.
using Answer = std::function<sdp::Solution(const sdp::Problem&)>;

inline sdp::Solution ended(sdp::Status status, const sdp::Problem& problem) {
  sdp::Solution solution;
  solution.status = status;
  solution.cause = status == sdp::Status::optimal     ? sdp::Cause::converged
                   : status == sdp::Status::undecided ? sdp::Cause::stalled
                                                      : sdp::Cause::certificate;
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

inline Answer optimal(const std::vector<double>& x) {
  return [x](const sdp::Problem& problem) {
    sdp::Solution solution = ended(sdp::Status::optimal, problem);
    EXPECT_EQ(x.size(), solution.x.size()) << "the script does not fit the program";
    solution.x = x;
    return solution;
  };
}

inline Answer infeasible(bool checked = true) {
  return [checked](const sdp::Problem& problem) {
    sdp::Solution solution = ended(sdp::Status::primal_infeasible, problem);
    solution.certificate = {1, 1e-14, 0.25, 1e14, checked};
    return solution;
  };
}

inline Answer ending(sdp::Status status) {
  return [status](const sdp::Problem& problem) { return ended(status, problem); };
}
inline Answer undecided() { return ending(sdp::Status::undecided); }
inline Answer unbounded() { return ending(sdp::Status::dual_infeasible); }

inline constexpr Rung kRungs[] = {Rung::own, Rung::margin, Rung::free, Rung::backed_off,
                                  Rung::tighter};

/// One climb over a script, with what holds for every climb: the programs asked are those of the
/// rungs in their order, each tried once, and a record stays as it was.
class Scripted {
 public:
  Scripted(const Case& of, const std::vector<Answer>& script)
      : Scripted(
            [script, at = std::size_t{0}](const sdp::Problem& problem) mutable {
              if (at == script.size()) ADD_FAILURE() << "more is asked than the script has";
              return at == script.size() ? ended(sdp::Status::undecided, problem)
                                         : script[at++](problem);
            },
            of) {}

  Scripted(const Answer& answer, const Case& of)
      : climb(of.posed(), of.bounds, [this, answer](const sdp::Problem& problem) {
          asked.push_back(problem);
          return answer(problem);
        }) {
    climb.to_answer();
    const auto before = records();
    climb.from_point();
    const auto after = records();
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin())) << "a record has changed";
    conclude(climb, gains);
    climb.to_answer();
    climb.from_point();
    EXPECT_TRUE(records() == after);
    EXPECT_EQ(asked.size(), tried.size()) << "a rung was tried twice";
    for (std::size_t i = 0; i < tried.size(); ++i) {
      const sdp::Problem& posed = climb.find(tried[i])->formulation.problem;
      EXPECT_TRUE(posed.blocks == asked[i].blocks && posed.c == asked[i].c &&
                  posed.f == asked[i].f);
    }
  }

  const Attempt& at(Rung rung) const { return *climb.find(rung); }
  const std::string& message() const { return gains.solver.message; }
  bool says(const std::string& text) const { return message().find(text) != std::string::npos; }

  std::vector<sdp::Problem> asked;
  std::vector<Rung> tried;
  model::Gains gains;
  Climb climb;

 private:
  using Record = std::tuple<lmi::Goal, double, double, sdp::Status, bool, std::vector<double>,
                            std::vector<double>, std::vector<double>>;

  std::vector<Record> records() {
    std::vector<Record> list;
    tried.clear();
    for (const Rung rung : kRungs) {
      const Attempt* attempt = climb.find(rung);
      if (attempt == nullptr) continue;
      tried.push_back(rung);
      std::vector<double> reached;
      for (const model::Margin& margin : attempt->margins.margins)
        reached.push_back(margin.reached);
      list.emplace_back(attempt->question.goal, attempt->question.backoff,
                        attempt->question.bounds.beta, attempt->solution.status, attempt->point,
                        attempt->solution.x, attempt->x, reached);
    }
    return list;
  }
};

}  // namespace gainsmith::design::testing
