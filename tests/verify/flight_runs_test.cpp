#include "flights/flight_runner.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "verify/pack_agreement.h"
#include "verify/pack_cases.h"
#include "verify/pack_judge.h"

namespace gainsmith::verify {
namespace {

constexpr std::uint64_t kRuns = 96;

/// A setup with its packs, at an address of its own.
struct Flown {
  explicit Flown(const std::string& text)
      : instance(bind::bind(io::read_problem(text))),
        setup(make_setup(instance, {})),
        packs(make_packs(*setup, kRuns)) {}

  bool flies() const { return packs.flights.has_value(); }
  std::vector<packs::PackVerdict> verdicts() const {
    return flights::FlightRunner(*packs.any, *packs.flights).run(11, 0, kRuns);
  }

  model::Instance instance;
  std::unique_ptr<const Setup> setup;
  Packs packs;
};

// Bounds lie among what the runs reach, so that some hold and some violate.
const PackCase kFlightCases[] = {
    {"a ball and its observer", R"yaml(problem: p
method:
  method: m
  events: {impact: {when: x(1) <= 0 and x(2) < 0}}
  plant:
    state: {x: {shape: 2}}
    flow: {x: "[x(2); -9.81]"}
    output: {y: {value: x(2), at: impact}}
    at: {impact: {x: "[0; -0.7*x(2)]"}}
  observer:
    state: {z: {shape: 2, start: "[1.2; 0]"}}
    flow: {z: "[z(2); -9.81]"}
    at: {impact: {z: "[0; -0.7*y + 0.1*(z(2) - y)]"}}
  claims:
    near: {below: norm(x - z), bound: 1.4}
    high: {below: x(1), bound: 1.2}
    ground: {above: x(1), bound: -1e-6}
    impacts: {nonincreasing: (x - z)'*(x - z), over: impact}
    rebound: {below: x(2), bound: 3.2, over: impact}
    converges: {shrinks: norm(x - z), to: 0.3}
    energy: {nonincreasing: x(2)^2/2 + 9.81*x(1), over: impact}
campaign: {runs: 96, horizon: 2.2, initial: {x: {box: [[0.5, -1], [1.5, 1]]}}}
)yaml"},
    {"a ball that comes to rest", R"yaml(problem: p
method:
  method: m
  events: {impact: {when: x(1) <= 0 and x(2) < 0}}
  plant: {state: {x: {shape: 2}}, flow: {x: "[x(2); -9.81]"}, at: {impact: {x: "[-x(1); -0.5*x(2)]"}}}
  claims:
    energy: {nonincreasing: x(2)^2/2 + 9.81*x(1), over: impact}
    high: {below: x(1), bound: 1.2}
    weighted: {below: x(1)*x(2)^2, bound: 5}
campaign: {runs: 96, horizon: 20, initial: {x: {box: [[0.5, -1], [1.5, 1]]}}}
)yaml"},
    {"a ball whose height falls to the ground", R"yaml(problem: p
method:
  method: m
  events: {impact: {falls: h}, top: {when: q == 0 and v <= 0}}
  plant:
    mode: {q: 0}
    state: {h: 1, v: 1}
    flow: {h: v, v: -9.81}
    at: {impact: {h: 0, v: -0.6*v, q: 0}, top: {q: 1}}
  claims: {high: {below: h, bound: 1.3}, fast: {above: v, bound: -5}, often: {below: count(impact), bound: 40.5}}
campaign: {runs: 96, horizon: 0.9, initial: {h: {box: [0.5, 1.5]}, v: {box: [0.1, 1]}}}
)yaml"},
    {"a double integrator with a relay, between two walls", R"yaml(problem: p
method:
  method: m
  events:
    up: {when: q == 1 and x(1) + x(2)/3 >= 0.9}
    down: {when: q == -1 and x(1) + x(2)/3 <= -1}
  plant:
    mode: {q: 1}
    state: {x: 2, c: {shape: scalar, start: 0}}
    flow: {x: "[x(2); q]", c: 0.1 + x(1)^2}
    at: {up: {q: -1}, down: {q: 1}}
  signals: {u: q}
  claims:
    range: {below: x(1), bound: 1.8}
    speed: {below: abs(q)*x(2)^2, bound: 3}
    sum: {below: c, bound: 12}
    counted: {below: j, bound: 9.5}
campaign: {runs: 96, horizon: 12, initial: {x: {box: [-0.4, 0.4]}}}
)yaml"},
    {"two tanks that are filled in turn", R"yaml(problem: p
method:
  method: m
  data: {inflow: scalar}
  events:
    first_low: {when: fills == 2 and h(1) <= 0.3}
    second_low: {when: fills == 1 and h(2) <= 0.4}
  plant:
    mode: {fills: 1}
    state: {h: {shape: 2}, w: {shape: scalar, start: 0}}
    flow: {h: "[where(fills == 1, inflow, 0) - 0.5; where(fills == 2, inflow, 0) - 0.4]", w: since(first_low)}
    at: {first_low: {fills: 1}, second_low: {fills: 2}}
  claims:
    full: {below: "h(1) + h(2)", bound: 2.6}
    empty: {above: h(1), bound: 0.2999}
    waits: {below: w, bound: 9}
data: {inflow: 1}
campaign: {runs: 96, horizon: 6, initial: {h: {box: [0.6, 1.6]}}}
)yaml"},
};

class FlightRuns : public testing::TestWithParam<PackCase> {};

TEST_P(FlightRuns, AgreeWithCarefulRuns) {
  const Flown one(GetParam().text);
  ASSERT_TRUE(one.flies());
  // Of a degree above 2 the largest value is bounded.
  const auto near = [&](std::size_t c) {
    return one.setup->judged().judged[c].name == "weighted" ? 2e-2 : 1e-6;
  };
  expect_agreement(*one.setup, 11, one.verdicts(), near, kRuns / 5);
}

INSTANTIATE_TEST_SUITE_P(Systems, FlightRuns, testing::ValuesIn(kFlightCases));

std::string falling(const std::string& flow, const std::string& event, const std::string& start) {
  return R"yaml(problem: p
method:
  method: m
  events: {e: {)yaml" +
         event + R"yaml(}}
  plant: {state: {x: {shape: 2}}, flow: {x: ")yaml" +
         flow + R"yaml("}, at: {e: {x: "[0; -0.5*x(2)]"}}}
  claims: {low: {below: x(1), bound: 9}}
campaign: {runs: 96, horizon: 1, initial: {x: {box: )yaml" +
         start + "}}}\n";
}

TEST(FlightRuns, LeaveToStepsWhatIsUnusual) {
  const auto open = [](const std::string& text) {
    const Flown one(text);
    EXPECT_TRUE(one.flies());
    std::size_t count = 0;
    for (const packs::PackVerdict& verdict : one.verdicts()) count += verdict.open ? 1 : 0;
    return count;
  };
  const std::string impact = "when: x(1) <= 0 and x(2) < 0";
  EXPECT_EQ(open(falling("[x(2); -9]", impact, "[[1, -1], [2, 1]]")), 0U);
  // It turns where it touches the wall: x(1) = (s - 1)^2/2 and nearly so.
  EXPECT_EQ(open(falling("[x(2); 1]", "when: x(1) <= 0", "[[0.5, -1], [0.5, -1]]")), kRuns);
  EXPECT_EQ(open(falling("[x(2); 1]", "falls: x(1)", "[[0.5, -1], [0.5000000000001, -1]]")), kRuns);
  // It is due at the start; it starts at 0 and leaves it in the direction of the event.
  EXPECT_EQ(open(falling("[x(2); -9]", impact, "[[-1, -1], [-1, -1]]")), kRuns);
  EXPECT_EQ(open(falling("[x(2); -9]", "falls: x(1)", "[[0, -1], [0, -1]]")), kRuns);
  // It falls to the ground at the horizon.
  EXPECT_EQ(open(falling("[x(2); 0]", impact, "[[1, -1], [1, -1]]")), kRuns);
  // Two conditions come true at one time.
  EXPECT_EQ(open(falling("[x(2); -1]", "when: x(1) <= 0 and x(2) <= -1", "[[0.5, 0], [0.5, 0]]")),
            kRuns);
}

/// Both a and b fall by a tenth of the speed; each jump makes their difference, rounding, 21 times as large.
TEST(FlightRuns, KnowWhatJumpsAmplify) {
  const std::string difference = R"yaml(problem: p
method:
  method: m
  events: {e: {when: c >= 1}}
  plant:
    state: {c: {shape: scalar, start: 0}, a: {shape: scalar, start: 0.1}, b: {shape: scalar, start: 0.1}, v: 1}
    flow: {c: 1, a: 0.1*v, b: v/10}
    at: {e: {c: 0, a: a + 10*(a - b), b: b - 10*(a - b), v: -0.9*v}}
  claims: {low: {below: a - b, bound: 1e-9}}
campaign: {runs: 96, horizon: 8.5, initial: {v: {box: [0.5, 1]}}}
)yaml";
  const std::string map = R"yaml(problem: p
method:
  method: m
  events: {e: {when: c >= 1}}
  plant: {state: {c: {shape: scalar, start: 0}, x: 1}, flow: {c: 1}, at: {e: {c: 0, x: 3*x - floor(3*x)}}}
  claims: {low: {below: x, bound: 9}}
campaign: {runs: 96, horizon: 60.5, initial: {x: {box: [0.1, 0.9]}}}
)yaml";
  for (const std::string& text : {difference, map}) {
    const Flown one(text);
    ASSERT_TRUE(one.flies());
    for (const packs::PackVerdict& verdict : one.verdicts()) EXPECT_TRUE(verdict.open);
  }
  const Flown stepped(map);
  for (const packs::PackVerdict& verdict : packs::PackRunner(*stepped.packs.any).run(11, 0, kRuns))
    EXPECT_TRUE(verdict.open);
}

TEST(FlightRuns, AreOfPolynomialsAlone) {
  for (const char* flow :
       {"[x(2); -x(1)]", "[x(2); -9 - x(2)]", "[x(2); -9*sin(t)]", "[x(2); -9 + abs(x(1))]"})
    EXPECT_FALSE(Flown(falling(flow, "when: x(1) <= 0 and x(2) < 0", "[1, 2]")).flies()) << flow;
  EXPECT_FALSE(Flown(falling("[x(2); -9]", "when: norm(x) <= 0.5 and x(2) < 0", "[1, 2]")).flies());
  EXPECT_TRUE(
      Flown(falling("[x(2); -9 + 3]", "when: x(1) <= x(2)/7 and x(2) < 0", "[1, 2]")).flies());
}

}  // namespace
}  // namespace gainsmith::verify
