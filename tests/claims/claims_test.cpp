// Claims along runs of methods with events, whose truth is known by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "claims/case.h"
#include "claims/run_setup.h"
#include "io/problem_text.h"
#include "verify/campaign.h"
#include "verify/replay.h"

namespace gainsmith::verify {
namespace {

using model::CampaignVerdict;

/// A problem with these parts of its method and of itself.
model::Instance instance_of(const std::string& method, const std::string& claims,
                            const std::string& campaign, const std::string& more = "") {
  return bind::bind(io::read_problem("problem: p\nmethod:\n  method: m\n" + method + "  claims: " +
                                     claims + "\ncampaign: " + campaign + "\n" + more));
}

Report report_of(const model::Instance& instance) {
  CampaignOptions options;
  options.threads = 1;
  return run_campaign(*make_setup(instance, {}), options);
}

/// x = exp(-t); y = sin(50 t); z' = 1, z+ = 0.9 z when it comes to 1; q counts.
const std::string kMethod = R"(  data: {a: {shape: scalar, default: 1}}
  events: {tick: {every: 1}, full: {when: plant.z >= 1}}
  plant:
    state:
      x: {shape: scalar, start: 1}
      y: {shape: 2, start: "[0; 1]"}
      z: {shape: scalar, start: 0}
      q: {shape: scalar, start: 0}
    flow: {x: -a*x, y: "50*[y(2); -y(1)]", z: 1}
    at: {tick: {q: q + 1}, full: {z: 0.87*z}}
)";

class ClaimsAlongRuns : public testing::TestWithParam<Case> {};

TEST_P(ClaimsAlongRuns, AreJudgedAsTheyAre) {
  const Report report =
      report_of(instance_of(kMethod, "{c: {" + GetParam().claim + "}}", "{runs: 1, horizon: 4.5}"));
  EXPECT_EQ(report.verdict, GetParam().verdict)
      << report.checks[0].worst.value << " against " << report.checks[0].worst.bound;
}

// exp(-1) = 0.36787944, exp(-4.5) = 0.011108997.
INSTANTIATE_TEST_SUITE_P(
    Bounds, ClaimsAlongRuns,
    testing::Values(Case{"below: x, bound: 1.00001", CampaignVerdict::held},
                    Case{"below: x, bound: 0.99999", CampaignVerdict::violated},
                    Case{"below: x, bound: exp(-1) + 1e-6, after: a", CampaignVerdict::held},
                    Case{"below: x, bound: exp(-1) - 1e-6, after: 1", CampaignVerdict::violated},
                    // The peaks lie between the parts at which flows are cut.
                    Case{"below: y(1), bound: 1 + 1e-6", CampaignVerdict::held},
                    Case{"below: y(1), bound: 1 - 1e-6", CampaignVerdict::violated},
                    Case{"above: y(1), bound: -1 - 1e-6", CampaignVerdict::held},
                    Case{"above: y(1), bound: -1 + 1e-6", CampaignVerdict::violated},
                    Case{"above: x, bound: exp(-4.5) - 1e-6", CampaignVerdict::held},
                    Case{"above: x, bound: exp(-4.5) + 1e-6", CampaignVerdict::violated},
                    Case{"above: z, bound: 0.87 - 1e-9, after: 1", CampaignVerdict::held}));

INSTANTIATE_TEST_SUITE_P(
    Rates, ClaimsAlongRuns,
    testing::Values(Case{"below: rate(x^2) + 1.99*x^2, bound: 0", CampaignVerdict::held},
                    Case{"below: rate(x^2) + 2.01*x^2, bound: 0", CampaignVerdict::violated},
                    Case{"below: rate(x) + 0.5*a*x, bound: 0", CampaignVerdict::held},
                    Case{"above: rate(z), bound: 0.999", CampaignVerdict::held},
                    Case{"above: rate(z), bound: 1.001", CampaignVerdict::violated},
                    Case{"below: rate(since(tick)*tick.left), bound: 1.001", CampaignVerdict::held},
                    Case{"below: rate(since(tick)*tick.left), bound: 0.999",
                         CampaignVerdict::violated}));

// An equation is neither.
INSTANTIATE_TEST_SUITE_P(Equations, ClaimsAlongRuns,
                         testing::Values(Case{"nonincreasing: y'*y", CampaignVerdict::undecided},
                                         Case{"below: norm(y), bound: 1",
                                              CampaignVerdict::undecided}));

/// r' = -r^2, r = 1/(1 + t), integrated.
TEST(ClaimsAlongRuns, AnEquationWithAClosedFormIsUndecided) {
  const std::string method = "  plant: {state: {r: {shape: scalar, start: 1}}, flow: {r: -r^2}}\n";
  for (const char* claim :
       {"below: rate(r) + 1/(1 + t)^2, bound: 0", "above: rate(r) + 1/(1 + t)^2, bound: 0",
        "below: r*(1 + t), bound: 1, after: 0.1", "above: r*(1 + t), bound: 1, after: 0.1"}) {
    const Report report = report_of(
        instance_of(method, "{c: {" + std::string(claim) + "}}", "{runs: 1, horizon: 4}"));
    EXPECT_EQ(report.verdict, CampaignVerdict::undecided) << claim;
    EXPECT_EQ(report.violations, 0U) << claim;
  }
}

/// 1e-6 decides an equation; what is off by more stays violated.
TEST(ClaimsAlongRuns, AToleranceHoldsAnEquation) {
  const std::string method = "  plant: {state: {r: {shape: scalar, start: 1}}, flow: {r: -r^2}}\n";
  const auto verdict = [&](const std::string& claim) {
    const Report report =
        report_of(instance_of(method, "{c: {" + claim + "}}", "{runs: 1, horizon: 4}"));
    EXPECT_GT(report.checks[0].worst.tolerance, 0) << claim;
    return report.verdict;
  };
  for (const std::string claim :
       {"below: r*(1 + t), bound: 1", "above: r*(1 + t), bound: 1", "above: -r*(1 + t), bound: -1",
        "below: rate(r) + 1/(1 + t)^2, bound: 0", "above: rate(r) + 1/(1 + t)^2, bound: 0",
        "below: 1e9*(rate(r) + 1/(1 + t)^2), bound: 0", "nonincreasing: r*(1 + t)",
        "nonincreasing: -r*(1 + t)", "cost: {flow: r^2}, below: r - 0.2", "shrinks: r, to: 0.2",
        "shrinks: -r, to: 0.2", "below: r*(1 + 5e-7), bound: 1"})
    EXPECT_EQ(verdict(claim + ", tolerance: 1e-6"), CampaignVerdict::held) << claim;
  for (const std::string claim :
       {"below: r*(1 + t)*(1 + 2e-6), bound: 1", "above: r*(1 + t)*(1 - 2e-6), bound: 1",
        "above: -r*(1 + t)*(1 + 2e-6), bound: -1",
        "below: rate(r) + (1 + 3e-6)/(1 + t)^2, bound: 0", "nonincreasing: r*(1 + t)*(1 + 1e-6*t)",
        "nonincreasing: -r*(1 + t)*(1 - 1e-6*t)", "cost: {flow: r^2}, below: (r - 0.2)*(1 - 2e-6)",
        "shrinks: r, to: 0.2*(1 - 2e-6)", "shrinks: -r, to: 0.2*(1 + 2e-6)"})
    EXPECT_EQ(verdict(claim + ", tolerance: 1e-6"), CampaignVerdict::violated) << claim;
}

/// An LQR cost is x'*P*x in truth: x' = x + u, u = -(1 + sqrt(2)) x, P = 1 + sqrt(2).
TEST(ClaimsAlongRuns, AToleranceHoldsAnOptimalCostOfBoundedRuns) {
  const std::string method =
      "  let: {k: 1 + sqrt(2)}\n  timer: {tau: {reset: [0.5, 1]}}\n"
      "  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: x - k*x}}\n";
  const std::string cost = "cost: {flow: (1 + k^2)*x^2}, below: k*x^2";
  const auto verdict = [&](const std::string& claim) {
    return report_of(instance_of(method, "{c: {" + claim + "}}", "{runs: 2, horizon: 30}")).verdict;
  };
  EXPECT_NE(verdict(cost), CampaignVerdict::held);
  EXPECT_EQ(verdict(cost + ", tolerance: 1e-9"), CampaignVerdict::held);
  EXPECT_EQ(verdict("cost: {flow: (1 + k^2)*x^2}, below: k*x^2*(1 - 1e-8), tolerance: 1e-9"),
            CampaignVerdict::violated);
}

/// x = exp(-t), an exact flow: both runs round alike.
TEST(ClaimsAlongRuns, AnEquationOfAnExactFlowIsNotViolated) {
  const std::string method = "  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: -x}}\n";
  for (const char* claim :
       {"below: rate(x) + exp(-t), bound: 0", "above: rate(x) + exp(-t), bound: 0",
        "below: x*exp(t), bound: 1", "above: x*exp(t), bound: 1", "below: rate(x) + x, bound: 0"}) {
    const Report report = report_of(
        instance_of(method, "{c: {" + std::string(claim) + "}}", "{runs: 1, horizon: 5}"));
    EXPECT_EQ(report.violations, 0U) << claim;
  }
}

INSTANTIATE_TEST_SUITE_P(
    OverEvents, ClaimsAlongRuns,
    testing::Values(Case{"nonincreasing: z, over: full", CampaignVerdict::undecided},
                    Case{"nonincreasing: z - 1e-6*t, over: full", CampaignVerdict::held},
                    Case{"nonincreasing: z + 1e-6*t, over: full", CampaignVerdict::violated},
                    Case{"nonincreasing: z, after: 1", CampaignVerdict::violated},
                    Case{"nonincreasing: -x, over: tick", CampaignVerdict::violated},
                    Case{"nonincreasing: x - q, over: tick", CampaignVerdict::held},
                    Case{"below: q, bound: 3.5, after: 1.5", CampaignVerdict::violated},
                    Case{"above: q, bound: 0.5, over: tick", CampaignVerdict::held},
                    Case{"above: q, bound: 1.5, over: tick", CampaignVerdict::violated},
                    Case{"above: q, bound: 0.5", CampaignVerdict::violated},
                    Case{"above: q, bound: 1.5, over: tick, after: 1.5", CampaignVerdict::held}));

TEST(ClaimsAlongRuns, WhatFallsToItsBoundIsHeldAndSaysHowFar) {
  // V = x^2: rate(V) + V <= -V -> 0, down to 1e-35 of what it was, far below what is integrated.
  const std::string method =
      "  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: -x - x^3}}\n";
  const Report report = report_of(
      instance_of(method, "{c: {below: \"rate(x^2) + x^2\", bound: 0}}", "{runs: 1, horizon: 40}"));
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
  EXPECT_GT(report.checks[0].floor, 0);
  EXPECT_LT(report.checks[0].floor, 1e-8);
}

/// z+ = 4 z (1 - z) at every tick: the rounding of z doubles, and after 50 ticks it is all of z.
TEST(ClaimsAlongRuns, TwoRunsThatHavePartedSayNothingMore) {
  const std::string method = R"(  events: {tick: {every: 1}}
  plant:
    state: {x: {shape: scalar, start: 1}, z: {shape: scalar, start: 0.3}}
    flow: {x: -x - x^3}
    at: {tick: {z: 4*z*(1 - z)}}
)";
  const auto verdict = [&](const char* claim, const char* horizon) {
    return report_of(instance_of(method, "{c: {" + std::string(claim) + "}}",
                                 "{runs: 1, horizon: " + std::string(horizon) + "}"))
        .verdict;
  };
  EXPECT_EQ(verdict("below: z, bound: 1.01", "20.5"), CampaignVerdict::held);
  EXPECT_EQ(verdict("below: z, bound: 1.01", "100.5"), CampaignVerdict::undecided);
  EXPECT_EQ(verdict("below: rate(x^2) + x^2, bound: 0", "40"), CampaignVerdict::held);
}

