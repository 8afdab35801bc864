#include "verify/pack_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "verify/pack_agreement.h"
#include "verify/pack_cases.h"

namespace gainsmith::verify {
namespace {

/// How many of 40 runs are left open.
std::size_t open_runs(const std::string& text) {
  const model::Instance instance = bind::bind(io::read_problem(text));
  const auto setup = make_setup(instance, {});
  const Packs packs = make_packs(*setup, 40);
  if (!packs.any) return 40;
  const std::vector<packs::PackVerdict> all = packs::PackRunner(*packs.any).run(1, 0, 40);
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const auto& one) { return one.open; }));
}

std::string problem_of(const std::string& events, const std::string& plant,
                       const std::string& horizon, const std::string& start) {
  return "problem: p\nmethod:\n  method: m\n  events: {" + events + "}\n  plant: {" + plant +
         "}\n  claims: {size: {below: x(1), bound: 100}}\ncampaign: {runs: 40, horizon: " +
         horizon + ", initial: {x: {box: " + start + "}}}\n";
}

TEST(UnusualRuns, AreLeftOpen) {
  const std::string ball = "impact: {when: x(1) <= 0 and x(2) < 0}";
  const std::string falls =
      R"(state: {x: {shape: 2}}, flow: {x: "[x(2); -9.81]"}, at: {impact: {x: "[0; -0.5*x(2)]"}})";
  const std::string box = R"(["[1; 0]", "[2; 0]"])";
  EXPECT_EQ(open_runs(problem_of(ball, falls, "1", box)), 0U);
  // It comes to rest: its jumps accumulate.
  EXPECT_EQ(open_runs(problem_of(ball, falls, "10", box)), 0U);
  // Jumps that follow each other at once, and do not accumulate.
  EXPECT_EQ(open_runs(problem_of("back: {rises: x(1) - 1e-10}",
                                 R"(state: {x: {shape: 2}}, flow: {x: "[1; 0]"},
             at: {back: {x: "[0; x(2)]"}})",
                                 "2", R"(["[-1; 0]", "[-0.5; 0]"])")),
            40U);
  // A chain of three thousand jumps at one time.
  EXPECT_EQ(open_runs(problem_of("go: {when: x(1) > 1 and x(2) < 3000}",
                                 R"(state: {x: {shape: 2}}, flow: {x: "[1; 0]"},
             at: {go: {x: "[x(1); x(2) + 1]"}})",
                                 "2", R"(["[0; 0]", "[0.5; 0]"])")),
            40U);
  // Two conditions with one root: the second holds there, the first behind it.
  EXPECT_EQ(open_runs(problem_of("far: {when: x(1) > 1}, near: {when: x(1) >= 1 and x(2) < 2}",
                                 R"(state: {x: {shape: 2}}, flow: {x: "[1; 0]"},
             at: {far: {x: "[x(1)/2; x(2)]"}, near: {x: "[x(1); x(2) + 1]"}})",
                                 "0.9", R"(["[0.5; 0]", "[0.6; 0]"])")),
            40U);
  // Two events at one time, whose order matters.
  EXPECT_EQ(open_runs(problem_of("one: {rises: x(1) - 1}, two: {rises: x(2) - 2}",
                                 R"(state: {x: {shape: 2}}, flow: {x: "[1; 2]"},
             at: {one: {x: "[0; x(2)]"}, two: {x: "[2*x(1); 0]"}})",
                                 "2", R"(["[0; 0]", "[0; 0]"])")),
            40U);
  // A graze: the parabola touches 0 where it turns.
  EXPECT_EQ(open_runs(problem_of("touch: {rises: x(1) - 1}",
                                 R"(state: {x: {shape: 2}}, flow: {x: "[x(2); -1]"},
             at: {touch: {x: "[0; 0]"}})",
                                 "3", R"(["[0.5; 1]", "[0.5; 1]"])")),
            40U);
  // Steps that stability keeps short.
  EXPECT_EQ(open_runs(problem_of("", R"t(state: {x: {shape: 1}}, flow: {x: "-1e6*(x - cos(t))"
})t",
                                 "10", "[0, 1]")),
            40U);
}

