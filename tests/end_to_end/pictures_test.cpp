// Pictures of runs, scans and bisections, as a person asks for them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// An oscillator, a force, and two observers; the second one starts near the truth and copies it.
const std::string kOscillator = R"(problem: oscillator
method:
  method: oscillator
  inputs: {u: sin(t)}
  events: {sample: {every: [0.4, 0.6]}}
  plant:
    state: {x: {shape: 2, start: [1, 0]}}
    output: {y: x}
    flow:  {x: "[x(2); -x(1) + u]"}
  observers:
    filter:
      state: {xh: {shape: 2, start: 0}, P: {shape: symmetric 2, start: I}}
      flow:  {xh: "[xh(2); -xh(1) + u]", P: "He([0, 1; -1, 0]*P) - 0.1*P"}
      at:    {sample: {xh: xh + 0.5*(y - xh), P: 0.5*P}}
    copy:
      state: {xh: {shape: 2, start: [1, 1e-10]}}
      flow:  {xh: "[xh(2); -xh(1) + u]"}
  signals: {e: x - xh
}
  claims:
    small: {shrinks: norm(e), to: 0.5}
    large: {below: 1e5*norm(x), bound: 5e5}
    work:  {below: x(1)*x(2), bound: 9}
units: {t: s, x: [m, m/s], u: N}
campaign: {runs: 20, horizon: 6}
)";

