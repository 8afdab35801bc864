// The weights and intensities of the ready designs: semidefinite ones, and those that are refused.
#include <gtest/gtest.h>

#include <cmath>
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

/// A stable mode that the weight does not see, or that no noise reaches, mixed into a plant that is known:
/// the optimum is that of the plant without it, as the Riccati equation has it by hand.
TEST(Weights, MayMissAStableMode) {
  const std::string mixed = "let: {T: \"[0.6, 0, 0.8; 0, 1, 0; -0.8, 0, 0.6]\"}\n";
  const std::string body = "A: \"T'*[0, 1, 0; 0, 0, 0; 0, 0, -1]*T\", ";
  const std::string sum = "A: \"T'*diag([1, 0.2, 0.5])*T\", ";
  const auto found = [&](const std::string& method, const std::string& data) {
    return objective(gainsmith({"synth", "-", "--json"}, "problem: p\nmethod: " + method + "\n" +
                                                             mixed + "data: {" + data + "}\n"));
  };
  const double two_integrators = 2 * std::sqrt(2);   // p = [sqrt(2), 1; 1, sqrt(2)]
  const double integrator = (1 + std::sqrt(5)) / 2;  // p^2 = p + 1
  const std::string force = "T'*[0; 1; 0]";
  const std::string step = "T'*[1; 0; 0]";
  const auto quoted = [](const std::string& text) { return "\"" + text + "\""; };
  const std::string weight = "Q: \"T'*diag([1, 0, 0])*T\", R: 1";
  EXPECT_NEAR(found("lqr", body + "B: " + quoted(force) + ", " + weight), two_integrators, 1e-5);
  EXPECT_NEAR(found("discrete-lqr", sum + "B: " + quoted(step) + ", " + weight), integrator, 1e-5);
  EXPECT_NEAR(found("kalman", body + "C: \"[1, 0, 0]*T\", G: " + quoted(force)), two_integrators,
              1e-5);
  EXPECT_NEAR(found("discrete-kalman", sum + "C: \"[1, 0, 0]*T\", G: " + quoted(step)), integrator,
              1e-5);
  const std::string output = ", B1: eye(3), C1: \"[1, 0, 0; 0, 0, 0]*T\", D12: [0, 1]";
  EXPECT_NEAR(found("h2-state-feedback", body + "B2: " + quoted(force) + output), two_integrators,
              1e-5);
  EXPECT_NEAR(found("discrete-h2-state-feedback", sum + "B2: " + quoted(step) + output), integrator,
              1e-5);
}

/// Five masses and springs, sampled: in units of the data the sums of x x' are small.
TEST(Weights, OfALongerChainAreMetToTheDigitsOfTheSolver) {
  const Outcome outcome = gainsmith({"synth", "-", "--json"}, R"yaml(
problem: p
method: discrete-lqr
let: {M: "[2, -1, 0, 0, 0; -1, 2, -1, 0, 0; 0, -1, 2, -1, 0; 0, 0, -1, 2, -1; 0, 0, 0, -1, 2]"}
data:
  A: "expm(0.2*[zeros(5, 5), eye(5); -M, -0.1*M])"
  B: "[zeros(9, 1); 0.2]"
)yaml");
  const double least = objective(outcome);
  const double bound = outcome.json()["objective_lower_bound"];
  EXPECT_GT(bound, 0);
  EXPECT_NEAR(least, bound, 1e-6 * bound);
}

}  // namespace
}  // namespace gainsmith::tests