/// Two filters that are equal on a linear plant differ by rounding, which says nothing of chaos.
TEST(ClaimsAlongRuns, EqualSignalsHaveNotParted) {
  const std::string method = R"yaml(  events: {tick: {every: 0.1}}
  plant:
    state: {x: {shape: 2, start: "[2; 0]"}}
    output: {y: {value: x(1), at: tick}}
    flow: {x: "[x(2); -x(1) - 0.2*x(2)]"}
  observers:
    one:
      state: {z: {shape: 2, start: "[1; 1]"}}
      flow: {z: "[z(2); -z(1) - 0.2*z(2)]"}
      at: {tick: {z: "z + [0.3; 0.1]*(y - z(1))"}}
    other:
      state: {z: {shape: 2, start: "[1; 1]"}}
      flow: {z: "[z(2); -z(1) - 0.2*z(2)]"}
      at: {tick: {z: "[0.7, 0; -0.1, 1]*z + [0.3; 0.1]*y"}}
)yaml";
  const Report report = report_of(instance_of(
      method, "{c: {below: norm(one.z - other.z), bound: 1e-9}}", "{runs: 1, horizon: 20}"));
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
}

/// An angle between a state and its estimate, which is 0 but for rounding, is far from its branch.
TEST(ClaimsAlongRuns, AWrappedAngleBesideZeroHasNoBranch) {
  const std::string method = R"yaml(  events: {tick: {every: 0.2}}
  plant: {state: {x: {shape: scalar, start: 2.8}}, output: {y: {value: x, at: tick}}, flow: {x: 0.5}}
  observer:
    state: {z: {shape: 2, start: "[2.8; 0.5]"}}
    flow: {z: "[z(2); 0]"}
    at: {tick: {z: "[z(1) + 0.5*(y - z(1)); z(2) + 0.3*(y - z(1))]"}}
  signals: {e: "x - z(1)"}
)yaml";
  for (const char* value : {"abs(atan2(sin(e), cos(e)))", "atan2(sin(e), cos(e))",
                            "max(abs(e), abs(2*e))", "abs(mod(e + pi, 2*pi) - pi)"}) {
    const Report report =
        report_of(instance_of(method, "{c: {below: \"" + std::string(value) + "\", bound: 0.4}}",
                              "{runs: 1, horizon: 0.7}"));
    EXPECT_EQ(report.verdict, CampaignVerdict::held) << value;
  }
}

