#include "claims/run_costs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "expr/program/rewrite.h"
#include "ode/chebyshev.h"

namespace gainsmith::claims {
namespace {

/// A run of x, with c beside it: x(t) = t on [0, 2], then a jump to 5, where it rests up to 3.
hybrid::Trajectory two_flows() {
  hybrid::Trajectory run;
  run.start = Eigen::Vector2d(0, 0);
  numbers::Matrix line = numbers::Matrix::Zero(2, 2);
  line.row(0) << 1, 1;
  run.parts.emplace_back(hybrid::FlowPiece{0, run.start, Eigen::Vector2d(2, 0), {{0, 2, line}}});
  run.parts.emplace_back(
      hybrid::JumpPoint{2, 0, 0, false, Eigen::Vector2d(2, 0), Eigen::Vector2d(5, 0)});
  numbers::Matrix rest = numbers::Matrix::Zero(2, 1);
  rest(0, 0) = 5;
  run.parts.emplace_back(
      hybrid::FlowPiece{1, Eigen::Vector2d(5, 0), Eigen::Vector2d(5, 0), {{2, 3, rest}}});
  run.end = 3;
  return run;
}

expr::Program program_of(expr::Op op) {
  expr::Composer compose({});
  const int x = compose.input("x");
  return compose.take(
      op == expr::Op::multiply
          ? compose.apply(op, {x, x})
          : compose.apply(op, {compose.apply(expr::Op::subtract, {x, compose.number("1")})}));
}

hybrid::StateLayout layout() {
  hybrid::StateLayout layout;
  layout.slots = {{"x", {1, 1}, 0}, {"c", {1, 1}, 1}};
  layout.size = 2;
  return layout;
}

/// c at the end of the first flow, after the jump, at t = 2.5 and at the end.
Eigen::Vector4d costs(const RunCost& cost, bool moved = false) {
  const std::vector<RunCost> all = {cost};
  const hybrid::StateLayout where = layout();
  const numbers::Values constants;
  hybrid::Trajectory run = two_flows();
  RunCosts(all, where, constants).add_to(run, moved);
  const auto& first = std::get<hybrid::FlowPiece>(run.parts[0]);
  const auto& jump = std::get<hybrid::JumpPoint>(run.parts[1]);
  const auto& last = std::get<hybrid::FlowPiece>(run.parts[2]);
  EXPECT_EQ(first.start(1), 0);
  EXPECT_EQ(jump.before(1), first.end(1));
  EXPECT_EQ(last.start(1), jump.after(1));
  return {first.end(1), jump.after(1), last.steps.back()(2.5)(1), last.end(1)};
}

TEST(RunCosts, AreThoseOfThePolynomialsThatRunsAre) {
  const Eigen::Vector4d found = costs({1, program_of(expr::Op::multiply), {}});
  const Eigen::Vector4d wanted(8.0 / 3, 8.0 / 3, 8.0 / 3 + 12.5, 8.0 / 3 + 25);
  EXPECT_LE((found - wanted).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RunCosts, KinksAreFound) {
  const Eigen::Vector4d found = costs({1, program_of(expr::Op::abs), {}});
  const Eigen::Vector4d wanted(1, 1, 3, 5);
  EXPECT_LE((found - wanted).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(RunCosts, OfAJumpAreOfTheValuesBeforeIt) {
  const double before = std::get<hybrid::JumpPoint>(two_flows().parts[1]).before(0);
  const expr::Program square = program_of(expr::Op::multiply);
  const double cost = before * before;
  EXPECT_NE(cost, 0);
  EXPECT_EQ(costs({1, {}, square}), Eigen::Vector4d(0, cost, cost, cost));
  const Eigen::Vector4d both = costs({1, square, square});
  const Eigen::Vector4d flow = costs({1, square, {}});
  EXPECT_LE((both - flow - Eigen::Vector4d(0, cost, cost, cost)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RunCosts, ThatOfATwinIsMovedByTheErrorOfTheQuadrature) {
  const RunCost square{1, program_of(expr::Op::multiply), {}};
  const double moved = costs(square, true)(3) - costs(square)(3);
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, 1e-9);
}

}  // namespace
}  // namespace gainsmith::claims
