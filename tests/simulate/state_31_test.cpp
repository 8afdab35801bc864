// Runs in 31 digits. A double shows what they know beyond its own digits where the text multiplies it:
// y = 1e20 (x - what x is).
#include "simulate/state_31.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/simulator.h"
#include "support/dynamics_text.h"

namespace gainsmith::simulate {
namespace {

using model::Between;
using tests::DynamicsText;
using NoiseKind = model::Dynamics::NoiseKind;

class Run31 {
 public:
  Run31(const DynamicsText& text, double horizon, std::optional<std::uint64_t> moved = {})
      : stated_(text.stated()), system_(hybrid::make_system(text.dynamics(), stated_.values)) {
    system_.in_31_digits = [this] {
      Constants31 constants;
      for (const auto& [name, value] : system_.constants)
        constants[name] = value.cast<DoubleDouble>();
      return constants;
    };
    const hybrid::Scenario scenario = hybrid::make_scenario(horizon, system_);
    EXPECT_TRUE(State31::may_run(system_, scenario));
    run = Simulator(system_, scenario).run(1, 0, {.in_31_digits = true}, {}, moved);
  }

  double last(const std::string& name) const {
    const Eigen::Index at = system_.layout.slots[*system_.slot(name)].offset;
    const auto& part = run.parts.back();
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) return jump->after(at);
    return std::get<hybrid::FlowPiece>(part).end(at);
  }

  hybrid::Trajectory run;

 private:
  model::Stated stated_;
  hybrid::System system_;
};

/// x = 0.98343056891522 after 70 ticks; x(1) = -11.71318443710740582 at t = 30 (60 digits).
TEST(State31, FollowsChaos) {
  DynamicsText map;
  map.state("x", 1, "", "0.3").every("tick", "1").reacts("tick", {{"x", "4*x*(1 - x)"}});
  EXPECT_NEAR(Run31(map, 70.2).last("x"), 0.98343056891522, 1e-9);

  DynamicsText lorenz;
  lorenz.state("x", 3, "[10*(x(2) - x(1)); 28*x(1) - x(2) - x(1)*x(3); x(1)*x(2) - 8*x(3)/3]",
               "[0.8661; -1.3917; 13.8216]");
  for (const auto moved : {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1)})
    EXPECT_NEAR(Run31(lorenz, 30, moved).last("x"), -11.71318443710740582, 1e-14);
}

TEST(State31, FollowsEventsOfFlows) {
  for (const char* flow : {"1/3", "1/3 + x*(t - t)"}) {  // affine, and not
    DynamicsText line;
    line.state("x", 1, flow, "0").state("y", 1, "", "1").when("root", "x >= 0.1 and y == 1");
    line.reacts("root", {{"y", "1e20*(t - 0.3)"}});
    EXPECT_NEAR(Run31(line, 1).last("y"), 0, 1e-7) << flow;
  }
  DynamicsText exponential;
  exponential.state("x", 1, "x", "1").state("y", 1, "", "0").rises("root", "x - 2");
  exponential.reacts("root", {{"y", "1e20*(exp(t) - 2)"}});
  EXPECT_NEAR(Run31(exponential, 1).last("y"), 0, 1e-7);
  // Both at one time, in the order of the file.
  DynamicsText two;
  two.state("x", 1, "0.141", "-0.142").state("y", 1, "0.917", "-0.481").state("z", 1, "", "0");
  two.rises("p", "x - 0.245609").rises("r", "y - 2.039833");
  two.reacts("p", {{"z", "1e20*(t - 2.749)"}}).reacts("r", {{"z", "z + 1e20*(t - 2.749)"}});
  EXPECT_NEAR(Run31(two, 3).last("z"), 0, 1e-6);
}

TEST(State31, TakesTimesAsTheirDecimals) {
  DynamicsText clocks;
  clocks.state("x", 1, "1", "0").state("y", 1, "", "1").state("z", 1, "", "1");
  clocks.every("tick", "0.1").reacts("tick", {{"y", "1e20*(t - count(tick)/10 - 0.1)"}});
  clocks.at("look", {"0.7"}).reacts("look", {{"z", "1e20*(x - 0.7)"}});
  const Run31 run(clocks, 0.75);
  EXPECT_NEAR(run.last("y"), 0, 1e-9);
  EXPECT_NEAR(run.last("z"), 0, 1e-9);
}

TEST(State31, ChangesBranchesAtTheirTimes) {
  DynamicsText branches;
  branches.state("x", 1, "where(t < 1/3, 1, -1)", "0").state("a", 1, "abs(t - 1/3)", "0");
  branches.state("y", 1, "", "1").state("z", 1, "", "1");
  branches.at("look", {"1"}).reacts("look", {{"y", "1e20*(x + 1/3)"}, {"z", "1e20*(a - 5/18)"}});
  const Run31 run(branches, 1.1);
  EXPECT_NEAR(run.last("y"), 0, 1e-9);
  EXPECT_NEAR(run.last("z"), 0, 1e-7);
}

TEST(State31, TakesWhatIsDrawnOrMeasuredAsItIs) {
  DynamicsText given;
  given.measured("u", Between::hold, {{0, 1}, {0.1, 3}, {0.4, 2}});
  given.noise("w", NoiseKind::uniform, {"0", "1"}).drawn_every("0.3");
  given.state("x", 1, "u", "0").state("v", 1, "w", "0").state("y", 1, "", "1");
  given.at("look", {"0.5"}).reacts("look", {{"y", "1e20*(x - 1.2)"}});
  const Run31 run(given, 0.6);
  EXPECT_NEAR(run.last("y"), 0, 1e-9);
  EXPECT_GT(run.last("v"), 0);
}

/// Twins differ by their last places, and by no more than the dynamics make of them.
TEST(State31, ATwinIsMovedInItsLastPlaces) {
  DynamicsText grows;
  grows.state("x", 1, "x", "0.1").state("y", 1, "", "1");
  grows.at("look", {"1"}).reacts("look", {{"y", "1e28*(x - 0.1*exp(1))"}});
  const double own = Run31(grows, 1.1).last("y");
  int differ = 0;
  for (const std::uint64_t moved : {0, 1, 2, 3}) {
    const double twin = Run31(grows, 1.1, moved).last("y");
    differ += own != twin ? 1 : 0;  // moves of either sign may cancel
    EXPECT_LT(std::abs(own) + std::abs(twin), 1);
  }
  EXPECT_GE(differ, 2);
}

/// What is 0, or has decayed, asks for no accuracy of its own.
TEST(State31, DecaysInLongSteps) {
  DynamicsText decays;
  decays.state("x", 3, "[-x(1); x(3)^3; -5*x(3)]", "[1; 0; 1e-3]");
  const Run31 run(decays, 50);
  EXPECT_EQ(run.run.ending, hybrid::Ending::horizon);
  EXPECT_NEAR(run.last("x") * std::exp(50), 1, 1e-9);
}

TEST(State31, EndsWhereStepsAreMany) {
  DynamicsText fast;
  fast.state("x", 2, "[1e5*x(2); -1e5*x(1)]", "[1; 0]");
  EXPECT_EQ(Run31(fast, 10).run.ending, hybrid::Ending::lost);
}

}  // namespace
}  // namespace gainsmith::simulate
