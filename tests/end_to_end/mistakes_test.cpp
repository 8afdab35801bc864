// Mistakes as people make them: each message says where, what was expected, and how to mend it.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

const std::string kDesign = R"(problem: observer
method:
  method: observer
  data: {A: n x n, C: p x n, T: {shape: scalar, default: 1}}
  parameters: {a: {default: 0.5}}
  unknowns: {P: symmetric n, Y: n x p}
  require:
    positive: P > I
    decay: He(P*A - Y*C) < -2*a*P
  minimize: trace(P)
  gains: {L: inv(P)*Y}
data:
  A: [[0, 1], [-2, -1]]
  C: [[1, 0]]
synthesis: {gain_bound: 100}
)";

const std::string kRun = R"yaml(problem: filter
method:
  method: filter
  let:      {f(x): "[x(2); -9.81*sin(x(1)) - 0.1*x(2)]", C: "[1, 0]"}
  events:   {sample: {every: [0.05, 0.2]}}
  noise:    {w: {normal: 0.03, new at: sample}}
  plant:    {state: {x: {shape: 2, start: [1, 0]}}, output: {y: {value: x(1) + w, at: sample}}, flow: {x: f(x)}}
  observer:
    state:  {xh: {shape: 2, start: 0}, P: {shape: symmetric 2, start: I}}
    flow:   {xh: f(xh), P: "He(jacobian(f(xh), xh)*P)"}
    at:     {sample: {let: {K: P*C'/(C*P*C' + 0.001)}, xh: xh + K*(y - C*xh)}}
  signals:  {e: x - xh}
  claims:   {small: {shrinks: norm(e), to: 0.5}}
campaign:   {horizon: 10, runs: 5}
)yaml";

