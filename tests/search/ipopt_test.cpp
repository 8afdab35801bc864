#include "search/ipopt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace gainsmith::search {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// The point of the circle x^2 + y^2 = 2 with the smallest x + y, x >= low.
SmoothProgram circle(double low) {
  SmoothProgram program;
  program.start = {1, -1.5};
  program.low = {low, -kNone};
  program.high = {kNone, kNone};
  program.constraints = 1;
  program.objective = [](const auto& v) { return v[0] + v[1]; };
  program.gradient = [](const auto&) { return std::vector<double>{1, 1}; };
  program.residuals = [](const auto& v) {
    return std::vector<double>{v[0] * v[0] + v[1] * v[1] - 2};
  };
  program.rows = {0, 0};
  program.columns = {0, 1};
  program.jacobian = [](const auto& v) { return std::vector<double>{2 * v[0], 2 * v[1]}; };
  return program;
}

TEST(Ipopt, SolvesAProgramWithEqualitiesAndBounds) {
  const SmoothSolution free = ipopt_solver()(circle(-kNone), 1e-9, 200);
  EXPECT_TRUE(free.converged) << free.cause;
  EXPECT_NEAR(free.v[0], -1, 1e-6);
  EXPECT_NEAR(free.v[1], -1, 1e-6);
  const SmoothSolution bounded = ipopt_solver()(circle(0.5), 1e-9, 200);
  EXPECT_TRUE(bounded.converged) << bounded.cause;
  EXPECT_NEAR(bounded.v[0], 0.5, 1e-6);
  EXPECT_NEAR(bounded.v[1], -std::sqrt(1.75), 1e-6);
}

TEST(Ipopt, SaysWhyItStoppedAndPassesExceptionsOn) {
  const SmoothSolution cut = ipopt_solver()(circle(-kNone), 1e-9, 1);
  EXPECT_FALSE(cut.converged);
  EXPECT_EQ(cut.cause, "iteration limit");
  SmoothProgram failing = circle(-kNone);
  failing.residuals = [](const auto&) -> std::vector<double> { throw std::runtime_error("no"); };
  EXPECT_THROW(ipopt_solver()(failing, 1e-9, 50), std::runtime_error);
}

}  // namespace
}  // namespace gainsmith::search
