// Claims, starts, noise and uncertain data as texts: what they mean, and where they are wrong.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bind/bind.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using model::ClaimKind;
using tests::input_error;

const std::string kBall = R"(problem: ball
method:
  method: ball
  data: {m: {shape: scalar, default: 2}, Q: {shape: 2 x 2, default: I}}
  events: {impact: {when: plant.x(1) <= 0 and plant.x(2) < 0}}
  noise: {w: {sinusoid: {amplitude: 0.1, frequency: [1, 2]}}}
  plant:
    state: {x: 2}
    output: {y: x(1) + w}
    flow: {x: "[x(2); -m]"}
    at: {impact: {x: "[0; -0.8*x(2)]"}}
  observer:
    state: {xh: {shape: 2, start: 0}}
    flow: {xh: "[xh(2); -m]"}
  signals: {V: norm(x - xh)^2}
  claims:
    falls: {nonincreasing: V, over: impact}
    small: {below: rate(V) + V, bound: 2*m, after: 5}
campaign: {horizon: 10, initial: {x: {ellipsoid: {center: [1, 0], matrix: Q}}}}
uncertain: {m: {vertices: [1, 2, 3]}}
)";

TEST(Claims, BoundsTimesAndEventsAreBound) {
  const model::DesignPtr design = bound(kBall);
  ASSERT_EQ(design->claims.size(), 2U);
  EXPECT_EQ(design->claims[0].kind, ClaimKind::nonincreasing);
  EXPECT_EQ(design->claims[0].over, 0U);
  EXPECT_FALSE(design->claims[0].after);
  EXPECT_EQ(design->claims[1].kind, ClaimKind::below);
  EXPECT_FALSE(design->claims[1].over);
  EXPECT_EQ(design->claims[1].bound->text, "2*m");
  EXPECT_EQ(design->claims[1].after->text, "5");
}

TEST(Claims, AnEventThatOnlyAClaimNamesIsOne) {
  const std::string text = replaced(kBall, "  events: {", "  events: {look: {every: 1}, ");
  EXPECT_EQ(bound(text)->dynamics->events.size(), bound(kBall)->dynamics->events.size() + 1);
  EXPECT_EQ(bound(replaced(text, "over: impact", "over: look"))->claims[0].over, 0U);
}

TEST(Claims, OfAMethodWithATimer) {
  const std::string text =
      "problem: p\nmethod:\n  method: m\n  plant: {state: {z: scalar}, flow: {z: -z}}\n"
      "  timer: {tau: {reset: [1, 2]}}\n"
      "  claims: {c: {above: z, bound: -1, after: 3}, d: {nonincreasing: abs(z)}}\n";
  EXPECT_EQ(bound(text)->claims[0].kind, ClaimKind::above);
  EXPECT_EQ(bound(replaced(text, "abs(z)", "z, over: timer"))->claims[1].over, 0U);
  EXPECT_EQ(bound(replaced(text, "abs(z)", "rate(z)"))->claims.size(), 2U);
  EXPECT_NE(input_error([&] { bound(replaced(text, "abs(z)", "z, over: tau")); })
                .message()
                .find("there is no event 'tau'"),
            std::string::npos);
}

TEST(Claims, MistakesAreNamedAtTheirPlace) {
  const std::vector<Mistake> mistakes = {
      {"over: impact", "over: inpact", 17, 37,
       "there is no event 'inpact'; did you mean 'impact'?"},
      {"over: impact", "ower: impact", 17, 31, "did you mean 'over'?"},
      {"over: impact", "tolerance: 0", 17, 42, "tolerance: expected a positive number"},
      {"over: impact", "tolerance: 1", 17, 42, "so below 1"},
      {"{nonincreasing: V, over: impact}", "V < 1", 17, 5, "expected {nonincreasing: V}, {below:"},
      {"bound: 2*m, ", "", 18, 12, "bound"},
      {"nonincreasing: V, over: impact", "nonincreasing: V, bound: 1", 17, 31,
       "bound: of the claims below and above"},
      {"nonincreasing: V, over: impact", "shrinks: V, to: 1, over: impact", 17, 32,
       "over: of the claims nonincreasing, below and above"},
      {"nonincreasing: V, over: impact", "above: V, below: V, bound: 1", 17, 5,
       "needs exactly one of nonincreasing, cost, shrinks, below, above; found 2"},
      {"bound: 2*m", "bound: x(1)", 18, 40, "the value comes first: {below: norm(x), bound: 2}"},
      {"after: 5", "after: t", 18, 52, "'t' changes along a run"},
      {"rate(V)", "rate(x*x')", 18, 25, "rate(v) is of a number or a column, not x*x'"},
      {"rate(V)", "rate(rate(V))", 18, 20, "what holds a jacobian or a rate has none"},
      {"-m]\"}\n    at", "-rate(m)]\"}\n    at", 10, 24, "it is for signals, claims and figures"},
      {"{center: [1, 0], matrix: Q}", "{center: [1, 0]}", 19, 50, "matrix"},
      {"center: [1, 0]", "centre: [1, 0]", 19, 51, "did you mean 'center'?"},
      {"center: [1, 0]", "center: [1, 0, 0]", 19, 59, "wrong shape"},
      {"{ellipsoid:", "{elipsoid:", 19, 39, "did you mean 'ellipsoid'?"},
      {"frequency: [1, 2]", "phase: 0", 6, 25, "frequency"},
      {"frequency: [1, 2]", "frequenzy: 1", 6, 42, "frequency"},
      {"{sinusoid:", "{new at: impact, sinusoid:", 6, 15, "a sinusoid is drawn once a run"},
      {"vertices: [1, 2, 3]", "vertices: [1, 2], box: [1, 2]", 20, 13, "expected {box:"},
      {"vertices: [1, 2, 3]", "box: [1, 2], sampling: corners", 20, 40, "unknown word 'corners'"},
      {"vertices: [1, 2, 3]", "vertices: [1, [1, 2]]", 20, 31, "wrong shape"},
      {"vertices: [1, 2, 3]", "vertices: [1, x(1)]", 20, 31, "changes along a run"},
  };
  for (const Mistake& mistake : mistakes) {
    const auto error = input_error([&] { bound(replaced(kBall, mistake.from, mistake.to)); });
    EXPECT_NE(error.message().find(mistake.message), std::string::npos)
        << mistake.to << ": " << error.what();
    EXPECT_EQ(error.place().line, mistake.line) << mistake.to << ": " << error.what();
    EXPECT_EQ(error.place().column, mistake.column) << mistake.to << ": " << error.what();
  }
}

}  // namespace
}  // namespace gainsmith::io