struct Mistake {
  const std::string* base;
  const char* from;
  const char* to;
  int line, column;  ///< 0: of the whole file
  const char* message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.to; }

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreNamedWithTheirCure) {
  const Mistake& mistake = GetParam();
  const Folder folder;
  std::string text = *mistake.base;
  const std::size_t at = text.find(mistake.from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(mistake.from).size(), mistake.to);
  const std::string file = folder.file("p.yaml", text);
  const std::string place = mistake.line == 0 ? file + ": "
                                              : file + ":" + std::to_string(mistake.line) + ":" +
                                                    std::to_string(mistake.column) + ": ";
  const Outcome outcome = gainsmith({"check", file});
  EXPECT_EQ(outcome.exit, 2) << outcome.out;
  EXPECT_EQ(outcome.err.find("gainsmith: " + place), 0U) << outcome.err;
  EXPECT_NE(outcome.err.find(mistake.message), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Designs, Mistakes,
    testing::Values(
        Mistake{&kDesign, "gain_bound", "gainBound", 15, 13, "did you mean 'gain_bound'?"},
        Mistake{&kDesign, "minimize:", "Minimize:", 10, 3, "did you mean 'minimize'?"},
        Mistake{&kDesign, "data:\n  A: [[0, 1], [-2, -1]]", "A: [[0, 1], [-2, -1]]\ndata:", 12, 1,
                "unknown key 'A'; it belongs under 'data'"},
        Mistake{&kDesign, "  C: [[1, 0]]\n", "", 0, 0, "the datum C (p x n)"},
        Mistake{&kDesign, "[[0, 1], [-2, -1]]", "[[0, 1, 2], [-2, -1, 3]]", 13, 3,
                "declared n x n (n = 2); found 2 x 3"},
        Mistake{&kDesign, "[[0, 1], [-2, -1]]", "[[0, 1], [-2]]", 13, 15,
                "this row has 1 element, the first row has 2 elements"},
        Mistake{&kDesign, "[[0, 1], [-2, -1]]", "[0 1; -2 -1]", 13, 7, "must be quoted"},
        Mistake{&kDesign, "[[0, 1], [-2, -1]]", "\"[0 1; -2 -1]\"", 13, 10,
                "a comma is missing between elements"},
        Mistake{&kDesign, "[[0, 1], [-2, -1]]", "[[.nan, 1], [-2, -1]]", 13, 8,
                "a number must be finite"},
        Mistake{&kDesign, "A: n x n", "A: [n, n]", 4, 13, "expected a shape, such as n x p"},
        Mistake{&kDesign, "A: n x n", "A: n*n", 13, 3, "declared n*n x 1"},
        Mistake{&kDesign, "default: 1}}", "default: 5 ms}}", 4, 60, "for 5 ms write 5e-3"},
        Mistake{&kDesign, "positive: P > I", "positive: P = I", 8, 17, "is written =="},
        Mistake{&kDesign, "He(P*A - Y*C)", "A.'*P + P*A", 9, 13, "write ' for the transpose"},
        Mistake{&kDesign, "-2*a*P", "-2a*P", 9, 30, "a product is written 2*a"},
        Mistake{&kDesign, "  minimize: trace(P)", "  minimize: P", 10, 13, "expected 1 x 1"},
        Mistake{&kDesign, "P*A - Y*C", "P*A - P*Y*C", 9, 21, "not affine in the unknowns"},
        Mistake{&kDesign, "P > I", "eig(P) > 1", 8, 15, "for a symmetric matrix write 1*I < P"},
        Mistake{&kDesign, "P > I", "P semidefinite", 8, 17, "; write P > 0"},
        Mistake{&kDesign, "P: symmetric n", "P: \"sdpvar(2, 2)\"", 6, 18,
                "'sdpvar(2, 2)' is no shape; a shape is n x p"},
        Mistake{&kDesign, "trace(P)", "cp.trace(P)", 10, 13,
                "unknown function 'cp.trace': write trace(...)"},
        Mistake{&kDesign, "[[1, 0]]", "[[1], [0]]", 14, 3, "a row is written [1, 2]"},
        Mistake{&kDesign, "P*A - Y*C", "inv(P)*A - Y*C", 9, 15, "by a Schur complement"},
        Mistake{&kDesign, "minimize: trace(P)", "cost: trace(P)", 10, 3, "write minimize: ..."},
        Mistake{&kDesign, "gain_bound: 100", "gain_bound: big", 15, 25,
                "expected a number, found 'big'"},
        Mistake{&kDesign, "    decay:", "    positive: P > 2*I\n    decay:", 9, 5,
                "is given twice; first in line 8"}));

INSTANTIATE_TEST_SUITE_P(
    Runs, Mistakes,
    testing::Values(
        Mistake{&kRun, "runs: 5", "runs: 2.5", 14, 33, "expected a whole number from 1"},
        Mistake{&kRun, "campaign:   {", "campaign {", 14, 9, "a ':' is missing behind a key"},
        Mistake{&kRun, "campaign:", "data: {L: 1}\ncampaign:", 14, 8,
                "no datum 'L'; declare it under 'data' of the method with its shape"},
        Mistake{&kRun, "sin(x(1))", "sin(x1)", 4, 38,
                "unknown name 'x1'; an element of x is written x(1)"},
        Mistake{&kRun, "sin(x(1))", "sin(x(3))", 4, 40, "the index 3 is outside 1:2 in x(3)"},
        Mistake{&kRun, "shrinks: norm(e)", "shrinks: e", 13, 31,
                "expected 1 x 1; the size of a column is norm(e), an element e(1)"},
        Mistake{&kRun, "x: {shape: 2", "x: {size: 2", 7, 25,
                "x: the key 'shape' is missing; unknown here: 'size'"},
        Mistake{&kRun, "horizon: 10", "horizon: -10", 14, 23, "must be positive, not -10"},
        Mistake{&kRun, "flow: {x: f(x)}", "flow: {z: f(x)}", 7, 104,
                "the flow of 'z', which is no state; known: x"},
        Mistake{&kRun, "start: [1, 0]", "start: [1, 0, 0]", 7, 43,
                "[1;0;0] (3 x 1) has the wrong shape: expected 2 x 1"},
        Mistake{&kRun, "start: [1, 0]", "start: \"[1, 0]\"", 7, 44,
                "expected 2 x 1; a column is written [a; b]"},
        Mistake{&kRun, "x(2); -9.81", "x[2]; -9.81", 4, 23, "an element is written x(1, 2)"},
        Mistake{&kRun, "{shrinks: norm(e), to: 0.5}", "{below: norm(e)}", 13, 21,
                "small: the key 'bound' is missing"},
        Mistake{&kRun, "{shrinks: norm(e), to: 0.5}", "norm(e) < 1", 13, 14,
                "the claim 'small': expected {nonincreasing: V}, {below: v, bound: b}"},
        Mistake{&kRun, "{shrinks: norm(e), to: 0.5}", "{below: 1, above: 1, bound: 2}", 13, 14,
                "needs exactly one of nonincreasing, cost, shrinks, below, above; found 2"},
        Mistake{&kRun, "shrinks: norm(e)", "shrinks: norm(err)", 13, 36,
                "unknown name 'err'; known: j, t, w, x, C, f, y"},
        Mistake{&kRun, "to: 0.5", "to: 0.5, tolerance: -1", 13, 60, "expected a positive number"},
        Mistake{&kRun, "{every: [0.05, 0.2]}", "0.1", 5, 14, "expected {when: condition}"},
        Mistake{&kRun, "{normal: 0.03, new at: sample}", "0.03", 6, 14,
                "the noise 'w': expected {normal: deviation}, {uniform: [low, high]}"},
        Mistake{&kRun, "{normal: 0.03,", "{normal: {deviation: 0.03, covariance: 1},", 6, 18,
                "normal: expected a deviation or {covariance: V}"},
        Mistake{&kRun, "{normal: 0.03,", "{normal: {mean: [1, 2], covariance: \"[1, 2]\"},", 6, 54,
                "1 x 2 is no covariance of a column"},
        Mistake{&kRun, "runs: 5", "runs: 5, initial: {x: {normal: {median: 1, deviation: 2}}}", 14,
                59, "unknown key 'median'"},
        Mistake{&kRun, "runs: 5", "runs: 5, initial: {x: {lognormal: [1, 2, 3]}}", 14, 61,
                "the state x is 2 x 1: 3 x 1 does not fit"},
        Mistake{&kRun, "new at", "new_at", 6, 32, "did you mean 'new at'?"},
        Mistake{&kRun, "y - C*xh", "x(1) - C*xh", 11, 68,
                "which the observer does not know: it reads outputs"},
        Mistake{&kRun, "runs: 5", "runs: 5, initial: {z: 0}", 14, 46,
                "there is no state 'z'; known: x"},
        Mistake{&kRun, "sin(x(1))", "sin(x(1), 2)", 4, 34, "'sin' is written sin(x)"},
        Mistake{&kDesign, "decay: He(P*A - Y*C) < -2*a*P", "decay: He(P*A - Y*C) < -2*a*P;", 9, 34,
                "a formula ends without ';'"},
        Mistake{
            &kDesign, "[[0, 1], [-2, -1]]", "[[0, 1], [-2 -1]]", 13, 15,
            "this row has 1 element, the first row has 2 elements; a comma is missing in '-2 -1'"},
        Mistake{&kDesign, "  C: [[1, 0]]", "  C: [[1, 0]]\n  mu(s): s^2", 15, 3,
                "no datum 'mu'; a part of a formula is named under 'let' of the problem"},
        Mistake{&kDesign, "  C: [[1, 0]]", "  C: [[1, 0]]\n  a: 1", 15, 3,
                "no datum 'a'; write it under 'parameters'"},
        Mistake{&kDesign, "synthesis:", "negotiable: {gamma: [0, 1]}\nsynthesis:", 15, 14,
                "no scalar datum or parameter 'gamma'; known: T, a, gain_bound"},
        Mistake{&kDesign, "synthesis:", "uncertain: {T: [0.9, 1.1]}\nsynthesis:", 15, 16,
                "T: expected {box: [low, high]}, {vertices: [values]}, {normal: deviation}"},
        Mistake{&kRun, "campaign:", "expect: {verdict: maybe}\ncampaign:", 14, 19,
                "known: yes, no, undecided"}));

TEST(WrongFiles, ALikeNameIsNamed) {
  const Folder folder;
  const std::string file = folder.file("motor.yaml", kRun);
  for (const char* like : {"motor.yml", "motor"}) {
    const Outcome outcome = gainsmith({"check", folder.path(like)});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.err.find("did you mean '" + file + "'?"), std::string::npos) << outcome.err;
  }
}

