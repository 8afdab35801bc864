// Where it is uncertain which events happen, or in which order.
#include "claims/event_doubts.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "support/event_problem.h"

namespace gainsmith::claims {
namespace {

using EventKind = model::Dynamics::EventKind;
using tests::EventProblem;

/// A run beside a coarser one.
struct Runs {
  explicit Runs(const EventProblem& problem)
      : system(problem.system()),
        fine(run_to({1e-10, 1e-10})),
        coarse(run_to({1e-8, 1e-8})),
        doubts(system),
        twins(pair_twins(fine, coarse, system, doubts.maps())) {}

  hybrid::Trajectory run_to(const simulate::Accuracy& accuracy) const {
    const hybrid::Scenario scenario = hybrid::make_scenario(2, system);
    return simulate::Simulator(system, scenario).run(1, 0, accuracy);
  }

  /// The first doubt about the order of events.
  std::optional<std::string> doubt() {
    doubts.begin(twins);
    for (std::size_t k = 0; k < twins.parts.size(); ++k)
      if (std::holds_alternative<TwinJump>(twins.parts[k]))
        if (auto found = doubts.of_jump(k)) return found;
    return std::nullopt;
  }

  hybrid::System system;
  hybrid::Trajectory fine, coarse;
  EventDoubts doubts;
  TwinParts twins;
};

/// x and y rise at the rate 1 and come to 1 at times that differ by `apart`; both jumps change p.
EventProblem two_events(const std::string& apart, const std::string& first,
                        const std::string& second) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "1").state("y", {}, apart).flow("y", "1");
  problem.state("p", {}, "3");
  problem.crossing(EventKind::rises, "first", "x - 1").jump("first", {{"p", first}});
  problem.crossing(EventKind::rises, "second", "y - 1").jump("second", {{"p", second}});
  return problem;
}

TEST(EventDoubts, AnOrderWithinTheErrorThatMattersIsUncertain) {
  Runs runs(two_events("1e-15", "p + 1", "2*p"));
  const auto doubt = runs.doubt();
  ASSERT_TRUE(doubt);
  EXPECT_NE(doubt->find("first"), std::string::npos) << *doubt;
  EXPECT_NE(doubt->find("second"), std::string::npos) << *doubt;
}

TEST(EventDoubts, EventsThatCommuteAreCertain) {
  EXPECT_FALSE(Runs(two_events("1e-15", "p + 1", "p + 0.1")).doubt());
}

TEST(EventDoubts, EventsThatLieApartAreCertain) {
  EXPECT_FALSE(Runs(two_events("1e-6", "p + 1", "2*p")).doubt());
}

/// `after` is a crossing that the jump of `first` causes, and no flow.
TEST(EventDoubts, ACrossingByAJumpBesideAnotherEvent) {
  EventProblem problem = two_events("-1e-15", "p + 1", "p + 1");
  problem.state("q", {}, "0").jump("first", {{"q", "1"}});
  problem.crossing(EventKind::rises, "after", "q - 0.5").jump("after", {{"p", "p - 3"}});
  Runs runs(problem);
  EXPECT_FALSE(runs.doubt());
  EXPECT_EQ(tests::jumps_of(runs.fine).size(), 3U);
}

/// x(1) = sin(t) turns at 1, which the guard x(1) - 1 only just reaches.
/// To 0 by three thirds: whether that is left, or crossed, is a matter of rounding.
TEST(EventDoubts, AJumpToZeroUpToItsErrorIsUncertain) {
  const auto with = [](const std::string& to) {
    EventProblem problem;
    problem.state("x", {}, "0.7").flow("x", "1").state("p", {}, "3").flow("p", "-0.1");
    problem.crossing(EventKind::rises, "first", "x - 1").jump("first", {{"p", to}});
    problem.crossing(EventKind::falls, "second", "p");
    return Runs(problem).doubt();
  };
  const auto doubt = with("p - 2.97 + 1e-16*sin(x)");
  ASSERT_TRUE(doubt);
  EXPECT_NE(doubt->find("second"), std::string::npos) << *doubt;
  EXPECT_FALSE(with("0"));
  EXPECT_FALSE(with("p - 2.9"));
}

/// p comes to the bound of a condition, but for the rounding of two jumps.
TEST(EventDoubts, AJumpToATieOfAConditionIsUncertain) {
  const auto with = [](const std::string& to) {
    EventProblem problem;
    problem.state("x", {}, "0.7").flow("x", "1").state("p", {}, "0.3").state("n", {}, "0");
    problem.crossing(EventKind::rises, "first", "x - 1").jump("first", {{"p", to}});
    problem.when("second", "p > 0.9 and n < 1").jump("second", {{"n", "1"}});
    return Runs(problem).doubt();
  };
  const auto doubt = with("p + p + 0.3");
  ASSERT_TRUE(doubt);
  EXPECT_NE(doubt->find("condition of second to a tie"), std::string::npos) << *doubt;
  EXPECT_FALSE(with("0.9"));
  EXPECT_FALSE(with("p + 0.7"));
}

