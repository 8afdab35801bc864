// Claims and figures whose texts branch between two sample points, or whose evaluation cancels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <tuple>

#include "base/number.h"
#include "bind/bind.h"
#include "claims/case.h"
#include "io/problem_text.h"
#include "support/input_error.h"
#include "verify/campaign.h"
#include "verify/expected_run.h"

namespace gainsmith::verify {
namespace {

using model::CampaignVerdict;

/// x = t, y = exp(-t) and r' = -r + 0.1 sin(r), which makes the whole flow one that is integrated.
model::Instance instance_of(const std::string& claims, bool integrated,
                            const std::string& more = "") {
  const std::string plant = integrated ? R"(    state:
      x: {shape: scalar, start: 0}
      y: {shape: scalar, start: 1}
      r: {shape: scalar, start: 1}
    flow: {x: "1", y: -y, r: -r + 0.1*sin(r)}
)"
                                       : R"(    state:
      x: {shape: scalar, start: 0}
      y: {shape: scalar, start: 1}
    flow: {x: "1", y: -y}
)";
  return bind::bind(io::read_problem("problem: p\nmethod:\n  method: m\n" + more + "  plant:\n" +
                                     plant + "  claims: " + claims +
                                     "\ncampaign: {runs: 1, horizon: 3}\n"));
}

CampaignVerdict verdict_of(const std::string& claim, bool integrated) {
  CampaignOptions options;
  options.threads = 1;
  return run_campaign(*make_setup(instance_of("{c: {" + claim + "}}", integrated), {}), options)
      .verdict;
}

class NarrowClaims : public testing::TestWithParam<Case> {};

TEST_P(NarrowClaims, AreJudgedAsTheyAre) {
  for (const bool integrated : {false, true})
    EXPECT_EQ(verdict_of(GetParam().claim, integrated), GetParam().verdict) << integrated;
}

const std::string kBand = "where(x > 1.26, where(x < 1.2601, 1, 0), 0)";
const std::string kTent = "max(0, 1 - abs(x - 1.2345)/0.001)";

INSTANTIATE_TEST_SUITE_P(
    Jumps, NarrowClaims,
    testing::Values(
        Case{"below: \"" + kBand + "\", bound: 0.5", CampaignVerdict::violated},
        Case{"below: \"" + kBand + "\", bound: 1.1", CampaignVerdict::held},
        Case{"nonincreasing: \"y + 0.1*" + kBand + "\"", CampaignVerdict::violated},
        Case{"nonincreasing: \"y - 0.1*sign(x - 1.1)\"", CampaignVerdict::held},
        Case{"below: sign(x - 1) - sign(x - 1.001), bound: 1.5", CampaignVerdict::violated},
        Case{"above: floor(10*x) - 10*x, bound: -0.999", CampaignVerdict::violated},
        Case{"above: floor(10*x) - 10*x, bound: -1.0001", CampaignVerdict::held},
        Case{"below: \"mod(x, 0.07)\", bound: 0.0699", CampaignVerdict::violated},
        Case{"below: \"mod(x, 0.07)\", bound: 0.0701", CampaignVerdict::held},
        Case{"below: \"" + kBand + "\", bound: 0.5, after: 1.2602", CampaignVerdict::held},
        Case{"above: \"atan2(x - 2, -1)\", bound: -3.1415", CampaignVerdict::violated}));

INSTANTIATE_TEST_SUITE_P(
    Kinks, NarrowClaims,
    testing::Values(Case{"below: \"" + kTent + "\", bound: 0.9999", CampaignVerdict::violated},
                    Case{"below: \"" + kTent + "\", bound: 1.0001", CampaignVerdict::held},
                    Case{"nonincreasing: \"y + " + kTent + "\"", CampaignVerdict::violated},
                    Case{"below: \"rate(" + kTent + ")\", bound: 900", CampaignVerdict::violated},
                    Case{"below: \"rate(" + kTent + ")\", bound: 1000.1", CampaignVerdict::held},
                    Case{"above: \"rate(abs(x - 1))\", bound: -1.001", CampaignVerdict::held},
                    Case{"nonincreasing: \"y + 0*" + kTent + "\"", CampaignVerdict::held}));