TEST(WrongFiles, AreNamedForWhatTheyAre) {
  const Folder folder;
  struct Case {
    std::string text;
    const char* message;
  };
  for (const Case& wrong : std::vector<Case>{
           {"", "the file is empty"},
           {"# nothing\n", "the file is empty"},
           {"- a\n- b\n", ":1:1: problem: expected a mapping 'key: value', found a list"},
           {std::string("\x89PNG\r\n\x1a\n\0", 9), "this is no UTF-8 text"},
           {std::string("a\0b", 3), "this is no text file"},
           {"{\"problem\": \"x\"}", "the key 'method' is missing"},
           {"t,x\n0,1\n", "found 't,x 0,1'"},
           {std::string(1000000, 'x'), "found 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...'"}}) {
    const Outcome outcome = gainsmith({"check", folder.file("p.yaml", wrong.text)});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.err.find(wrong.message), std::string::npos) << outcome.err.substr(0, 500);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  }
}

TEST(WrongCommandLines, AreNamedWithWhatWasExpected) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kRun);
  struct Case {
    std::vector<std::string> arguments;
    const char* message;
  };
  for (const Case& wrong : std::vector<Case>{
           {{"simulate", file, "--step", "-1"},
            "--step: expected a positive time between two points, such as 0.01, not '-1'"},
           {{"simulate", file, "--step", "0"}, "not '0'"},
           {{"simulate", file, "--step", "nan"}, "not 'nan'"},
           {{"simulate", file, "--step", "1e-9"}, "a step of 1e-09 makes 1e+10 points"},
           {{"verify", file, "--runs", "1.5e0"},
            "--runs: expected a whole number from 1 to 1000000000000000, not '1.5e0'"},
           {{"verify", file, "--runs"}, "--runs: a value is missing"},
           {{"verify", file, "--run", "5"}, "did you mean '--runs'?"},
           {{"verify", file, "--seed", "1.5"}, "whole number"},
           {{"simulate", file, "--compare"}, "names nothing to compare"},
           {{"synth", file, folder.path("more.yaml")}, "unexpected argument"},
           {{"verify", folder.path("none.yaml")}, "cannot open this file"},
           {{"verify", folder.path("")}, "this is a folder; expected a file"},
           {{"verify", file, "--plot", "a.svg"},
            "unknown option '--plot'; it is an option of bisect, scan, merge, simulate"},
           {{"simulate", file, "--horizon", "5"}, "'--set NAME=VALUE' changes a value"},
           {{"init", "hinfsyn"}, "did you mean 'output-feedback'?"},
           {{"methods", "h-infinity"}, "'gainsmith methods' lists them by task"},
           {{"bode", file}, "unknown command 'bode'; known: synth"},
           {{"scan", file, "--over", "a=1,2,5"}, "expected NAME=LOW:HIGH, NAME=LOW:HIGH:COUNT"},
           {{"run", file, "-o", file}, "cannot make this folder"}}) {
    const Outcome outcome = gainsmith(wrong.arguments);
    EXPECT_EQ(outcome.exit, 2) << outcome.err;
    const std::string said = outcome.err + outcome.out;
    EXPECT_NE(said.find(wrong.message), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }
  const Outcome runs = gainsmith({"verify", file, "--runs", "1e1", "--json"});
  EXPECT_EQ(runs.json()["runs"], 10);
}

