// Figures over the runs of a campaign, as a person asks for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests::figures {
namespace {

using Json = nlohmann::ordered_json;

const std::string kFilter = "own-systems/trusted-covariance.yaml";

/// A decay from a start that is drawn, whose peak is its start.
const std::string kDecay = R"yaml(problem: decay
method:
  method: decay
  plant:  {state: {x: 1}, flow: {x: -x}}
  claims: {small: {below: norm(x), bound: 3}}
campaign: {runs: 300, horizon: 1, initial: {x: {box: [[1], [2]]}}}
compare: [{peak: x}, {integral: x, over: [0, 1]}, {settles: x, below: 0.5}]
)yaml";

Json figure_of(const Json& figures, const std::string& title, const std::string& observer = "") {
  for (const Json& figure : figures["figures"])
    if (figure["figure"] == title && figure["observer"] == observer) return figure;
  ADD_FAILURE() << "no figure " << title << " of " << observer << " in " << figures.dump(1);
  return {};
}

double number(const std::string& file, const std::string& run, std::size_t figure) {
  return gainsmith({"simulate", file, "--compare", "--json", "--run", run})
      .json()["figures"][figure]["least"]["value"];
}

TEST(FiguresOverRuns, AreThoseOfTheRunsOneByOne) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kDecay);
  const Json record = gainsmith({"simulate", file, "--compare", "--json", "--runs", "0:4"}).json();
  EXPECT_EQ(record["runs"], 5);
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> values;
    for (const char* run : {"0", "1", "2", "3", "4"}) values.push_back(number(file, run, k));
    const Json& figure = record["figures"][k];
    const auto least = std::min_element(values.begin(), values.end());
    const auto largest = std::max_element(values.begin(), values.end());
    EXPECT_EQ(figure["least"]["run"], least - values.begin());
    EXPECT_EQ(figure["least"]["value"], *least);
    EXPECT_EQ(figure["largest"]["run"], largest - values.begin());
    EXPECT_EQ(figure["largest"]["value"], *largest);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(figure["quantiles"][1]["value"], values[2]);
  }
  // x = x(0)*exp(-t)
  EXPECT_NEAR(number(file, "3", 1), number(file, "3", 0) * (1 - std::exp(-1)), 1e-7);
}

TEST(FiguresOverRuns, OfACampaignHaveIntervals) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kDecay);
  const Json report = gainsmith({"verify", file, "--compare", "--json"}).json();
  const Json& figures = report["figures"];
  EXPECT_EQ(figures["runs"], 300);
  EXPECT_EQ(figures["confidence"], 0.95);
  const Json peak = figure_of(figures, "peak x");
  const Json& median = peak["quantiles"][1];
  EXPECT_LT(median["low"], median["value"]);
  EXPECT_GT(median["high"], median["value"]);
  EXPECT_LT(median["low"], 1.5) << "the start is uniform on [1, 2]";
  EXPECT_GT(median["high"], 1.5);
  // x falls below 0.5 at log(2*x(0)) <= 1 where x(0) <= e/2; the others never do.
  const Json settles = figure_of(figures, "settles x below 0.5");
  EXPECT_EQ(settles["largest"]["value"], "inf");
  EXPECT_EQ(settles["runs"], 300);
  EXPECT_NEAR(settles["least"]["value"], std::log(2 * peak["least"]["value"].get<double>()), 1e-6);
  EXPECT_EQ(settles["least"]["run"], peak["least"]["run"]);
}

/// Of linear packs, of integrated runs with events, and where nothing is drawn.
TEST(FiguresOverRuns, DoNotDependOnThreads) {
  const Folder folder;
  const std::string compare = "\ncompare: [{peak: norm(e)}, {settles: norm(e), below: 0.01}]\n";
  const std::string linear =
      folder.file("p.yaml", text_of(problem("ferrante-seuret-2021/t2-0.70.yaml")) + compare);
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", linear, "-o", gains}).exit, 0);
  for (const std::string& file :
       {gains, problem(kFilter), problem("bouncing-ball-impacts/restitution-0.8.yaml")}) {
    std::vector<std::string> found;
    for (const char* threads : {"1", "2"})
      found.push_back(
          gainsmith({"verify", file, "--compare", "--runs", "150", "--threads", threads}).out);
    EXPECT_TRUE(has(found[0], "figures     of 1")) << file << "\n" << found[0];
    EXPECT_EQ(found[0], found[1]) << file;
  }
}