// Texts that are faster than the steps of a clock, which are a 16th of the horizon.
INSTANTIATE_TEST_SUITE_P(
    FasterThanTheSteps, NarrowClaims,
    testing::Values(
        Case{"below: sin(20*x)*exp(-(x - 1.5)^2/10), bound: 0.9975", CampaignVerdict::violated},
        Case{"below: sin(20*x)*exp(-(x - 1.5)^2/10), bound: 0.999", CampaignVerdict::held},
        Case{"below: sin(600*x)*exp(-(x - 1.5)^2), bound: 0.9999", CampaignVerdict::violated},
        Case{"above: sin(60*t) - 0.1*t, bound: -1.29", CampaignVerdict::violated},
        Case{"above: sin(60*t) - 0.1*t, bound: -1.3", CampaignVerdict::held},
        Case{"nonincreasing: sin(60*x) - 59.9*x", CampaignVerdict::violated},
        Case{"below: sign(x)*(1 + sin(20*t)), bound: 1.999", CampaignVerdict::violated},
        Case{"below: \"where(sin(60*x) > 0.9, 1, 0)\", bound: 0.5", CampaignVerdict::violated},
        Case{"nonincreasing: \"where(sin(134*x) > 0.9, 1, 0) - x\"", CampaignVerdict::violated},
        Case{"nonincreasing: 1 + 3e-9*sin(400*x) - 1e-7*x", CampaignVerdict::violated},
        Case{"nonincreasing: sin(60*t) - 60.1*t", CampaignVerdict::held}));

// An equation whose evaluation rounds is neither held nor violated for certain, whatever else there
// is.
INSTANTIATE_TEST_SUITE_P(
    Cancellation, NarrowClaims,
    testing::Values(
        Case{"above: (1e15 + y/3) - 1e15 - y/3, bound: 0", CampaignVerdict::undecided},
        Case{"above: (1e15 + y/3) - 1e15 - y/3, bound: 0.001", CampaignVerdict::undecided},
        Case{"below: exp(log(y)) - y, bound: 0", CampaignVerdict::undecided},
        Case{"below: t*0.1*10 - t, bound: 0", CampaignVerdict::undecided},
        Case{"below: rate(y) + exp(-t) + 0*rate(abs(x - 1)), bound: 0", CampaignVerdict::undecided},
        Case{"above: (1e15 + y/3) - 1e15 - y/3, bound: -2", CampaignVerdict::held}));

// Differences of large numbers that are elements of vectors: their rounding is no branch.
INSTANTIATE_TEST_SUITE_P(
    RoundedDifferences, NarrowClaims,
    testing::Values(Case{"below: \"abs([1000*y - 999.99*y - 0.001, 0](1))\", bound: 100",
                         CampaignVerdict::held},
                    Case{"below: \"abs([1, 0]*[1000*y - 999.99*y - 0.001; x])\", bound: 100",
                         CampaignVerdict::held},
                    Case{
                        "below: \"abs(([1000*y; 1] - [999.99*y + 0.001; 2])'*[1; 0])\", bound: 100",
                        CampaignVerdict::held},
                    Case{"below: \"max(([1000*y; 1] - [999.99*y + 0.001; 2])(1), 0)\", bound: 100",
                         CampaignVerdict::held},
                    Case{"below: \"abs([1000*y - 999.99*y - 0.001, 0](1))\", bound: 0.00899",
                         CampaignVerdict::violated}));

TEST(NarrowClaims, RandomBandsAreFound) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const double at = std::uniform_real_distribution<>(0.01, 2.9)(random);
    const double width = std::pow(10, std::uniform_real_distribution<>(-7, -2)(random));
    const std::string low = brief(at, 17);
    const std::string high = brief(at + width, 17);
    const std::string band = "where(x > " + low + ", where(x <= " + high + ", 1, 0), 0)";
    EXPECT_EQ(verdict_of("below: \"" + band + "\", bound: 0.5", trial % 2 == 1),
              CampaignVerdict::violated)
        << band;
  }
}

