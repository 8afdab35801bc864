#include "verify/pack_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "verify/campaign.h"
#include "verify/judge.h"
#include "verify/pack_agreement.h"
#include "verify/pack_cases.h"
#include "verify/tolerances.h"

namespace gainsmith::verify {
namespace {

using claims::Judgement;

class PackRuns : public testing::TestWithParam<PackCase> {};

TEST_P(PackRuns, AgreeWithCarefulRuns) {
  const model::Instance instance = bind::bind(io::read_problem(GetParam().text));
  const auto setup = make_setup(instance, {});
  const Packs packs = make_packs(*setup, 96);
  ASSERT_NE(packs.any, nullptr);
  packs::PackRunner runner(*packs.any);
  constexpr std::uint64_t runs = 96;
  const std::vector<packs::PackVerdict> verdicts = runner.run(11, 0, runs);
  expect_agreement(
      *setup, 11, verdicts, [](std::size_t) { return 2e-2; }, runs / 2);
}

TEST_P(PackRuns, AreTheSameInAnyOrder) {
  const model::Instance instance = bind::bind(io::read_problem(GetParam().text));
  const auto setup = make_setup(instance, {});
  const Packs packs = make_packs(*setup, 96);
  ASSERT_NE(packs.any, nullptr);
  packs::PackRunner runner(*packs.any);
  const std::vector<packs::PackVerdict> all = runner.run(3, 0, 60);
  const std::vector<packs::PackVerdict> some = runner.run(3, 37, 45);
  for (std::size_t k = 0; k < some.size(); ++k) {
    EXPECT_EQ(some[k].open, all[37 + k].open);
    ASSERT_EQ(some[k].findings.size(), all[37 + k].findings.size());
    for (std::size_t c = 0; c < some[k].findings.size(); ++c)
      EXPECT_EQ(some[k].findings[c].score, all[37 + k].findings[c].score);
  }
}

Report campaign_of(const std::string& runs, unsigned threads) {
  std::string text = kPackCases[0].text;
  text.replace(text.find("runs: 96"), 8, "runs: " + runs);
  const model::Instance instance = bind::bind(io::read_problem(text));
  CampaignOptions options;
  options.threads = threads;
  return run_campaign(*make_setup(instance, {}), options);
}

TEST(PackJudge, RepeatsSomeRunsCarefully) {
  const Report report = campaign_of("1100", 1);
  // Runs 0 and 1024, and those that packs leave open.
  std::uint64_t open = 0;
  for (const std::uint64_t count : report.open) open += count;
  EXPECT_GE(*report.careful, open + 1);
  EXPECT_LE(*report.careful, open + 2);
  EXPECT_LT(open, 200U);
}

TEST(PackJudge, AFewRunsAreMadeOneByOne) {
  EXPECT_FALSE(campaign_of("5", 1).careful);
  EXPECT_TRUE(campaign_of("40", 1).careful);
}

TEST(PackJudge, ACountAtItsBoundIsExact) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  events: {e: {every: 0.3}, f: {every: 0.7}}
  plant: {state: {x: 1, k: {shape: scalar, start: 0}}, flow: {x: -0.7*x}, at: {e: {k: k + 1}}}
  claims:
    few: {below: count(e), bound: 3}
    counted: {below: k, bound: 3}
    many: {above: count(e), bound: 3, after: 0.9}
    apart: {below: abs(count(e) - count(f)), bound: 2}
    more: {above: 2*count(e) - 3*count(f), bound: 1, after: 0.6}
campaign: {horizon: 1, initial: {x: {box: [1, 2]}}, runs: )yaml";
  for (const char* runs : {"5}", "100}"}) {
    const Report report = run_campaign(*make_setup(bind::bind(io::read_problem(text + runs)), {}));
    EXPECT_EQ(report.verdict, model::CampaignVerdict::held);
    EXPECT_EQ(std::accumulate(report.open.begin(), report.open.end(), std::uint64_t{0}), 0U);
  }
}

/// Many runs at once leave open, or agree on, how often an event comes where jumps lead to a root.
TEST(PackJudge, EventsAtSharedRootsAreCountedAsInSingleRuns) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  events: {EVENTS}
  plant: {state: {x: 2}, flow: {x: "[x(2); -4]"}, at: {MAPS}}
  observer: {state: {zh: {shape: scalar, start: ZH}}, at: {d: {zh: "MAP"}}}
  claims: {n: {below: count(f), bound: 0.5}}
campaign: {horizon: 2, runs: 24, initial: {x: {box: [[-0.2, 0.3], [0.5, 1.5]]}}}
)yaml";
  struct Case {
    std::string events, maps, start, map;
  };
  const Case cases[] = {// Another event turns back what is just to fall through 0.
                        {"d: {when: x(1) <= -0.5 and count(d) < 2}, f: {rises: x(1) + 0.5}",
                         "d: {x: \"[x(1) + 2; 0]\"}", "0", "zh"},
                        // To 0.3 and 5e-17, and to 0 exactly, and on from there.
                        {"d: {at: [0.5, 1]}, f: {falls: zh - 0.3}", "d: {x: x}", "-0.5",
                         "where(t < 0.7, 0.1 + 0.2, -0.3)"},
                        {"d: {at: [0.5, 1]}, f: {rises: zh}", "d: {x: x}", "1", "1 - zh"},
                        // From the border of a condition into it.
                        {"d: {at: [0.5]}, f: {when: x(1) < -0.5 and count(f) < 2}",
                         "d: {x: \"[-0.5; -0.1]\"}", "0", "zh"},
                        {"d: {at: [0.5]}, f: {when: x(1) < -0.5 and count(f) < 2}",
                         "d: {x: \"[-0.5; 0.1]\"}", "0", "zh"}};
  const auto set = [](std::string& in, const std::string& name, const std::string& to) {
    in.replace(in.find(name), name.size(), to);
  };
  for (const Case& one : cases) {
    std::string made = text;
    set(made, "EVENTS", one.events);
    set(made, "MAPS", one.maps);
    set(made, "ZH", one.start);
    set(made, "MAP", one.map);
    const model::Instance instance = bind::bind(io::read_problem(made));
    const auto setup = make_setup(instance, {});
    Judge judge(*setup);
    const auto verdicts = packs::PackRunner(*make_packs(*setup, 96).any).run(1, 0, 24);
    for (std::uint64_t run = 0; run < 24; ++run) {
      const RunVerdict single = judge(1, run);
      if (verdicts[run].open || single.findings[0].undecided()) continue;
      EXPECT_EQ(verdicts[run].happened, single.happened) << one.events << ", run " << run;
      EXPECT_EQ(verdicts[run].findings[0].score, single.findings[0].score) << one.events;
    }
  }
}