/// What was once decided wrongly, or never: what packs do not leave open is as careful runs are.
const PackCase kDelicate[] = {
    {"a crossing by the jump of an earlier event at the start", R"yaml(problem: p
method:
  method: m
  events: {a: {when: plant.x >= 1}, b: {falls: plant.x - 0.5}}
  plant:
    state: {x: scalar}
    flow: {x: -0.01*sin(x)}
    at: {a: {x: x - 2}}
  claims: {c: {below: count(b), bound: 0.5}}
campaign: {runs: 96, horizon: 0.3, initial: {x: {box: [0.6, 1.2]}}}
)yaml"},
    {"an alarm that the first sample sets off", R"yaml(problem: p
method:
  method: m
  events: {sample: {every: 0.5, first: 0}, alarm: {rises: xh - 1}}
  plant: {state: {x: scalar}, output: {y: {value: x, at: sample}}, flow: {x: -0.1*sin(x)}}
  observer:
    state: {xh: {shape: scalar, start: 0}}
    flow: {xh: -0.1*sin(xh)}
    at: {sample: {xh: xh + 0.8*(y - xh)}}
  claims: {c: {below: count(alarm), bound: 0.5}}
campaign: {runs: 96, horizon: 0.4, initial: {x: {box: [1, 1.6]}}}
)yaml"},
    // From x(2) = -1 it leads to 1.
    {"a jump that leads from one surface to another", R"yaml(problem: p
method:
  method: m
  events: {d: {when: plant.x(2) < -1}, b: {when: plant.x(2) > 1 and plant.n < 3}}
  plant:
    state: {x: {shape: 2}, n: {shape: scalar, start: 0}}
    flow: {x: "[x(2); 3.01*cos(5*t) - x(1)]"}
    at: {d: {x: "[x(1); -x(2)]"}, b: {x: "[-x(1); x(2) - 0.5]", n: n + 1}}
  claims: {c: {below: plant.n, bound: 1.5}}
campaign: {runs: 96, horizon: 2, initial: {x: {box: [-1.5, 1.5]}}}
)yaml"},
    {"a flow that slides along a switch", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: 2}
    flow: {x: "[-9*x(1) - 0.05 + x(2); -8*x(2) + where(x(1) > x(2), -0.01068, x(1))]"}
  claims: {c: {below: plant.x(1), bound: 10}}
campaign: {runs: 96, horizon: 3, initial: {x: {box: [-1.9, 1.8]}}}
)yaml"},
    {"a condition that another jump makes true at exactly 0", R"yaml(problem: p
method:
  method: m
  events:
    a: {when: plant.q == 0 and plant.x >= 1}
    b: {when: plant.q == 1 and plant.y <= 0}
  plant:
    state: {x: scalar, y: {shape: scalar, start: 0}}
    mode: {q: 0}
    flow: {x: 1 + 0.1*sin(x), y: "where(q == 1, 1, 0)"}
    at: {a: {q: 1}, b: {q: 2}}
  claims: {c: {below: plant.y, bound: 0.5}}
campaign: {runs: 96, horizon: 4, initial: {x: {box: [0, 0.5]}}}
)yaml"},
    {"sticking and slipping", R"yaml(problem: p
method:
  method: m
  events:
    stick: {when: plant.q == 1 and plant.v <= 0}
    slip: {when: plant.q == 0 and plant.n < 9 and plant.x <= -1}
  plant:
    state: {x: scalar, v: {shape: scalar, start: 1}, n: {shape: scalar, start: 0}}
    mode: {q: 1}
    flow: {x: "where(q == 1, v, -0.5)", v: "q*(-4.4*x - 0.6)"}
    at: {stick: {q: 0, v: 0, n: n + 1}, slip: {q: 1}}
  claims: {c: {below: plant.n, bound: 4.5}}
campaign: {runs: 96, horizon: 10, initial: {x: {box: [-0.9, -0.5]}}}
)yaml"},
    {"a value that falls with a kink", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: 3}
    flow: {x: "[x(2) - x(1)*0.2; -2.175*x(1) - 0.3*x(2) + (x(3) - clip(x(3), -0.2, 0.2)); -2*x(3)]"}
  claims: {c: {nonincreasing: "exp(-3*t)*max(abs(plant.x(1)), abs(plant.x(2)))"}}
campaign: {runs: 96, seed: 86, horizon: 0.5, initial: {x: {box: [-2, 2]}}}
)yaml"},
    {"a value that no jump changes, at the root of an event", R"yaml(problem: p
method:
  method: m
  events:
    smp: {every: [0.2414, 0.3814]}
    up: {rises: "sin(plant.x(2)) + 0.05838"}
  plant:
    state: {x: 3}
    flow: {x: "[-2*x(1) + sign(x(2)) - 0.035; -8*x(2) + where(x(3) > x(1), x(2), -0.57) + 1; -0.5*x(3) - 0.14*x(3)^3 - 0.72]"}
  claims: {c: {nonincreasing: exp(-t)*norm(plant.x)}}
campaign: {runs: 96, seed: 49, horizon: 3, initial: {x: {box: [-1.673, 0.8268]}}}
)yaml"}};

class DelicateRuns : public testing::TestWithParam<PackCase> {};

TEST_P(DelicateRuns, AreNotDecidedWrongly) {
  const model::Instance instance = bind::bind(io::read_problem(GetParam().text));
  const auto setup = make_setup(instance, {});
  const Packs packs = make_packs(*setup, 96);
  ASSERT_NE(packs.any, nullptr);
  const std::vector<packs::PackVerdict> verdicts = packs::PackRunner(*packs.any).run(86, 0, 96);
  Judge judge(*setup);
  for (std::uint64_t run = 0; run < verdicts.size(); ++run) {
    if (verdicts[run].open) continue;
    const RunVerdict careful = judge(86, run);
    EXPECT_EQ(verdicts[run].happened, careful.happened) << "run " << run;
    if (careful.findings[0].undecided()) continue;
    EXPECT_EQ(verdicts[run].findings[0].violated(), careful.findings[0].violated())
        << "run " << run;
  }
}