TEST(FiguresOverRuns, TellCovariancesThatDoNotFit) {
  const Json report = gainsmith({"verify", problem(kFilter), "--compare", "--json"}).json();
  const std::vector<std::pair<std::string, std::string>> fits = {
      {"right", "consistent"}, {"bold", "too optimistic"}, {"timid", "too pessimistic"}};
  for (const auto& [observer, fit] : fits)
    for (const char* title : {"nees e at t = 10", "nis y - C*xh at sample"}) {
      const Json figure = figure_of(report["figures"], title, observer);
      EXPECT_EQ(figure["consistency"]["fit"], fit) << figure.dump(1);
      EXPECT_EQ(figure["consistency"]["improper"], 0);
    }
  const std::string text = gainsmith({"verify", problem(kFilter), "--compare"}).out;
  EXPECT_TRUE(has(text, "bold: nees e at t = 10: too optimistic, mean 20.")) << text;
  EXPECT_TRUE(has(text, "of 100; 2 is expected")) << text;
}

/// W and V are covariances: with noise of their diagonals alone the optimal filter would not fit. The
/// second W is singular.
TEST(FiguresOverRuns, TellThatAKalmanFilterFitsItsNoise) {
  const Folder folder;
  for (const char* W : {"[[1, 0.9], [0.9, 1]]", "[[1, 1], [1, 1]]"})
    for (const auto& [method, plant, rest] :
         {std::tuple("kalman", "[[0, 1], [0, -1]]", "horizon: 4"),
          std::tuple("discrete-kalman", "[[1, 0.1], [0, 0.9]]", "horizon: 60")}) {
      SCOPED_TRACE(std::string(method) + W);
      const bool discrete = std::string(method) == "discrete-kalman";
      const std::string file = folder.file(
          "p.yaml", "problem: p\nmethod: " + std::string(method) + "\ndata: {A: " + plant +
                        ", C: [[1, 0], [1, 1]], W: " + W + ", V: [[0.1, 0.08], [0.08, 0.1]]}\n" +
                        (discrete ? "" : "parameters: {hold: 0.02}\n") + "campaign: {runs: 120, " +
                        rest + ", initial: {x: 0}}\ncompare: [{nees: e, covariance: P, at: {t: " +
                        (discrete ? "59" : "4") + "}}]\n");
      const std::string gains = folder.path("gains.json");
      ASSERT_EQ(gainsmith({"synth", file, "-o", gains}).exit, 0);
      const Outcome outcome = gainsmith({"verify", gains, "--compare", "--json"});
      EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
      const Json fit = outcome.json()["figures"]["figures"][0]["consistency"];
      EXPECT_EQ(fit["fit"], "consistent") << fit.dump(1);
    }
}

/// P is negative in the runs with x(0) < 0 and zero where nothing is drawn.
TEST(FiguresOverRuns, SayWhereACovarianceIsNone) {
  const std::string text = R"yaml(problem: squares
method:
  method: squares
  plant:  {state: {x: 1, P: {shape: 1, start: START}}, flow: {x: -x, P: "0"}}
  claims: {small: {below: norm(x), bound: 3}}
campaign: {runs: 40, horizon: 1, initial: {x: {box: [[-1], [1]]}}}
compare: [{nees: x, covariance: "COVARIANCE", at: {t: 0.5}}]
)yaml";
  const Folder folder;
  const auto squares = [&](const std::string& covariance) {
    const std::string file =
        folder.file("p.yaml", with(with(text, "COVARIANCE", covariance), "START", "0"));
    const Outcome outcome = gainsmith({"verify", file, "--compare", "--json"});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_TRUE(has(gainsmith({"verify", file, "--compare"}).out, "not positive definite there"));
    return outcome.json()["figures"]["figures"][0]["consistency"];
  };
  const Json negative = squares("x");
  EXPECT_EQ(negative["fit"], "undecided");
  EXPECT_GT(negative["improper"], 5);
  EXPECT_LT(negative["improper"], 35);
  EXPECT_EQ(negative["improper"].get<int>() + negative["squares"].get<int>(), 40);
  const Json singular = squares("P");
  EXPECT_EQ(singular["fit"], "undecided");
  EXPECT_EQ(singular["improper"], 40);
  EXPECT_TRUE(singular["mean"].is_null());
}

