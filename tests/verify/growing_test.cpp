#include "verify/growing.h"

#include <gtest/gtest.h>

#include "support/yaml_problem.h"
#include "verify/setup.h"

namespace gainsmith::verify {
namespace {

std::string growing(const std::string& method) {
  const tests::YamlProblem problem("problem: p\nmethod:\n  method: m\n" + method +
                                   "campaign: {runs: 3, horizon: 3}\n");
  const auto setup = make_setup(problem.instance, {});
  return growing_mode(*setup->events, setup->claims().front());
}

/// x' = x is to grow; the error of its observer obeys e' = (1 - L) e.
std::string observed(const std::string& L) {
  return growing(
      "  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: x}, output: {y: x}}\n"
      "  observer: {state: {xh: {shape: scalar, start: 0}}, flow: {xh: xh + (" +
      L + ")*(y - xh)}}\n  claims: {error: {shrinks: abs(x - xh), to: 1e-3}}\n");
}

TEST(Growing, AFlowByTheErrorAlone) {
  EXPECT_EQ(observed("-2"), "the closed loop grows: its eigenvalue 3 has a positive real part");
  EXPECT_EQ(observed("1.1"), "");
}

/// u is held: of one period x+ = (1 - g/2) x with T = 0.5.
TEST(Growing, AJumpAndAFlow) {
  const auto sampled = [](const std::string& gain) {
    return growing(
        "  plant: {state: {x: {shape: scalar}, u: {shape: scalar}}, flow: {x: u}, "
        "jump: {u: -(" +
        gain + ")*x}}\n  timer: {tau: {reset: [0.5, 0.5], first: [0, 0.5]}}\n" +
        "  claims: {settles: {shrinks: \"norm([x; u])\", to: 0.5}}\n");
  };
  EXPECT_EQ(
      sampled("5"),
      "the closed loop grows: its eigenvalue -1.5, of one period, lies outside the unit circle");
  EXPECT_EQ(sampled("3"), "");
  EXPECT_EQ(growing("  plant: {state: {x: {shape: 2}}, jump: {x: \"[0, -2; 2, 0]*x\"}}\n"
                    "  timer: {tau: {reset: [1, 1], first: [0, 1]}}\n"
                    "  claims: {settles: {shrinks: norm(x), to: 0.5}}\n"),
            "the closed loop grows: its eigenvalue 0 +- 2i, of one period, lies outside the unit "
            "circle");
}

/// The plant grows, and its observer converges, however it is written: the claim does not see it.
TEST(Growing, APlantThatTheClaimDoesNotSeeIsNoCause) {
  const auto of = [](const std::string& flow, const std::string& value) {
    return growing(
        "  plant: {state: {x: {shape: 2, start: [1, 1]}}, flow: {x: \"[0.1, 1; -1, 0.1]*x\"}, "
        "output: {y: x(1)}}\n"
        "  observer: {state: {xh: {shape: 2, start: 0}}, flow: {xh: \"" +
        flow + "\"}}\n  claims: {error: {shrinks: \"" + value + "\", to: 1e-9}}\n");
  };
  for (const std::string flow :
       {"[0.1, 1; -1, 0.1]*xh + [3; 2]*(y - xh(1))", "[-2.9, 1; -3, 0.1]*xh + [3; 2]*y"})
    for (const std::string value : {"norm(x - xh)", "abs(x(2) - xh(2))", "(x - xh)'*(x - xh)"})
      EXPECT_EQ(of(flow, value), "") << flow << " " << value;
  EXPECT_NE(of("[0.1, 1; -1, 0.1]*xh + [3; 2]*(y - xh(1))", "norm(x)"), "");
  EXPECT_NE(of("[0.1, 1; -1, 0.1]*xh - [3; 2]*(y - xh(1))", "norm(x - xh)"), "");
}

TEST(Growing, NothingIsSaidOfOtherDynamics) {
  EXPECT_EQ(growing("  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: x^3 + x}}\n"
                    "  claims: {settles: {shrinks: abs(x), to: 0.5}}\n"),
            "");
}

}  // namespace
}  // namespace gainsmith::verify