/// u is 0.2 at many ticks, as clip says; 3*u is computed, and rounding alone decides.
TEST(ClaimsAlongRuns, AnInputAtItsLimitIsEqualToIt) {
  const std::string method = R"yaml(  events: {tick: {every: 0.1, first: 0}}
  plant: {state: {x: {shape: 2, start: 0}}, output: {y: x(1)}, flow: {x: "[x(2); -x(2) + observer.u]"}}
  observer:
    state: {z: {shape: scalar, start: 0}, u: {shape: scalar, start: 0}}
    at: {tick: {let: {e: 1 - y}, u: "clip(2*e + z, -0.2, 0.2)", z: z + 0.1*e}}
)yaml";
  const auto verdict = [&](const char* claim) {
    return report_of(
               instance_of(method, "{c: {" + std::string(claim) + "}}", "{runs: 1, horizon: 40}"))
        .verdict;
  };
  EXPECT_EQ(verdict("below: abs(u), bound: 0.2"), CampaignVerdict::held);
  EXPECT_EQ(verdict("below: u, bound: 0.2"), CampaignVerdict::held);
  EXPECT_EQ(verdict("above: u, bound: -0.2"), CampaignVerdict::held);
  EXPECT_EQ(verdict("below: u, bound: 0.19999999"), CampaignVerdict::violated);
  EXPECT_EQ(verdict("below: 3*u, bound: 0.6"), CampaignVerdict::undecided);
}

