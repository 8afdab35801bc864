// What is exported of a design, and the files that hold matrices alone.
#include "export/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "bind/stated.h"
#include "export/shared_text.h"
#include "support/yaml_problem.h"

namespace gainsmith::exports {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// An observer with samples, and one that reads the output all the time; the gains are data.
std::string problem(const std::string& events, const std::string& observers) {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n, C: p x n, K: n x p}\n  gains: {K: "
         "K}\n"
         "  events: {sample: " +
         events +
         "}\n  inputs: {u: cos(t)}\n"
         "  plant: {state: {x: {shape: n, start: [1, 0]}}, output: {y: C*x}, flow: {x: A*x}}\n" +
         observers +
         "data: {A: [[0, 1], [-4, -0.2]], C: [[1, 0]], K: [[0.5], [0.2]]}\n"
         "campaign: {horizon: 5}\n";
}

const std::string kSampled =
    "  observer: {state: {xh: {shape: n, start: [3, 0]}}, flow: {xh: A*xh},"
    " at: {sample: {xh: xh + K*(y - C*xh)}}, output: {out: 2*xh(1)}}\n";

Content content(const std::string& text) {
  const tests::YamlProblem yaml(text);
  model::Gains gains;
  gains.problem_name = "p";
  gains.gains = {{"K", numbers::Matrix{{0.5}, {0.2}}}};
  const model::Stated stated = bind::state(yaml.instance, gains);
  Units units;
  for (const model::UnitText& one : yaml.problem->units) units[one.name] = one.units;
  return content_of(gains, *yaml.instance.design, stated,
                    model::run_texts(*yaml.instance.design, stated), "file", units);
}

TEST(ExportContent, MeasurementsAreInputs) {
  const Content made = content(problem("{every: [0.1, 0.2]}", kSampled));
  ASSERT_EQ(made.observers.size(), 1U);
  const Observer& observer = made.observers[0];
  ASSERT_EQ(observer.states.size(), 1U);
  EXPECT_EQ(observer.states[0].name, "xh");
  EXPECT_EQ(observer.states[0].start, (numbers::Matrix{{3}, {0}}));
  ASSERT_EQ(observer.inputs.size(), 1U);
  EXPECT_EQ(observer.inputs[0].name, "y");
  ASSERT_EQ(observer.jumps.size(), 1U);
  EXPECT_EQ(observer.jumps[0].event, "sample");
  EXPECT_FALSE(observer.jumps[0].period);
  ASSERT_EQ(observer.outputs.size(), 1U);
  EXPECT_EQ(observer.outputs[0].name, "out");
  EXPECT_TRUE(made.notes.empty());
}

TEST(ExportContent, WhatHasNoElementsIsNoInput) {
  const std::string text = problem(
      "{every: 0.1}",
      "  observer: {state: {xh: {shape: n, start: 0}}, at: {sample: {xh: \"xh + K*(y - C*xh) + "
      "zeros(2, 0)*none\"}}}\n");
  const std::string output = "output: {y: C*x}";
  Content made = content(std::string(text).replace(text.find(output), output.size(),
                                                   "output: {y: C*x, none: \"zeros(0, 2)*x\"}"));
  ASSERT_EQ(made.observers[0].inputs.size(), 1U);
  EXPECT_TRUE(has(c_file(made, "m"), "void m_jump(m_state *state, double y)"));
}

TEST(ExportContent, AnAffineFlowHasItsMatrix) {
  const Content made = content(problem("{every: 0.1}", kSampled));
  ASSERT_TRUE(made.observers[0].linear);
  EXPECT_EQ(made.observers[0].linear->M, (numbers::Matrix{{0, 1}, {-4, -0.2}}));
  EXPECT_EQ(made.observers[0].jumps[0].period, 0.1);
  const Content held = content(problem("{every: 0.1}",
                                       "  observer: {state: {xh: {shape: n, start: 0}}, flow: {xh: "
                                       "\"A*xh + K*(y - C*xh) + [0; u]\"}}\n"));
  ASSERT_TRUE(held.observers[0].linear);
  EXPECT_EQ(held.observers[0].linear->M, (numbers::Matrix{{-0.5, 1}, {-4.2, -0.2}}));
  EXPECT_EQ(held.observers[0].inputs.size(), 2U);
}

TEST(ExportContent, OthersHaveNone) {
  for (const std::string flow : {"A*xh + [0; sin(xh(1))]", "A*xh*t", "A*xh*y", "A*xh + [t; 0]"})
    EXPECT_FALSE(content(problem("{every: 0.1}",
                                 "  observer: {state: {xh: {shape: n, start: 0}}, flow: {xh: \"" +
                                     flow + "\"}}\n"))
                     .observers[0]
                     .linear)
        << flow;
}

TEST(ExportContent, LoopsAreLeftOutAndSaid) {
  const Content made =
      content(problem("{every: 0.1}",
                      "  observer: {state: {xh: {shape: n, start: 0}}, at: {sample: {repeat: {xh: "
                      "xh/2}, until: norm(xh) < 1, at_most: 9}}}\n"));
  EXPECT_TRUE(made.observers[0].jumps.empty());
  ASSERT_EQ(made.notes.size(), 1U);
  EXPECT_TRUE(has(made.notes[0], "loop")) << made.notes[0];
}

/// Texts of strangers stay in the comments that they are in.
TEST(ExportFiles, HostileTextsStayInTheirComments) {
  EXPECT_EQ(comment_text("a\nb\tc\x1b"), "a b c/x1b");
  EXPECT_EQ(comment_text("*/*/ /*\"\\"), "* / * / / *'/");
  EXPECT_EQ(comment_text("coding: utf-7, fileencoding=x, recoded"),
            "coding : utf-7, fileencoding =x, recoded");
  const std::string evil = "EVIL";
  /// What is left of a text without comments to the ends of lines.
  const auto without = [](const std::string& text, const std::string& sign) {
    std::string rest;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find_first_of("\n\r\v\f", at), text.size() - 1) + 1;
      const std::string line = text.substr(at, end - at);
      rest += line.substr(0, line.find(sign)) + "\n";
      at = end;
    }
    return rest;
  };
  for (const std::string begin :
       {"\n", "\r", "\r\n", "\v", "\f", "\xc2\x85", "\xe2\x80\xa8", "*/", "%}", "%{\n", "\"\"\"",
        "\\", "\\end{verbatim}", "^^M", "</script>", "*\\\n/", "*?\?/\n/"}) {
    SCOPED_TRACE(begin);
    const std::string hostile = "x" + begin + evil;
    Content made = content(problem("{every: 0.1}", kSampled));
    made.problem = made.method = hostile;
    made.notes = {hostile};
    model::Margin margin;
    margin.name = margin.worst_point = hostile;
    made.margins = {margin};
    const std::vector<GainMatrix> matrices = made.gains;
    std::string c = c_file(made, "m");
    for (std::size_t at; (at = c.find("/*")) != std::string::npos;)
      c.erase(at, c.find("*/", at + 2) + 2 - at);
    EXPECT_FALSE(has(c, evil)) << c;
    EXPECT_FALSE(has(without(matlab_file(made, "m"), "%"), evil));
    EXPECT_FALSE(has(without(python_file(made, "m"), "#"), evil));
    EXPECT_FALSE(has(without(latex_file(made, matrices), "%"), evil));
  }
}

