// What `simulate` writes of a run is a log: observers that run on it give what they gave.
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

/// The columns of a table by name; empty cells are not numbers.
using Table = std::map<std::string, std::vector<std::string>>;

Table table(const std::string& text) {
  std::istringstream lines(text);
  std::string line, cell;
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  Table result;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    for (const std::string& name : names) {
      cell.clear();
      std::getline(cells, cell, ',');
      result[name].push_back(cell);
    }
  }
  return result;
}

/// The values of a column in the rows of an event.
std::vector<double> at_event(const Table& table, const std::string& column,
                             const std::string& event) {
  std::vector<double> values;
  for (std::size_t k = 0; k < table.at("event").size(); ++k)
    if (table.at("event")[k] == event) values.push_back(std::stod(table.at(column)[k]));
  return values;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

const std::string kObserver =
    "  observer:\n"
    "    state: {xh: {shape: 2, start: 0}}\n"
    "    flow:  {xh: A*xh + b*u}\n"
    "    at:    {sample: {xh: \"xh + [0.5; 0.2]*(y - xh(1))\"}}\n";

std::string problem_with(const std::string& events, const std::string& rest) {
  return "problem: round-trip\nmethod:\n  method: round-trip\n"
         "  let:    {A: \"[0, 1; -4, -0.2]\", b: \"[0; 1]\"}\n  events: " +
         events + "\n" + rest + "campaign: {horizon: 5}\n";
}

const std::string kPlant =
    "  inputs: {u: 0.5}\n"
    "  noise:  {w: {normal: 0.1, new at: sample}}\n"
    "  plant:  {state: {x: {shape: 2, start: \"[1; 0]\"}}, flow: {x: A*x + b*u},\n"
    "           output: {y: {value: x(1) + w, at: sample}, z: x(1)}}\n";

/// The table of a run, which the judge accepts; also as a file.
Table simulated(const Folder& folder, const std::string& name, const std::string& problem,
                const std::vector<std::string>& more = {}) {
  const std::string csv = folder.path(name + ".csv");
  std::vector<std::string> arguments = {"simulate", folder.file(name + ".yaml", problem), "-o", csv,
                                        "--judge"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = gainsmith(arguments);
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  return table(text_of(csv));
}

TEST(MeasuredTest, ALogOfSamplesGivesTheSameEstimates) {
  const Folder folder;
  const Table run =
      simulated(folder, "run", problem_with("{sample: {every: [0.1, 0.3]}}", kPlant + kObserver));
  const Table again = simulated(
      folder, "again",
      problem_with("{sample: {at: {csv: run.csv, column: t, rows: {event: sample}}}}",
                   "  inputs: {u: 0.5}\n"
                   "  plant: {log: run.csv, output: {y: {column: y, at: sample}, x: x}}\n" +
                       kObserver));
  ASSERT_GT(at_event(run, "t", "sample").size(), 15U);
  for (const char* column : {"t", "y", "xh1", "xh2"})
    EXPECT_LT(
        largest_difference(at_event(run, column, "sample"), at_event(again, column, "sample")),
        1e-12)
        << column;
  EXPECT_EQ(at_event(run, "y", "sample"), at_event(again, "y", "sample"));
}

/// y(1) is compared with xh(1): its panel has both, that of xh(2) the estimate alone.
TEST(MeasuredTest, AMeasurementIsDrawnBehindTheStateThatItCorrects) {
  const Folder folder;
  folder.file("log.csv", "t,y,u\n0,1,0\n0.5,0.9,0\n1,0.4,0\n1.5,-0.1,0\n");
  const std::string problem =
      problem_with("{sample: {at: {csv: log.csv, column: t}}}",
                   "  inputs: {u: {csv: log.csv, column: u}}\n"
                   "  plant: {log: log.csv, output: {y: {column: y, at: sample}}}\n" +
                       kObserver);
  const auto legends = [&](const std::string& panels) {
    const std::string svg = folder.path("run.svg");
    const Outcome outcome =
        gainsmith({"simulate", folder.file("p.yaml", with(problem, "horizon: 5", "horizon: 1.5")),
                   "--plot", svg, "--panels", panels});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    const std::string picture = text_of(svg);
    return std::pair(has(picture, ">y<"), has(picture, ">xh1<") || has(picture, ">xh2<"));
  };
  EXPECT_EQ(legends("xh1"), std::pair(true, true));
  EXPECT_EQ(legends("xh2"), std::pair(false, true));
}

TEST(MeasuredTest, LinesBetweenRowsErrByTheSquareOfTheirDistance) {
  const std::string follower =
      "  observer: {state: {zh: {shape: 2, start: 0}}, flow: {zh: \"A*zh + b*u + [3; 2]*(z - "
      "zh(1))\"}}\n";
  const std::string plant =
      "  inputs: {u: cos(2*t)}\n"
      "  plant:  {state: {x: {shape: 2, start: \"[1; 0]\"}}, flow: {x: A*x + b*u}, output: {z: "
      "x(1), v: u}}\n";
  std::vector<double> errors;
  for (const char* step : {"0.1", "0.05"}) {
    const Folder folder;
    const Table run =
        simulated(folder, "run", problem_with("{}", plant + follower), {"--step", step});
    const Table again =
        simulated(folder, "again",
                  problem_with("{}",
                               "  inputs: {u: {csv: run.csv, column: v, between: line}}\n"
                               "  plant: {log: {csv: run.csv, between: line}, output: {z: z}}\n" +
                                   follower),
                  {"--step", step});
    errors.push_back(std::abs(std::stod(run.at("zh1").back()) - std::stod(again.at("zh1").back())));
  }
  EXPECT_LT(errors[0], 5e-3);
  EXPECT_GT(errors[0], 1e-6);
  EXPECT_NEAR(errors[0] / errors[1], 4, 1);
}

TEST(MeasuredTest, TheSameLogGivesTheSameBytes) {
  const Folder folder;
  const std::string problem = problem_with("{sample: {at: [1, 2]}}",
                                           "  inputs: {u: {csv: u.csv, column: u}}\n"
                                           "  plant: {log: u.csv, output: {y: u}}\n" +
                                               kObserver);
  folder.file("u.csv", "t,u\n0,1\n0.5,-1\n2.5,3\n");
  simulated(folder, "one", problem);
  simulated(folder, "two", problem);
  EXPECT_EQ(text_of(folder.path("one.csv")), text_of(folder.path("two.csv")));
}

/// The innovation is that before the jump, and there is none between the samples.
TEST(MeasuredTest, ASignalOfASampleExistsThereOnly) {
  const Folder folder;
  folder.file("log.csv", "time [s],y\n0.5,1\n1,\n2,3\n");
  const std::string observer =
      "  plant: {log: log.csv, output: {y: {column: y, at: sample}}}\n"
      "  observer: {state: {xh: {shape: scalar, start: 0}}, at: {sample: {xh: y}}}\n"
      "  signals: {r: y - xh}\n";
  const auto text = [&](const std::string& rest) {
    return problem_with("{sample: {at: {csv: log.csv}}}", observer + rest);
  };
  const Table run = simulated(folder, "p", text(""));
  EXPECT_EQ(at_event(run, "r", "sample"), (std::vector<double>{1, 2}));
  for (std::size_t k = 0; k < run.at("r").size(); ++k)
    EXPECT_EQ(run.at("r")[k].empty(), run.at("event")[k].empty()) << k;
  const Outcome outcome = gainsmith(
      {"verify", folder.file("c.yaml", text("  claims: {c: {below: abs(r), bound: 9}}\n"))});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.err, "measured at the event 'sample' only; `over:` that event"))
      << outcome.err;
}

TEST(MeasuredTest, WhatIsWrongInALogEndsWithItsPlace) {
  const Folder folder;
  const std::string problem =
      folder.file("p.yaml", problem_with("{sample: {at: [1, 2]}}",
                                         "  inputs: {u: {csv: u.csv, column: u, between: line}}\n"
                                         "  plant: {log: u.csv, output: {y: u}}\n" +
                                             kObserver));
  const auto refused = [&](const std::string& csv) {
    folder.file("u.csv", csv);
    const Outcome outcome = gainsmith({"simulate", problem});
    EXPECT_EQ(outcome.exit, 2);
    return outcome.err;
  };
  EXPECT_NE(refused("t,u\n0,1\n1,x\n").find("u.csv:3:3: the column u needs finite decimal"),
            std::string::npos);
  EXPECT_NE(refused("t [ticks],u\n0,1\n9,2\n").find("the times are in 'ticks', which is none of s"),
            std::string::npos);
  EXPECT_NE(refused("t,u\n1,1\n9,2\n").find("no value at t = 0"), std::string::npos);
  EXPECT_NE(refused("t,u\n0,1\n1,2\n").find("lies after the last row of u"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::tests