/// x = (cos t, -sin t); with z the flow is integrated.
CampaignVerdict verdict_on_circle(const std::string& claim, const std::string& horizon,
                                  bool integrated) {
  const std::string z = integrated ? ", z: {shape: scalar, start: 0.3}" : "";
  CampaignOptions options;
  options.threads = 1;
  const model::Instance instance = bind::bind(io::read_problem(
      "problem: p\nmethod:\n  method: m\n  plant:\n    state: {x: {shape: 2, start: \"[1; 0]\"}" +
      z + "}\n    flow: {x: \"[x(2); -x(1)]\"" + (integrated ? ", z: -z^3" : "") +
      "}\n  claims: {c: {" + claim + "}}\ncampaign: {runs: 1, horizon: " + horizon + "}\n"));
  return run_campaign(*make_setup(instance, {}), options).verdict;
}

TEST(NarrowClaims, WhatIsFalseIsNeverHeld) {
  for (const bool integrated : {false, true}) {
    for (const char* claim : {"below: \"where(x(1) < 0, 1 + 1e5*x(1), 0)\", bound: 0.9",
                              "below: \"where(x(1) < 0, 1 + 1e7*x(1), 0)\", bound: 0.9",
                              "below: \"mod(x(1), 1)\", bound: 0.999999",
                              "below: \"atan2(x(2), x(1))\", bound: 3.141592",
                              "below: \"where(x(1) < -0.999999999, 1, 0)\", bound: 0.5",
                              "below: \"where(x(2) > 0.99999999, rate(x(1)), 0)\", bound: 0.5"})
      EXPECT_NE(verdict_on_circle(claim, "7", integrated), CampaignVerdict::held) << claim;
    for (const char* claim : {"below: \"max(0, x(1) - 1 + 1e-7)*1e7\", bound: 0.5, after: 49",
                              "below: \"where(x(1) > 1 - 1e-7, 1, 0)\", bound: 0.5, after: 49"})
      EXPECT_NE(verdict_on_circle(claim, "51", integrated), CampaignVerdict::held) << claim;
    EXPECT_NE(verdict_of("below: \"where(x > 2.2, 1 - 1e6*(x - 2.2), 0)\", bound: 0.9", integrated),
              CampaignVerdict::held);
    EXPECT_NE(verdict_of("below: \"where(x < 2.2, 1 + 1e6*(x - 2.2), 0)\", bound: 0.9", integrated),
              CampaignVerdict::held);
  }
}

TEST(NarrowClaims, TextsThatBranchTooOftenAreUndecidedFromThereOn) {
  for (const bool integrated : {false, true}) {
    EXPECT_EQ(verdict_of("below: \"mod(1e9*x, 1)\", bound: 2", integrated),
              CampaignVerdict::undecided);
    EXPECT_EQ(verdict_of("below: \"where(x < 2, 0, mod(1e9*x, 1))\", bound: -0.5", integrated),
              CampaignVerdict::violated);
    EXPECT_EQ(verdict_of("above: \"x + floor(1e300*t)\", bound: 0.5", integrated),
              CampaignVerdict::violated);
  }
}

TEST(NarrowClaims, WhatIsTrueIsNeverViolated) {
  for (const bool integrated : {false, true}) {
    for (const char* claim : {"below: \"where(y > exp(-t), 1, 0)\", bound: 0.5",
                              "below: \"where(exp(-t) > y, 1, 0)\", bound: 0.5",
                              "below: \"where((y - exp(-t))*1e10 > 0, 1, 0)\", bound: 0.5",
                              "below: sign(y - exp(-t)), bound: 0.5"})
      EXPECT_NE(verdict_of(claim, integrated), CampaignVerdict::violated) << claim;
    for (const char* claim : {"below: \"where(x'*x < 1 - 1e-11, 1, 0)\", bound: 0.5",
                              "above: floor(x'*x + 1e-11), bound: 0.5"})
      EXPECT_NE(verdict_on_circle(claim, "51", integrated), CampaignVerdict::violated) << claim;
  }
}