/// Units stand in the comments and texts of each map.
TEST(ExportFiles, HostileUnitsStayInTheirComments) {
  for (const std::string unit : {R"(V*/ EVIL /*)", R"(V\"\"\" EVIL)", R"(V\nEVIL)", R"(V\\)"}) {
    SCOPED_TRACE(unit);
    std::string text = problem("{every: 0.1}", kSampled) + "units: {";
    for (const char* name : {"xh: ", "y: ", "out: ", "t: "}) text += name + ("\"" + unit + "\", ");
    Content made = content(text + "}\n");
    std::string c = c_file(made, "m");
    ASSERT_TRUE(has(c, "/* V"));
    for (std::size_t at; (at = c.find("/*")) != std::string::npos;)
      c.erase(at, c.find("*/", at + 2) + 2 - at);
    EXPECT_FALSE(has(c, "EVIL")) << c;
    for (const std::string& file : {python_file(made, "m"), matlab_file(made, "m")}) {
      EXPECT_FALSE(has(file, "\nEVIL"));
      EXPECT_FALSE(has(file, "V\"\"\""));
    }
  }
}

TEST(ExportFiles, AHeaderHasGainsAndMaps) {
  Content made = content(problem("{every: 0.1}", kSampled));
  const std::string text = c_file(made, "motor");
  for (const std::string part : {"static const double motor_K[2] = {0.5, 0.2};", "} motor_state;",
                                 "void motor_rate(const motor_state *state, motor_state *rate)",
                                 "void motor_flow(motor_state *state, double dt)",
                                 "void motor_flow_period(motor_state *state)",
                                 "void motor_jump(motor_state *state, double y)",
                                 "double motor_out(const motor_state *state)", "y - state->xh[0];",
                                 "state->xh[0] + motor_K[0]*"})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
}