/// The same of the `if` of an event that this jump makes due.
TEST(EventDoubts, AJumpToATieOfAnIfIsUncertain) {
  const auto with = [](const std::string& to) {
    EventProblem problem;
    problem.state("x", {}, "0.7").flow("x", "1").state("p", {}, "0.3").state("n", {}, "0");
    problem.crossing(EventKind::rises, "first", "x - 1").jump("first", {{"p", to}});
    problem.crossing(EventKind::rises, "second", "p - 0.5").jump("second", {{"n", "1"}});
    problem.only_if("p >= 0.9");
    return Runs(problem).doubt();
  };
  const auto doubt = with("p + p + 0.3");
  ASSERT_TRUE(doubt);
  EXPECT_NE(doubt->find("'if' of second, which is due, to a tie"), std::string::npos) << *doubt;
  EXPECT_FALSE(with("0.9"));
  EXPECT_FALSE(with("p + 0.7"));
  EXPECT_FALSE(with("p - 0.2"));
}

/// Its own jump takes its speed where it has crossed: whether it crosses again is rounding.
TEST(EventDoubts, ACrossingWithinItsRoundingIsUncertain) {
  EventProblem problem;
  problem.state("x", {}, "0.5").flow("x", "v").state("v", {}, "-0.5").flow("v", "-3.99*x");
  problem.crossing(EventKind::falls, "low", "x + 0.5").jump("low", {{"v", "v + 0.5"}});
  problem.crossing(EventKind::falls, "far", "x + 9");
  Runs runs(problem);
  EXPECT_TRUE(tests::jumps_of(runs.fine).size() == 1 || runs.doubt());
}

TEST(EventDoubts, ATurningPointWithinTheErrorIsUncertain) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[0; 1]").flow("x", "[x(2); -x(1)]");
  problem.crossing(EventKind::rises, "top", "x(1) - 1 - 1e-3").jump("top", {{"x", "0*x"}});
  Runs runs(problem);
  ASSERT_EQ(runs.twins.parts.size(), 1U);
  const auto& flow = std::get<TwinFlow>(runs.twins.parts[0]);
  hybrid::NearTurn turn;
  turn.of = hybrid::NearTurn::Of::crossing;
  turn.t = 1.5707963;
  turn.text = "x(1) - 1";
  turn.value = -1e-3;
  EXPECT_FALSE(runs.doubts.of_turn(turn, flow));
  turn.value = -1e-17;
  const auto doubt = runs.doubts.of_turn(turn, flow);
  ASSERT_TRUE(doubt);
  EXPECT_NE(doubt->find("x(1) - 1"), std::string::npos) << *doubt;
}

/// At t = 1, where x = 16.5 but for `off`, p jumps to a text of x.
EventProblem sampled(const std::string& off, const std::string& text) {
  EventProblem problem;
  problem.state("x", {}, "0.1").flow("x", "16.4 + " + off).state("p", {}, "0");
  problem.every("sample", "1", "1").jump("sample", {{"p", text}});
  return problem;
}

TEST(EventDoubts, AQuantizerAtATieIsUncertain) {
  const auto doubt = Runs(sampled("0", "floor(x + 0.5)")).doubt();
  ASSERT_TRUE(doubt);
  EXPECT_NE(doubt->find("sample"), std::string::npos) << *doubt;
  EXPECT_TRUE(Runs(sampled("0", "where(x >= 16.5, 2, 1)")).doubt());
  EXPECT_FALSE(Runs(sampled("1e-9", "floor(x + 0.5)")).doubt());
  EXPECT_FALSE(Runs(sampled("-1e-9", "floor(x + 0.5)")).doubt());
}

TEST(EventDoubts, AStepOfAMapThatChangesNothingIsCertain) {
  for (const char* text :
       {"where(x >= 16.5, x - 16.5, 0)", "max(x, 16.5)", "sqrt(abs(x - 16.5))", "0*floor(x + 0.5)"})
    EXPECT_FALSE(Runs(sampled("0", text)).doubt()) << text;
}

/// An event lies on the side of its guard that lets it happen, and so do maps that branch there.
TEST(EventDoubts, AMapThatBranchesOnItsOwnGuardIsCertain) {
  for (const bool crossing : {false, true}) {
    EventProblem problem;
    problem.state("x", {}, "0.1").flow("x", "16.4").state("p", {}, "0");
    if (crossing)
      problem.crossing(EventKind::rises, "full", "x - 16.5");
    else
      problem.when("full", "x >= 16.5 and p < 1");
    problem.jump("full", {{"p", "where(x >= 16.5, 2, 1)"}, {"x", "where(2*x >= 33, 0, x)"}});
    EXPECT_FALSE(Runs(problem).doubt()) << crossing;
  }
}

TEST(EventDoubts, WholeNumbersAreAtNoTie) {
  EventProblem problem;
  problem.state("n", {}, "0").state("p", {}, "0");
  problem.every("sample", "0.1", "0.1")
      .jump("sample", {{"n", "n + 1"}, {"p", "floor(n/3) + sign(n)"}});
  EXPECT_FALSE(Runs(problem).doubt());
}

}  // namespace
}  // namespace gainsmith::claims
