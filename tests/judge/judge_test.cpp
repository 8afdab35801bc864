// The judge on flows and jumps: runs from closed forms are accepted, planted faults are named.
#include "judge/judge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/dynamics_text.h"
#include "support/reference_run.h"

namespace gainsmith::judge {
namespace {

using Eigen::VectorXd;
using tests::DynamicsText;
using tests::has_fault;
using tests::place_of;
using tests::ReferenceRun;
using tests::to_text;

constexpr double kGravity = 9.81;

/// A bouncing ball, a component that counts impacts, and one that does not look at them.
struct Ball {
  DynamicsText text;
  model::Dynamics dynamics;
  double horizon = 2;

  Ball() {
    text.state("x", 2, "[x(2); -9.81]", "[1; 0]")
        .when("impact", "x(1) <= 0 and x(2) < 0")
        .reacts("impact", {{"x", "[0; -0.8*x(2)]"}})
        .observer("counter")
        .state("n", 1, "", "0")
        .symmetric("P", 2, "[1, 0; 0, 1]", "[0, 1; 1, 0]")
        .reacts("impact", {{"n", "n + 1"}, {"P", "[2, 1; 1, 2]"}})
        .observer("idle")
        .state("z", 1, "-z", "1")
        .mode("q", "3")
        .signal("run", "t + j + count(impact) + since(impact) + z + q");
    dynamics = text.dynamics();
  }

  VectorXd start() const {
    VectorXd x = VectorXd::Zero(13);
    set(x, "x", 1);
    x.segment(place_of(dynamics, "P"), 4) << 0, 1, 1, 0;
    set(x, "z", 1);
    set(x, "q", 3);
    return x;
  }
  void set(VectorXd& x, const std::string& name, double value) const {
    x(place_of(dynamics, name)) = value;
  }
  double get(const VectorXd& x, const std::string& name) const {
    return x(place_of(dynamics, name));
  }

  /// The flow from x at `from`.
  ReferenceRun::Values flow(const VectorXd& x, double from) const {
    return [this, x, from](double t) {
      VectorXd y = x;
      const double s = t - from;
      const Eigen::Index at = place_of(dynamics, "x");
      y(at) = x(at) + s * x(at + 1) - kGravity / 2 * s * s;
      y(at + 1) = x(at + 1) - kGravity * s;
      const Eigen::Index P = place_of(dynamics, "P");
      y(P) += s;
      y(P + 3) += s;
      set(y, "z", get(x, "z") * std::exp(-s));
      set(y, "t", t);
      set(y, "since(impact)", get(x, "since(impact)") + s);
      return y;
    };
  }
  VectorXd impact(const VectorXd& x) const {
    VectorXd y = x;
    const Eigen::Index at = place_of(dynamics, "x");
    y(at) = 0;
    y(at + 1) = -0.8 * x(at + 1);
    set(y, "n", get(x, "n") + 1);
    y.segment(place_of(dynamics, "P"), 4) << 2, 1, 1, 2;
    set(y, "j", get(x, "j") + 1);
    set(y, "count(impact)", get(x, "count(impact)") + 1);
    set(y, "since(impact)", 0);
    return y;
  }
  /// How long it flies from x.
  double flight(const VectorXd& x) const {
    const Eigen::Index at = place_of(dynamics, "x");
    return (x(at + 1) + std::sqrt(x(at + 1) * x(at + 1) + 2 * kGravity * x(at))) / kGravity;
  }

