// Pictures of linear systems, from the problem file to the picture.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// 5/(s (s + 1) (s + 2)): gain margin 1.2 at sqrt(2).
const std::string kLoop = R"yaml(problem: loop
method:
  data: {k: scalar}
  let:
    L: "k*tf(1, [1, 3, 2, 0])"
    T: feedback(L)
data: {k: 5}
figures:
  loop:   {bode: {open loop: L, closed: T}}
  circle: {nyquist: L, over: [0.1, 100]}
  chart:  {nichols: L, over: [0.1, 100]}
  gains:  {singular values: [L, T]}
  answer: {step: T, over: [0, 40]}
  kick:   {impulse: T}
  modes:  {poles: T}
)yaml";

class PlotTest : public testing::Test {
 protected:
  Outcome plot(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"plot", file});
    return gainsmith(more);
  }
  /// Of the loop with something else in it.
  Outcome plot_with(const std::string& old, const std::string& fresh) const {
    return gainsmith({"plot", folder.file("changed.yaml", with(kLoop, old, fresh))});
  }

  Folder folder;
  std::string file = folder.file("loop.yaml", kLoop);
};

TEST_F(PlotTest, SaysWhatOneReadsFromThePictures) {
  const Outcome outcome = plot();
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::string& shown = outcome.out;
  EXPECT_TRUE(
      has(shown, "open loop under u = -y: gain margin 1.2 (1.58362 dB) at 1.41421, phase margin"))
      << shown;
  EXPECT_TRUE(has(shown, "the closed loop is stable")) << shown;
  EXPECT_TRUE(has(shown, "  L: not stable, so there is no largest gain")) << shown;
  EXPECT_TRUE(has(shown, "  T: largest gain")) << shown;
  EXPECT_TRUE(has(shown, "proved between")) << shown;
  EXPECT_TRUE(has(shown, "  T: ends at 1, overshoot")) << shown;
  EXPECT_TRUE(has(shown, "  T: pole -2.9")) << shown;
}

TEST_F(PlotTest, WritesAPictureForEach) {
  const std::string picture = folder.path("p.svg");
  const Outcome outcome = plot({"-o", picture});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  for (const char* name : {"loop", "circle", "chart", "gains", "answer", "kick", "modes"}) {
    const std::string svg = text_of(folder.path(std::string("p-") + name + ".svg"));
    EXPECT_TRUE(svg.starts_with("<svg ")) << name;
    EXPECT_TRUE(has(svg, std::string(">") + name + "</text>")) << name;
    EXPECT_FALSE(has(svg, "no data")) << name;
  }
  ASSERT_EQ(plot({"--figure", "modes", "-o", picture}).exit, 0);
  EXPECT_EQ(text_of(picture), text_of(folder.path("p-modes.svg")));
}

TEST_F(PlotTest, PrintsTheCurves) {
  const auto document = plot({"--json"}).json();
  ASSERT_EQ(document.size(), 7U);
  const auto& loop = document[0]["systems"][0];
  EXPECT_NEAR(loop["margins"]["gain"]["value"].get<double>(), 1.2, 1e-12);
  const auto& w = loop["frequency"];
  const auto& response = loop["response"][0];
  ASSERT_EQ(w.size(), response["real"].size());
  for (std::size_t k = 0; k < w.size(); k += 7) {
    const double x = w[k].get<double>();
    const double size =
        std::hypot(response["real"][k].get<double>(), response["imaginary"][k].get<double>());
    EXPECT_NEAR(size * x * std::hypot(x, 1) * std::hypot(x, 2) / 5, 1, 1e-12);
  }
  EXPECT_EQ(document[4]["systems"][0]["time"].back().get<double>(), 40);
  EXPECT_EQ(document[6]["systems"][0]["poles"].size(), 3U);
}

