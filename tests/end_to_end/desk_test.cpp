// Pictures over many values, and designs side by side, from files to pages.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// k/(s (s + 1) (s + 2)): stable up to k = 6.
const std::string kLoopOfGain = R"yaml(problem: loop
method: {}
data: {k: 5, d: 2, P: "tf(1, [1, 1])"}
let:
  G: "P*tf(1, [1, d, 0])"
  L: "k*G"
uncertain: {d: {box: [1.5, 3]}}
figures:
  weights: {margins: L, scan: {k: [1, 7]}, title: Over the gain}
  locus:   {poles: feedback(L), scan: {k: [1, 7]}}
  steps:   {step: feedback(L), scan: {k: [1, 5]}}
  band:    {bode: k*plant.G}
  cloud:   {poles: feedback(k*plant.G)}
)yaml";

TEST(DeskTest, AScanDesignsAnewForEachValue) {
  const Folder folder;
  const std::string file = folder.file("loop.yaml", kLoopOfGain), picture = folder.path("p.svg");
  const Outcome outcome = gainsmith({"plot", file, "--json", "-o", picture});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto figures = outcome.json();
  const auto values = figures[0]["scan"]["values"].get<std::vector<double>>();
  ASSERT_EQ(values.size(), 61U);
  EXPECT_EQ(values.front(), 1);
  EXPECT_EQ(values.back(), 7);
  const auto& margins = figures[0]["systems"][0];
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_EQ(margins["stable"][k].get<bool>(), values[k] < 6) << values[k];
    EXPECT_NEAR(margins["gain_margin"][k].get<double>(), 6 / values[k], 1e-9);
  }
  EXPECT_TRUE(has(figures[0]["facts"][0], "not stable in 11 of 61, first at k = 6")) << figures[0];
  EXPECT_TRUE(has(text_of(folder.path("p-weights.svg")), "Over the gain"));
  const auto& locus = figures[1]["systems"][0]["locus"];
  ASSERT_EQ(locus.size(), 61U);
  for (std::size_t k = 0; k < values.size(); ++k) {
    ASSERT_EQ(locus[k].size(), 3U);
    double sum = 0;
    for (const auto& pole : locus[k]) sum += pole[0].get<double>();
    EXPECT_NEAR(sum, -3, 1e-9);
  }
  ASSERT_EQ(figures[2]["systems"].size(), 5U);
  EXPECT_EQ(figures[2]["systems"][4]["system"], "feedback(L) at k = 5");
}

/// Of s^2 + d s the loop k/((s + 1) (s^2 + d s)) has the gain margin d (d + 1)/k.
TEST(DeskTest, UncertainDataAreDrawnAsInRuns) {
  const Folder folder;
  const std::string file = folder.file("loop.yaml", kLoopOfGain), picture = folder.path("p.svg");
  const Outcome outcome =
      gainsmith({"plot", file, "--json", "--figure", "band", "--figure", "cloud", "-o", picture});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto figures = outcome.json();
  EXPECT_NEAR(figures[0]["systems"][0]["margins"]["gain"]["value"].get<double>(), 1.2, 1e-9);
  const auto& draws = figures[0]["draws"][0];
  ASSERT_EQ(draws["stable"].size(), 102U);  // and both ends of the box
  double least = 100, most = 0;
  for (std::size_t k = 0; k < 102; ++k) {
    const double margin = draws["gain_margin"][k].get<double>();
    least = std::min(least, margin);
    most = std::max(most, margin);
    EXPECT_EQ(draws["stable"][k].get<bool>(), margin > 1);
  }
  EXPECT_NEAR(least, 1.5 * 2.5 / 5, 1e-9);
  EXPECT_NEAR(most, 3 * 4 / 5.0, 1e-9);
  EXPECT_TRUE(has(figures[0]["facts"][1], "over 100 draws and 2 corners of plant.d: least gain"));
  const auto& band = figures[0]["bands"][0];
  for (std::size_t k = 0; k < band["x"].size(); ++k)
    EXPECT_LE(band["low"][k].get<double>(), band["high"][k].get<double>());
  EXPECT_EQ(
      gainsmith({"plot", file, "--json", "--figure", "band", "--figure", "cloud", "-o", picture})
          .out,
      outcome.out);
}

/// The gains stay, the plant moves: the loop k/((s + 1) (s^2 + d s)).
TEST(DeskTest, AScanMayBeOfThePlantAlone) {
  const Folder folder;
  const std::string text =
      with(kLoopOfGain, "{bode: k*plant.G}", "{margins: k*plant.G, scan: {plant.d: [1, 3]}}");
  const auto figures =
      gainsmith({"plot", folder.file("p.yaml", text), "--json", "--figure", "band"}).json();
  const auto values = figures[0]["scan"]["values"].get<std::vector<double>>();
  for (std::size_t k = 0; k < values.size(); ++k)
    EXPECT_NEAR(figures[0]["systems"][0]["gain_margin"][k].get<double>(),
                values[k] * (values[k] + 1) / 5, 1e-9);
}

