// Why there is no campaign: of a method in which nothing moves, or of a problem.
#include <gtest/gtest.h>

#include <string>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "io/yaml/method_yaml.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

const std::string kStill = R"(problem: still
method:
  method: still
  data: {A: n x n}
  unknowns: {P: symmetric n}
  require: {positive: P > I}
  no campaign: "a matrix: nothing moves"
data: {A: 2}
)";

std::string reason_of(const std::string& text) {
  return bind::bind(read_problem(text)).design->no_campaign;
}

std::string message_of(const std::string& text) {
  return input_error([&] { bind::bind(read_problem(text)); }).message();
}

TEST(NoCampaign, TheReasonOfTheProblemComesFirst) {
  EXPECT_EQ(reason_of(kStill), "a matrix: nothing moves");
  EXPECT_EQ(reason_of(kStill + "no campaign: not today\n"), "not today");
  EXPECT_EQ(reason_of(kProblem), "");
}

TEST(NoCampaign, EitherACampaignOrAReason) {
  EXPECT_NE(message_of(kProblem + "no campaign: not today\n").find("not both"), std::string::npos);
  EXPECT_NE(message_of(kStill + "campaign: {runs: 3}\n").find("a matrix: nothing moves"),
            std::string::npos);
}

TEST(NoCampaign, AMethodThatMovesHasNone) {
  for (const char* part :
       {"plant: {state: {x: n}, flow: {x: A*x}}\n", "claims: {c: {nonincreasing: trace(P)}}\n"}) {
    const std::string text =
        replaced(kStill, "  no campaign", std::string("  ") + part + "  no campaign");
    EXPECT_NE(message_of(text).find("has dynamics or claims"), std::string::npos) << part;
  }
}

TEST(NoCampaign, TheReasonIsAText) {
  EXPECT_NE(message_of(replaced(kStill, "\"a matrix: nothing moves\"", "\"\""))
                .find("expected the reason"),
            std::string::npos);
  input_error([&] { reason_of(replaced(kStill, "\"a matrix: nothing moves\"", "[1, 2]")); });
}

/// A design of gains alone needs neither a horizon nor starts; a run does.
TEST(NoCampaign, ADesignWithEventsMayAskForGainsAlone) {
  const std::string design = R"(problem: gains-alone
method:
  method: gains-alone
  data: {A: n x n}
  unknowns: {P: symmetric n}
  require: {positive: P > I}
  events: {tick: {every: 1}}
  plant: {state: {x: n}, flow: {x: A*x}, at: {tick: {x: x/2}}}
  claims: {c: {nonincreasing: x'*P*x}}
data: {A: 2}
)";
  EXPECT_FALSE(bind::bind(read_problem(design)).design->campaign.horizon);
  EXPECT_NE(message_of(design + "campaign: {runs: 3}\n").find("horizon"), std::string::npos);
  // A start is asked for when a run is made.
  EXPECT_TRUE(
      bind::bind(read_problem(design + "campaign: {horizon: 3}\n")).design->campaign.horizon);
  const std::string by_formula = replaced(replaced(design, "  require: {positive: P > I}\n", ""),
                                          "unknowns: {P: symmetric n}", "parameters: {P: 1}");
  EXPECT_NE(message_of(by_formula).find("horizon"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::io
