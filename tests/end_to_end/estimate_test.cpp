// Maxima over boxes and searches over figures of runs, as a person sees them.
#include <gtest/gtest.h>

#include <cmath>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

const std::string kConstants = R"yaml(problem: constants
method:
  method: constants
  parameters: {r: 6}
  let:
    L: "maximum(abs(jacobian(x - x^3, x)), x in [-r, r])"
  gains: {kappa: 2*L, k: r}
  report: {L: L, least: "minimum(x^2, x in [1, r])"}
)yaml";

TEST(EstimateTest, ConstantsAreLabelledWhereTheyAreShown) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  const Outcome outcome =
      gainsmith({"synth", folder.file("constants.yaml", kConstants), "-o", gains});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const Json document = Json::parse(text_of(gains));
  EXPECT_EQ(document["report"]["L"], 107);
  EXPECT_EQ(document["estimates"]["L"], "estimate from below");
  EXPECT_EQ(document["estimates"]["least"], "estimate from above");
  EXPECT_EQ(document["estimates"]["kappa"], "from estimates");
  EXPECT_FALSE(document["estimates"].contains("k"));
  const std::string shown = outcome.out + outcome.err;
  EXPECT_NE(shown.find("L = 107 (estimate from below)"), std::string::npos) << shown;
  EXPECT_NE(shown.find("kappa = 214 (from estimates)"), std::string::npos) << shown;
}

/// A heater with two thresholds around 1 that its room heats past: the mean error is least where
/// the thresholds are closest.
const std::string kThresholds = R"yaml(problem: thresholds
method:
  method: thresholds
  parameters: {low: 0.5, high: 1.5}
  plant:
    state: {x: {shape: scalar, start: 1}}
    mode:  {q: 1}
    flow:  {x: 3*q - x}
    events: {off: {when: q == 1 and x >= high}, on: {when: q == 0 and x <= low}}
    at:    {off: {q: 0}, on: {q: 1}}
  signals: {e: x - 1}
search: {over: {low: [0.2, 0.9], high: [1.1, 1.8]}, minimize: {rms: e, over: [0, 10]}, evaluations: 60}
campaign: {runs: 1, horizon: 10}
)yaml";

TEST(EstimateTest, ThresholdsAreTunedOnAFigureOfARun) {
  const Folder folder;
  const std::string problem = folder.file("thresholds.yaml", kThresholds);
  const std::string gains = folder.path("gains.json"), again = folder.path("again.json");
  const Outcome outcome = gainsmith({"synth", problem, "-o", gains, "--threads", "1"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const Json document = Json::parse(text_of(gains));
  EXPECT_NEAR(document["searched"]["low"].get<double>(), 0.9, 1e-3);
  EXPECT_NEAR(document["searched"]["high"].get<double>(), 1.1, 1e-3);
  EXPECT_EQ(document["search"]["figure"], "rms e over [0, 10]");
  ASSERT_EQ(gainsmith({"synth", problem, "-o", again, "--threads", "2"}).exit, 0);
  EXPECT_EQ(without_timings(text_of(gains)), without_timings(text_of(again)));
}

}  // namespace
}  // namespace gainsmith::tests