TEST(ExportFiles, TheLibraryIsIncludedWhereItIsUsed) {
  Content without = content(problem("{every: 0.1}", kSampled));
  EXPECT_FALSE(has(c_file(without, "m"), "#include"));
  Content with =
      content(problem("{every: 0.1}",
                      "  observer: {state: {xh: {shape: n, start: 0}}, at: {sample: {xh: "
                      "xh + K*sin(y)}}}\n"));
  EXPECT_TRUE(has(c_file(with, "m"), "#include <math.h>\n"));
}

TEST(ExportFiles, NamesOfTheProblemEndNoComment) {
  Content made = content(problem("{every: 0.1}", kSampled));
  made.problem = "a */ b /* c";
  const std::string text = c_file(made, "m");
  EXPECT_TRUE(has(text, "a * / b / * c")) << text.substr(0, 200);
}

TEST(ExportFiles, AHeldInputIsAParameter) {
  Content made = content(problem("{every: 0.1}",
                                 "  observer: {state: {xh: {shape: n, start: 0}}, flow: {xh: "
                                 "\"A*xh + K*(y - C*xh) + [0; u]\"}}\n"));
  EXPECT_TRUE(has(c_file(made, "m"), "void m_flow(m_state *state, double u, double y, double dt)"));
}

/// x' = -x + c from 2: 2 exp(-T) + c (1 - exp(-T)).
TEST(ExportFiles, StepMatricesSolveTheFlow) {
  const auto [Phi, Psi] = step_matrices(numbers::Matrix{{-1}}, 0.3);
  EXPECT_NEAR(Phi(0, 0), std::exp(-0.3), 1e-15);
  EXPECT_NEAR(Psi(0, 0), 1 - std::exp(-0.3), 1e-15);
}

const std::string kUnits = "units: {t: s, x: [rad, rad/s], y: rad, out: \"V*/A\"}\n";

TEST(ExportFiles, UnitsStandBesideTheirNames) {
  Content made = content(problem("{every: 0.1}", kSampled) + kUnits);
  EXPECT_EQ(made.observers[0].states[0].unit, "rad, rad/s") << "of x, which xh estimates";
  EXPECT_EQ(made.observers[0].inputs[0].unit, "rad");
  EXPECT_EQ(made.time_unit, "s");
  const std::string c = c_file(made, "m");
  for (const char* words :
       {"  double xh[2]; /* rad, rad/s */\n", "dt [s]. */\nstatic inline void m_flow(",
        "one sample to the next, 0.1 s later. */", "the event sample. Units: y [rad]. */",
        "/* out [V* /A] */"})
    EXPECT_TRUE(has(c, words)) << words << "\n" << c;
  const std::string matlab = matlab_file(made, "m");
  for (const char* words :
       {"[3; 0]);  % xh [rad, rad/s]\n", "the event sample. Units: y [rad].\n", "% out [V* /A]\n"})
    EXPECT_TRUE(has(matlab, words)) << words << "\n" << matlab;
  const std::string python = python_file(made, "m");
  for (const char* words :
       {"dtype=float)  # rad, rad/s\n", "        # Units: y [rad].\n", "        # Units: V* /A\n"})
    EXPECT_TRUE(has(python, words)) << words << "\n" << python;
}