TEST(FiguresOverRuns, OfAStoppedCampaignAreOfTheRunsThatAreDone) {
  const Outcome outcome =
      interrupted({"verify", problem(kFilter), "--compare", "--json", "--runs", "1000000"}, 4);
  EXPECT_EQ(outcome.exit, 3) << outcome.err;
  const Json report = outcome.json();
  const Json& figures = report["figures"];
  EXPECT_EQ(figures["runs_asked"], 1000000);
  EXPECT_GE(figures["runs"], 1);
  EXPECT_LE(figures["runs"], report["runs"]);
  const std::uint64_t runs = figures["runs"];
  EXPECT_EQ(figure_of(figures, "nees e at t = 10", "right")["runs"], runs);
  // The same as of a campaign of so many runs.
  const Json whole =
      gainsmith({"verify", problem(kFilter), "--compare", "--json", "--runs", std::to_string(runs)})
          .json();
  EXPECT_EQ(whole["figures"]["figures"], figures["figures"]);
}

TEST(FiguresOverRuns, OfManyRunsSayHowExactTheyAre) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", with(kDecay, ", {settles: x, below: 0.5}", ""));
  const Json figures =
      gainsmith({"verify", file, "--compare", "--json", "--runs", "9000"}).json()["figures"];
  EXPECT_EQ(figures["runs"], 9000);
  const Json peak = figure_of(figures, "peak x");
  EXPECT_GT(peak["resolution"], 0);
  EXPECT_LT(peak["resolution"], 1e-3);
  // The start is uniform on [1, 2].
  for (const Json& quantile : peak["quantiles"])
    EXPECT_NEAR(quantile["value"], 1 + quantile["probability"].get<double>(), 0.03);
  EXPECT_TRUE(has(gainsmith({"verify", file, "--compare", "--runs", "9000"}).out,
                  "quantiles are computed to "));
  EXPECT_EQ(gainsmith({"simulate", file, "--compare", "--runs", "0:299"}).exit, 0);
}

TEST(FiguresOverRuns, AreDrawn) {
  const Folder folder;
  const std::string picture = folder.path("h.svg");
  const Outcome outcome =
      gainsmith({"simulate", problem(kFilter), "--compare", "--runs", "0:39", "--plot", picture});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "right: nees e at t = 10: "));
  const std::string svg = text_of(picture);
  for (const char* text : {">nees e at t = 10<", ">bold<", ">runs<"})
    EXPECT_TRUE(has(svg, text)) << text;
  // Of the runs that never settle, and of one value and whole numbers.
  const std::string file =
      folder.file("p.yaml", with(kDecay, "{peak: x}", "{at: {t: 0}, value: 0.1*x/x}"));
  gainsmith({"simulate", file, "--compare", "--runs", "0:39", "--plot", picture});
  EXPECT_TRUE(has(text_of(picture), " of 40 runs have no finite value<"));
}

TEST(FiguresOverRuns, AnEnvelopeLiesAroundTheRuns) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kDecay);
  const std::string picture = folder.path("e.svg");
  const std::vector<std::string> draw = {"simulate", file,     "--envelope", "--runs",
                                         "0:199",    "--plot", picture};
  const Outcome outcome = gainsmith(draw);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "quantiles of 200 runs of seed 1")) << outcome.out;
  const std::string svg = text_of(picture);
  for (const char* text : {">x: median<", ">5 to 95 % of the runs<", ">least, largest<"})
    EXPECT_TRUE(has(svg, text)) << text;
  EXPECT_TRUE(has(gainsmith({"simulate", file, "--envelope", "--plot", picture}).err,
                  "give --runs and --plot FILE"));
}

TEST(FiguresOverRuns, NeedSomethingToCompare) {
  const Outcome outcome =
      gainsmith({"verify", problem("own-systems/pendulum-ekf.yaml"), "--compare"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.err, "the problem names nothing to compare")) << outcome.err;
}

