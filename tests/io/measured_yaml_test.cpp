// Measured data in a problem: which rows of which file are taken, and what is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "bind/bind.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using model::Between;
using tests::input_error;

class Measured : public testing::Test {
 protected:
  Measured() {
    folder_ =
        std::filesystem::temp_directory_path() /
        ("measured-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_ / "data");
    write("data/run.csv",
          "t,j,event,y,x1,x2,time\n0,0,,,1,2,10\n0.5,0,,,1.5,1,10.5\n0.5,1,sample,7,2,1,11\n"
          "1,1,,,3,0,12\n1.5,2,sample,8,4,-1,13\n");
  }
  ~Measured() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  model::Problem read(const std::string& plant, const std::string& inputs = "",
                      const std::string& at = "[1]") const {
    return parse_problem("problem: p\nmethod:\n  method: p\n  plant: " + plant + "\n  inputs: {" +
                             inputs + "}\n  events: {sample: {at: " + at +
                             "}}\n  observer: {state: {z: {shape: scalar, start: 0}}, at: "
                             "{sample: {z: z + 1}}}\n",
                         (folder_ / "p.yaml").string(), library());
  }
  InputError refused(const std::string& plant, const std::string& inputs = "",
                     const std::string& at = "[1]") const {
    return input_error([&] { read(plant, inputs, at); });
  }
  model::MeasuredText input(const std::string& text) const {
    return read("{}", "u: " + text).method->measured.front();
  }
  std::filesystem::path folder_;
};

TEST_F(Measured, AnInputIsAColumn) {
  const auto u = input("{csv: data/run.csv, column: x1}");
  EXPECT_EQ(u.name, "u");
  EXPECT_EQ(u.between, Between::hold);
  EXPECT_EQ(u.series->times, (std::vector<double>{0, 0.5, 0.5, 1, 1.5}));
  EXPECT_EQ(u.series->values, (numbers::Matrix{{1}, {1.5}, {2}, {3}, {4}}));
  EXPECT_EQ(input("{csv: data/run.csv, column: x1, between: line}").between, Between::line);
}

TEST_F(Measured, RowsWithoutAValueCountForNothing) {
  const auto u = input("{csv: data/run.csv, column: y}");
  EXPECT_EQ(u.series->times, (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(u.series->values, (numbers::Matrix{{7}, {8}}));
}

TEST_F(Measured, RowsTimesAndStartsAreChosen) {
  const auto u =
      input("{csv: data/run.csv, column: x2, rows: {event: sample}, time: time, from: 11}");
  EXPECT_EQ(u.series->times, (std::vector<double>{0, 2}));
  EXPECT_EQ(u.series->values, (numbers::Matrix{{1}, {-1}}));
}

TEST_F(Measured, TheColumnsOfAVectorAreOneQuantity) {
  const auto x = input("{csv: data/run.csv, column: x}");
  EXPECT_EQ(x.series->values.cols(), 2);
  EXPECT_EQ(x.series->values.row(4), (numbers::Matrix{{4, -1}}));
}

TEST_F(Measured, ALogIsAPlant) {
  const model::Problem problem = read(
      "{log: {csv: data/run.csv, between: line}, output: {angle: x1, y: {column: y, at: sample}}}",
      "", "{csv: data/run.csv, column: t, rows: {event: sample}}");
  const auto& measured = problem.method->measured;
  ASSERT_EQ(measured.size(), 2U);
  EXPECT_EQ(measured[0].name, "angle.log");
  EXPECT_EQ(measured[0].between, Between::line);
  EXPECT_EQ(measured[1].at, "sample");
  EXPECT_EQ(problem.method->events.front().rows, (std::vector<double>{0.5, 1.5}));
  const auto design = bind::bind(problem).design;
  EXPECT_EQ(design->dynamics->signals[0].name, "angle");
  EXPECT_EQ(design->dynamics->signals[1].at, 0U);
  EXPECT_EQ(design->dynamics->events[0].rows.size(), 2U);
}

TEST_F(Measured, AnInputMayHaveAUnit) {
  const model::Problem problem = parse_problem(
      "problem: p\nmethod:\n  method: p\n  inputs: {u: {csv: data/run.csv, column: x1}}\n"
      "  plant: {state: {x: scalar}, flow: {x: u}}\n"
      "  observer: {state: {z: scalar}, flow: {z: u}}\nunits: {u: m/s^2}\n",
      (folder_ / "p.yaml").string(), library());
  EXPECT_NO_THROW(bind::bind(problem));
}

/// An event that a log says does not happen at rows in which the sensor is silent.
TEST_F(Measured, ASilentSensorCorrectsNothing) {
  write("gaps.csv", "t,y,z\n0,1,1\n0.1,,2\n0.2,NaN,3\n0.3,NA,4\n0.4,5,\n0.4,,6\n");
  const auto rows = [&](const std::string& output) {
    return bind::bind(
               read("{log: gaps.csv, output: {" + output + "}}", "", "{csv: gaps.csv, column: t}"))
        .design->dynamics->events[0]
        .rows;
  };
  EXPECT_EQ(rows("y: {column: y, at: sample}"), (std::vector<double>{0, 0.4, 0.4}));
  EXPECT_EQ(rows("y: {column: y, at: sample}, w: {column: z, at: sample}"),
            (std::vector<double>{0, 0.4, 0.4}));
  EXPECT_EQ(rows("w: {column: z, at: sample}").size(), 6U);
}

TEST_F(Measured, TimesHaveUnitsAndOrigins) {
  const auto times = [&](const std::string& text, const std::string& more = "") {
    write("log.csv", text);
    return input("{csv: log.csv, column: u" + more + "}").series->times;
  };
  const std::vector<double> steps{0, 0.1, 0.25};
  EXPECT_EQ(times("t,u\n0,1\n100,2\n250,3\n", ", scale: 1e-3"), steps);
  EXPECT_EQ(times("t,u\n1700000000.05,1\n1700000000.15,2\n1700000000.3,3\n"), steps);
  EXPECT_EQ(times("t,u\n1700000000050,1\n1700000000150,2\n1700000000300,3\n", ", scale: 1e-3"),
            steps);
  EXPECT_EQ(times("t,u\n1700000000050000000,1\n1700000000150000000,2\n1700000000300000000,3\n",
                  ", scale: 1e-9"),
            steps);
  EXPECT_EQ(times("t,u\n7,1\n7.1,2\n7.25,3\n", ", from: first row"), steps);
  EXPECT_EQ(times("t,u\n7000,1\n7100,2\n7250,3\n", ", scale: 0.001, from: 7000"), steps);
  EXPECT_EQ(times("t,u\n2024-02-29T23:59:59.9Z,1\n2024-03-01T00:00:00Z,2\n"
                  "2024-03-01 01:00:00.15+01:00,3\n"),
            steps);
  EXPECT_EQ(times("t,u\n2026-11-29T08:00:01Z,1\n", ", from: \"2026-11-29T08:00:00Z\""),
            std::vector<double>{1});
  EXPECT_EQ(times("# made by a logger\nt [s],u (V)\ns,V\n0,1\n# a break\n0.1,2\n0.25,3\n"), steps);
  EXPECT_EQ(input_error([&] {
              read("{}", "u: {csv: log.csv, column: u}, v: {csv: log.csv, column: u, scale: 1e-3}");
            })
                .message()
                .substr(0, 6),
            "scale:");
  write("log.csv", "t,u [V],u [mV]\n0,1,1000\n");
  EXPECT_NE(refused("{}", "u: {csv: log.csv, column: u}").message().find("no column 'u'"),
            std::string::npos);
  EXPECT_EQ(input("{csv: log.csv, column: 'u [mV]'}").series->values(0, 0), 1000);
  write("log.csv", "t [ms],u\n0,1\n100,2\n250,3\n");
  EXPECT_EQ(input("{csv: log.csv, column: u}").series->times, steps);
  EXPECT_EQ(times("t,u\nms,m/s^2\n0,1\n100,2\n250,3\n"), steps);
  EXPECT_EQ(times("t,u\n[ms],[m/s2]\n0,-1\n100,.2\n250,3\n"), steps);
  const auto message = [&](const std::string& text, const std::string& more = "") {
    return input_error([&] { times(text, more); }).message();
  };
  EXPECT_NE(message("t,u\n0,1\n", ", from: first").find("expected 'first row' or a time"),
            std::string::npos);
  EXPECT_NE(message("t,u\n0,1\n", ", from: \"2026-11-29T08:00:00Z\"").find("as in"),
            std::string::npos);
  EXPECT_NE(message("t,u\n0,1\n", ", scale: 0").find("positive"), std::string::npos);
  for (const char* const time : {"2026-13-29T08:00:00Z", "2026-11-29T24:59:00Z",
                                 "2026-11-29T08:-1:00Z", "2026-11-29T08:00:61Z"})
    EXPECT_NE(message("t,u\n" + std::string(time) + ",1\n").find("expected a time"),
              std::string::npos)
        << time;
  EXPECT_EQ(times("t,u\n2026-11-30T00:00:01Z,1\n", ", from: \"2026-11-29T24:00:00Z\""),
            times("t,u\n2026-11-29T08:00:01Z,1\n", ", from: \"2026-11-29T08:00:00Z\""));
  EXPECT_NE(message("t,u\n1700000000050,1\n").find("scale: 1e-3 for ms"), std::string::npos);
  EXPECT_NE(message("# t,u\n0,1\n").find("lines that begin with #"), std::string::npos);
}

/// Two logs, each counted from its own first row, would be moved against each other.
TEST_F(Measured, TwoLogsNeedOneOrigin) {
  write("a.csv", "t,u\n1700000000,1\n");
  write("b.csv", "t,u\n1700000001,1\n");
  EXPECT_NE(
      refused("{}", "u: {csv: a.csv, column: u}, v: {csv: a.csv, column: u, from: 1699999999}")
          .message()
          .find("in one place and not in another"),
      std::string::npos);
  EXPECT_NE(refused("{}", "u: {csv: a.csv, column: u}, v: {csv: b.csv, column: u}")
                .message()
                .find("`from` has to say of both when a run begins"),
            std::string::npos);
  EXPECT_NE(
      refused("{}", "u: {csv: a.csv, column: u}, v: {csv: b.csv, column: u, from: 1700000000}")
          .message()
          .find("of both"),
      std::string::npos);
  read("{}",
       "u: {csv: a.csv, column: u, from: first row}, v: {csv: b.csv, column: u, from: 1700000000}");
}

TEST_F(Measured, WhatIsWrongInTheFileIsSaidOfTheFile) {
  const std::string csv = (folder_ / "bad.csv").string();
  write("bad.csv", "t,u,x1,x2\n0,1,1,1\n1,x,1,1\n0.5,2,1,\n,3,1,1\n");
  EXPECT_EQ(refused("{}", "u: {csv: bad.csv, column: u}").place(), (Place{csv, 3, 3}));
  EXPECT_EQ(refused("{}", "u: {csv: bad.csv, column: x}").place(), (Place{csv, 4, 7}));
  const InputError falls = refused("{}", "u: {csv: bad.csv, column: x1}");
  EXPECT_EQ(falls.place(), (Place{csv, 4, 1}));
  EXPECT_EQ(falls.message(), "the time 0.5 comes after 1: rows must be in the order of time");
  write("bad.csv", "t,u\n0,1\n,3\n");
  EXPECT_EQ(refused("{}", "u: {csv: bad.csv, column: u}").message(), "the row has no time");
}

TEST_F(Measured, WhatIsWrongInTheProblemIsSaidOfIt) {
  const auto message = [&](const std::string& text) { return refused("{}", text).message(); };
  EXPECT_NE(std::string(refused("{}", "u: {csv: none.csv, column: u}").what()).find("none.csv"),
            std::string::npos);
  EXPECT_NE(message("u: {csv: data/run.csv, column: evnt}").find("did you mean 'event'?"),
            std::string::npos);
  EXPECT_NE(message("u: {csv: data/run.csv, column: y, time: T}").find("has no column 'T'"),
            std::string::npos);
  EXPECT_NE(message("u: {csv: data/run.csv, column: y, rows: {event: none}}").find("no row of"),
            std::string::npos);
  const InputError misspelt =
      refused("{}", "u: {csv: data/run.csv, column: y, rows: {event: ENC}}");
  EXPECT_NE(misspelt.message().find("says 'ENC' there"), std::string::npos) << misspelt.what();
  EXPECT_NE(message("u: {csv: data/run.csv, column: y, between: spline}").find("'hold' or 'line'"),
            std::string::npos);
  EXPECT_NE(message("u: {csv: data/run.csv}").find("column"), std::string::npos);
  EXPECT_NE(message("u: {csv: data/run.csv, colum: y}").find("column"), std::string::npos);
  EXPECT_NE(refused("{log: data/run.csv, output: {y: y}, flow: {y: 1}}")
                .message()
                .find("a plant that is a log has outputs and events"),
            std::string::npos);
  EXPECT_NE(refused("{}", "", "{csv: data/run.csv, column: t, from: 99}").message().find("no row"),
            std::string::npos);
}

TEST_F(Measured, ItsPastIsNotKeptForFlowMaps) {
  const auto bound = [&](const std::string& flow) {
    return parse_problem(
        "problem: p\nmethod:\n  method: p\n  plant: {log: data/run.csv, output: "
        "{y: x1}}\n  inputs: {u: {csv: data/run.csv, column: x2}, w: sin(t)}\n"
        "  observer: {state: {z: {shape: scalar, start: 0}, k: {shape: scalar, "
        "start: 1}}, flow: {z: \"" +
            flow + "\"}}\n",
        (folder_ / "p.yaml").string(), library());
  };
  const auto message = [&](const std::string& flow) {
    return input_error([&] { bind::bind(bound(flow)); }).message();
  };
  EXPECT_NE(message("flow_map(-z + y, z, -1)").find("e has 'y.log', whose past is not kept"),
            std::string::npos);
  EXPECT_NE(message("flow_map(-z + u, z, -1)").find("e has 'u'"), std::string::npos);
  bind::bind(bound("y + flow_map(-k*z + w, z, -1)"));
}

TEST_F(Measured, OutputsOfThePlantHaveNoPast) {
  const auto bound = [&](const std::string& flow) {
    return parse_problem(
        "problem: p\nmethod:\n  method: p\n  plant: {state: {x: {shape: scalar, "
        "start: 1}}, output: {y: 2*x}}\n  observer: {state: {z: {shape: scalar, "
        "start: 0}}, flow: {z: \"" +
            flow + "\"}}\n",
        "p.yaml", library());
  };
  EXPECT_NE(input_error([&] { bind::bind(bound("flow_map(y - z, z, -1)")); })
                .message()
                .find("e has what the observer measures of 'x'"),
            std::string::npos);
  EXPECT_NE(input_error([&] { bind::bind(bound("jacobian(flow_map(y - z, z, -1), z)")); })
                .message()
                .find("e has what the observer measures of 'x'"),
            std::string::npos);
  bind::bind(bound("flow_map(-z, z, -y)"));
}

}  // namespace
}  // namespace gainsmith::io