  ReferenceRun begin() const { return {start(), horizon}; }
  /// Flows to the next impact and `late` beyond, and jumps.
  void bounce(ReferenceRun& run, double late = 0) const {
    run.flow(run.t() + flight(run.x()) + late, flow(run.x(), run.t()));
    run.jump(0, impact(run.x()));
  }
  void finish(ReferenceRun& run) const { run.flow(horizon, flow(run.x(), run.t())); }
  /// Parts 0 to 6: flows with three impacts between them.
  hybrid::Trajectory right() const {
    ReferenceRun run = begin();
    for (int k = 0; k < 3; ++k) bounce(run);
    finish(run);
    return run.end();
  }
  std::vector<Fault> judged(const hybrid::Trajectory& trajectory, double accuracy = 1e-10) const {
    Question question;
    question.relative = accuracy;
    question.absolute = accuracy;
    return check_trajectory(trajectory, dynamics, text.stated(), question);
  }
};

hybrid::FlowPiece& flow_part(hybrid::Trajectory& trajectory, std::size_t part) {
  return std::get<hybrid::FlowPiece>(trajectory.parts[part]);
}

hybrid::JumpPoint& jump_part(hybrid::Trajectory& trajectory, std::size_t part) {
  return std::get<hybrid::JumpPoint>(trajectory.parts[part]);
}

TEST(Judge, AcceptsABouncingBall) {
  const Ball ball;
  const auto faults = ball.judged(ball.right());
  EXPECT_TRUE(faults.empty()) << to_text(faults);
  const auto strict = ball.judged(ball.right(), 1e-14);
  EXPECT_TRUE(strict.empty()) << to_text(strict);
}

TEST(Judge, FindsASkippedJump) {
  const Ball ball;
  ReferenceRun run = ball.begin();
  ball.bounce(run);
  ball.finish(run);
  const auto faults = ball.judged(run.end());
  EXPECT_TRUE(has_fault(faults, 2, "becomes due inside a flow: impact")) << to_text(faults);
  EXPECT_TRUE(has_fault(faults, 3, "is due, but does not jump: impact")) << to_text(faults);
}

TEST(Judge, FindsALateJump) {
  const Ball ball;
  for (const double late : {1e-3, 1e-6, 1e-10}) {
    ReferenceRun run = ball.begin();
    ball.bounce(run, late);
    ball.bounce(run);
    ball.bounce(run);
    ball.finish(run);
    const auto faults = ball.judged(run.end());
    EXPECT_TRUE(has_fault(faults, 0, "becomes due inside a flow: impact"))
        << late << to_text(faults);
    EXPECT_EQ(faults.size(), 1u) << to_text(faults);
  }
}

TEST(Judge, FindsAnEarlyJump) {
  const Ball ball;
  ReferenceRun run = ball.begin();
  ball.bounce(run, -1e-9);
  const auto faults = ball.judged(run.end());
  EXPECT_TRUE(has_fault(faults, 1, "jumps, but is not due: impact")) << to_text(faults);
}

TEST(Judge, FindsADoubledJump) {
  const Ball ball;
  ReferenceRun run = ball.begin();
  ball.bounce(run);
  run.jump(0, ball.impact(run.x()));
  EXPECT_TRUE(has_fault(ball.judged(run.end()), 2, "jumps, but is not due: impact"));
}

TEST(Judge, FindsAWrongMap) {
  const Ball ball;
  hybrid::Trajectory trajectory = ball.right();
  jump_part(trajectory, 1).after(1) *= 1 + 1e-12;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 1, "the jump impact gives another value: x"));
}

/// 0.1 + 0.2 - 0.3 is 0, or what the order and the fused steps of a computation leave of it.
TEST(Judge, AJumpMapIsOffByTheRoundingOfItsTerms) {
  DynamicsText text;
  text.state("x", 1, "", "1").at("sum", {"1"}).reacts("sum", {{"x", "0.1*x + 0.2*x - 0.3*x"}});
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](double after) {
    const auto rest = [](double x) { return [x](double) { return VectorXd::Constant(1, x); }; };
    ReferenceRun run(VectorXd::Ones(1), 2);
    run.flow(1, rest(1)).jump(0, VectorXd::Constant(1, after)).flow(2, rest(after));
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  for (const double rounding : {0.0, 5.5e-17, -1.1e-16})
    EXPECT_TRUE(judged(rounding).empty()) << to_text(judged(rounding));
  EXPECT_TRUE(has_fault(judged(1e-12), 1, "the jump sum gives another value: x"));
}

TEST(Judge, FindsAStateThatJumpsWithoutAReaction) {
  const Ball ball;
  hybrid::Trajectory trajectory = ball.right();
  double& z = jump_part(trajectory, 3).after(place_of(ball.dynamics, "z"));
  z = std::nextafter(z, 1);  // its bits count
  const auto faults = ball.judged(trajectory);
  EXPECT_TRUE(has_fault(faults, 3, "to which its component does not react: z")) << to_text(faults);
}

TEST(Judge, FindsWrongNumbersOfTheRun) {
  const Ball ball;
  for (const std::string name : {"j", "count(impact)", "since(impact)", "t"}) {
    hybrid::Trajectory trajectory = ball.right();
    jump_part(trajectory, 5).after(place_of(ball.dynamics, name)) += 1;
    const auto faults = ball.judged(trajectory);
    EXPECT_TRUE(has_fault(faults, 5, "wrong after the jump impact: " + name)) << to_text(faults);
    EXPECT_TRUE(has_fault(faults, 5, "has another value: " + name)) << to_text(faults);
  }
  hybrid::Trajectory trajectory = ball.right();
  jump_part(trajectory, 3).j = 2;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 3, "has another number of jumps"));
}