TEST(NarrowClaims, BranchesOfSmoothValuesAreDecided) {
  for (const bool integrated : {false, true})
    for (const char* claim : {"below: \"where(x(1) < -0.9999, 1, 0)\", bound: 0.5",
                              "below: floor(x(1) + 0.0001), bound: -0.5",
                              "nonincreasing: \"where(x(1) < -0.9999, 1, 0)\""})
      EXPECT_EQ(verdict_on_circle(claim, "7", integrated), CampaignVerdict::violated) << claim;
}

INSTANTIATE_TEST_SUITE_P(
    ConstantOnABranch, NarrowClaims,
    testing::Values(Case{"nonincreasing: \"max(y, 0.5)\"", CampaignVerdict::held},
                    Case{"nonincreasing: floor(10*y)", CampaignVerdict::held},
                    Case{"nonincreasing: sign(y - 0.5)", CampaignVerdict::held},
                    Case{"nonincreasing: \"where(y > 0.5, y, 0.15)\"", CampaignVerdict::held},
                    Case{"below: \"max(0, y - 0.5)\", bound: 0, after: 2", CampaignVerdict::held}));

// Where a value merely touches its bound nothing falls to nothing.
INSTANTIATE_TEST_SUITE_P(Touches, NarrowClaims,
                         testing::Values(Case{"above: \"(x - 1)^2 + 19\", bound: 19",
                                              CampaignVerdict::undecided},
                                         Case{"above: \"2*((x - 1)^2 + 19) - 38\", bound: 0",
                                              CampaignVerdict::undecided}));

TEST(NarrowClaims, BranchesWithoutAnErrorBoundAreDecidedWhereTheyAreFar) {
  const std::string inverse = "norm(sat(pinv([1, x; 0, y]), ";
  EXPECT_EQ(verdict_of("below: \"" + inverse + "1000))\", bound: 70", true), CampaignVerdict::held);
  EXPECT_EQ(verdict_of("below: \"" + inverse + "10))\", bound: 9.9", true),
            CampaignVerdict::violated);
}

TEST(NarrowClaims, ALostRunDoesNotHideAViolatedOne) {
  CampaignOptions options;
  options.threads = 1;
  const model::Instance instance = bind::bind(io::read_problem(R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: scalar, start: 3}}
    flow: {x: "where(x > 0, 1, -sign(x + 0.5))"}
  claims: {c: {below: x, bound: 3.5}}
campaign: {runs: 2, horizon: 2, initial: {x: {list: [3, -1]}}}
)yaml"));
  const Report report = run_campaign(*make_setup(instance, {}), options);
  EXPECT_EQ(report.verdict, CampaignVerdict::violated);
  EXPECT_EQ(report.violations, 1U);
  EXPECT_EQ(report.undecided, 1U);
  EXPECT_EQ(report.worst_run, 0U);
}

TEST(NarrowClaims, WhatIsNeverComparedSaysSo) {
  CampaignOptions options;
  options.threads = 1;
  const model::Instance instance =
      instance_of("{a: {below: x, bound: 1, over: never}, b: {above: x, bound: -1}}", false,
                  "  events: {never: {when: plant.x >= 100}}\n  observer: {state: {n: {shape: "
                  "scalar, start: 0}}, at: {never: {n: 1}}}\n");
  const Report report = run_campaign(*make_setup(instance, {}), options);
  EXPECT_EQ(report.verdict, CampaignVerdict::held);
  EXPECT_FALSE(report.checks[0].worst.sampled);
  EXPECT_TRUE(report.checks[1].worst.sampled);
}