TEST(ExportFiles, UnitsOfAnotherShapeAreOfSomethingElse) {
  const std::string observer =
      "  observer: {state: {xh: {shape: scalar, start: 3}}, at: {sample: {xh: y}}}\n";
  const Content made = content(problem("{every: 0.1}", observer) + kUnits.substr(0, 30) + "}\n");
  EXPECT_EQ(made.observers[0].states[0].unit, "");
}

TEST(ExportFiles, AMapThatIsLeftOutSaysWhatFollows) {
  const std::string consequence =
      "; so the exported observer does not do at that event what the simulated one does, and the "
      "claims that were verified do not cover it";
  for (const char* map : {"xh + svd(xh)(1)*K", "xh + expm(A + xh*xh')*K*y"}) {
    Content made = content(
        problem("{every: 0.1}", std::string("  observer: {state: {xh: {shape: n, start: 0}}, "
                                            "at: {sample: {xh: \"") +
                                    map + "\"}}}\n"));
    const std::string c = c_file(made, "m");
    ASSERT_EQ(made.notes.size(), 1U);
    EXPECT_TRUE(has(made.notes[0], "the map at sample is left out")) << made.notes[0];
    EXPECT_TRUE(made.notes[0].ends_with(consequence)) << made.notes[0];
    EXPECT_TRUE(has(c, consequence)) << c;
  }
}

TEST(ExportFiles, LatexHasBracketsAndPowers) {
  const std::string text = latex_file({}, {{"K", numbers::Matrix{{1, -2.5e-7}, {3, 1.23456789}}},
                                           {"Ldno_1", numbers::Matrix{{2}}}});
  EXPECT_TRUE(
      has(text, "K = \\begin{bmatrix}\n    1 & -2.5 \\times 10^{-7} \\\\\n    3 & 1.23457\n"))
      << text;
  EXPECT_TRUE(has(text, "\\mathit{Ldno}_{1} = 2")) << text;
  EXPECT_TRUE(has(text, "% The numbers are rounded to 6 digits.")) << text;
  EXPECT_FALSE(has(text, "MaxMatrixCols"));
  EXPECT_TRUE(has(latex_file({}, {{"K", numbers::Matrix::Zero(1, 11)}}), "{MaxMatrixCols}{11}"));
}

TEST(ExportFiles, AMatFileIsLaidOutAsItsFormatSays) {
  const std::string bytes = mat_file({{"L", numbers::Matrix{{1, 2}, {3, 4.5}}}});
  const auto whole = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const auto number = [&](std::size_t at) {
    double value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  EXPECT_EQ(bytes.substr(126, 2), "IM");
  EXPECT_EQ(whole(128), 14U);                  // a matrix
  EXPECT_EQ(whole(132), bytes.size() - 136U);  // of as many bytes as follow
  EXPECT_EQ(whole(144), 6U);                   // of doubles
  EXPECT_EQ(whole(160), 2U);
  EXPECT_EQ(whole(164), 2U);
  EXPECT_EQ(bytes[176], 'L');
  EXPECT_EQ(whole(184), 9U);
  EXPECT_EQ(whole(188), 32U);
  EXPECT_EQ(number(192), 1);
  EXPECT_EQ(number(200), 3);  // columns below each other
  EXPECT_EQ(number(216), 4.5);
  EXPECT_EQ(bytes.size(), 224U);
}

TEST(ExportFiles, CsvHasAllDigits) {
  EXPECT_EQ(csv_text(numbers::Matrix{{0.1, 1.0 / 3}, {2, -0.0}}),
            "0.1,0.3333333333333333\n2,-0.0\n");
}

}  // namespace
}  // namespace gainsmith::exports