/// The quadrupole motion of a nucleus. q2(100) = 4.7038097..., by 45 and by 60 digits; its sixteen
/// digits are lost near t = 60.
TEST(Figures, OfAChaoticRunAreUnknownAndUndecided) {
  const std::string text = R"yaml(problem: chaos
method:
  method: chaos
  plant:
    state: {p: {shape: 2, start: [7.1989885061904335, -0.165912283356219]}, q: {shape: 2, start: [0, -3.63534900748947]}}
    let: {r2: q(1)^2 + q(2)^2}
    flow:
      p: "[-q(1) - 1.65/sqrt(2)*(q(2)^2 - q(1)^2) - 0.4*q(1)*r2; -q(2)*(1 + 1.65*sqrt(2)*q(1) + 0.4*r2)]"
      q: p
    events: {cut: {crosses: q(1)}}
campaign: {horizon: 300}
compare: [{at: {t: 10}, value: q(2)}, {at: {t: 100}, value: q(2)}, {count: cut}]
expect: {run: [EXPECTED]}
)yaml";
  const Folder folder;
  const std::string file = folder.file("p.yaml", with(text, "EXPECTED", ""));
  const Json figures = gainsmith({"simulate", file, "--compare", "--json"}).json()["figures"];
  EXPECT_EQ(figures[0]["runs_unknown"], 0);
  EXPECT_LT(figures[0]["error"], 1e-8);
  EXPECT_EQ(figures[1]["runs_unknown"], 1);
  EXPECT_TRUE(figures[1]["least"]["value"].is_null());
  EXPECT_EQ(figures[2]["runs_unknown"], 1);
  EXPECT_TRUE(has(gainsmith({"simulate", file, "--compare"}).out, "unknown"));
  const auto run = [&](const std::string& expected) {
    const std::string path = folder.file("e.yaml", with(text, "EXPECTED", expected));
    return gainsmith({"run", path, "-o", folder.path("results")});
  };
  const double early = figures[0]["least"]["value"];
  const Outcome open = run("{at: {t: 299}, value: q(2), is: 4.7038097, relative: 1e-4}");
  EXPECT_EQ(open.exit, 3) << open.out;
  EXPECT_TRUE(has(open.out + open.err, "not known")) << open.out << open.err;
  EXPECT_EQ(run(fmt::format("{{at: {{t: 10}}, value: q(2), is: {}, absolute: 1e-6}}", early)).exit,
            0);
  // 31 digits know it. With the start rounded to double it is 2.723.
  EXPECT_EQ(run("{at: {t: 100}, value: q(2), is: 4.7038097, relative: 1e-4}").exit, 0);
  EXPECT_EQ(
      run(fmt::format("{{at: {{t: 10}}, value: q(2), is: {}, absolute: 1e-6}}", early + 1e-4)).exit,
      1);
}

TEST(Figures, UnknownOnesAreCountedInCampaigns) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", R"yaml(problem: maps
method:
  method: maps
  events: {tick: {every: 1}}
  plant: {state: {y: {shape: scalar, start: 0.3}, k: {shape: scalar, start: 0}}, at: {tick: {y: k*y*(1 - y)}}}
  claims: {small: {below: y, bound: 2, after: 1.5}}
campaign: {runs: 2, horizon: 90, initial: {k: {list: [2, 4]}}}
compare: [{at: {t: 90}, value: y}]
)yaml");
  const std::string part = folder.path("part.json");
  const Outcome text = gainsmith({"verify", file, "--compare"});
  EXPECT_TRUE(has(text.out, "at t = 90: not known in 1 of 2 runs, as: t = ")) << text.out;
  const Json figure =
      gainsmith({"verify", file, "--compare", "--json"}).json()["figures"]["figures"][0];
  EXPECT_EQ(figure["runs"], 1);
  EXPECT_EQ(figure["runs_unknown"], 1);
  EXPECT_TRUE(figure["quantiles"][1]["low"].is_null()) << "half of the runs may lie anywhere";
  EXPECT_NEAR(figure["least"]["value"], 0.5, 1e-12);
  EXPECT_GT(figure["least"]["error"], 0);
  // The same in parts.
  for (const char* shard : {"1/2", "2/2"})
    EXPECT_LE(gainsmith({"verify", file, "--compare", "--shard", shard, "-o",
                         folder.path(shard[0] == '1' ? "1.json" : "2.json")})
                  .exit,
              3);
  const Json merged =
      gainsmith({"merge", folder.path("1.json"), folder.path("2.json"), "--json"}).json();
  EXPECT_EQ(merged["figures"]["figures"][0], figure);
}

}  // namespace
}  // namespace gainsmith::tests::figures
