// What `export` writes runs elsewhere: C beside the simulator, Python and MATLAB files where these are; and
// `check` of gain files, edited or not.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// The exit code of a shell command; what it printed is in the file `output`.
int shell(const std::string& command, const std::string& output = "/dev/null") {
  const int status = std::system((command + " > " + output + " 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool is_there(const std::string& program) { return shell("command -v " + program) == 0; }

/// x' = A x with samples of x(1) after 0.1 to 0.2, and an observer for it.
const std::string kOscillator = R"(problem: oscillator
method:
  method: oscillator
  data: {A: n x n, C: p x n}
  unknowns: {P: symmetric n, Y: n x p}
  require: {positive: P > I, decay: "He(P*A - Y*C) + 0.1*P < 0", small: norm(Y) <= 5}
  gains: {lambda: inv(P)*Y}
  events: {sample: {every: [0.1, 0.2]}}
  plant: {state: {x: {shape: n, start: [1, 0]}}, output: {y: C*x}, flow: {x: A*x}}
  observer:
    state: {xh: {shape: n, start: 0}, th: {shape: p, start: 0}}
    flow: {xh: A*xh + lambda*th, th: -th}
    at: {sample: {xh: xh + 0.1*lambda*(y - C*xh), th: y - C*xh}}
data: {A: [[0, 1], [-4, -0.2]], C: [[1, 0]]}
campaign: {horizon: 150}
)";

struct Row {
  double t = 0;
  bool jump = false;
  std::vector<double> state;
  double y = 0;
};

/// The rows of a run of kOscillator.
std::vector<Row> rows_of(const std::string& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    Row row;
    for (const std::string& name : names) {
      cell.clear();
      std::getline(cells, cell, ',');
      if (name == "event") row.jump = !cell.empty();
      if (name == "t") row.t = std::stod(cell);
      if (name == "xh1" || name == "xh2" || name == "th") row.state.push_back(std::stod(cell));
      if (name == "y") row.y = std::stod(cell);
    }
    rows.push_back(row);
  }
  return rows;
}

/// Lines "jump dt y" for a program that follows a run.
std::string steps_of(const std::vector<Row>& rows) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t k = 1; k < rows.size(); ++k)
    text << (rows[k].jump ? 1 : 0) << ' ' << rows[k].t - rows[k - 1].t << ' ' << rows[k].y << '\n';
  return text.str();
}

/// The largest difference of three states a line, relative to the largest state.
double difference(const std::string& output, const std::vector<Row>& rows) {
  std::istringstream numbers(text_of(output));
  double largest = 0, worst = 0;
  for (std::size_t k = 1; k < rows.size(); ++k)
    for (const double expected : rows[k].state) {
      double found = 0;
      if (!(numbers >> found)) return INFINITY;
      largest = std::max(largest, std::abs(expected));
      worst = std::max(worst, std::abs(found - expected));
    }
  return worst / largest;
}

/// A firmware that reads its steps.
std::string follower(const std::string& number) {
  return "#include <stdio.h>\n#include \"observer.h\"\n"
         "int main(void)\n{\n  observer_state s;\n  int jump;\n  double dt, y;\n  "
         "observer_start(&s);\n"
         "  while (scanf(\"%d %lf %lf\", &jump, &dt, &y) == 3) {\n"
         "    if (jump) observer_jump(&s, (" +
         number + ")y);\n    else observer_flow(&s, (" + number +
         ")dt);\n"
         "    printf(\"%.17g %.17g %.17g\\n\", (double)s.xh[0], (double)s.xh[1], (double)s.th);\n  "
         "}\n  return 0;\n}\n";
}

class Export : public testing::Test {
 protected:
  /// Synthesizes kOscillator and simulates it with at least 1000 steps.
  void SetUp() override {
    ASSERT_EQ(gainsmith({"synth", folder.file("p.yaml", kOscillator), "-o", gains}).exit, 0);
  }
  std::vector<Row> run() {
    EXPECT_EQ(gainsmith({"simulate", gains, "--step", "0.1", "-o", folder.path("run.csv")}).exit,
              0);
    std::vector<Row> rows = rows_of(folder.path("run.csv"));
    EXPECT_GT(rows.size(), 1000U);
    folder.file("steps", steps_of(rows));
    return rows;
  }
  /// Compiles main.c beside the header and follows the steps.
  void run_c(const std::string& number) {
    folder.file("main.c", follower(number));
    ASSERT_EQ(shell("gcc -std=c99 -O1 -Wall -Wextra -Wconversion -Wpedantic -Werror " +
                        folder.path("main.c") + " -o " + folder.path("follower") + " -lm",
                    folder.path("compiled")),
              0)
        << text_of(folder.path("compiled")) << text_of(folder.path("observer.h"));
    ASSERT_EQ(shell(folder.path("follower") + " < " + folder.path("steps"), folder.path("output")),
              0);
  }

