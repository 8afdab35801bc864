// The judge on clocks, losses, noise and the order of jumps.
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

/// A plant with an observer that sees noisy samples, of which some are lost. Variables: x, n, xh,
/// w, count(sample), since(sample), sample.left.
struct Sampled {
  struct Sample {
    double length = 0.15;
    double noise = 0.05;
    bool lost = false;
    bool seen = true;  ///< by the observer
  };
  DynamicsText text;
  model::Dynamics dynamics;
  double first = 0.12;

  explicit Sampled(bool has_left = true) {
    text.state("x", 1, "-0.5*x", "1")
        .state("n", 1, "", "0")
        .every("sample", "0.1", "0.2")
        .lost(0.4, 2)
        .reacts("sample", {{"n", "n + 1"}})
        .observer("observer")
        .state("xh", 1, "-0.5*xh", "0")
        .reacts("sample", {{"xh", "xh + 0.75*(x + w - xh)"}})
        .noise("w", model::Dynamics::NoiseKind::uniform, {"-0.1", "0.1"})
        .drawn_at("sample")
        .signal("run", has_left ? "count(sample) + since(sample) + sample.left"
                                : "count(sample) + since(sample)");
    dynamics = text.dynamics();
  }
  bool has_left() const { return dynamics.variables.size() == 7; }

  ReferenceRun::Values flow(const VectorXd& x, double from) const {
    return [this, x, from](double t) {
      VectorXd y = x;
      const double s = t - from;
      y(0) *= std::exp(-0.5 * s);
      y(2) *= std::exp(-0.5 * s);
      y(5) = x(5) + s;
      if (has_left()) y(6) = x(6) - s;
      return y;
    };
  }
  VectorXd jump(const VectorXd& x, const Sample& sample) const {
    VectorXd y = x;
    y(1) += 1;
    if (sample.seen) y(2) = x(2) + 0.75 * (x(0) + sample.noise - x(2));
    y(4) += 1;
    y(5) = 0;
    if (has_left()) y(6) = sample.length;
    return y;
  }
  /// Samples after `first` and then after each length; a flow to the horizon at the end.
  hybrid::Trajectory run(const std::vector<Sample>& samples, double last = 0.05) const {
    VectorXd start = column_of({1, 0, 0, 0.02, 0, 0, first});
    if (!has_left()) start.conservativeResize(6);
    double horizon = first;
    for (const Sample& sample : samples) horizon += sample.length;
    ReferenceRun reference(start, horizon - samples.back().length + last);
    double t = first;
    for (const Sample& sample : samples) {
      reference.flow(t, flow(reference.x(), reference.t()), 1);
      reference.draw(3, sample.noise);
      reference.jump(0, jump(reference.x(), sample), sample.lost);
      t += sample.length;
    }
    const double end = reference.t() + last;
    reference.flow(end, flow(reference.x(), reference.t()), 1);
    hybrid::Trajectory trajectory = reference.end();
    trajectory.horizon = end;
    return trajectory;
  }
  std::vector<Fault> judged(const hybrid::Trajectory& trajectory) const {
    return check_trajectory(trajectory, dynamics, text.stated());
  }
};

const Sampled::Sample kLost{0.15, 0.03, true, false};

TEST(JudgedSamples, AreAccepted) {
  for (const bool has_left : {true, false}) {
    const Sampled sampled(has_left);
    const auto faults =
        sampled.judged(sampled.run({{}, {0.1, -0.1}, kLost, kLost, {0.2, 0.1}, kLost, {}}));
    EXPECT_TRUE(faults.empty()) << to_text(faults);
  }
}

TEST(JudgedSamples, LengthsMustLieInTheirRange) {
  for (const bool has_left : {true, false})
    for (const double length : {0.201, 0.25, 0.099, 0.01}) {
      const Sampled sampled(has_left);
      const auto faults = sampled.judged(sampled.run({{}, {length}, {}}));
      // With what is left it is seen where the clock is set, else at the next sample.
      EXPECT_TRUE(has_fault(faults, has_left ? 3 : 5, "length of the clock is not in its range"))
          << to_text(faults);
    }
  Sampled sampled(false);
  EXPECT_TRUE(has_fault(sampled.judged(sampled.run({{}, {}}, 0.21)), 5, "length of the clock"));
  sampled.first = 0.3;
  EXPECT_TRUE(has_fault(sampled.judged(sampled.run({{}})), 1, "length of the clock"));
  Sampled with_left;
  with_left.first = 0.05;
  EXPECT_TRUE(has_fault(with_left.judged(with_left.run({{}})), 0, "first length of the clock"));
}