TEST(Judge, FindsAMatrixThatIsNotSymmetric) {
  const Ball ball;
  hybrid::Trajectory trajectory = ball.right();
  double& element = jump_part(trajectory, 1).after(place_of(ball.dynamics, "P") + 1);
  element = std::nextafter(element, 2);
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 1, "not symmetric after the jump impact: P"));
}

TEST(Judge, FindsAFlowThatIsOff) {
  const Ball ball;
  for (const double slope : {1e-6, -1e-6}) {
    ReferenceRun run = ball.begin();
    for (int k = 0; k < 3; ++k) ball.bounce(run);
    const auto right = ball.flow(run.x(), run.t());
    const double from = run.t();
    run.flow(ball.horizon, [&](double t) {
      VectorXd x = right(t);
      ball.set(x, "z", ball.get(x, "z") + slope * (t - from));
      return x;
    });
    const auto faults = ball.judged(run.end());
    EXPECT_TRUE(has_fault(faults, 6, "does not follow its text: z")) << to_text(faults);
    EXPECT_FALSE(has_fault(faults, 6, "does not follow its text: x")) << to_text(faults);
  }
}

TEST(Judge, FindsABumpBetweenTheEndsOfAStep) {
  const Ball ball;
  hybrid::Trajectory trajectory = ball.right();
  hybrid::DenseStep& step = flow_part(trajectory, 2).steps[1];
  const Eigen::Index z = place_of(ball.dynamics, "z");
  step.coefficients(z, 0) += 1e-7;  // T_0 - T_2 is 0 at both ends
  step.coefficients(z, 2) -= 1e-7;
  const auto faults = ball.judged(trajectory);
  ASSERT_EQ(faults.size(), 1u) << to_text(faults);
  EXPECT_TRUE(has_fault(faults, 2, "a flow does not follow its text: z"));
  EXPECT_GT(faults[0].t, step.from);
  EXPECT_LT(faults[0].t, step.to);
  EXPECT_NEAR(faults[0].size, 2e-7, 1e-9);
}

TEST(Judge, FindsADriftThatNoStepShows) {
  // Each of 400 steps is off by 20 times the accuracy: allowed to each of them, not to all.
  const Ball ball;
  ReferenceRun run = ball.begin();
  for (int k = 0; k < 3; ++k) ball.bounce(run);
  const auto right = ball.flow(run.x(), run.t());
  const double from = run.t();
  const int steps = 400;
  const auto drifting = [&](double by) {
    return [&, by](double t) {
      VectorXd x = right(t);
      ball.set(x, "z", ball.get(x, "z") + by * steps * (t - from) / (ball.horizon - from));
      return x;
    };
  };
  ReferenceRun fine = run;
  fine.flow(ball.horizon, drifting(2e-10), steps);
  EXPECT_TRUE(ball.judged(fine.end()).empty());
  run.flow(ball.horizon, drifting(2e-9), steps);
  const auto faults = ball.judged(run.end());
  EXPECT_TRUE(has_fault(faults, 6, "a flow drifts away from its text: z")) << to_text(faults);
  EXPECT_EQ(faults.size(), 1u) << to_text(faults);
}

TEST(Judge, FindsADiscontinuity) {
  const Ball ball;
  hybrid::Trajectory trajectory = ball.right();
  flow_part(trajectory, 2).start(1) += 1e-9;
  const auto faults = ball.judged(trajectory);
  EXPECT_TRUE(has_fault(faults, 2, "does not go on from the part before it: x")) << to_text(faults);

  trajectory = ball.right();
  std::vector<hybrid::DenseStep>& steps = flow_part(trajectory, 4).steps;
  steps[2].coefficients(place_of(ball.dynamics, "z"), 0) += 1e-9;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 4, "the steps of a flow do not join: z"));

  trajectory = ball.right();
  flow_part(trajectory, 4).steps.erase(flow_part(trajectory, 4).steps.begin() + 1);
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 4, "the steps of a flow are not contiguous"));

  trajectory = ball.right();
  jump_part(trajectory, 3).before(0) += 1e-12;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 3, "does not go on from the part before it: x"));
}

TEST(Judge, FindsWhatMovesButRests) {
  const Ball ball;
  for (const std::string name : {"q", "n", "count(impact)"}) {
    hybrid::Trajectory trajectory = ball.right();
    hybrid::DenseStep& step = flow_part(trajectory, 2).steps[1];
    const Eigen::Index at = place_of(ball.dynamics, name);
    step.coefficients(at, 0) += 1e-9;  // T_0 - T_2 is 0 at both ends
    step.coefficients(at, 2) -= 1e-9;
    EXPECT_TRUE(has_fault(ball.judged(trajectory), 2, "flows, but rests: " + name)) << name;
  }
  hybrid::Trajectory trajectory = ball.right();
  hybrid::DenseStep& step = flow_part(trajectory, 2).steps[1];
  step.coefficients(place_of(ball.dynamics, "since(impact)"), 2) += 1e-9;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 2, "a clock does not run at its rate: since"));
}