  const Folder folder;
  const std::string gains = folder.path("gains.json");
};

TEST_F(Export, TheCodeInCIsTheSimulatorToRounding) {
  if (!is_there("gcc")) GTEST_SKIP() << "there is no gcc";
  const auto rows = run();
  const Outcome outcome =
      gainsmith({"export", gains, "--to", "c", "-o", folder.path("observer.h")});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  run_c("double");
  EXPECT_LE(difference(folder.path("output"), rows), 1e-12);
}

TEST_F(Export, SinglePrecisionIsShownAndRuns) {
  if (!is_there("gcc")) GTEST_SKIP() << "there is no gcc";
  const auto rows = run();
  const Outcome outcome =
      gainsmith({"export", gains, "--to", "c", "--float", "-o", folder.path("observer.h")});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(text_of(folder.path("observer.h")), "static const float observer_lambda[2]"));
  run_c("float");
  const double found = difference(folder.path("output"), rows);
  EXPECT_LE(found, 1e-4);
  EXPECT_GT(found, 1e-12) << "that was no single precision";
}

TEST_F(Export, PythonLoadsWhatIsWrittenForIt) {
  if (shell("python3 -c 'import numpy'") != 0) GTEST_SKIP() << "Python has no numpy";
  const auto rows = run();
  ASSERT_EQ(gainsmith({"export", gains, "--to", "python", "-o", folder.path("observer.py")}).exit,
            0);
  folder.file("main.py",
              "import sys\nimport observer\no = observer.Observer()\nassert observer.lambda_.shape "
              "== (2, 1)\n"
              "for line in sys.stdin:\n    jump, dt, y = map(float, line.split())\n"
              "    if jump:\n        o.jump(y)\n    else:\n        o.flow(dt)\n"
              "    print(repr(float(o.xh[0])), repr(float(o.xh[1])), repr(float(o.th)))\n");
  ASSERT_EQ(shell("python3 -B " + folder.path("main.py") + " < " + folder.path("steps"),
                  folder.path("output")),
            0)
      << text_of(folder.path("output"));
  EXPECT_LE(difference(folder.path("output"), rows), 1e-12);
}

TEST_F(Export, OctaveLoadsWhatIsWrittenForMatlab) {
  if (!is_there("octave")) GTEST_SKIP() << "there is no octave";
  ASSERT_EQ(gainsmith({"export", gains, "--to", "matlab", "-o", folder.path("motor.m")}).exit, 0);
  ASSERT_EQ(gainsmith({"export", gains, "--to", "mat", "-o", folder.path("motor.mat")}).exit, 0);
  const auto json = nlohmann::json::parse(text_of(gains));
  const double first = json["gains"]["lambda"][0][0].get<double>();
  std::ostringstream code;
  code.precision(17);
  // After 0.3 x' = A x + lambda th, th' = -th from th = 1, against expm of the whole.
  code << "cd " << folder.path("")
       << "; s = motor(); m = load('motor.mat'); assert(s.lambda, m.lambda);"
       << "assert(m.lambda(1), " << first << "); x = s.observer.jump(s.observer.start, 1);"
       << "assert(x.th, 1); assert(x.xh, 0.1*m.lambda); x = s.observer.flow(x, 0.3);"
       << "M = [0, 1, m.lambda(1); -4, -0.2, m.lambda(2); 0, 0, -1];"
       << "assert([x.xh; x.th], expm(0.3*M)*[0.1*m.lambda; 1], 1e-14); r = s.observer.rate(x);"
       << "assert([r.xh; r.th], M*[x.xh; x.th], 1e-14)";
  EXPECT_EQ(shell("octave-cli --no-init-file --eval \"" + code.str() + "\"", folder.path("output")),
            0)
      << text_of(folder.path("output"));
}

