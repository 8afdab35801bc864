// A method in the short form, with plant, observer and one timer, and the same written with events:
// one run of both along the same intervals. Two simulators, two numbers that have to be the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// The states before and after each jump of a run, by the number of jumps so far.
struct Ends {
  std::vector<double> first;
  std::vector<double> last;
  double t = 0;  ///< of the last one
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

std::map<int, Ends> ends_of(const std::string& csv, const std::vector<std::string>& names) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = cells_of(line);
  const auto column = [&](const std::string& name) {
    const auto at = std::find(header.begin(), header.end(), name);
    EXPECT_NE(at, header.end()) << name << " in " << line;
    return static_cast<std::size_t>(at - header.begin());
  };
  std::map<int, Ends> ends;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cells_of(line);
    std::vector<double> values;
    for (const std::string& name : names) values.push_back(std::stod(cells.at(column(name))));
    Ends& here = ends[std::stoi(cells.at(column("j")))];
    if (here.first.empty()) here.first = values;
    here.last = values;
    here.t = std::stod(cells.at(column("t")));
  }
  return ends;
}

void expect_same(const std::string& short_form, const std::string& with_events,
                 const std::vector<std::string>& names, double tolerance) {
  const Folder folder;
  const auto ends = [&](const char* file, const std::string& text) {
    const Outcome outcome = gainsmith({"simulate", folder.file(file, text)});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    return ends_of(outcome.out, names);
  };
  const std::map<int, Ends> one = ends("short.yaml", short_form);
  const std::map<int, Ends> other = ends("events.yaml", with_events);
  ASSERT_GT(one.size(), 10U);
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [j, here] : one) {
    const Ends& there = other.at(j);
    EXPECT_NEAR(here.t, there.t, 1e-12 * (1 + here.t));
    for (std::size_t k = 0; k < names.size(); ++k) {
      EXPECT_NEAR(here.first[k], there.first[k], tolerance) << names[k] << " after jump " << j;
      EXPECT_NEAR(here.last[k], there.last[k], tolerance) << names[k] << " before jump " << j + 1;
    }
  }
}

const std::string kData = R"(
data: {A: [[0.2, -1.01], [1, 0]], C: [[0.5, -1]], T1: 0.5, T2: 1.1}
campaign:
  runs: 1
  horizon: 12
  first: 0.3
  sampling: [{list: [0.7, 0.5, 1.1, 0.9]}]
  initial: {z: [3, -2], zh: [0, 1], th: 0.5}
)";

const std::string kClaim = R"(
  signals: {e: z - zh}
  claims:  {error: {shrinks: norm(e), to: 1}}
)";

/// The published observer with printed gains: affine, exact in both.
TEST(TwoForms, AnObserverWithConstantGainsIsTheSame) {
  const std::string head = R"(problem: two-forms
method:
  method: two-forms
  data: {A: n x n, C: p x n, T1: scalar, T2: scalar}
  let: {L: "[0.8922; -1.6787]", H: -3.2, F: "[0.1; -0.9]"}
  plant: {state: {z: n}, output: {y: C*z}, flow: {z: A*z})";
  const std::string maps = "zh: zh + F*(y - C*zh), th: (I - C*F)*(y - C*zh)";
  const std::string flow = "flow: {zh: A*zh + L*th, th: H*th}";
  expect_same(head + "}\n  observer: {state: {zh: n, th: p}, " + flow + ", jump: {" + maps +
                  "}}\n  timer: {tau: {reset: [T1, T2], first: [0, T2]}}" + kClaim + kData,
              head + ", at: {}}\n  observer: {state: {zh: n, th: p}, " + flow + ", at: {sample: {" +
                  maps + "}}}\n  events: {sample: {every: [T1, T2], first: [0, T2]}}" + kClaim +
                  kData,
              {"z1", "z2", "zh1", "zh2", "th"}, 1e-11);
}

/// Gains of the time since the last sample: integrated in both, to a relative 1e-8 a flow.
TEST(TwoForms, AnObserverWithGainsOfAClockIsTheSame) {
  const std::string head = R"(problem: two-forms
method:
  method: two-forms
  data: {A: n x n, C: p x n, T1: scalar, T2: scalar}
  let: {L(s): "[0.9 - 0.2*s; -1.6 + 0.3*s^2]", H(s): -3 + s, F(s): "[0.1 + 0.05*s; -0.9 + 0.1*s]"}
  plant: {state: {z: n}, output: {y: C*z}, flow: {z: A*z}}
)";
  const std::string state =
      "  observer: {state: {zh: n, th: p, clock: {shape: scalar, start: 0}}, ";
  const std::string flow = "flow: {zh: A*zh + L(clock)*th, th: H(clock)*th, clock: 1}";
  const std::string maps =
      "zh: zh + F(clock)*(y - C*zh), th: (eye(p) - C*F(clock))*(y - C*zh), clock: 0";
  expect_same(head + state + flow + ", jump: {" + maps +
                  "}}\n  timer: {tau: {reset: [T1, T2], first: [0, T2]}}" + kClaim + kData,
              head + state + flow + ", at: {sample: {" + maps +
                  "}}}\n  events: {sample: {every: [T1, T2], first: [0, T2]}}" + kClaim + kData,
              {"z1", "z2", "zh1", "zh2", "th", "clock"}, 1e-7);
}

}  // namespace
}  // namespace gainsmith::tests