/// Steps that end at 0 have no rise time; what has no number is null.
TEST_F(PlotTest, PrintsStepsThatEndAt0) {
  const Outcome outcome =
      gainsmith({"plot",
                 folder.file("washout.yaml",
                             "problem: washout\nmethod: {}\nlet: {G: 'tf([1, 0], [1, 1])'}\n"
                             "figures: {step: {step: G}}\n"),
                 "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto steps = outcome.json()[0]["systems"][0]["steps"][0];
  EXPECT_NEAR(steps["final_value"].get<double>(), 0, 1e-12);
  EXPECT_NEAR(steps["largest"].get<double>(), 1, 1e-9);
}

TEST_F(PlotTest, SaysWhichClosedLoopIsStable) {
  const std::string problem = folder.file("loop.yaml", kLoop);
  std::vector<std::string> files;
  for (const std::string k : {"5", "7"}) {
    files.push_back(folder.path("k" + k + ".json"));
    ASSERT_EQ(gainsmith({"synth", problem, "--set", "k=" + k, "-o", files.back()}).exit, 0);
  }
  const Outcome outcome = gainsmith({"report", files[0], files[1], "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto document = outcome.json();
  for (const auto& row : document["rows"]) {
    const std::string what = row["what"];
    if (has(what, "loop, open loop: closed loop stable")) {
      EXPECT_EQ(row["values"][0].get<std::string>(), "1");
      EXPECT_EQ(row["values"][1].get<std::string>(), "0");
      return;
    }
  }
  FAIL() << outcome.out;
}

TEST_F(PlotTest, TakesValuesOfTheCommandLine) {
  EXPECT_TRUE(has(plot({"--set", "k=7"}).out, "the closed loop is not stable"));
}

/// The gain of the file is drawn, and the report has the pictures.
TEST_F(PlotTest, TakesGainFiles) {
  const std::string problem = folder.file("designed.yaml", R"yaml(problem: designed
method:
  data:     {A: n x n, B: n x m}
  unknowns: {X: symmetric n, Y: m x n}
  require:  {normal: X > I, decay: He(A*X + B*Y) + 2*X < 0}
  gains:    {F: Y*inv(X)}
data: {A: [[0, 1], [0, 0]], B: [[0], [1]]}
figures: {modes: {poles: "ss(A + B*F, B, eye(2), 0)"}}
)yaml");
  const std::string gains = folder.path("gains.json"), page = folder.path("page.html");
  ASSERT_EQ(gainsmith({"synth", problem, "-o", gains}).exit, 0);
  const Outcome outcome = gainsmith({"plot", gains});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out, gainsmith({"plot", problem}).out);
  EXPECT_TRUE(has(outcome.out, "pole -")) << outcome.out;
  ASSERT_EQ(gainsmith({"report", gains, "-o", page}).exit, 0);
  EXPECT_TRUE(has(text_of(page), "<h3>Figures</h3>"));
  EXPECT_TRUE(has(text_of(page), "real part"));
}

TEST_F(PlotTest, WithoutGainsThereIsNoPictureOfThem) {
  const std::string problem = folder.file("none.yaml", R"yaml(problem: none
method:
  data:     {A: n x n, B: n x m}
  unknowns: {X: symmetric n, Y: m x n}
  require:  {normal: X > I, decay: He(A*X + B*Y) + 2*X < 0}
  gains:    {F: Y*inv(X)}
data: {A: [[1, 0], [0, 1]], B: [[0], [1]]}
figures: {loop: {poles: "ss(A + B*F, B, eye(2), 0)"}, plant: {poles: "ss(A, B, eye(2), 0)"}}
)yaml");
  const Outcome outcome = gainsmith({"plot", problem});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_TRUE(has(outcome.out, "no picture")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "pole 1")) << outcome.out;
}

TEST_F(PlotTest, MistakesHaveTheirPlaces) {
  const auto says = [](const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, what)) << outcome.err;
  };
  says(plot({"--figure", "mode"}), "did you mean 'modes'?");
  says(plot({"-o", folder.path("p.gif")}), "--output: a picture is SVG, PDF or PNG");
  const std::string alike = folder.file(
      "alike.yaml", with(kLoop, "kick:   {impulse: T}", "a b: {step: T}\n  a/b: {step: T}"));
  says(gainsmith({"plot", alike, "-o", folder.path("p.svg")}), "two pictures would be");
  says(plot_with("{poles: T}", "{pole: T}"), "changed.yaml:15:12: ");
  says(plot_with("{poles: T}", "{poles: T, bode: T}"), "two pictures have two names");
  says(plot_with("{poles: T}", "{}"),
       "expected one of bode, singular values, nyquist, nichols, step");
  says(plot_with("{poles: T}", "{poles: T, over: [1, 2]}"), "poles have no range");
  says(plot_with("{poles: T}", "{poles: Q}"), "changed.yaml:15:19: unknown name 'Q'");
  says(plot_with("{poles: T}", "{nyquist: \"append(L, T)\"}"), "one input and one output");
  says(plot_with("over: [0.1, 100]", "over: [0, 100]"), "positive and rises");
  says(plot_with("over: [0, 40]", "over: [1, 40]"), "begins at 0");
  says(plot_with("data: {k: 5}", "data: {k: 1e400}"), "changed.yaml:");
  says(gainsmith({"plot", problem("designs/lqr.yaml")}), "asks for no pictures of linear systems");
  // A sampled system beside a continuous one.
  says(plot_with("{poles: T}", "{bode: \"L*tf(1, [1, 0.5], 0.1)\"}"), "c2d(A, B, T)");
  says(plot_with("{poles: T}", "{bode: \"tf(1, [1, 0.5], 0)\"}"), "sampling time");
}

}  // namespace
}  // namespace gainsmith::tests