/// Held at a bound that a saturated input reaches, and at a start that is the bound.
TEST(PackJudge, WhatHoldsWhereverStatesAreIsHeld) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  data: {most: scalar}
  plant: {state: {x: 2}, flow: {x: "[x(2); clip(-5*x(1) - 3*x(2), -most, most)]"}}
  claims:
    limits: {below: "abs(clip(-5*x(1) - 3*x(2), -most, most))", bound: most}
    sign: {above: sign(x(1)), bound: -1}
    branch: {above: "where(x(1) > 0.2, most, 0)", bound: 0}
    start: {below: "max(abs(x))", bound: 0.9}
data: {most: 0.7}
campaign: {horizon: 8, initial: {x: {box: [[-0.9, 0.05], [-0.9, 0.1]]}}, runs: )yaml";
  for (const char* runs : {"5}", "100}"}) {
    const Report report = run_campaign(*make_setup(bind::bind(io::read_problem(text + runs)), {}));
    EXPECT_EQ(report.verdict, model::CampaignVerdict::held);
    EXPECT_EQ(std::accumulate(report.open.begin(), report.open.end(), std::uint64_t{0}), 0U);
  }
}

/// A peak between two points of a step that falls short of its bound by little.
TEST(PackJudge, APeakThatFallsShortIsHeld) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  plant: {state: {x: {shape: 2, start: "[0; 1]"}}, flow: {x: "[x(2); -RATE]"}}
  claims: {apex: {below: x(1), bound: BOUND}}
campaign: {runs: 60, horizon: 2, initial: {x: {box: [[0, 0.5], [0, 1]]}}}
)yaml";
  const auto with = [&](const std::string& rate, const std::string& bound) {
    std::string made = text;
    made.replace(made.find("RATE"), 4, rate);
    made.replace(made.find("BOUND"), 5, bound);
    const model::Instance instance = bind::bind(io::read_problem(made));
    const auto setup = make_setup(instance, {});
    std::size_t violated = 0;
    for (const packs::PackVerdict& one :
         packs::PackRunner(*make_packs(*setup, 60).any).run(1, 0, 60))
      violated += !one.open && one.violated() ? 1 : 0;
    return violated;
  };
  // Peaks v^2/2 of 1/8 to 1/2, and those of sines.
  for (const char* bound : {"0.5", "0.500000000001", "0.50000001"}) EXPECT_EQ(with("1", bound), 0U);
  for (const char* bound : {"1", "1.000000000001", "1.00000001"})
    EXPECT_EQ(with("x(1)", bound), 0U);
  EXPECT_GT(with("1", "0.3"), 0U);
}