Outcome simulate(const Folder& folder, const std::vector<std::string>& more,
                 const std::string& name = "run.svg", const std::string& text = kOscillator) {
  std::vector<std::string> arguments = {"simulate", folder.file("p.yaml", text), "--plot",
                                        folder.path(name)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return gainsmith(arguments);
}

/// The texts of a picture, one a line.
std::string words_of(const std::string& picture) {
  std::string texts;
  const std::regex text("<text[^>]*>([^<]*)<");
  for (auto found = std::sregex_iterator(picture.begin(), picture.end(), text);
       found != std::sregex_iterator(); ++found)
    texts += (*found)[1].str() + "\n";
  return texts;
}

std::string drawn(const std::vector<std::string>& more, const std::string& text = kOscillator) {
  const Folder folder;
  const Outcome outcome = simulate(folder, more, "run.svg", text);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  return text_of(folder.path("run.svg"));
}

bool has_line(const std::string& texts, const std::string& line) {
  return ("\n" + texts).find("\n" + line + "\n") != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(Pictures, TheUsualOneHasInputsUnitsAndClaimsApart) {
  const std::string texts = words_of(drawn({}));
  for (const char* line :
       {"x1", "x2", "m", "m/s", "u", "N", "t [s]", "filter.xh1", "copy.xh2", "size of the error",
        "claim filter.small", "claim copy.small", "claim large", "claim work"})
    EXPECT_TRUE(has_line(texts, line)) << line << "\n" << texts;
}

TEST(Pictures, TheWorstRunHasTheSameAxes) {
  const Folder folder;
  gainsmith({"run", folder.file("p.yaml", kOscillator), "-o", folder.path("out")});
  const std::string texts = words_of(text_of(folder.path("out/p/worst-run.svg")));
  for (const char* line : {"m", "m/s", "u", "N", "t [s]"})
    EXPECT_TRUE(has_line(texts, line)) << line << "\n" << texts;
}

TEST(Pictures, TheBoundOfShrinksIsDrawn) {
  const std::string with = drawn({"--panels", "filter.small"});
  EXPECT_EQ(count(with, "stroke-dasharray=\"3 2\""), 1U);
}

/// The smallest power of ten at a logarithmic axis.
int least_power(const std::string& picture) {
  int least = 0;
  const std::regex power("<tspan[^>]*>\xE2\x88\x92([0-9]+)</tspan>");
  for (auto found = std::sregex_iterator(picture.begin(), picture.end(), power);
       found != std::sregex_iterator(); ++found)
    least = std::min(least, -std::stoi((*found)[1]));
  return least;
}

TEST(Pictures, WhatIsRoundingIsNoCurve) {
  // The filter halves its error each half second: after 25 s it is the rounding of states of 10.
  std::string longer = kOscillator;
  longer.replace(longer.find("horizon: 6"), 10, "horizon: 60");
  const int least = least_power(drawn({"--panels", "filter.small"}, longer));
  EXPECT_LE(least, -10);
  EXPECT_GE(least, -14);
}

TEST(Pictures, PanelsAreChosenInOrder) {
  const std::string texts = words_of(drawn({"--panels", "large, u,x2"}));
  EXPECT_LT(texts.find("claim large\n"), texts.find("u\n"));
  EXPECT_LT(texts.find("\nu\n"), texts.find("\nx2\n"));
  EXPECT_FALSE(has_line(texts, "x1") || has_line(texts, "size of the error")) << texts;
}

TEST(Pictures, PlanesShowThePlantAndItsEstimates) {
  const std::string texts = words_of(drawn({"--phase", "x1,x2"}));
  for (const char* line : {"x2 over x1", "x1 [m]", "x2 [m/s]", "x1, x2", "filter.xh1, filter.xh2"})
    EXPECT_TRUE(has_line(texts, line)) << line << "\n" << texts;
  EXPECT_FALSE(has_line(texts, "t [s]")) << texts;
  EXPECT_TRUE(has_line(words_of(drawn({"--phase", "x1,x2", "--panels", "u"})), "t [s]"));
}

/// The longest line between two points of a picture's curves, in pixels.
double longest_line(const std::string& picture) {
  const std::string begin = "stroke-width=\"1.6\" stroke-linejoin=\"round\" d=\"";
  double longest = 0;
  for (std::size_t at = picture.find(begin); at != std::string::npos;
       at = picture.find(begin, at + 1)) {
    const std::string path =
        picture.substr(at + begin.size(), picture.find('"', at + begin.size()) - at - begin.size());
    for (std::size_t line = path.find('l'); line != std::string::npos;
         line = path.find('l', line + 1)) {
      const char* next = path.c_str() + line + 1;
      while (*next != 'M' && *next != '\0') {
        char* end = nullptr;
        const double across = std::strtod(next, &end);
        const double down = std::strtod(*end == ',' ? end + 1 : end, &end);
        longest = std::max(longest, std::hypot(across, down));
        next = end;
      }
    }
  }
  return longest;
}

/// 160 turns of an oscillator, and turns of Lorenz' system, which is integrated.
TEST(Pictures, OrbitsHaveNoCorners) {
  const std::pair<const char*, const char*> plants[] = {
      {"2", "[-0.01, 5; -5, -0.01]*x"},
      {"3", "[10*(x(2) - x(1)); x(1)*(28 - x(3)) - x(2); x(1)*x(2) - 8/3*x(3)]"}};
  for (const auto& [size, flow] : plants) {
    const std::string picture =
        drawn({"--phase", "x1,x2"},
              "problem: orbit\nmethod: {plant: {state: {x: " + std::string(size) +
                  "}, flow: {x: \"" + flow +
                  "\"}}}\n"
                  "campaign: {runs: 1, horizon: 200, initial: {x: {box: [0.5, 1]}}}\n");
    const double longest = longest_line(picture);
    EXPECT_GT(longest, 1) << flow;
    EXPECT_LT(longest, 100) << flow;
  }
}

TEST(Pictures, BandsComeFromTheOptionOrTheProblem) {
  const std::string label = "filter.xh1 \xC2\xB1 2\xCF\x83";
  EXPECT_FALSE(has(drawn({}), label));
  const std::string with = drawn({"--band", "xh:P"});
  EXPECT_TRUE(has(with, label));
  EXPECT_EQ(with, drawn({}, kOscillator + "covariance: {xh: P}\n"));
  EXPECT_EQ(with, drawn({"--band", "filter.xh:filter.P"}));
}

TEST(Pictures, SeveralRunsLieOverEachOther) {
  const Folder folder;
  const Outcome outcome = simulate(folder, {"--runs", "0,3,17"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::string texts = words_of(text_of(folder.path("run.svg")));
  for (const char* run : {"run 0", "run 3", "run 17"}) {
    EXPECT_TRUE(has_line(texts, run)) << texts;
    EXPECT_TRUE(has(outcome.out, std::string(run) + " of seed 1")) << outcome.out;
  }
  EXPECT_NE(words_of(drawn({"--runs", "3"})).find("x1"), std::string::npos);
  EXPECT_EQ(count(words_of(drawn({"--runs", "0:9", "--panels", "x1"})), "run "), 10U);
}

/// It ends after 1e-17 s, and a picture of it has no more points than others.
TEST(Pictures, ARunThatSlidesAtOnceIsDrawn) {
  const Folder folder;
  const Outcome made = simulate(folder, {}, "run.svg",
                                "problem: p\nmethod:\n  plant: {state: {x: {shape: scalar, start: "
                                "0}, v: {shape: scalar, start: 0}}, flow: {x: v, v: 3*sin(t) - "
                                "1.5*sign(v)}}\ncampaign: {horizon: 20}\n");
  EXPECT_TRUE(has(made.out + made.err, "sliding on the switching surface")) << made.err;
  EXPECT_TRUE(has(text_of(folder.path("run.svg")), "</svg>"));
}

TEST(Pictures, AreTheSameBytesTwice) {
  const std::vector<std::string> all = {"--panels", "states,claims", "--phase", "x1,x2",
                                        "--band",   "xh:P",          "--runs",  "1,2"};
  EXPECT_EQ(drawn(all), drawn(all));
}

TEST(Pictures, WrongRequestsSayWhatWasExpected) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--phase", "x1,x3"}, "--phase: no quantity of the run is named 'x3'; did you mean 'x1'?"},
      {{"--phase", "x1,speed"},
       "--phase: no quantity of the run is named 'speed'; known: x1, x2, u, y1, "},
      {{"--phase", "x1"}, "--phase: expected two names, such as x1,x2, not 'x1'"},
      {{"--phase", "x1,"}, "--phase: expected two names"},
      {{"--phase", "x1,x2,u"}, "--phase: expected two names"},
      {{"--phase", "x1,x1"}, "--phase: 'x1' is named twice"},
      {{"--phase", "x,u"}, "--phase: 'x' has several elements; name one, such as x1"},
      {{"--panels", "stats"},
       "--panels: no quantity of the run is named 'stats'; did you mean 'states'?"},
      {{"--panels", "x1,,x2"}, "--panels: expected names such as"},
      {{"--panels", "x1,u,x1"}, "--panels: 'x1' is named twice"},
      {{"--band", "xh"}, "--band: expected an estimate and its covariance, such as xh:P"},
      {{"--band", "xh:Q"}, "--band: no quantity of the run is named 'Q'"},
      {{"--band", "xh:u"}, "--band: 'u' is no covariance of 'xh'"},
      {{"--runs", "1,x"}, "--runs: expected numbers of runs, such as 0,3,17 or 0:9, not '1,x'"},
      {{"--runs", "5:2"}, "--runs: expected numbers of runs"},
      {{"--runs=-1"}, "--runs: expected numbers of runs"},
      {{"--runs", "1,0:2"}, "--runs: run 1 is named twice"},
      {{"--runs", "0:1e9"},
       "--runs: at most 100 runs are drawn over each other: name fewer of them; 'gainsmith verify "
       "--runs N "
       "--compare' has no such limit"},
      {{"--runs", "1", "--judge"}, "--runs draws several runs"}};
  for (const auto& [arguments, message] : wrong) {
    const Folder folder;
    const Outcome outcome = simulate(folder, arguments);
    EXPECT_EQ(outcome.exit, 2) << message;
    EXPECT_TRUE(has(outcome.err, message)) << arguments.front() << "\n" << outcome.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"p.yaml"});
  }
  const Folder folder;
  const Outcome outcome =
      gainsmith({"simulate", folder.file("p.yaml", kOscillator), "--phase", "x1,x2"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.err, "give --plot FILE")) << outcome.err;
}

