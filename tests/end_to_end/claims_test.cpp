// Claims of methods with events, from a problem's text to the exit code, and the replay of what
// they find.
#include <gtest/gtest.h>

#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

/// A damped pendulum in an ellipsoid, with a sinusoid and two lengths; `claims` of it.
std::string pendulum(const std::string& claims) {
  return "problem: pendulum\nmethod:\n  method: pendulum\n"
         "  data: {l: {shape: scalar, default: 1}}\n"
         "  noise: {d: {sinusoid: {amplitude: 0.3, frequency: [1, 3], phase: [0, 2*pi]}}}\n"
         "  events: {tick: {every: [0.1, 0.3], lost: 0.3}}\n"
         "  plant:\n    state: {x: 2, n: {shape: scalar, start: 0}}\n    output: {y: x(1)}\n"
         "    flow: {x: \"[x(2); -9.81/l*sin(x(1)) - x(2) + d]\"}\n"
         "    at: {tick: {n: n + 1}}\n"
         "  observer:\n    state: {z: {shape: scalar, start: 0}}\n    at: {tick: {z: y}}\n"
         "  signals: {E: 9.81/plant.l*(1 - cos(x(1))) + x(2)^2/2}\n"
         "  claims: " +
         claims +
         "\ncampaign: {runs: 8, seed: 5, horizon: 6, initial: {x: {ellipsoid: {matrix: \"[9, 0; 0, "
         "1]\"}}}}\n"
         "uncertain: {l: {vertices: [0.8, 1.25]}}\n";
}

TEST(ClaimsTest, TheEnergyIsDissipatedButForWhatTheDisturbanceGives) {
  // E' = -x2^2 + x2 d.
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", pendulum("{power: {below: \"rate(E) + x(2)^2/2 - d^2/2\", bound: "
                                     "1e-9}, gives: {above: \"rate(E) + 1.5*x(2)^2 + d^2/2\", "
                                     "bound: -1e-9, after: 1}}"));
  const Outcome outcome = gainsmith({"verify", file, "--json"});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.json()["violations"], 0);
}

TEST(ClaimsTest, AViolationReplaysAlone) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", pendulum("{power: {below: \"rate(E) + x(2)^2\", bound: 0.002, over: "
                                     "tick, after: 2}}"));
  const Outcome outcome = gainsmith({"verify", file, "--json", "--threads", "2"});
  ASSERT_EQ(outcome.exit, 1) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out, gainsmith({"verify", file, "--json", "--threads", "1"}).out);
  const Json check = outcome.json()["checks"][0];
  EXPECT_EQ(check["kind"], "stays below");
  EXPECT_GT(check["worst"]["value"].get<double>(), 0.002);
  EXPECT_GE(check["worst"]["t"].get<double>(), 2);
  const std::string run = std::to_string(check["worst_run"].get<int>());
  const Outcome replay = gainsmith(
      {"simulate", file, "--run", run, "--seed", "5", "-o", folder.path("run.csv"), "--judge"});
  EXPECT_NE(replay.out.find("power") != std::string::npos ? replay.out.find("violated")
                                                          : replay.err.find("violated"),
            std::string::npos)
      << replay.out << replay.err;
  EXPECT_NE(text_of(folder.path("run.csv")).find("tick (lost)"), std::string::npos);
}

TEST(ClaimsTest, AnEquationIsUndecided) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", pendulum("{power: {below: \"rate(E) + x(2)^2 - x(2)*d\", bound: 0}}"));
  const Outcome outcome = gainsmith({"verify", file, "--json"});
  EXPECT_EQ(outcome.exit, 3) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.json()["violations"], 0);
}

TEST(ClaimsTest, AMisspeltEventIsNamedAtItsPlace) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", pendulum("{power: {below: E, bound: 9, over: tock}}"));
  const Outcome outcome = gainsmith({"verify", file});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("p.yaml:16:46: there is no event 'tock'; did you mean 'tick'?"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace gainsmith::tests