TEST(DeskTest, MistakesOfScansHaveTheirPlaces) {
  const Folder folder;
  const auto says = [&](const std::string& old, const std::string& fresh, const std::string& what) {
    const Outcome outcome =
        gainsmith({"plot", folder.file("m.yaml", with(kLoopOfGain, old, fresh))});
    EXPECT_EQ(outcome.exit, 2) << fresh;
    EXPECT_TRUE(has(outcome.err, what)) << fresh << ": " << outcome.err;
  };
  says(", scan: {k: [1, 7]}, title", ", title", "margins are drawn over a scalar");
  says("scan: {k: [1, 7]}, title", "scan: {q: [1, 7]}, title", "m.yaml:9:32");
  says("scan: {k: [1, 7]}, title", "scan: {k: [1, 7], d: [1, 2]}, title", "expected one scalar");
  says("scan: {k: [1, 7]}, title", "scan: {k: 3}, title", "expected a range [low, high]");
  says("margins: L", "margins: \"append(L, L)\"", "one input and one output");
  says("poles: feedback(L), scan", "poles: feedback(k*plant.G), scan", "two pictures");
  says("poles: feedback(L), scan: {k: [1, 7]}", "poles: [\"tf(1, [1, 2])\", \"tf(1, [1, 2], 1)\"]",
       "need two pictures");
  says("bode: k*plant.G", "bode: k*plant.H", "unknown name 'plant.H'");
}

/// An observer of a pendulum, whose gain depends on w.
const std::string kPendulum = R"yaml(problem: pendulum
method:
  data: {w: scalar}
  gains: {L: "[2*w; w^2]"}
  plant:
    state: {x: 2}
    flow: {x: "[x(2); -9.81*sin(x(1)) - 0.2*x(2)]"}
    output: {y: x(1)}
  observer:
    state: {xh: 2}
    flow: {xh: "[xh(2); -9.81*sin(xh(1)) - 0.2*xh(2)] + L*(y - xh(1))"}
  signals: {e: x - xh}
data: {w: 3}
compare: [{peak: norm(e)}]
campaign: {runs: 10, horizon: 5, initial: {x: {box: [[-1.5, -1], [1.5, 1]]}, xh: [0, 0]}}
figures: {error: {poles: "ss([0, 1; -9.81, -0.2] - L*[1, 0], L, [1, 0], 0)"}}
)yaml";

class TwoDesigns : public testing::Test {
 protected:
  TwoDesigns() {
    const std::string file = folder.file("pendulum.yaml", kPendulum);
    EXPECT_EQ(gainsmith({"synth", file, "-o", calm}).exit, 0);
    EXPECT_EQ(gainsmith({"synth", file, "--set", "w=10", "-o", quick}).exit, 0);
  }
  Folder folder;
  std::string calm = folder.path("calm.json"), quick = folder.path("quick.json"),
              picture = folder.path("p.svg"), page = folder.path("p.html");
};

TEST_F(TwoDesigns, ShareAPictureOfTheSameRun) {
  const Outcome outcome = gainsmith({"simulate", calm, quick, "--plot", picture});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::string drawn = text_of(picture);
  EXPECT_TRUE(has(drawn, ">calm: xh1<"));
  EXPECT_TRUE(has(drawn, ">quick: xh1<"));
  // No observer drives the plant, which is there once.
  EXPECT_TRUE(has(drawn, ">x1<"));
  EXPECT_FALSE(has(drawn, ": x1<"));
  const Outcome figures = gainsmith({"simulate", calm, quick, "--compare"});
  const Outcome several = gainsmith({"simulate", calm, quick, "--compare", "--runs", "0:4"});
  EXPECT_TRUE(has(several.out, "median")) << several.out << several.err;
  EXPECT_TRUE(has(figures.out, "calm\n")) << figures.out;
  EXPECT_TRUE(has(figures.out, "quick\n")) << figures.out;
  const std::string other = folder.file(
      "other.yaml", with(with(kPendulum, "state: {x: 2}", "state: {x: 2, z: 1}"),
                         "0.2*x(2)]\"}\n    output", "0.2*x(2)]\", z: -z}\n    output"));
  const std::string third = folder.path("third.json");
  ASSERT_EQ(gainsmith({"synth", other, "-o", third}).exit, 0);
  EXPECT_TRUE(has(gainsmith({"simulate", calm, third, "--plot", picture}).err,
                  "its plant has other states"));
}

TEST_F(TwoDesigns, HaveATableOfWhatDiffers) {
  const Outcome outcome = gainsmith({"report", calm, quick, "-o", page});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "at most 91")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "run 0: peak norm(e)")) << outcome.out;
  const auto table = gainsmith({"report", calm, quick, "--json"}).json();
  EXPECT_EQ(table["designs"][1], "quick");
  bool found = false;
  for (const auto& row : table["rows"])
    if (row["what"] == "L") {
      found = true;
      EXPECT_EQ(row["values"][0], "[6; 9]");
      EXPECT_EQ(row["values"][1], "[20; 100]");
    }
  EXPECT_TRUE(found);
  const std::string shown = text_of(page);
  EXPECT_TRUE(has(shown, "Run 0 of seed 1 of each"));
  EXPECT_TRUE(has(shown, ">quick: xh1<"));
  EXPECT_TRUE(has(gainsmith({"report", calm, calm, "--json"}).out, calm));
}

