// One run of a problem with events, for the tests of the simulator.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <variant>
#include <vector>

#include "simulate/simulator.h"
#include "support/event_problem.h"

namespace gainsmith::simulate {

inline hybrid::Trajectory simulate(const hybrid::System& system, double horizon,
                                   const Accuracy& accuracy = {}, std::uint64_t run = 0) {
  const hybrid::Scenario scenario = hybrid::make_scenario(horizon, system);
  return Simulator(system, scenario).run(1, run, accuracy);
}

inline std::vector<double> jump_times(const hybrid::Trajectory& trajectory, std::size_t event = 0) {
  std::vector<double> times;
  for (const hybrid::JumpPoint& jump : tests::jumps_of(trajectory))
    if (jump.event == event) times.push_back(jump.t);
  return times;
}

/// Parts fit together: each starts where and when the one before it ended.
inline void expect_contiguous(const hybrid::Trajectory& trajectory) {
  double t = 0;
  std::int64_t j = 0;
  for (const auto& part : trajectory.parts) {
    if (const auto* piece = std::get_if<hybrid::FlowPiece>(&part)) {
      EXPECT_EQ(piece->j, j);
      for (const hybrid::DenseStep& step : piece->steps) {
        EXPECT_EQ(step.from, t);
        EXPECT_LT(step.from, step.to);
        t = step.to;
      }
      const Eigen::VectorXd first = piece->steps.front()(piece->from());
      EXPECT_LT((first - piece->start).cwiseAbs().maxCoeff(),
                1e-13 * (1 + piece->start.cwiseAbs().maxCoeff()));
      const Eigen::VectorXd last = piece->steps.back()(piece->to());
      EXPECT_LT((last - piece->end).cwiseAbs().maxCoeff(),
                1e-13 * (1 + piece->end.cwiseAbs().maxCoeff()));
      continue;
    }
    const auto& jump = std::get<hybrid::JumpPoint>(part);
    EXPECT_EQ(jump.t, t);
    EXPECT_EQ(jump.j, j++);
  }
  EXPECT_EQ(trajectory.end, t);
}

}  // namespace gainsmith::simulate
