// The judge on the ends of runs: each cause is believed where it is there, and nowhere else.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "judge/judge.h"
#include "support/dynamics_text.h"
#include "support/reference_run.h"

namespace gainsmith::judge {
namespace {

using Eigen::VectorXd;
using tests::column_of;
using tests::DynamicsText;
using tests::has_fault;
using tests::ReferenceRun;
using tests::to_text;

/// The faults of one flow of the text from 0 to `to` along `values` that ends so.
std::vector<Fault> judged(const DynamicsText& text, const ReferenceRun::Values& values, double to,
                          hybrid::Ending ending, int steps = 4) {
  const model::Dynamics dynamics = text.dynamics();
  ReferenceRun run(values(0), 10);
  run.flow(to, values, steps);
  return check_trajectory(run.end(ending, "because"), dynamics, text.stated());
}

constexpr const char* kCause = "the end is not that of its cause: ";

TEST(JudgedEnds, LeftMeansOutside) {
  DynamicsText text;
  text.state("x", 1, "1", "0").flow_set("x <= 2", "x is large");
  const auto flow = [](double t) { return column_of({t}); };
  EXPECT_TRUE(judged(text, flow, 2, hybrid::Ending::left).empty());
  EXPECT_TRUE(has_fault(judged(text, flow, 1.5, hybrid::Ending::left), 1, kCause));
  EXPECT_TRUE(has_fault(judged(text, flow, 2.1, hybrid::Ending::left), 0,
                        "a flow leaves where it may be: x is large"));
}

TEST(JudgedEnds, EscapedMeansLargeOrAtOnce) {
  DynamicsText text;
  text.state("x", 1, "x^2", "1");
  const auto flow = [](double t) { return column_of({1 / (1 - t)}); };
  // The last step halves the rest again and again, so that polynomials follow.
  const model::Dynamics dynamics = text.dynamics();
  ReferenceRun run(flow(0), 10);
  for (int k = 1; k <= 24; ++k) run.flow(1 - std::ldexp(1, -k), flow, 1);
  EXPECT_TRUE(
      check_trajectory(run.end(hybrid::Ending::escaped, "x escapes"), dynamics, text.stated())
          .empty());
  EXPECT_TRUE(has_fault(judged(text, flow, 0.5, hybrid::Ending::escaped), 1, kCause));
  DynamicsText slow;
  slow.state("x", 1, "x", "1");
  const auto grown = [](double t) { return column_of({std::exp(t)}); };
  EXPECT_TRUE(has_fault(judged(slow, grown, 7, hybrid::Ending::escaped, 16), 1, kCause));
}

TEST(JudgedEnds, UndefinedMeansWithoutAValue) {
  DynamicsText text;
  text.state("x", 1, "-1", "1").state("y", 1, "x*sqrt(x)", "0");
  const auto flow = [](double t) { return column_of({1 - t, 0.4 * (1 - std::pow(1 - t, 2.5))}); };
  const auto faults = judged(text, flow, 1 - 1e-12, hybrid::Ending::undefined, 1);
  EXPECT_FALSE(has_fault(faults, 1, kCause)) << to_text(faults);
  EXPECT_TRUE(has_fault(judged(text, flow, 0.5, hybrid::Ending::undefined), 1, kCause));
}

TEST(JudgedEnds, SlidingMeansAnotherRateAtOnce) {
  DynamicsText text;
  text.state("x", 1, "where(x > 0, -1, 1)", "1");
  const auto flow = [](double t) { return column_of({1 - t}); };
  EXPECT_TRUE(judged(text, flow, 1, hybrid::Ending::sliding).empty());
  EXPECT_TRUE(has_fault(judged(text, flow, 0.5, hybrid::Ending::sliding), 1, kCause));
}

TEST(JudgedEnds, AMessageIsGiven) {
  DynamicsText text;
  text.state("x", 1, "1", "0");
  const model::Dynamics dynamics = text.dynamics();
  ReferenceRun run(column_of({0}), 10);
  run.flow(1, [](double t) { return column_of({t}); });
  EXPECT_TRUE(
      check_trajectory(run.end(hybrid::Ending::interrupted, "stopped"), dynamics, text.stated())
          .empty());
  EXPECT_TRUE(
      has_fault(check_trajectory(run.end(hybrid::Ending::interrupted), dynamics, text.stated()), 1,
                "the end has no message: interrupted"));
}

TEST(JudgedEnds, StuckMeansManyJumps) {
  DynamicsText text;
  text.state("x", 1, "1", "0").when("on", "x >= 0").reacts("on", {{"x", "x + 1"}});
  const model::Dynamics dynamics = text.dynamics();
  ReferenceRun run(column_of({0}), 10);
  for (int k = 1; k <= 20; ++k) run.jump(0, column_of({static_cast<double>(k)}));
  Question question;
  question.least_chain = 20;
  const hybrid::Trajectory trajectory = run.end(hybrid::Ending::stuck, "on is still due");
  EXPECT_TRUE(check_trajectory(trajectory, dynamics, text.stated(), question).empty());
  EXPECT_TRUE(has_fault(check_trajectory(trajectory, dynamics, text.stated()), 20, kCause));
}

TEST(JudgedEnds, PassesMeanALoopThatDoesNotEnd) {
  DynamicsText text;
  text.state("x", 1, "1", "0").when("out", "x >= 1");
  text.repeats("out", {{"x", "x + 1"}}, "x <= 0", "3");
  const auto flow = [](double t) { return column_of({t}); };
  EXPECT_TRUE(judged(text, flow, 1, hybrid::Ending::passes).empty());
  DynamicsText other;
  other.state("x", 1, "1", "0").when("out", "x >= 1");
  other.repeats("out", {{"x", "x - 1"}}, "x <= 0", "3");
  EXPECT_TRUE(has_fault(judged(other, flow, 1, hybrid::Ending::passes), 1, kCause));
}

/// A ball that keeps the parts `even` and `odd` of its speed at the impacts: from height 1, and where
/// its jumps accumulate.
struct Zeno {
  DynamicsText text;
  hybrid::Trajectory trajectory;
  double rest = 0;  ///< from the last impact to the accumulation point

