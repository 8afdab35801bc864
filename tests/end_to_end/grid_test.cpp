// "For all tau" is no grid: a case where many points of the interval say yes and the interval no.
#include <gtest/gtest.h>

#include <sstream>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// reset-observer/t2-3.3 with its inequality at `count` equidistant points of [0.1, 3.3] instead.
/// The samples of the campaign come every pi.
std::string on_a_grid(int count) {
  std::string method = gainsmith({"methods", "reset-observer"}).out;
  const std::string interval = "tau in [T1, T2]";
  std::string points = "tau in {";
  for (int k = 0; k < count; ++k)
    points += (k > 0 ? ", " : "") + std::to_string(0.1 + 3.2 * k / (count - 1));
  const std::size_t at = method.find(interval);
  EXPECT_NE(at, std::string::npos) << method;
  method.replace(at, interval.size(), points + "}");
  std::string text = "problem: grid\nmethod:\n";
  std::istringstream lines(method);
  for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
  return text +
         "data: {A: [[0, 1], [-1, 0]], C: [1, 0], T1: 0.1, T2: 3.3}\n"
         "campaign: {runs: 5, horizon: 2000, sampling: [{constant: pi}]}\n"
         "expect: {verdict: yes, campaign: violated}\n";
}

/// The rotation cannot be observed from samples half a turn apart, and the interval holds pi.
/// Between the points of a grid that is not seen; the gains of the grid fail there.
TEST(GridTest, FourHundredPointsAcceptWhatExchangeRejects) {
  const Folder folder;
  const Outcome grid =
      gainsmith({"run", folder.file("grid.yaml", on_a_grid(400)), "-o", folder.path("out")});
  EXPECT_EQ(grid.exit, 0) << grid.out << grid.err;
  EXPECT_NE(grid.out.find("yes; violated"), std::string::npos) << grid.out;
  const Outcome whole = gainsmith({"synth", problem("reset-observer/t2-3.3.yaml")});
  EXPECT_EQ(whole.exit, 3) << whole.out << whole.err;
  EXPECT_NE(whole.out.find("verdict     undecided"), std::string::npos) << whole.out;
}

}  // namespace
}  // namespace gainsmith::tests