/// At x(1) = 1 the first event turns back what the second waits for.
TEST(PackJudge, ACrossingThatIsTurnedBackDoesNotHappen) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  events: {wall: {when: x(1) >= 1 and q == 0}, beyond: {rises: x(1) - 1}}
  plant:
    mode: {q: 0}
    state: {x: {shape: 2}}
    flow: {x: "[x(2); -0.1*sin(x(1))]"}
    at: {wall: {q: 1, x: "[x(1); -x(2)]"}}
  claims: {never: {below: count(beyond), bound: 0}}
campaign: {runs: 60, horizon: 3, initial: {x: {box: [[0, 0.5], [0.3, 1.9]]}}}
)yaml";
  const auto setup = make_setup(bind::bind(io::read_problem(text)), {});
  for (const packs::PackVerdict& one : packs::PackRunner(*make_packs(*setup, 60).any).run(1, 0, 60))
    EXPECT_TRUE(one.open || !one.violated());
}

/// The error of a dead-beat observer is 0 from its third sample on, up to rounding of either sign.
/// States of 1e16 are whole numbers, and round nevertheless.
TEST(Judge, ATieIsNotViolatedByChance) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  let: {A: "[0, 1, 0; 0, 0, 1; 0, 0, 0]", C: "[1, 0, 0]", L: "[1; 3; 4]"}
  events: {s: {every: 0.5}}
  plant: {state: {x: {shape: 3}}, output: {y: {value: C*x, at: s}}, flow: {x: A*x}}
  observer: {state: {xh: {shape: 3, start: 0}}, flow: {xh: A*xh}, at: {s: {xh: xh + L*(y - C*xh)}}}
  claims: {zero: {below: norm(x - xh), bound: 0, after: 1.7}}
campaign: {runs: 800, horizon: 5, initial: {x: {box: )yaml";
  for (const char* box : {"[-1, 1]}}}", "[1e16, 3e16]}}}"}) {
    const Report report = run_campaign(*make_setup(bind::bind(io::read_problem(text + box)), {}));
    EXPECT_EQ(report.violations, 0U) << box;
    EXPECT_EQ(report.undecided, 800U) << box;
  }
}

/// After 69 ticks 31 digits know a chaotic map, and doubles do not.
TEST(Judge, AsManyTiesAsRunsTakeTheirTime) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  events: {tick: {every: 1}, look: {at: [69.5]}}
  plant:
    state: {x: {shape: scalar, start: 0.3}, y: {shape: scalar, start: 0}}
    at: {tick: {x: 4*x*(1 - x)}, look: {y: x}}
  claims: {c: {below: y, bound: 0.5, over: look}}
campaign: {runs: 1, horizon: 70}
)yaml";
  const auto setup = make_setup(bind::bind(io::read_problem(text)), {});
  Judge judge(*setup);
  EXPECT_NE(judge(1, kIn31Digits - 1).judgement, Judgement::undecided);
  EXPECT_EQ(judge(1, kIn31Digits).judgement, Judgement::undecided);
  EXPECT_NE(judge.confirm(1, kIn31Digits).judgement, Judgement::undecided);
}

TEST(PackJudge, ThreadsDoNotMatter) {
  const Report one = campaign_of("400", 1);
  const Report two = campaign_of("400", 2);
  EXPECT_EQ(one.violations, two.violations);
  EXPECT_EQ(one.worst_run, two.worst_run);
  EXPECT_EQ(one.open, two.open);
  ASSERT_EQ(one.checks.size(), two.checks.size());
  for (std::size_t k = 0; k < one.checks.size(); ++k) {
    EXPECT_EQ(one.checks[k].worst.score, two.checks[k].worst.score);
    EXPECT_EQ(one.checks[k].worst_run, two.checks[k].worst_run);
    EXPECT_EQ(one.checks[k].violations, two.checks[k].violations);
  }
}

TEST(PackJudge, AContradictionIsAFaultOfTheProgram) {
  EXPECT_THROW(require_agreement(3, Judgement::held, Judgement::violated), std::logic_error);
  EXPECT_THROW(require_agreement(3, Judgement::violated, Judgement::held), std::logic_error);
  EXPECT_NO_THROW(require_agreement(3, Judgement::held, Judgement::held));
  EXPECT_NO_THROW(require_agreement(3, Judgement::held, Judgement::undecided));
}

INSTANTIATE_TEST_SUITE_P(Systems, PackRuns, testing::ValuesIn(kPackCases));

}  // namespace
}  // namespace gainsmith::verify