TEST(Judge, FindsAWrongStart) {
  const Ball ball;
  hybrid::Trajectory trajectory = ball.right();
  trajectory.start(0) = 1.5;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 0, "starts with another value: x"));
  // A campaign's range takes the place of the text's start.
  Question question;
  question.starts.push_back({0, numbers::Matrix{{0.5}, {-1}}, numbers::Matrix{{1.5}, {1}}});
  EXPECT_TRUE(check_trajectory(ball.right(), ball.dynamics, ball.text.stated(), question).empty());
  question.starts[0].low(0) = 1.1;
  EXPECT_TRUE(has_fault(check_trajectory(ball.right(), ball.dynamics, ball.text.stated(), question),
                        0, "starts outside of its range: x"));
}

TEST(Judge, FindsAnEndBeforeTheHorizon) {
  const Ball ball;
  ReferenceRun run = ball.begin();
  ball.bounce(run);
  run.flow(1, ball.flow(run.x(), run.t()));
  EXPECT_TRUE(has_fault(ball.judged(run.end()), 3, "the end is not that of its cause: horizon"));
  hybrid::Trajectory trajectory = ball.right();
  trajectory.end = 1.9;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 7, "the run does not end where its last part"));
}

TEST(Judge, RefusesWhatIsNotWellFormed) {
  const Ball ball;
  hybrid::Trajectory trajectory = ball.right();
  flow_part(trajectory, 4).steps.clear();
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 4, "not well formed"));
  trajectory = ball.right();
  jump_part(trajectory, 1).event = 7;
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 1, "not well formed"));
  trajectory = ball.right();
  jump_part(trajectory, 1).after(1) = std::nan("");
  EXPECT_TRUE(has_fault(ball.judged(trajectory), 1, "gives another value: x"));
}

/// x' = -2 t x^2 from 1 is 1/(1 + t^2): the time is a variable of the flow.
TEST(Judge, FollowsANonlinearFlowThatDependsOnTime) {
  DynamicsText text;
  text.state("x", 1, "-2*t*x^2", "1")
      .crosses("half", "x - 0.5")
      .observer("late")
      .state("n", 1, "", "0");
  text.reacts("half", {{"n", "n + t"}});
  const model::Dynamics dynamics = text.dynamics();
  const auto run = [&](double cross) {
    const auto flow = [](double n) {
      return [n](double t) { return VectorXd(Eigen::Vector3d(1 / (1 + t * t), n, t)); };
    };
    ReferenceRun reference(flow(0)(0), 3);
    reference.flow(cross, flow(0), 6);
    reference.jump(0, Eigen::Vector3d(reference.x()(0), cross, cross));
    reference.flow(3, flow(cross), 6);
    return check_trajectory(reference.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(run(1).empty()) << to_text(run(1));
  EXPECT_TRUE(has_fault(run(1.001), 0, "crosses zero inside a flow: half"));
  EXPECT_TRUE(has_fault(run(0.999), 1, "jumps, but is not due: half"));
}

/// The steps are so long that eight Gauss steps and more are needed in each.
TEST(Judge, IntegratesLongAndStiffSteps) {
  DynamicsText text;
  text.state("x", 2, "[-1000*(x(1) - cos(3*t)) - 3*sin(3*t); 5*x(1)]", "[1; 0]");
  const model::Dynamics dynamics = text.dynamics();
  const auto flow = [](double off) {
    return [off](double t) {
      return VectorXd(Eigen::Vector3d(std::cos(3 * t), 5.0 / 3 * std::sin(3 * t) + off * t, t));
    };
  };
  ReferenceRun right(flow(0)(0), 4);
  const auto faults = check_trajectory(right.flow(4, flow(0), 8).end(), dynamics, text.stated());
  EXPECT_TRUE(faults.empty()) << to_text(faults);
  ReferenceRun wrong(flow(0)(0), 4);
  EXPECT_TRUE(
      has_fault(check_trajectory(wrong.flow(4, flow(1e-6), 8).end(), dynamics, text.stated()), 0,
                "does not follow its text: x"));
}

TEST(Judge, ATextWithoutAValueIsAnErrorAtItsPlace) {
  DynamicsText text;
  text.datum("a", numbers::Matrix::Ones(1, 1)).state("x", 1, "-a*x", "1");
  const model::Dynamics dynamics = text.dynamics();
  EXPECT_THROW(check_trajectory({}, dynamics, model::Stated{}), InputError);
}

}  // namespace
}  // namespace gainsmith::judge