TEST(Pictures, KeysOfTheProblemAreChecked) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"units: {t: s, x: [m, m/s], u: N}\n", "units: {speed: m/s}\n"},
      {"units: {t: s, x: [m, m/s], u: N}\n", "units: {x: [m, m, m]}\n"},
      {"units: {t: s, x: [m, m/s], u: N}\n", "units: {x: []}\n"},
      {"units: {t: s, x: [m, m/s], u: N}\n", "covariance: {xhh: P}\n"},
      {"units: {t: s, x: [m, m/s], u: N}\n", "covariance: {xh: u}\n"}};
  const std::vector<std::string> messages = {
      ":24:9: units: nothing is named 'speed'", ":24:9: units: x is 2 x 1; expected one unit",
      ":24:9: x: expected a unit",
      ":24:14: covariance: no state or signal is named 'xhh'; did you mean 'xh'?",
      ":24:18: covariance: 'u', 1 x 1, is none of 'xh', 2 x 1"};
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    std::string text = kOscillator;
    text.replace(text.find(wrong[k].first), wrong[k].first.size(), wrong[k].second);
    const Folder folder;
    const Outcome outcome = gainsmith({"check", folder.file("p.yaml", text)});
    EXPECT_EQ(outcome.exit, 2) << wrong[k].second;
    EXPECT_TRUE(has(outcome.err, messages[k])) << outcome.err;
  }
}