/// Of a branch that both runs take their difference says nothing, once they have parted.
TEST(ClaimsAlongRuns, ABranchOnWhatHasPartedIsUnknown) {
  const std::string method = R"yaml(  events: {tick: {every: 1}}
  plant:
    state: {a: {shape: scalar, start: 0.4}, b: {shape: scalar, start: 0.4}}
    at: {tick: {a: 3.9*a*(1 - a), b: 3.9*b - 3.9*b^2}}
)yaml";
  const auto verdict = [&](const char* claim) {
    return report_of(instance_of(method, "{c: {" + std::string(claim) + "}}",
                                 "{runs: 1, horizon: 300.5}"))
        .verdict;
  };
  EXPECT_EQ(verdict("below: sign(a - b), bound: 0.5"), CampaignVerdict::undecided);
  EXPECT_EQ(verdict("below: \"sat(a - b, 0.2)\", bound: 0.1"), CampaignVerdict::undecided);
  EXPECT_EQ(verdict("below: abs(a - b), bound: 1e-3"), CampaignVerdict::undecided);
  EXPECT_EQ(verdict("below: \"where(j == 213, where(a > 0.5, 3, -1), -1)\", bound: 0"),
            CampaignVerdict::undecided);
}

/// A filter whose arithmetic stands still before its limit has computed its value at each tick.
TEST(ClaimsAlongRuns, WhatStandsStillHasBeenComputed) {
  const auto verdict = [&](const char* start, const char* map, const char* claim) {
    const std::string method = R"yaml(  events: {tick: {every: 1}}
  plant: {state: {x: {shape: scalar, start: )yaml" +
                               std::string(start) + "}}, at: {tick: {x: " + map + "}}}\n";
    return report_of(instance_of(method, "{c: {" + std::string(claim) + "}}",
                                 "{runs: 1, horizon: 2400.5}"))
        .verdict;
  };
  EXPECT_EQ(verdict("0", "0.98*x + 0.4", "below: x, bound: 19.99999999999994, after: 2300"),
            CampaignVerdict::undecided);
  EXPECT_EQ(verdict("2.9999999999999", "x + 0.001*(3 - x)",
                    "above: x, bound: 2.99999999999991, after: 2300"),
            CampaignVerdict::undecided);
}

/// On the stable direction of a map: x(1) = 0.6^n while rounding doubles at each tick. In the twin
/// its largest terms nearly cancel. The bound is the true value and a thousandth of it. 31 digits
/// know it after 30 ticks, and no more after 60.
TEST(ClaimsAlongRuns, WhatRoundingMakesMayNearlyCancel) {
  const auto verdict = [&](const char* ticks, const char* bound) {
    const std::string method =
        R"(  events: {tick: {every: 1}, end: {at: [)" + std::string(ticks) + R"(.5]}}
  plant:
    state: {x: {shape: 2, start: "[1; 7/10]"}}
    at: {tick: {x: "[29/32, -7/16; -49/64, 271/160]*x"}}
)";
    return report_of(instance_of(method,
                                 "{c: {below: x(1), bound: " + std::string(bound) + ", over: end}}",
                                 "{runs: 1, horizon: " + std::string(ticks) + ".7}"))
        .verdict;
  };
  EXPECT_EQ(verdict("30", "2.2129499364045409e-7"), CampaignVerdict::held);
  EXPECT_EQ(verdict("60", "4.8922577e-14"), CampaignVerdict::undecided);
}

/// Ten lengths of 0.1 add up to a little less than 1.
TEST(ClaimsAlongRuns, AJumpAtTheRoundedTimeIsNotBeforeIt) {
  const std::string method = R"(  events: {tick: {every: [0.1, 0.4], first: 0.1}}
  plant:
    state: {x: {shape: scalar, start: 1}}
    flow: {x: -x}
    at: {tick: {x: 0.9*x}}
)";
  const auto verdict = [&](const char* claims, const char* campaign) {
    return report_of(instance_of(method, claims,
                                 "{horizon: 8, sampling: {tick: [{constant: 0.1}]}, " +
                                     std::string(campaign) + "}"))
        .verdict;
  };
  // exp(-1)*0.9^10 = 0.1282717
  for (const char* campaign : {"runs: 1", "runs: 16, initial: {x: {box: [1, 1.01]}}"}) {
    const char* beyond = "{c: {below: x, bound: 0.12, over: tick, after: 1}}";
    EXPECT_EQ(verdict(beyond, campaign), CampaignVerdict::violated) << campaign;
    const char* within =
        "{c: {below: x, bound: 0.13, over: tick, after: 1}, v: {nonincreasing: x}}";
    EXPECT_EQ(verdict(within, campaign), CampaignVerdict::held) << campaign;
  }
}