TEST(SilentMistakes, AGainThatNoRunReadsIsNamed) {
  const Folder folder;
  const std::string text =
      "problem: p\nmethod:\n  method: m\n  data: {a: scalar}\n  unknowns: {p: scalar, y: scalar}\n"
      "  require: {positive: p > 1, decay: p*a - y < 0}\n  gains: {L: y/p, K: 2*y/p}\n"
      "  plant: {state: {x: scalar}, flow: {x: a*x}, output: {y1: x}}\n"
      "  observer: {state: {z: scalar}, flow: {z: a*z + L*(y1 - z)}}\n"
      "  claims: {settles: {below: \"abs(x - z)\", bound: 1, after: 9}}\n"
      "data: {a: -1}\ncampaign: {runs: 3, horizon: 10, initial: {x: {box: [-1, 1]}, z: 0}}\n";
  const std::string note =
      "neither the plant nor an observer reads the gain 'K': the runs say nothing of it";
  const Outcome found = gainsmith({"check", folder.file("p.yaml", text)});
  EXPECT_TRUE(has(found.out, note)) << found.out << found.err;
  const Outcome read = gainsmith({"check", folder.file("p.yaml", with(text, "+ L*(", "+ K*("))});
  EXPECT_TRUE(has(read.out, "reads the gain 'L'")) << read.out << read.err;
  EXPECT_FALSE(has(read.out, note)) << read.out;
}