  explicit Zeno(int impacts, double even = 0.5, double odd = 0.5) {
    const double sum = even + odd;
    text.state("x", 3, "[x(2); -2; 0]", fmt::format("[1; 0; {}]", even))
        .when("impact", "x(1) <= 0 and x(2) < 0")
        .reacts("impact", {{"x", fmt::format("[0; -x(3)*x(2); {} - x(3)]", sum)}});
    ReferenceRun run(column_of({1, 0, even}), 10);
    for (int k = 0; k < impacts; ++k) {
      const double from = run.t();
      const VectorXd x = run.x();
      const double length = k == 0 ? 1 : x(1);
      run.flow(from + length, [=](double t) {
        const double s = t - from;
        return column_of({t == from + length ? 0 : x(0) + s * x(1) - s * s, x(1) - 2 * s, x(2)});
      });
      run.jump(0, column_of({0, -x(2) * run.x()(1), sum - x(2)}));
    }
    // Flights of v, f v, f g v, f^2 g v, ...
    rest = run.x()(1) * (1 + run.x()(2)) / (1 - even * odd);
    trajectory = run.end(hybrid::Ending::zeno, "impacts accumulate");
    trajectory.accumulation = trajectory.end + rest;
  }
  std::vector<Fault> judged() const {
    return check_trajectory(trajectory, text.dynamics(), text.stated());
  }
};

TEST(JudgedEnds, ZenoMeansASteadyFactor) {
  Zeno zeno(20);
  EXPECT_TRUE(zeno.judged().empty()) << to_text(zeno.judged());
  zeno.trajectory.accumulation += zeno.rest;
  EXPECT_TRUE(has_fault(zeno.judged(), 40, kCause));
  Zeno early(3);
  EXPECT_TRUE(has_fault(early.judged(), 6, kCause));
}

TEST(JudgedEnds, ZenoMayHaveAPeriodOfTwo) {
  Zeno zeno(24, 0.25, 0.75);
  EXPECT_TRUE(zeno.judged().empty()) << to_text(zeno.judged());
  zeno.trajectory.accumulation += zeno.rest;
  EXPECT_TRUE(has_fault(zeno.judged(), 48, kCause));
}

TEST(JudgedEnds, ChatteringMeansShortFlows) {
  Zeno zeno(40);
  zeno.trajectory.ending = hybrid::Ending::chattering;
  EXPECT_TRUE(zeno.judged().empty()) << to_text(zeno.judged());
  Zeno early(5);
  early.trajectory.ending = hybrid::Ending::chattering;
  EXPECT_TRUE(has_fault(early.judged(), 10, kCause));
}

}  // namespace
}  // namespace gainsmith::judge
