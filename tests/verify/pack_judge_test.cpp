#include "verify/pack_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "verify/campaign.h"

namespace gainsmith::verify {
namespace {

using claims::Judgement;

struct Case {
  const char* name;
  const char* text;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

// Bounds lie among what the runs reach, so that some hold and some violate.
const Case kCases[] = {
    {"a sampled observer of a pendulum with noise", R"yaml(problem: p
method:
  method: m
  let: {f(x): "[x(2); -9.81*sin(x(1)) - 0.1*x(2)]"}
  events: {sample: {every: [0.05, 0.2], lost: {probability: 0.3, in_a_row: 2}}}
  noise: {w: {normal: 0.02, new at: sample}, d: {uniform: [-0.5, 0.5], every: 0.37}}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    output: {y: {value: x(1) + w, at: sample}}
    flow: {x: "f(x) + [0; d]"}
  observer:
    state: {xh: {shape: 2, start: 0}, P: {shape: symmetric 2, start: I}}
    flow: {xh: f(xh), P: "He(jacobian(f(xh), xh)*P) + 0.01*I"}
    at: {sample: {let: {C: "[1, 0]", K: P*C'/(C*P*C' + 0.001)}, xh: xh + K*(y - C*xh), P: "(I - K*C)*P*(I - K*C)' + 0.001*K*K'"}}
  claims:
    small: {shrinks: norm(x - xh), to: 0.08}
    error: {below: norm(x - xh), bound: 0.25, after: 2}
    angle: {below: abs(x(1)), bound: 1.0}
    sampled: {below: norm(x - xh), bound: 0.24, over: sample, after: 1}
    trace: {above: "P(1, 1)", bound: 1e-4}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"a thermostat with two modes", R"yaml(problem: p
method:
  method: m
  events:
    off: {when: q == 1 and T >= 22}
    on: {when: q == 0 and T <= 18}
  noise: {outside: {uniform: [-5, 5]}}
  plant:
    mode: {q: 1}
    state: {T: {shape: 1, start: 20}}
    flow: {T: "0.1*(outside - T) + 4*q + 0.2*sin(t)"}
    at: {off: {q: 0}, on: {q: 1}}
  claims:
    hot: {below: T, bound: 22.001}
    swing: {above: T, bound: 17.5}
    settled: {below: T, bound: 21.6, over: on}
campaign: {runs: 96, horizon: 12, initial: {T: {box: [17.9, 23]}}}
)yaml"},
    {"a force that changes where it is passed, and a clipped input", R"yaml(problem: p
method:
  method: m
  inputs: {u: "clip(3*sin(t), -2, 2)"}
  plant:
    state: {x: {shape: 2, start: "[1; 0.5]"}}
    flow: {x: "[x(2); -4*x(1) - 0.2*x(2) + u + where(x(1) > 0.2, -1, 1)]"}
  claims:
    far: {below: x(1), bound: 1.4}
    fast: {below: abs(x(2)), bound: 2.4}
    least: {above: "min(x)", bound: -2.4}
campaign: {runs: 96, horizon: 5, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"a ball with drag", R"yaml(problem: p
method:
  method: m
  events: {impact: {when: x(1) <= 0 and x(2) < 0}}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    flow: {x: "[x(2); -9.81 - 0.1*x(2)*abs(x(2))]"}
    at: {impact: {x: "[0; -0.8*x(2)]"}}
  claims:
    energy: {nonincreasing: 9.81*x(1) + x(2)^2/2}
    speed: {below: abs(x(2)), bound: 5}
    low: {below: x(1), bound: 0.9, after: 0.8}
campaign: {runs: 96, horizon: 1.6, initial: {x: {box: ["[0.5; -1]", "[1.5; 1]"]}}}
)yaml"},
    {"a neuron that fires", R"yaml(problem: p
method:
  method: m
  events: {spike: {rises: v - 1}}
  plant:
    state: {v: {shape: 1, start: 0}, w: {shape: 1, start: 0}}
    flow: {v: "2*v^2 - w + 0.9", w: "0.5*(0.6*v - w)"}
    at: {spike: {v: 0.1, w: w + 0.2}}
  claims:
    slow: {below: w, bound: 0.6}
    height: {below: v, bound: 1.0001}
campaign: {runs: 96, horizon: 8, initial: {v: {box: [-0.2, 0.5]}, w: {box: [0, 0.3]}}}
)yaml"},
    {"a filter with two outputs, of a plant that is sampled at two times", R"yaml(problem: p
method:
  method: m
  events:
    one: {every: [0.1, 0.3]}
    two: {at: [0.5, 1, 1.5], if: plant.x(1) > 0}
  plant:
    state: {x: {shape: 3, start: 0}}
    output: {y: {value: "x(1:2)", at: one}}
    flow: {x: "[x(2); x(3) - x(1); -x(3) + 0.1*x(1)*x(2)]"}
    at: {two: {x: "x + [0; 0; 0.1]"}}
  observer:
    state: {xh: {shape: 3, start: 0}, P: {shape: symmetric 3, start: I}}
    flow: {xh: "[xh(2); xh(3) - xh(1); -xh(3) + 0.1*xh(1)*xh(2)]", P: "0.02*I"}
    at: {one: {let: {C: "[1, 0, 0; 0, 1, 0]", K: P*C'*inv(C*P*C' + 0.1*I)}, xh: xh + K*(y - C*xh), P: "(I - K*C)*P*(I - K*C)' + 0.1*K*K'"}}
  claims:
    small: {shrinks: norm(x - xh), to: 0.2}
    decrease: {nonincreasing: (x - xh)'*(x - xh)}
campaign: {runs: 96, horizon: 3, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"an oscillator with limits", R"yaml(problem: p
method:
  method: m
  events: {turn: {crosses: x(2)}}
  plant:
    state: {x: {shape: 2, start: 0}, n: {shape: 1, start: 0}}
    flow: {x: "[x(2); 1.5*(1 - x(1)^2)*x(2) - x(1)]"}
    at: {turn: {n: n + 1}}
  claims:
    few: {below: n, bound: 3.5}
    width: {below: x(1)^2, bound: 4.06}
    rate: {below: max(abs(x)), bound: 3}
campaign: {runs: 96, horizon: 9, initial: {x: {box: [-2.5, 2.5]}}}
)yaml"},
    {"costs of flows and jumps", R"yaml(problem: p
method:
  method: m
  events: {sample: {every: [0.1, 0.3]}}
  noise: {w: {normal: 0.05, new at: sample}}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    output: {y: {value: x(1) + w, at: sample}}
    flow: {x: "[x(2); -sin(x(1)) - x(2)]"}
  observer:
    state: {xh: {shape: 2, start: 0}}
    flow: {xh: "[xh(2); -sin(xh(1)) - xh(2)]"}
    at: {sample: {xh: "xh + [0.5; 0.2]*(y - xh(1))"}}
  claims:
    energy: {cost: {flow: x'*x}, below: 2.2*x'*x + 0.3}
    both: {cost: {flow: norm(x - xh), jump: (y - xh(1))^2}, below: 2}
    jumps: {cost: {jump: w^2 + abs(x(1))}, below: 5}
    signed: {cost: {flow: x(2)}, below: 0.05}
    eased: {cost: {flow: x'*x}, below: 0.5*x'*x, tolerance: 0.5}
    none: {cost: {}, below: x'*x}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"norms of 0, exponentials of matrices, limits at the start", R"yaml(problem: p
method:
  method: m
  events: {sample: {every: [0.1, 0.3]}}
  let: {A: "[0, 1; -2, -0.3]", rate: lambda_min(A'*A)/20}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}, c: {shape: 2, start: 0}, d: {shape: 1, start: 0}}
    flow: {x: "A*x - 0.1*x(1)^3*[0; 1]", c: A*c}
    at: {sample: {d: 1}}
  claims:
    exact: {below: "norm(c) + 1", bound: 2}
    ahead: {below: "norm(expm(A*sample.left)*x)", bound: 1.2}
    decays: {below: norm(x)*exp(rate*t), bound: 4}
    spent: {cost: {flow: x'*x/20}, below: x'*x/(1 - d)}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"balls that come to rest", R"yaml(problem: p
method:
  method: m
  events:
    hit:  {falls: "x(1)"}
    land: {when: y <= 0}
  plant:
    state: {x: {shape: 2, start: "[4; 2]"}, y: {shape: 2, start: "[1; 0]"}}
    flow: {x: "[x(2); -9.81]", y: "[y(2); -9.81 - 0.1*y(2)]"}
    at: {hit: {x: "[0; -0.8*x(2)]"}, land: {y: "[0; -0.3*y(2)]"}}
  claims:
    high: {below: "x(1)", bound: 3}
    energy: {nonincreasing: "9.81*x(1) + x(2)^2/2", tolerance: 1e-9}
    rests: {shrinks: norm(x), to: 1e-5}
    both: {below: "x(1) + y(1)", bound: 4}
campaign: {runs: 96, horizon: 20, initial: {x: {box: ["[1; -1]", "[4; 1]"]}}}
)yaml"},
    {"a ball that comes to rest", R"yaml(problem: p
method:
  method: m
  events: {hit: {falls: "x(1)"}}
  plant:
    state: {x: {shape: 2, start: "[4; 2]"}}
    flow: {x: "[x(2); -9.81]"}
    at: {hit: {x: "[0; -0.8*x(2)]"}}
  claims:
    high: {below: "x(1)", bound: 3}
    energy: {nonincreasing: "9.81*x(1) + x(2)^2/2", tolerance: 1e-9}
    rests: {shrinks: norm(x), to: 1e-5}
campaign: {runs: 96, horizon: 20, initial: {x: {box: ["[1; -1]", "[4; 1]"]}}}
)yaml"}};

class PackRuns : public testing::TestWithParam<Case> {};

TEST_P(PackRuns, AgreeWithCarefulRuns) {
  const model::Instance instance = bind::bind(io::read_problem(GetParam().text));
  const auto setup = make_setup(instance, {});
  const Packs packs = make_packs(*setup, 96);
  ASSERT_NE(packs.any, nullptr);
  packs::PackRunner runner(*packs.any);
  constexpr std::uint64_t runs = 96;
  const std::vector<packs::PackVerdict> verdicts = runner.run(11, 0, runs);
  Judge judge(*setup);
  std::size_t open = 0, held = 0, violated = 0;
  std::string reasons;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const packs::PackVerdict& pack = verdicts[run];
    if (pack.open) {
      ++open;
      reasons += packs::to_string(pack.why) + "; ";
      continue;
    }
    const RunVerdict careful = judge(11, run);
    EXPECT_EQ(pack.happened, careful.happened) << "run " << run;
    for (std::size_t c = 0; c < pack.claims.size(); ++c) {
      const claims::Finding& finding = careful.findings[c];
      ++(pack.claims[c].violated ? violated : held);
      EXPECT_EQ(pack.claims[c].looked, finding.looked);
      if (finding.undecided()) continue;
      EXPECT_EQ(pack.claims[c].violated, finding.violated())
          << "run " << run << ", claim " << c << ": " << finding.value << " and " << finding.bound
          << " at t = " << finding.t << ", j = " << finding.j;
      if (!finding.looked || !std::isfinite(finding.score)) continue;
      EXPECT_NEAR(pack.claims[c].score, finding.score, 2e-2 * (1 + std::abs(finding.score)))
          << "run " << run << ", claim " << c;
    }
  }
  EXPECT_GT(held, 0U);
  EXPECT_GT(violated, 0U);
  // What is ordinary is decided.
  EXPECT_LE(open, runs / 2) << reasons;
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
    ASSERT_EQ(some[k].claims.size(), all[37 + k].claims.size());
    for (std::size_t c = 0; c < some[k].claims.size(); ++c)
      EXPECT_EQ(some[k].claims[c].score, all[37 + k].claims[c].score);
  }
}

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
  // A chain of a hundred jumps at one time.
  EXPECT_EQ(open_runs(problem_of("go: {when: x(1) > 1 and x(2) < 100}",
                                 R"(state: {x: {shape: 2}}, flow: {x: "[1; 0]"},
             at: {go: {x: "[x(1); x(2) + 1]"}})",
                                 "2", R"(["[0; 0]", "[0.5; 0]"])")),
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
const Case kDelicate[] = {
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

class DelicateRuns : public testing::TestWithParam<Case> {};

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
    EXPECT_EQ(verdicts[run].claims[0].violated, careful.findings[0].violated()) << "run " << run;
  }
}

INSTANTIATE_TEST_SUITE_P(Systems, DelicateRuns, testing::ValuesIn(kDelicate));

TEST(DelicateClaims, WithNarrowPeaksAreLeftToCarefulRuns) {
  const auto runs_in_packs = [](const std::string& value) {
    const model::Instance instance = bind::bind(io::read_problem(
        "problem: p\nmethod:\n  method: m\n  plant: {state: {x: 2}, flow: {x: \"[x(2); "
        "-2*x(1)]\"}}\n"
        "  claims: {c: {below: \"" +
        value +
        "\", bound: 0.3}}\ncampaign: {runs: 40, horizon: 5, initial: {x: {box: [-1, 1]}}}\n"));
    return make_packs(*make_setup(instance, {}), 96).any != nullptr;
  };
  EXPECT_FALSE(runs_in_packs("1/(1 + 1e4*((x(1) - 0.5)^2 + x(2)^2))"));
  EXPECT_FALSE(runs_in_packs("exp(-1e4*x(1)^2)"));
  EXPECT_FALSE(runs_in_packs("tanh(1e4*x(1))"));
  EXPECT_TRUE(runs_in_packs("exp(-t)*norm(x)"));
  EXPECT_TRUE(runs_in_packs("x'*x/(1 + t)"));
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
      EXPECT_EQ(verdicts[run].claims[c].violated, careful.findings[c].violated()) << run;
  }
  EXPECT_GT(violated, 3U);
  EXPECT_LT(open, 60U);
}

Report campaign_of(const std::string& runs, unsigned threads) {
  std::string text = kCases[0].text;
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

INSTANTIATE_TEST_SUITE_P(Systems, PackRuns, testing::ValuesIn(kCases));

}  // namespace
}  // namespace gainsmith::verify