/// A file that says what was perhaps not meant is valid, with a note; --strict refuses it.
TEST(SilentMistakes, AreHeardOf) {
  const Folder folder;
  struct Case {
    const char *from, *to, *note;
  };
  const std::string campaign = "campaign:   {horizon: 10, runs: 5}\n";
  const std::string uncertain = "data: {m: 2}\nuncertain: {m: {box: [1, 3]}}\n" + campaign;
  for (const Case& one : std::vector<Case>{
           {", new at: sample", "",
            "the noise 'w' is drawn once a run, so it is a bias: `new at: sample`"},
           {"w: {normal: 0.03, new at: sample}", "w: {uniform: [-1, 1]}", "drawn once a run"},
           {"new at: sample", "every: 0.5",
            "drawn anew after 0.5, and the event 'sample' reads it after 0.2"},
           {"sample: {every: [0.05, 0.2]}}\n  noise:    {w: {normal: 0.03, new at: sample}}",
            "sample: {every: [0.05, 0.2]}, slow: {every: 1}}\n  noise:    {w: {normal: 0.03, new "
            "at: slow}}",
            "`new at: sample` gives each its own"},
           {"y: {value: x(1) + w, at: sample}",
            "y: {value: x(1) + w, at: sample}, z: {value: x(2) + w, at: sample}",
            "the outputs 'y' and 'z' have the same noise 'w'"},
           {"flow: {x: f(x)}", "flow: {x: \"f(x) + [0; w]\"}", ""},
           {"y: {value: x(1) + w, at: sample}", "y: {value: \"[x(1) + w; w]\", at: sample}",
            "several elements of the output 'y' have the same noise"},
           {"noise:    {w: {normal: 0.03, new at: sample}}",
            "noise:    {w: {normal: 0.03, new at: sample}, d: {normal: 1}}",
            "nothing reads the noise 'd'"},
           {"value: x(1) + w,", "value: x(1),", "nothing reads the noise 'w'"},
           {"noise:    {w: {normal: 0.03, new at: sample}}",
            "inputs: {u: sin(t)}\n  noise:    {w: {normal: 0.03, new at: sample}}",
            "nothing reads the input 'u'"},
           {"P: {shape: symmetric 2, start: I}",
            "P: {shape: symmetric 2, start: I}, bias: {shape: scalar, start: 0}",
            "nothing reads the state 'bias'"},
           {"y: {value: x(1) + w, at: sample}", "y: {value: x(1) + w, at: sample}, z: x(2)",
            "nothing reads the output 'z'"},
           {"C: \"[1, 0]\"}", "C: \"[1, 0]\", twice(z): 2*z}",
            "nothing reads the definition 'twice'"},
           {"sample: {every: [0.05, 0.2]}}",
            "sample: {every: [0.05, 0.2]}, gust: {every: 1, lost: 0.5}}",
            "the event 'gust' may be lost, and no observer has a map there"},
           {"normal: 0.03", "normal: 0", "the noise 'w' is always 0"},
           {"to: 0.5", "to: 5", "the claim 'small' lets a value above 0 grow: `to` is 5"},
           {"method: filter\n  let:", "method: filter\n  parameters: {a: {default: 2}}\n  let:",
            "nothing reads the parameter 'a'"},
           {"{value: x(1) + w, at: sample}", "{value: x + w, at: sample}",
            "several elements of the output 'y' have the same noise"},
           {"xh + K*(y - C*xh)", "xh + K*(C*xh - C*xh)",
            "no observer reads the plant: their estimates do not depend on an output"},
           {"w: {normal: 0.03, new at: sample}}\n  plant:    {state: {x: {shape: 2, start: [1, "
            "0]}}, output: "
            "{y: {value: x(1) + w, at: sample}}",
            "w: {normal: 0.03, new at: sample}, b: {normal: 1}}\n  plant:    {state: {x: {shape: "
            "2, start: [1, "
            "0]}}, output: {y: {value: x(1) + w, at: sample}, z: x(2) + b}",
            "the noise 'b' is drawn once a run, so it is a bias: `every: 0.01`"}}) {
    std::string text = with(kRun, one.from, one.to);
    if (has(one.to, "[x(1) + w; w]") || has(one.to, "value: x + w,"))
      text = with(text, "(y - C*xh)", "(y(1) - C*xh)");
    if (!has(one.note, "nothing reads the output"))
      text = with(text, "{e: x - xh}",
                  has(one.to, " z: ") ? "{e: x - xh, ry: y, rz: z}" : "{e: x - xh, ry: y}");
    const std::string file = folder.file("p.yaml", text);
    const Outcome checked = gainsmith({"check", file});
    const Outcome strict = gainsmith({"check", "--strict", file});
    EXPECT_EQ(checked.exit, 0) << one.to << checked.err;
    EXPECT_TRUE(has(checked.out, one.note)) << one.to << checked.out;
    EXPECT_EQ(strict.exit, *one.note != '\0' ? 2 : 0) << one.to << strict.err;
    EXPECT_TRUE(has(strict.err, one.note)) << strict.err;
    const Outcome verified = gainsmith({"verify", file});
    EXPECT_TRUE(has(verified.out, one.note)) << verified.out;
    EXPECT_EQ(gainsmith({"verify", "--strict", file}).exit == 2, *one.note != '\0') << one.to;
    const Outcome run = gainsmith({"run", file, "-o", folder.path("out")});
    EXPECT_NE(run.exit, 2) << run.out;
    EXPECT_TRUE(has(run.out, one.note)) << run.out;
    EXPECT_EQ(gainsmith({"run", "--strict", file, "-o", folder.path("out")}).exit,
              *one.note != '\0' ? 2 : 0);
  }
  const auto noted = [&](const std::string& flow, const std::string& range) {
    const std::string text =
        with(with(with(kRun, campaign, with(uncertain, "[1, 3]", range)),
                  "method: filter\n  let:", "method: filter\n  data: {m: scalar}\n  let:"),
             "flow: {x: f(x)}", "flow: {x: " + flow + "}");
    return gainsmith({"check", folder.file("p.yaml", text)}).out;
  };
  EXPECT_TRUE(has(noted("f(x)", "[1, 3]"), "uncertain: the plant does not read 'm'"));
  EXPECT_TRUE(has(noted("m*f(x)", "[3, 3]"), "'m' has no range, as low is high"));
  EXPECT_TRUE(has(noted("m*f(x)", "[0.8, 1.2]"), "'m' is 2, outside of its range [0.8, 1.2]"));
  EXPECT_FALSE(has(noted("m*f(x)", "[1, 3]"), "note"));
}

/// What only runs show.
TEST(SilentMistakes, OfRunsAreHeardOf) {
  const Folder folder;
  const auto noted = [&](const std::string& text) {
    const std::string file = folder.file("p.yaml", text);
    EXPECT_EQ(gainsmith({"verify", "--strict", file}).exit, 2);
    return gainsmith({"verify", file}).out;
  };
  const std::string same =
      with(with(kRun, "value: x(1) + w,", "value: x(1),"), "start: 0}, P", "start: [1, 0]}, P");
  EXPECT_TRUE(has(noted(same), "the value of every claim is 0 in these runs"));
  const std::string never =
      with(with(kRun, "events:   {", "events:   {hit: {when: x(1) > 50}, "), "to: 0.5}",
           "to: 0.5}, hits: {below: norm(e), bound: 1, over: hit}");
  EXPECT_TRUE(has(noted(never), "the claim 'hits' is never checked in these runs"));
}

}  // namespace
}  // namespace gainsmith::tests