TEST(Pictures, UnitsAreInTheJson) {
  const Folder folder;
  const auto document =
      gainsmith({"simulate", folder.file("p.yaml", kOscillator), "--json"}).json();
  EXPECT_EQ(document["units"]["x2"], "m/s");
  EXPECT_EQ(document["units"]["t"], "s");
  EXPECT_FALSE(document["units"].contains("e1"));
}

TEST(Pictures, TheEndingOfTheNameDecides) {
  for (const char* name : {"run.jpg", "run", "run.SVG", "svg"}) {
    const Folder folder;
    const Outcome outcome = simulate(folder, {}, name);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, "expected one that ends with '.svg', '.pdf' or '.png', not"))
        << outcome.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"p.yaml"});
  }
}

/// Another PATH while a test runs.
class OtherPath {
 public:
  explicit OtherPath(const std::string& path) : before_(std::getenv("PATH")) {
    ::setenv("PATH", path.c_str(), 1);
  }
  OtherPath(const OtherPath&) = delete;
  OtherPath& operator=(const OtherPath&) = delete;
  ~OtherPath() { ::setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST(Pictures, WithoutLibrsvgTheMessageNamesIt) {
  const Folder folder;
  const OtherPath path(folder.path("nowhere"));
  for (const char* name : {"run.pdf", "run.png"}) {
    const Outcome outcome = simulate(folder, {}, name);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, "package librsvg2-bin in Debian")) << outcome.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"p.yaml"});
  }
  EXPECT_EQ(simulate(folder, {}).exit, 0);
}

TEST(Pictures, AConverterThatFailsLeavesNothing) {
  const Folder folder;
  const std::string converter = folder.file("rsvg-convert", "#!/bin/sh\nexit 1\n");
  std::filesystem::permissions(converter, std::filesystem::perms::owner_all);
  const OtherPath path(std::filesystem::path(converter).parent_path().string() + ":/bin:/usr/bin");
  const Outcome outcome = simulate(folder, {}, "run.pdf");
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.err, "rsvg-convert could not make this picture")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("run.pdf")));
}