/// Two clocks strike at 0.1, in the order of the file; the first one leads to `step`.
TEST(ClaimsAlongRuns, WhatAClockLeadsToComesBeforeTheNextClock) {
  const std::string method =
      R"(  events: {tick: {every: 0.1}, step: {when: q > 0}, spot: {at: [0.1]}}
  plant:
    state: {x: {shape: scalar, start: 1}}
    mode: {q: 0}
    flow: {x: -x}
    at: {tick: {q: 1}, step: {q: q - 1, x: 0.9*x}, spot: {x: x + 1}}
)";
  const Report report =
      report_of(instance_of(method, "{c: {below: x, bound: 3}}", "{runs: 1, horizon: 1}"));
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
}

TEST(ClaimsAlongRuns, AViolationIsFoundWhereItIs) {
  const Report report = report_of(
      instance_of(kMethod, "{c: {below: x, bound: 0.3, after: 1}}", "{runs: 1, horizon: 4.5}"));
  const claims::Finding& worst = report.checks[0].worst;
  EXPECT_EQ(worst.t, 1);
  EXPECT_NEAR(worst.value, std::exp(-1), 1e-8);
  EXPECT_EQ(worst.bound, 0.3);
}

TEST(ClaimsAlongRuns, AnEventThatNeverHappensLeavesNothingToCompare) {
  const std::string method = R"(  events: {never: {when: plant.x > 2}}
  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: -x}, at: {never: {x: 0}}}
)";
  const Report report = report_of(
      instance_of(method, "{c: {above: x, bound: 5, over: never}}", "{runs: 1, horizon: 1}"));
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
}