TEST_F(Export, TextsHoldTheGains) {
  const Outcome json = gainsmith({"export", gains, "--to", "json"});
  EXPECT_EQ(json.json()["gains"]["lambda"].size(), 2U);
  EXPECT_EQ(json.json()["gains"]["lambda"],
            nlohmann::ordered_json::parse(text_of(gains))["gains"]["lambda"]);
  EXPECT_EQ(gainsmith({"export", gains, "--to", "csv", "-o", folder.path("k.csv")}).exit, 0);
  const std::string csv = text_of(folder.path("k-lambda.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
}

TEST_F(Export, LatexIsAnEquation) {
  const Outcome latex = gainsmith({"export", gains, "--to", "latex"});
  EXPECT_TRUE(has(latex.out, "\\begin{bmatrix}")) << latex.out;
  if (!is_there("pdflatex")) GTEST_SKIP() << "there is no pdflatex";
  folder.file("gains.tex", "\\documentclass{article}\\usepackage{amsmath}\\begin{document}\n" +
                               latex.out + "\\end{document}\n");
  EXPECT_EQ(
      shell("cd " + folder.path("") + " && pdflatex -halt-on-error gains.tex", folder.path("tex")),
      0)
      << text_of(folder.path("tex"));
}

/// Names that mean something in one of the languages, and every kind of operation.
const std::string kWords = R"yaml(problem: words */ of languages
method:
  method: words
  data: {A: n x n, C: p x n, elif: n x p}
  gains: {while_: elif}
  events: {sample: {every: [0.1, 0.2]}, other: {every: 0.3}}
  inputs: {i: cos(t)}
  plant: {state: {x: {shape: n, start: [1, 0]}}, output: {int: C*x, step: "C*x*2"}, flow: {x: A*x}}
  observers:
    state:
      state: {float: {shape: n, start: 0}, lambda: {shape: scalar, start: 1}, M: {shape: 2 x 2, start: 0}}
      flow: {float: "A*float + [0; i]", lambda: "mod(lambda, 2) + sign(int) + min(lambda, float(1))*max(lambda, 0) + atan2(lambda, 1) + abs(lambda)^1.5"}
      at: {sample: {float: float + while_*(int - C*float), M: "inv(M + eye(2))"}, other: {lambda: "where(lambda > step, floor(lambda), tanh(lambda))"}}
      output: {def: 2*float(1), class: "M*float"}
    rate: {state: {z: {shape: n, start: 0}}, flow: {z: A*z + while_*(int - C*z)}}
data: {A: [[0, 1], [-4, -0.2]], C: [[1, 0]], elif: [[0.5], [0.2]]}
campaign: {horizon: 5}
)yaml";

TEST(ExportNames, WordsOfALanguageAreNoNamesInIt) {
  if (!is_there("gcc")) GTEST_SKIP() << "there is no gcc";
  const Folder folder;
  const std::string gains = folder.path("g.json");
  ASSERT_EQ(gainsmith({"synth", folder.file("p.yaml", kWords), "-o", gains}).exit, 0);
  ASSERT_EQ(gainsmith({"export", gains, "--to", "c", "-o", folder.path("w.h")}).exit, 0);
  // 1 mod 2 + sign(0.1) + 0 + atan2(1, 1) + 1 at the start; the inverse of I after a sample.
  folder.file(
      "w.c",
      "#include <stdio.h>\n#include \"w.h\"\nint main(void)\n{\n"
      "  w_state__state s, r;\n  w_state__start(&s);\n  w_state__rate(&s, 0.5, 0.1, &r);\n"
      "  w_state__jump_sample(&s, 1.0);\n"
      "  printf(\"%.12f %.12f %.1f %.1f\\n\", r.lambda, r.float_[1], s.M[0][0], s.float_[0]);\n"
      "  return 0;\n}\n");
  ASSERT_EQ(shell("gcc -std=c99 -Wall -Wextra -Wconversion -Wpedantic -Werror " +
                      folder.path("w.c") + " -o " + folder.path("w") + " -lm",
                  folder.path("compiled")),
            0)
      << text_of(folder.path("compiled"));
  ASSERT_EQ(shell(folder.path("w"), folder.path("output")), 0);
  EXPECT_EQ(text_of(folder.path("output")), "3.785398163397 0.500000000000 1.0 0.5\n");
}

/// The file with another number in the place of the first gain.
std::string edited(const std::string& gains, const std::string& number) {
  auto document = nlohmann::ordered_json::parse(text_of(gains));
  document["gains"]["lambda"][0][0] = std::stod(number);
  return document.dump(1);
}

TEST_F(Export, CheckProvesTheGainsOfTheFile) {
  const Outcome fresh = gainsmith({"check", gains});
  EXPECT_EQ(fresh.exit, 0) << fresh.err;
  EXPECT_TRUE(
      has(fresh.out,
          "every inequality holds at the gains of the file, shown with the unknowns of the file"))
      << fresh.out;
  const Outcome better = gainsmith({"check", folder.file("edited.json", edited(gains, "0.3"))});
  EXPECT_EQ(better.exit, 0) << better.out;
  EXPECT_TRUE(has(better.out, "edited      lambda")) << better.out;
  const Outcome worse =
      gainsmith({"check", folder.file("edited.json", edited(gains, "-0.3")), "--json"});
  EXPECT_EQ(worse.exit, 1);
  EXPECT_EQ(worse.json()[0]["verdict"], "no");
  EXPECT_EQ(worse.json()[0]["edited"][0], "lambda");
}

/// x > 1e-9 above 2/3: what single precision rounds away.
TEST(ExportFloat, GainsThatDoNotHoldThereAreRefused) {
  const Folder folder;
  const std::string problem =
      folder.file("p.yaml",
                  "problem: close\nmethod:\n  method: close\n  unknowns: {x: scalar}\n"
                  "  require: {low: 3*x > 2 + 1e-10, high: 3*x < 2 + 2e-10}\n  gains: {K: x}\n");
  const std::string gains = folder.path("g.json");
  ASSERT_EQ(gainsmith({"synth", problem, "-o", gains}).exit, 0);
  EXPECT_EQ(gainsmith({"export", gains, "--to", "c"}).exit, 0);
  const Outcome outcome =
      gainsmith({"export", gains, "--to", "c", "--float", "-o", folder.path("k.h")});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(has(outcome.err, "at single precision the inequalities do not hold: "))
      << outcome.err;
  EXPECT_TRUE(has(outcome.err, "high") || has(outcome.err, "low")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "ask for less, or export without --float")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("k.h")));
}