TEST(Pictures, PdfAndPngAreWhatTheirNamesSay) {
  if (std::system("rsvg-convert --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "rsvg-convert (librsvg2-bin) is not installed";
  for (const auto& [name, start] : std::vector<std::pair<std::string, std::string>>{
           {"run.pdf", "%PDF-"}, {"run.png", "\x89PNG\r\n"}}) {
    std::string before;
    for (int time = 0; time < 2; ++time) {
      const Folder folder;
      ASSERT_EQ(simulate(folder, {}, name).exit, 0);
      const std::string bytes = text_of(folder.path(name));
      EXPECT_TRUE(bytes.starts_with(start)) << bytes.substr(0, 8);
      if (time == 1) {
        EXPECT_EQ(bytes, before);
      }
      before = bytes;
    }
  }
}

/// Feasible for k < 2 and, as far as c allows, refused above k = 4.
const std::string kScanned = R"(problem: scanned
method:
  method: scanned
  parameters: {k: {default: 1}, c: {default: 1}}
  assume: {range: k <= 4}
  unknowns: {x: scalar}
  require: {floor: "x > k^2", ceiling: x < 4*c}
  minimize: x
  gains: {K: 2*x}
units: {k: s, K: N/m}
)";

TEST(Pictures, AScanOfOneScalarHasVerdictsAndGaps) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kScanned);
  const Outcome outcome = gainsmith(
      {"scan", file, "--over", "k=0.75:5.25:10", "--show", "K", "--plot", folder.path("scan.svg")});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "k [s]")) << outcome.out;
  const std::string picture = text_of(folder.path("scan.svg"));
  const std::string texts = words_of(picture);
  for (const char* line :
       {"objective", "K [N/m]", "verdict", "feasible", "infeasible", "refused", "k [s]"})
    EXPECT_TRUE(has_line(texts, line)) << line << "\n" << texts;
  // Three feasible points in two panels and in the row of verdicts; four crosses, three rings.
  EXPECT_EQ(count(picture, "l6,6m0-6l-6,6"), 4U);
  EXPECT_EQ(count(picture, "r=\"2.6\""), 9U);
  EXPECT_EQ(count(picture, "r=\"3\""), 3U);
}

TEST(Pictures, AScanOfTwoScalarsIsAMap) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kScanned);
  const std::vector<std::string> scan = {"scan",      file,     "--over",
                                         "k=0.5:5:4", "--over", "c=0.1:10:3:log"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = scan;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gainsmith(arguments);
  };
  ASSERT_EQ(with({"--plot", folder.path("map.svg")}).exit, 0);
  const std::string texts = words_of(text_of(folder.path("map.svg")));
  for (const char* line : {"objective", "k [s]", "c", "infeasible", "refused"})
    EXPECT_TRUE(has_line(texts, line)) << line << "\n" << texts;
  const Outcome three = with({"--over", "x=1:2", "--plot", folder.path("three.svg")});
  EXPECT_EQ(three.exit, 2);
  EXPECT_TRUE(has(three.err, "a picture shows a grid of one scalar or two, not of 3")) << three.err;
  EXPECT_EQ(with({"--plot", folder.path("map.gif")}).exit, 2);
}

TEST(Pictures, ABisectionShowsWhatWasTried) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kScanned);
  const Outcome outcome = gainsmith({"bisect", file, "--largest", "k", "--in", "0.5", "3.5",
                                     "--plot", folder.path("bisect.svg"), "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::string picture = text_of(folder.path("bisect.svg"));
  const std::string texts = words_of(picture);
  for (const char* line : {"k [s]", "feasible", "infeasible", "bracket so far", "value tried",
                           "distance from the largest feasible value"})
    EXPECT_TRUE(has_line(texts, line)) << line << "\n" << texts;
  const auto samples = outcome.json()["samples"];
  std::size_t infeasible = 0;
  for (const auto& sample : samples) infeasible += sample["answer"] == "no" ? 1 : 0;
  // In both panels and in the legend.
  EXPECT_EQ(count(picture, "l6,6m0-6l-6,6"), 2 * infeasible + 1);
}

}  // namespace
}  // namespace gainsmith::tests