TEST(ClaimsAlongRuns, AClaimOverAnEventOfAnObserverIsOneOfThoseThatHaveIt) {
  const std::string method =
      R"(  plant: {state: {x: {shape: scalar, start: 1}}, output: {y: x}, flow: {x: -x}}
  observers:
    plain:    {state: {xh: {shape: scalar, start: 3}}, flow: {xh: -xh + y - xh}}
    clipping: {like: plain, events: {far: {when: xh >= 2}}, at: {far: {xh: 2 - 1e-3}}}
)";
  const Report report = report_of(
      instance_of(method, "{c: {below: xh, bound: 2, over: far}}", "{runs: 1, horizon: 1}"));
  ASSERT_EQ(report.checks.size(), 1U);
  EXPECT_EQ(report.checks[0].name, "clipping.c");
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
}

TEST(ClaimsAlongRuns, AClaimThatBeginsAfterTheRunsIsRefused) {
  try {
    report_of(
        instance_of(kMethod, "{c: {below: x, bound: 2, after: 9}}", "{runs: 1, horizon: 4.5}"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the runs end at 4.5"), std::string::npos);
  }
}

/// The columns of a replay, by name.
Eigen::VectorXd column(const Replay& replay, const std::string& name) {
  for (std::size_t k = 0; k < replay.columns.size(); ++k)
    if (replay.columns[k].name == name) return replay.table.col(static_cast<Eigen::Index>(k));
  ADD_FAILURE() << "no column " << name;
  return {};
}

/// rate(v) against the difference quotient of v, along random runs with clocks, a frozen component,
/// a switch, a sinusoid and matrices.
TEST(Rate, IsTheLimitOfDifferenceQuotients) {
  const std::string method = R"(  data: {A: {shape: 2 x 2, default: "[0, 1; -2, -0.3]"}}
  events: {sample: {every: [0.3, 0.9]}}
  noise: {w: {sinusoid: {amplitude: [0.5, 1], frequency: [1, 3], phase: [0, 6]}}}
  plant:
    state: {x: {shape: 2}, P: {shape: symmetric 2, start: "[2, 0.3; 0.3, 1]"}}
    output: {y: x(1)}
    flow: {x: "A*x + [0; 0.2]*sin(x(1)) + [w; 0]", P: He(A*P) + I}
  observer:
    state: {z: {shape: 2}, s: {shape: scalar, start: 0}}
    mode: {q: 0}
    frozen: q == 1
    flow: {z: "A*z + [y; where(z(1) > 0, 1, -2)]", s: 1}
    at: {sample: {q: 1 - q}}
  signals:
    v:  "x'*P*x + exp(-z(1)^2)*s + sin(w)*since(sample) + sample.left*t"
    dv: rate(v)
    u:  "[z; trace(P)]"
    du: rate(u)
)";
  const auto instance =
      instance_of(method, "{c: {below: v, bound: 1e9}}",
                  "{runs: 3, horizon: 2, initial: {x: {box: [-2, 2]}, z: {box: [-2, 2]}}}");
  constexpr double kStep = 1e-4;
  for (std::uint64_t run = 0; run < 3; ++run) {
    const Replay replay = replay_run(*make_setup(instance, {}), 1, run, kStep);
    const Eigen::VectorXd t = column(replay, "t");
    const Eigen::VectorXd j = column(replay, "j");
    const Eigen::VectorXd z = column(replay, "z1");
    int compared = 0;
    for (const auto& [value, rate] : {std::pair("v", "dv"), std::pair("u1", "du1"),
                                      std::pair("u2", "du2"), std::pair("u3", "du3")}) {
      const Eigen::VectorXd of = column(replay, value);
      const Eigen::VectorXd by = column(replay, rate);
      for (Eigen::Index k = 1; k + 1 < t.size(); ++k) {
        const bool inside = j(k - 1) == j(k + 1) && std::abs(t(k + 1) - t(k) - kStep) < 1e-9 &&
                            std::abs(t(k) - t(k - 1) - kStep) < 1e-9 && z(k - 1) * z(k + 1) > 0;
        if (!inside) continue;
        ++compared;
        const double quotient = (of(k + 1) - of(k - 1)) / (2 * kStep);
        ASSERT_NEAR(by(k), quotient, 1e-5 * (1 + std::abs(quotient))) << value << " at " << t(k);
      }
    }
    EXPECT_GT(compared, 50000);
  }
}

TEST(Rate, OfAFrozenStateIsZero) {
  const std::string method = R"(  events: {stop: {at: [1]}}
  plant:
    state: {x: {shape: scalar, start: 1}}
    mode: {q: 0}
    frozen: q == 1
    flow: {x: 2 - x}
    at: {stop: {q: 1}}
  signals: {r: rate(x)}
)";
  const auto instance = instance_of(method, "{c: {below: r, bound: 9}}", "{runs: 1, horizon: 2}");
  const Replay replay = replay_run(*make_setup(instance, {}), 1, 0, 0.25);
  const Eigen::VectorXd t = column(replay, "t");
  const Eigen::VectorXd j = column(replay, "j");
  const Eigen::VectorXd r = column(replay, "r");
  for (Eigen::Index k = 0; k < t.size(); ++k)
    EXPECT_NEAR(r(k), j(k) == 1 ? 0 : std::exp(-t(k)), 1e-8) << t(k);
}

}  // namespace
}  // namespace gainsmith::verify