TEST(JudgedSamples, AClockIsNotMissedAndNotEarly) {
  const Sampled sampled;
  EXPECT_TRUE(has_fault(sampled.judged(sampled.run({{}, {}}, 0.17)), 4,
                        "becomes due inside a flow: sample"));
  hybrid::Trajectory trajectory = sampled.run({{}, {}, {}});
  std::get<hybrid::JumpPoint>(trajectory.parts[3]).after(6) += 0.01;
  const auto faults = sampled.judged(trajectory);
  EXPECT_TRUE(has_fault(faults, 5, "jumps, but is not due: sample")) << to_text(faults);
  EXPECT_TRUE(has_fault(faults, 4, "what is left of the clock is wrong")) << to_text(faults);
}

TEST(JudgedSamples, WhatIsLostIsNotSeen) {
  const Sampled sampled;
  Sampled::Sample seen = kLost;
  seen.seen = true;
  auto faults = sampled.judged(sampled.run({{}, seen, {}}));
  EXPECT_TRUE(has_fault(faults, 3, "to which its component does not react: xh")) << to_text(faults);
  Sampled::Sample unseen;
  unseen.seen = false;
  faults = sampled.judged(sampled.run({{}, unseen, {}}));
  EXPECT_TRUE(has_fault(faults, 3, "the jump sample gives another value: xh")) << to_text(faults);
}

TEST(JudgedSamples, NotMoreAreLostThanMayBe) {
  Sampled sampled;
  const auto faults = sampled.judged(sampled.run({kLost, kLost, kLost, {}}));
  EXPECT_TRUE(has_fault(faults, 5, "lost more often in a row")) << to_text(faults);
  const hybrid::Trajectory trajectory = sampled.run({{}, kLost, {}});
  sampled.dynamics.events[0].lost = 0;
  sampled.dynamics.events[0].lost_in_a_row.reset();
  EXPECT_TRUE(has_fault(sampled.judged(trajectory), 3, "is lost, but never may be: sample"));
}

TEST(JudgedSamples, NoiseLiesInItsRangeAndIsDrawnAtItsEvent) {
  const Sampled sampled;
  auto faults = sampled.judged(sampled.run({{}, {0.15, 0.11}, {}}));
  EXPECT_TRUE(has_fault(faults, 3, "noise outside of its range: w")) << to_text(faults);
  hybrid::Trajectory trajectory = sampled.run({{}, {}});
  auto& piece = std::get<hybrid::FlowPiece>(trajectory.parts[2]);
  piece.start(3) = piece.end(3) = piece.steps[0].coefficients(3, 0) = 0.01;
  faults = sampled.judged(trajectory);
  EXPECT_TRUE(has_fault(faults, 2, "does not go on from the part before it: w")) << to_text(faults);
  EXPECT_FALSE(has_fault(faults, 3, ": w")) << to_text(faults);  // drawn there
}

/// Noise that is drawn every 0.25 switches the flow without a jump.
TEST(JudgedNoise, ChangesAtItsTimesAlone) {
  DynamicsText text;
  text.state("x", 1, "w", "0")
      .noise("w", model::Dynamics::NoiseKind::normal, {"0", "1"})
      .drawn_every("0.25");
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](double at, bool one_piece) {
    hybrid::FlowPiece piece;
    const auto first = [](double t) { return column_of({2 * t, 2}); };
    const auto second = [at](double t) { return column_of({2 * at - (t - at), -1}); };
    piece.start = first(0);
    piece.steps = {tests::dense_step(0, at, first), tests::dense_step(at, 0.4, second)};
    piece.end = second(0.4);
    hybrid::Trajectory trajectory;
    trajectory.start = piece.start;
    trajectory.horizon = trajectory.end = 0.4;
    if (one_piece) {
      trajectory.parts = {piece};
    } else {
      hybrid::FlowPiece before = piece;
      before.steps.pop_back();
      before.end = first(at);
      piece.steps.erase(piece.steps.begin());
      piece.start = second(at);
      trajectory.parts = {before, piece};
    }
    return check_trajectory(trajectory, dynamics, text.stated());
  };
  for (const bool one_piece : {true, false})
    EXPECT_TRUE(judged(0.25, one_piece).empty()) << to_text(judged(0.25, one_piece));
  EXPECT_TRUE(has_fault(judged(0.2, true), 0, "the steps of a flow do not join: w"));
  EXPECT_TRUE(has_fault(judged(0.2, false), 1, "does not go on from the part before it: w"));
}

/// Two clocks whose maps do not commute. Variables: x, which rests.
struct Clocks {
  DynamicsText text;
  model::Dynamics dynamics;