TEST_F(TwoDesigns, ShareTheirPoles) {
  const auto figures = gainsmith({"plot", calm, quick, "--json"}).json();
  ASSERT_EQ(figures[0]["systems"].size(), 2U);
  // s^2 + (0.2 + 2 w) s + 9.81 + 0.4 w + w^2.
  for (std::size_t k = 0; k < 2; ++k) {
    const double w = k == 0 ? 3 : 10;
    double sum = 0;
    for (const auto& pole : figures[0]["systems"][k]["poles"]) sum += pole[0].get<double>();
    EXPECT_NEAR(sum, -0.2 - 2 * w, 1e-9);
  }
}

TEST_F(TwoDesigns, ArePresentedAsAsked) {
  const auto drawn = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", calm, "--plot", picture});
    const Outcome outcome = gainsmith(more);
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    return text_of(picture);
  };
  const std::string usual = drawn({});
  const std::string sized = drawn({"--size", "500x400", "--title", "A title"});
  EXPECT_TRUE(has(sized, "width=\"500\" height=\"400\"")) << sized.substr(0, 200);
  EXPECT_TRUE(has(sized, ">A title<"));
  EXPECT_TRUE(has(drawn({"--name", "x1=angle"}), ">angle<"));
  const std::string part = drawn({"--window", "0:0.5"});
  EXPECT_FALSE(has(part, ">5<"));
  EXPECT_TRUE(has(part, ">0.5<"));
  EXPECT_TRUE(has(drawn({"--jump-width", "0.1"}), ">t + 0.1 j<"));
  const auto refuses = [&](const std::vector<std::string>& more, const std::string& what) {
    std::vector<std::string> all = {"simulate", calm, "--plot", picture};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = gainsmith(all);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, what)) << outcome.err;
  };
  refuses({"--size", "500"}, "expected a width and a height");
  refuses({"--size", "5x1e9"}, "expected a width and a height");
  refuses({"--window", "3:1"}, "--window");
  refuses({"--name", "x9=angle"}, "no name 'x9'; did you mean");
  refuses({"--jump-width", "-1"}, "expected a positive time");
  EXPECT_TRUE(has(gainsmith({"simulate", calm, "--size", "500x400"}).err, "give --plot FILE"));
}

/// What corrects an estimate, unless it is the state itself.
TEST(DeskTest, NoisySamplesLieBehindTheirEstimates) {
  const Folder folder;
  const std::string text = R"yaml(problem: samples
method:
  gains: {L: "[0.3; 0.2]"}
  plant: {state: {x: 2}, flow: {x: "[x(2); -x(1)]"}, output: {y: {value: x(1) + w, at: sample}}}
  events: {sample: {every: 0.1}}
  noise: {w: {normal: 0.1, new at: sample}}
  observer: {state: {xh: 2}, flow: {xh: "[xh(2); -xh(1)]"}, at: {sample: {xh: "xh + L*(y - xh(1))"}}}
campaign: {horizon: 3, initial: {x: [1, 0], xh: [0, 0]}}
)yaml";
  const auto drawn = [&](const std::string& problem) {
    const std::string picture = folder.path("p.svg");
    const Outcome outcome =
        gainsmith({"simulate", folder.file("p.yaml", problem), "--plot", picture});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    return text_of(picture);
  };
  EXPECT_TRUE(has(drawn(text), ">y<"));
  EXPECT_FALSE(has(drawn(with(text, "x(1) + w,", "x(1) + 0*w,")), ">y<"));
}

TEST(WatchTest, RunsAgainAfterAChange) {
  const Folder folder;
  std::filesystem::create_directory(folder.path("p"));
  const std::string file = folder.file("p/lqr.yaml", text_of(problem("designs/lqr.yaml")));
  const std::string out = folder.path("out.txt"), err = folder.path("err.txt");
  const pid_t child = start({"run", file, "--watch", "-o", folder.path("results")}, out, err);
  const auto waits = [&] {
    return std::filesystem::exists(err) && has(text_of(err), "waiting for a change");
  };
  wait_for(child, waits);
  EXPECT_TRUE(has(text_of(out), "ok          lqr")) << text_of(out);
  folder.file("p/lqr.yaml", "problem: lqr\nmethod: lqrr\n");
  wait_for(child, [&] { return has(text_of(out), "ERROR"); });
  EXPECT_TRUE(has(text_of(out), "lqr.yaml:2:9")) << text_of(out);
  EXPECT_TRUE(has(text_of(err), "lqr.yaml changed")) << text_of(err);
  ::kill(child, SIGINT);
  wait_for(child, [] { return false; });
}

}  // namespace
}  // namespace gainsmith::tests