/// The least norm leaves no margin. The command that the program prints gives gains that it exports.
TEST(ExportFloat, TheCommandThatIsPrintedWorks) {
  const Folder folder;
  for (const std::string design : {"output-feedback", "discrete-output-feedback", "observer"}) {
    const std::string gains = folder.path(design + ".json");
    ASSERT_EQ(gainsmith({"synth", problem("designs/" + design + ".yaml"), "-o", gains}).exit, 0);
    const Outcome refused = gainsmith({"export", gains, "--to", "c", "--float"});
    EXPECT_NE(refused.exit, 0) << design;
    EXPECT_TRUE(has(refused.err, design == "observer" ? ": decay; nothing" : ": norm; nothing"))
        << refused.err;
    const std::size_t command = refused.err.find("\n  gainsmith synth ");
    ASSERT_NE(command, std::string::npos) << refused.err;
    const std::string line = refused.err.substr(command + 3, refused.err.rfind('\n') - command - 3);
    const std::string rest = line.substr(line.find(' '));
    EXPECT_TRUE(has(rest, " --set margin=")) << rest;
    EXPECT_EQ(shell("cd " + problem("designs") + " && " + program() + rest), 0) << rest;
    EXPECT_EQ(gainsmith({"export", gains, "--to", "c", "--float"}).exit, 0) << rest;
  }
}

TEST_F(Export, WrongInputIsNamed) {
  const auto fails = [&](const std::vector<std::string>& arguments, const std::string& words) {
    const Outcome outcome = gainsmith(arguments);
    EXPECT_EQ(outcome.exit, 2) << outcome.out;
    EXPECT_TRUE(has(outcome.err, words)) << outcome.err;
  };
  fails({"export", folder.path("p.yaml"), "--to", "c"}, "this is no gain file");
  fails({"export", gains, "--to", "pyhton"}, "did you mean 'python'?");
  fails({"export", gains, "--to", "mat"}, "a MAT-file is no text");
  fails({"export", gains, "--to", "csv"}, "each matrix has a file of its own");
  fails({"export", gains, "--to", "matlab", "-o", folder.path("my-gains.m")},
        "'my-gains' cannot be one");
  fails({"export", gains, "--to", "c", "-o", gains}, "this is the input file");
  fails({"export", gains, "--to", "c", "-o", "/proc/none/x.h"}, "/proc/none");
  std::string later = text_of(gains);
  const std::string key = "\"gainsmith\": \"";
  const std::size_t at = later.find(key) + key.size();
  later.replace(at, later.find('"', at) - at, "99.0.0");
  fails({"export", folder.file("later.json", later), "--to", "c"},
        "gainsmith 99.0.0 wrote this file");
  EXPECT_FALSE(std::filesystem::exists(folder.path("my-gains.m")));
}

TEST_F(Export, TheSameFileGivesTheSameBytes) {
  for (const std::string target : {"c", "matlab", "python", "json", "latex"})
    EXPECT_EQ(gainsmith({"export", gains, "--to", target}).out,
              gainsmith({"export", gains, "--to", target}).out);
}

}  // namespace
}  // namespace gainsmith::tests