INSTANTIATE_TEST_SUITE_P(Systems, DelicateRuns, testing::ValuesIn(kDelicate));

/// The verdicts of packs on x'' = -2 x and `value` <= 0.3: how many runs are held, violated, open; the
/// decided ones as the careful run does.
std::array<int, 3> verdicts_on(const std::string& value) {
  const model::Instance instance = bind::bind(io::read_problem(
      "problem: p\nmethod:\n  method: m\n  plant: {state: {x: 2}, flow: {x: \"[x(2); "
      "-2*x(1)]\"}}\n"
      "  claims: {c: {below: \"" +
      value +
      "\", bound: 0.3}}\ncampaign: {runs: 40, horizon: 5, initial: {x: {box: [-1, 1]}}}\n"));
  const auto setup = make_setup(instance, {});
  const Packs packs = make_packs(*setup, 96);
  if (packs.any == nullptr) return {0, 0, 40};
  packs::PackRunner runner(*packs.any);
  const std::vector<packs::PackVerdict> verdicts = runner.run(1, 0, 40);
  Judge judge(*setup);
  std::array<int, 3> counts{};
  for (std::uint64_t run = 0; run < verdicts.size(); ++run) {
    const packs::PackVerdict& pack = verdicts[run];
    ++counts[pack.open ? 2 : pack.violated() ? 1 : 0];
    if (pack.open) continue;
    const RunVerdict careful = judge(1, run);
    EXPECT_EQ(pack.violated(), careful.judgement == claims::Judgement::violated)
        << value << ", run " << run;
  }
  return counts;
}

TEST(DelicateClaims, PeaksAreFollowedOrLeftToCarefulRuns) {
  for (const char* value : {"1/(1 + 1e4*((x(1) - 0.5)^2 + x(2)^2))", "exp(-300*(x(1) - 0.2)^2)",
                            "tanh(9*x(1)) - 0.5", "x(1)/(1.2 + x(2))", "norm(x)/(0.1 + x'*x)",
                            "log(0.1 + x(1)^2)", "atan2(x(2), 2 + x(1))"}) {
    const auto [held, violated, open] = verdicts_on(value);
    EXPECT_LE(open, 20) << value << ": " << held << ", " << violated;
  }
  // Narrower than any step that is worth making.
  EXPECT_EQ(verdicts_on("tanh(1e5*x(1))*1e-3")[1], 0);
}

/// A distance that comes near 0 for a moment, between the points of steps.
TEST(SharpClaims, AreDecidedRight) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2, start: 0}}
    flow: {x: "[x(2); -7*sin(x(1)) - 0.15*x(2)]"}
  claims:
    near: {above: "norm(x - [0.3; 0])", bound: 0.02}
    far: {below: norm(x), bound: 2.2}
campaign: {runs: 120, horizon: 5, initial: {x: {box: [-1.5, 1.5]}}}
)yaml";
  const model::Instance instance = bind::bind(io::read_problem(text));
  const auto setup = make_setup(instance, {});
  const Packs packs = make_packs(*setup, 96);
  ASSERT_NE(packs.any, nullptr);
  const std::vector<packs::PackVerdict> verdicts = packs::PackRunner(*packs.any).run(5, 0, 120);
  Judge judge(*setup);
  std::size_t violated = 0, open = 0;
  for (std::uint64_t run = 0; run < verdicts.size(); ++run) {
    open += verdicts[run].open ? 1 : 0;
    const RunVerdict careful = judge(5, run);
    violated += careful.findings[0].violated() ? 1 : 0;
    for (std::size_t c = 0; c < 2 && !verdicts[run].open; ++c)
      EXPECT_EQ(verdicts[run].findings[c].violated(), careful.findings[c].violated()) << run;
  }
  EXPECT_GT(violated, 3U);
  EXPECT_LT(open, 60U);
}

/// Steps pass the kinks of abs, max and min where these are all that is to be known of a claim.
TEST(SharpClaims, KinksAreLeftToNoCarefulRun) {
  const std::string text = R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2, start: 0}}
    flow: {x: "[x(2); -9.8 - 0.1*x(2)]"}
    events: {impact: {when: x(1) <= 0 and x(2) < 0}}
    at: {impact: {x: "[0; 5 - 0.5*x(2)]"}}
  claims:
    fast: {below: abs(x(2)), bound: 13}
    both: {below: "max(x(1)/3, -x(2)) + min(x(2), 0)", bound: 2.8}
campaign: {runs: 120, horizon: 20, initial: {x: {box: ["[1; -5]", "[10; 5]"]}}}
)yaml";
  const auto setup = make_setup(bind::bind(io::read_problem(text)), {});
  const Packs packs = make_packs(*setup, 96);
  ASSERT_NE(packs.any, nullptr);
  expect_agreement(
      *setup, 5, packs::PackRunner(*packs.any).run(5, 0, 120), [](std::size_t) { return 2e-2; }, 2);
}

}  // namespace
}  // namespace gainsmith::verify