TEST(NarrowFigures, SettlesAfterTheLastTop) {
  const auto found = [](const std::string& text, const std::string& level, const std::string& is) {
    model::Instance instance = bind::bind(io::read_problem(
        "problem: p\nmethod:\n  method: m\n  plant: {state: {x: {shape: 2, start: \"[1; 0]\"}}, "
        "flow: {x: \"[x(2); -x(1)]\"}}\ncampaign: {horizon: 7}\nexpect:\n  run:\n    - {settles: "
        "\"" +
        text + "\", below: " + level + ", is: " + is + ", absolute: 1e-7}\n"));
    return run_differences(instance, model::Gains{});
  };
  for (const auto& [text, level, is] :
       {std::tuple{"x(1)", "0.99999", "6.287657446861"},
        std::tuple{"x(1)", "0.99999999", "6.283326728536"}, std::tuple{"mod(t, 1)", "0.999", "7"},
        std::tuple{"mod(t, 1) - where(t > 6.5, 2, 0)", "0.99", "6"}})
    EXPECT_TRUE(found(text, level, is).different.empty())
        << text << ": " << found(text, level, is).different.front();
}

TEST(NarrowFigures, APeakIsFound) {
  model::Instance instance =
      bind::bind(io::read_problem("problem: p\nmethod:\n  method: m\n"
                                  "  plant: {state: {x: {shape: scalar, start: 0}}, flow: {x: "
                                  "\"1\"}}\ncampaign: {horizon: 3}\nexpect:\n  run:\n"
                                  "    - {peak: \"" +
                                  kTent +
                                  "\", is: 1, absolute: 1e-9}\n"
                                  "    - {settles: \"" +
                                  kTent + "\", below: 0.5, is: 1.235, absolute: 1e-9}\n"));
  const RunDifferences found = run_differences(instance, model::Gains{});
  EXPECT_EQ(found.figures, 2U);
  EXPECT_TRUE(found.different.empty()) << found.different.front();
  EXPECT_TRUE(found.undecided.empty());
}

TEST(NarrowFigures, HaveLimits) {
  const model::Instance instance = bind::bind(io::read_problem(
      "problem: p\nmethod:\n  method: m\n  plant: {state: {x: {shape: scalar, start: 1}}, flow: "
      "{x: -x}}\ncampaign: {horizon: 1}\nexpect:\n  run:\n"
      "    - {value: x, at: {t: 1}, is: {below: 0.4, above: 0.3}}\n"
      "    - {value: x, at: {t: 1}, is: {below: 0.3}}\n"
      "    - {value: x, at: {t: 1}, is: {above: exp(0)}}\n"
      "    - {value: x, at: {t: 1}, is: {below: 0.3678794411}}\n"
      "    - {settles: x, below: 0.1, is: {below: 10}}\n"
      "    - {value: x, at: {t: 2}, is: {below: 10}}\n"));
  const RunDifferences found = run_differences(instance, model::Gains{});
  ASSERT_EQ(found.different.size(), 5U);
  EXPECT_NE(found.different[0].find("expected at most 0.3, found 0.367879441"), std::string::npos);
  EXPECT_NE(found.different[1].find("expected at least 1, found 0.3678"), std::string::npos);
  EXPECT_NE(found.different[2].find("at most 0.367879441, found"), std::string::npos)
      << "an exact flow is known to all digits";
  EXPECT_NE(found.different[3].find("expected at most 10, found inf"), std::string::npos);
  EXPECT_NE(found.different[4].find("found none until the run ends, at t = 1"), std::string::npos);
  EXPECT_TRUE(found.undecided.empty());
  const model::Instance never = bind::bind(io::read_problem(
      "problem: p\nmethod:\n  method: m\n  plant: {state: {x: {shape: scalar, start: 1}}, flow: "
      "{x: -x}}\ncampaign: {horizon: 1}\nexpect:\n  run:\n"
      "    - {peak: x, is: {below: 1, above: 2}}\n"));
  EXPECT_EQ(tests::input_error([&] { run_differences(never, {}); }).message(),
            "is: no number is above 2 and below 1");
}

