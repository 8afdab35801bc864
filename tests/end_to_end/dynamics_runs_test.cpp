// Runs of dynamics with events through the program: to the accuracy that a campaign asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// x = tan(t) and z = 1e-6 tan(t), with what stands under `campaign`.
std::string tangent(const std::string& campaign) {
  return "problem: tangent\n"
         "method:\n"
         "  method: tangent\n"
         "  plant:\n"
         "    state: {x: {shape: scalar, start: 0}}\n"
         "    flow: {x: 1 + x^2}\n"
         "  observers:\n"
         "    small:\n"
         "      state: {z: {shape: scalar, start: 0}}\n"
         "      flow: {z: 1e-6*(1 + (1e6*z)^2)}\n"
         "  claims: {below: {shrinks: 2 - small.z, to: 10}}\n"
         "campaign: {runs: 1, horizon: 1.5, " +
         campaign +
         "}\n"
         "expect:\n"
         "  run: [{at: {t: 1.5}, value: x - 14.101419947171719, is: 0, absolute: 1e-6}]\n";
}

struct Simulated {
  double x = 0, z = 0;  ///< their errors
  std::ptrdiff_t rows = 0;
};

Simulated simulated(const std::string& campaign) {
  const Folder folder;
  const Outcome outcome =
      gainsmith({"simulate", folder.file("tangent.yaml", tangent(campaign)), "--judge"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("judged: the run satisfies the texts"),
            std::string::npos)
      << outcome.err;
  const std::vector<double> last = last_row(outcome.out);
  return {std::abs(last[3] - std::tan(1.5)), std::abs(1e6 * last[4] - std::tan(1.5)),
          std::count(outcome.out.begin(), outcome.out.end(), '\n')};
}

TEST(DynamicsRuns, TheAccuracyIsThatOfTheCampaign) {
  const Simulated usual = simulated("seed: 1");
  const Simulated coarse = simulated("accuracy: {relative: 1e-4}");
  const Simulated sharp = simulated("accuracy: {relative: 1e-12}");
  EXPECT_LT(coarse.rows, usual.rows);
  EXPECT_LT(usual.rows, sharp.rows);
  EXPECT_LT(usual.x, coarse.x / 100);
  EXPECT_LT(sharp.x, usual.x / 10);
}

/// With 1 for x the steps are those that z asks for: 1e-10 is much of a state of size 1e-6.
TEST(DynamicsRuns, AStateHasAnAccuracyOfItsOwn) {
  const Simulated rough =
      simulated("accuracy: {relative: 1e-10, absolute: {x: 1, small.z: 1e-10}}");
  const Simulated fine = simulated("accuracy: {relative: 1e-10, absolute: {x: 1, z: 1e-16}}");
  EXPECT_GT(rough.z, 100 * fine.z);
}

/// A run to 1e-4 does not decide what is expected to 1e-6; one to 1e-12 does.
TEST(DynamicsRuns, WhatIsExpectedIsDecidedToTheAccuracy) {
  const Folder folder;
  const auto run = [&](const std::string& campaign) {
    return gainsmith(
        {"run", folder.file("tangent.yaml", tangent(campaign)), "-o", folder.path("out")});
  };
  EXPECT_EQ(run("accuracy: {relative: 1e-12}").exit, 0);
  const Outcome coarse = run("accuracy: {relative: 1e-4}");
  EXPECT_NE(coarse.exit, 0) << coarse.out;
}

TEST(DynamicsRuns, WhatCannotBeIsRefused) {
  const Folder folder;
  const auto refused = [&](const std::string& campaign, const std::string& message) {
    const Outcome outcome =
        gainsmith({"check", folder.file("tangent.yaml", tangent("accuracy: " + campaign))});
    EXPECT_EQ(outcome.exit, 2) << campaign;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  refused("{relative: 1e-13}", "relative: expected a number from 1e-12 to 0.01, found 1e-13");
  refused("{absolute: 0}", "absolute: expected a number from 1e-100");
  refused("{absolute: {small.zz: 1e-3}}", "small.zz");
  refused("{relativ: 1e-6}", "relative");
}

}  // namespace
}  // namespace gainsmith::tests