  explicit Clocks(const std::string& only_if = "") {
    text.state("x", 1, "", "1").every("slow", "0.5").every("fast", "0.25");
    if (!only_if.empty()) text.only_if(only_if);
    text.reacts("slow", {{"x", "2*x"}}).reacts("fast", {{"x", "x + 1"}});
    dynamics = text.dynamics();
  }
  /// Jumps at times; event 0 is slow, 1 fast.
  std::vector<Fault> judged(const std::vector<std::pair<double, std::size_t>>& jumps,
                            double horizon) const {
    ReferenceRun run(column_of({1}), horizon);
    const auto flow_to = [&](double t) {
      const VectorXd x = run.x();
      if (t > run.t())
        run.flow(
            t, [x](double) { return x; }, 1);
    };
    for (const auto& [t, event] : jumps) {
      flow_to(t);
      run.jump(event, event == 0 ? VectorXd(2 * run.x()) : VectorXd(run.x().array() + 1));
    }
    flow_to(horizon);
    return check_trajectory(run.end(), dynamics, text.stated());
  }
};

TEST(JudgedOrder, TheFirstThatIsDueJumps) {
  const Clocks clocks;
  const auto faults = clocks.judged({{0.25, 1}, {0.5, 0}, {0.5, 1}}, 0.6);
  EXPECT_TRUE(faults.empty()) << to_text(faults);
  EXPECT_TRUE(has_fault(clocks.judged({{0.25, 1}, {0.5, 1}, {0.5, 0}}, 0.6), 3,
                        "is due before fast, which jumps: slow"));
}

TEST(JudgedOrder, TicksAreExactMissedAtNoTimeAndNotAtTheHorizon) {
  const Clocks clocks;
  EXPECT_TRUE(
      has_fault(clocks.judged({{0.25 + 1e-9, 1}}, 0.4), 0, "becomes due inside a flow: fast"));
  EXPECT_TRUE(has_fault(clocks.judged({{0.25 - 1e-9, 1}}, 0.4), 1, "jumps, but is not due: fast"));
  EXPECT_TRUE(
      has_fault(clocks.judged({{0.25, 1}, {0.5, 0}}, 0.6), 4, "is due, but does not jump: fast"));
  EXPECT_TRUE(has_fault(clocks.judged({{0.25, 1}, {0.5, 1}}, 0.6), 3, "which jumps: slow"));
  EXPECT_TRUE(has_fault(clocks.judged({}, 0.25), 1, "is due, but does not jump: fast"));
  const auto faults = clocks.judged({{0.25, 1}}, 0.25);
  EXPECT_TRUE(faults.empty()) << to_text(faults);
}

TEST(JudgedOrder, IfSpendsAnOccurrence) {
  // Where x is 2 `fast` does nothing: at 0.5, after slow made 4 of 2, it jumps.
  const Clocks clocks("x != 1");
  auto faults = clocks.judged({{0.5, 0}, {0.5, 1}, {0.75, 1}}, 0.8);
  EXPECT_TRUE(faults.empty()) << to_text(faults);
  faults = clocks.judged({{0.25, 1}}, 0.4);
  EXPECT_TRUE(has_fault(faults, 1, "jumps, but is not due: fast")) << to_text(faults);
  faults = clocks.judged({{0.5, 0}, {0.5, 1}}, 0.8);
  EXPECT_TRUE(has_fault(faults, 3, "becomes due inside a flow: fast")) << to_text(faults);
}

TEST(JudgedOrder, GivenTimes) {
  DynamicsText text;
  text.state("x", 1, "1", "0").at("log", {"[0; 0.3; 1]", "0.7"}).reacts("log", {{"x", "0"}});
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](const std::vector<double>& times) {
    ReferenceRun run(column_of({0}), 0.9);
    const auto flow_to = [&](double t) {
      const double from = run.t();
      if (t > from)
        run.flow(
            t, [from](double s) { return column_of({s - from}); }, 1);
    };
    for (const double t : times) {
      flow_to(t);
      run.jump(0, column_of({0}));
    }
    flow_to(0.9);
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(judged({0, 0.3, 0.7}).empty()) << to_text(judged({0, 0.3, 0.7}));
  EXPECT_TRUE(has_fault(judged({0.3, 0.7}), 0, "is due, but does not jump: log"));
  EXPECT_TRUE(has_fault(judged({0, 0.7}), 1, "becomes due inside a flow: log"));
  EXPECT_TRUE(has_fault(judged({0, 0.3, 0.5, 0.7}), 4, "jumps, but is not due: log"));
}

}  // namespace
}  // namespace gainsmith::judge
