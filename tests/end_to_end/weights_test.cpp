// The weights and intensities of the ready designs: semidefinite ones, and those that are refused.
#include <gtest/gtest.h>

#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

Outcome synth(const std::string& method, const std::string& data) {
  return gainsmith({"synth", "-", "--json"}, "problem: p\nmethod: " + method +
                                                 "\ndata: {A: [[0, 1], [0, 0]], " + data + "}\n");
}

double objective(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  return outcome.json()["objective"];
}

/// As with G = [0; 1] and W = 1, whose covariance is [sqrt(2), 1; 1, sqrt(2)] (Riccati equation by hand).
TEST(Weights, OfAKalmanFilterMayBeSingular) {
  EXPECT_NEAR(objective(synth("kalman", "C: [1, 0], W: \"diag([0, 1])\"")), 2.8284271, 1e-5);
  EXPECT_NEAR(objective(synth("kalman", "C: [1, 0], W: \"[0.5; 1]*[0.5, 1]\"")), 2.5, 1e-5);
}

TEST(Weights, ThatAreIndefiniteAreRefusedByName) {
  for (const char* method : {"kalman", "discrete-kalman"})
    EXPECT_NE(synth(method, "C: [1, 0], W: \"diag([-1, 1])\"")
                  .err.find("the assumption 'noise of the state'"),
              std::string::npos);
  for (const char* method : {"lqr", "discrete-lqr"}) {
    EXPECT_NE(synth(method, "B: [[0], [1]], Q: \"diag([1, -0.1])\"")
                  .err.find("the assumption 'weight of the state'"),
              std::string::npos);
    EXPECT_NE(synth(method, "B: [[0], [1]], R: 0").err.find("the assumption 'weight of the input'"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace gainsmith::tests