/// Expectations of a run to t = 2 of flows, with an event at each tenth.
RunDifferences differences(const std::string& states, const std::string& flow,
                           const std::string& map, const std::string& expectations) {
  return run_differences(
      bind::bind(io::read_problem("problem: p\nmethod:\n  method: m\n  events: {tick: {every: "
                                  "0.1}}\n  plant:\n    state: {" +
                                  states + "}\n    flow: {" + flow + "}\n    at: {tick: {" + map +
                                  "}}\ncampaign: {horizon: 2}\nexpect:\n  run:\n" + expectations)),
      model::Gains{});
}

TEST(NarrowFigures, AFigureAtATickIsAfterIt) {
  for (int k = 1; k < 20; ++k) {
    const std::string t = fmt::format("{}.{}", k / 10, k % 10);
    const RunDifferences found =
        differences("n: {shape: scalar, start: 0}", "", "n: n + 1",
                    fmt::format("    - {{at: {{t: {}}}, value: n, is: {}, absolute: 0}}\n"
                                "    - {{at: {{t: {}1}}, value: n, is: {}, absolute: 0}}\n"
                                "    - {{at: {{t: {} - 1e-9}}, value: n, is: {}, absolute: 0}}\n",
                                t, k, t, k, t, k - 1));
    EXPECT_TRUE(found.different.empty()) << found.different.front();
    EXPECT_TRUE(found.undecided.empty()) << found.undecided.front();
  }
}

/// x = 16.5 at t = 1, where exactly, and beside a state that is integrated.
TEST(NarrowFigures, ATieIsADoubt) {
  const std::string states =
      "x: {shape: scalar, start: 0.1}, q: {shape: scalar, start: 0}, r: {shape: scalar, start: 1}";
  for (const char* rate : {"-r", "-r^3"}) {
    const std::string flow = fmt::format("x: \"16.4\", r: {}", rate);
    const RunDifferences of_text =
        differences(states, flow, "q: x",
                    "    - {at: {t: 1}, value: floor(x + 0.5), is: 17, absolute: 0}\n"
                    "    - {at: {t: 1}, value: floor(x + 0.5), is: 17, absolute: 2}\n"
                    "    - {at: {t: 1.05}, value: x, is: 17.32, absolute: 1e-9}\n");
    EXPECT_TRUE(of_text.different.empty()) << of_text.different.front();
    ASSERT_EQ(of_text.undecided.size(), 1U);
    EXPECT_NE(of_text.undecided[0].find("its error does not decide"), std::string::npos);
    const RunDifferences of_map =
        differences(states, flow, "q: floor(x + 0.5)",
                    "    - {at: {t: 1}, value: q, is: 16, absolute: 0}\n"
                    "    - {at: {t: 1.05}, value: q, is: 16, absolute: 0}\n"
                    "    - {at: {t: 0.95}, value: q, is: 15, absolute: 0}\n");
    EXPECT_TRUE(of_map.different.empty()) << of_map.different.front();
    ASSERT_EQ(of_map.undecided.size(), 2U);
    EXPECT_NE(of_map.undecided[0].find("tick takes a step"), std::string::npos);
  }
}

TEST(NarrowFigures, OfAChaoticRunAreUndecidedOnceItHasParted) {
  // Each tick takes a digit away: of 16 there are 11 after five ticks, and none after 19.
  const RunDifferences found =
      differences("y: {shape: scalar, start: 0.3183098861837907}", "", "y: \"10*y - floor(10*y)\"",
                  "    - {at: {t: 0.55}, value: y, is: 0.98861837907, absolute: 1e-6}\n"
                  "    - {at: {t: 0.55}, value: y, is: 0.9887, absolute: 1e-6}\n"
                  "    - {at: {t: 1.95}, value: y, is: 0.5, absolute: 1e-9}\n"
                  "    - {peak: y, is: {below: 0.1}}\n");
  EXPECT_EQ(found.different.size(), 1U);
  ASSERT_EQ(found.undecided.size(), 2U);
  EXPECT_NE(found.undecided[0].find("found a number that is not known"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::verify
