// What a run keeps has an end.
#include "simulate/run_record.h"

#include <gtest/gtest.h>

#include "support/event_problem.h"

namespace gainsmith::simulate {
namespace {

using tests::EventProblem;
using tests::jumps_of;

hybrid::System ticking() {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-x").every("fast", "0.01", "0.01");
  problem.every("slow", "0.1", "0.1").jump("fast", {{"x", "x + 1"}});
  return problem.system();
}

TEST(RunRecord, JumpsHaveALimit) {
  const hybrid::System system = ticking();
  const hybrid::Scenario scenario = hybrid::make_scenario(10, system);
  RecordLimits limits;
  limits.jumps = 33;
  const hybrid::Trajectory run = Simulator(system, scenario).run(1, 0, {}, limits);
  EXPECT_EQ(run.ending, hybrid::Ending::full);
  EXPECT_EQ(jumps_of(run).size(), 33U);
  EXPECT_NE(run.message.find("33 jumps are the most"), std::string::npos) << run.message;
  EXPECT_NE(run.message.find("30 of fast, 3 of slow"), std::string::npos) << run.message;
  limits.jumps = 2000;
  EXPECT_EQ(Simulator(system, scenario).run(1, 0, {}, limits).ending, hybrid::Ending::horizon);
}

TEST(RunRecord, NumbersHaveALimit) {
  const hybrid::System system = ticking();
  const hybrid::Scenario scenario = hybrid::make_scenario(10, system);
  RecordLimits limits;
  limits.numbers = 1000;
  const hybrid::Trajectory run = Simulator(system, scenario).run(1, 0, {}, limits);
  EXPECT_EQ(run.ending, hybrid::Ending::full);
  EXPECT_NE(run.message.find("a record of 1000 numbers"), std::string::npos) << run.message;
  std::size_t kept = 0;
  double last = 0;
  for (const auto& part : run.parts) {
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) {
      kept += static_cast<std::size_t>(jump->before.size() + jump->after.size());
      continue;
    }
    for (const hybrid::DenseStep& step : std::get<hybrid::FlowPiece>(part).steps) {
      kept += static_cast<std::size_t>(step.coefficients.size());
      last = step.to;
    }
  }
  EXPECT_LE(kept, 1000U);
  EXPECT_GT(kept, 900U);
  EXPECT_EQ(run.end, last);
}

}  // namespace
}  // namespace gainsmith::simulate
