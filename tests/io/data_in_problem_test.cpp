// Data that stand in files, and values of the command line: how a problem reads them, and how a
// gain file states them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/file.h"
#include "base/hash.h"
#include "bind/bind.h"
#include "io/folder.h"
#include "io/json/gains_json.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

const std::string kCsvA = "0.2,-1.01\n1,0\n";

class DataFiles : public Folder {
 protected:
  model::Problem read(const std::string& data,
                      const std::vector<model::Setting>& settings = {}) const {
    return parse_problem(
        "problem: p\nmethod: sampled-data-hybrid\ndata:\n" + data + "campaign: {horizon: 10}\n",
        path("p.yaml"), library(), settings);
  }
  numbers::Matrix value(const model::Problem& problem, const std::string& name) const {
    return bind::bind(problem).values.at(name);
  }
  InputError refused(const std::string& data,
                     const std::vector<model::Setting>& settings = {}) const {
    return input_error([&] { bind::bind(read(data, settings)); });
  }
  /// The gain file of a problem, written and read again.
  model::Gains gains_of(const model::Problem& problem) const {
    model::Gains gains;
    gains.version = "0.1.0";
    gains.problem_name = "p";
    gains.statement = bind::bind(problem).design->statement;
    return parse_gains(gains_text(gains), path("gains.json"));
  }
};

const std::string kRest = "  C: [[0.5, -1]]\n  T1: 0.5\n  T2: 0.7\n  QF: I\n";

TEST_F(DataFiles, AreReadBesideTheProblem) {
  write("data/A.csv", kCsvA);
  write("plant.json", "{\"plant\": {\"C\": [0.5, -1]}, \"times\": {\"T1\": 0.5}}");
  const model::Problem problem = read(
      "  A: {csv: data/A.csv}\n  C: {json: plant.json, name: plant.C}\n"
      "  T1: {json: plant.json, name: times.T1}\n  T2: 0.7\n  QF: I\n");
  EXPECT_EQ(value(problem, "A"), (numbers::Matrix{{0.2, -1.01}, {1, 0}}));
  EXPECT_EQ(value(problem, "C"), (numbers::Matrix{{0.5, -1}}));
  EXPECT_EQ(value(problem, "T1"), (numbers::Matrix{{0.5}}));
  ASSERT_EQ(problem.files.size(), 2U);
  EXPECT_EQ(problem.files[0].name, "data/A.csv");
  EXPECT_EQ(problem.files[0].sha256, sha256(kCsvA));
  EXPECT_EQ(problem.files[1].matrices.size(), 2U);
}

TEST_F(DataFiles, StandWhereverAMatrixDoes) {
  write("A.csv", kCsvA);
  write("z.csv", "1\n2\n");
  const model::Problem problem = parse_problem(
      "problem: p\nmethod: sampled-data-hybrid\ndata: {A: {csv: A.csv}, C: [[0.5, -1]], T1: 0.5, "
      "T2: "
      "0.7, QF: I}\ncampaign: {initial: {z: {csv: z.csv}, zh: {box: [{csv: z.csv}, 3]}}}\n",
      path("p.yaml"), library());
  EXPECT_NO_THROW(bind::bind(problem));
  EXPECT_EQ(problem.campaign.initial[0].kind, model::StartKind::expression);
}

TEST_F(DataFiles, AFamilyTakesAListOfFiles) {
  write("A1.csv", kCsvA);
  const model::Problem problem = parse_problem(
      "problem: p\nmethod:\n  data: {A: {shape: n x n, for: i in 1..N}}\n"
      "  report: {last: \"A(N)\"}\ndata: {A: [{csv: A1.csv}, [[1, 2], [3, 4]]]}\n",
      path("p.yaml"), library());
  EXPECT_EQ(value(problem, "A_1"), (numbers::Matrix{{0.2, -1.01}, {1, 0}}));
}

TEST_F(DataFiles, AreRefusedWithTheirPlace) {
  write("A.csv", kCsvA);
  write("B.csv", "1,2\n");
  write("word.csv", "1,2\n3,x\n");
  std::filesystem::create_directories(path("folder"));
  struct Case {
    std::string data;
    int line, column;
    const char* says;
  };
  for (const Case& one :
       {Case{"  A: {csv: a.csv}\n", 4, 12, "a.csv; did you mean 'A.csv'?"},
        Case{"  A: {csv: folder}\n", 4, 12, "is no ordinary file"},
        Case{"  A: {csv: /dev/null}\n", 4, 12, "is no ordinary file"},
        Case{"  A: {csv: A.csv, name: A}\n", 4, 19, "a csv file holds one matrix"},
        Case{"  A: {csv: A.csv, npy: A.npy}\n", 4, 19, "either 'csv' or 'npy', not both"},
        Case{"  A: {csv: A.csv, column: x}\n", 4, 19, "unknown key 'column'"},
        Case{"  A: {csv: [A.csv]}\n", 4, 12, "expected a text, found a list"},
        Case{"  A: {csv: B.csv}\n", 4, 3, "is declared n x n (n = 1); found 1 x 2 in "},
        Case{"  A: {csv: word.csv}\n", 2, 3, "expected a finite decimal number, found 'x'"},
        Case{"  A: {cvs: A.csv}\n", 4, 6, "found a mapping with 'cvs'; did you mean 'csv'?"},
        Case{"  A: {mtx: A.mtx}\n", 4, 6,
             "a matrix of a file as in {csv: FILE}; found a mapping with 'mtx'; known: csv, npy, "
             "mat, json"},
        Case{"  A: {name: A}\n", 4, 6, "found a mapping with 'name'"},
        Case{"  A: {}\n", 4, 6, "found an empty mapping"},
        Case{"  A(1,2): 3\n", 4, 3, "given as a whole, not by its elements: 'A: VALUE'"},
        Case{"  A: A.csv\n", 4, 6, "a matrix of a file is written {csv: A.csv}"}}) {
    const InputError error = refused(one.data + kRest);
    EXPECT_EQ(error.place().line, one.line) << error.what();
    EXPECT_EQ(error.place().column, one.column) << error.what();
    EXPECT_NE(error.message().find(one.says), std::string::npos) << error.what();
  }
}

TEST_F(DataFiles, OfAMethodFileCannotBeNamed) {
  const std::string text = "method: m\nplant: {state: {x: 1}, flow: {x: {csv: A.csv}}}\n";
  EXPECT_NE(input_error([&] {
              parse_problem("problem: p\nmethod: m\n", path("p.yaml"),
                            {[&](const std::string&) { return text; }, {"m"}});
            })
                .message()
                .find("a file may be named in a problem"),
            std::string::npos);
}

TEST_F(DataFiles, AGainFileStatesThem) {
  write("A.csv", "2e-1,-1.01\n1,0.0\n");
  const model::Gains gains = gains_of(read("  A: {csv: A.csv}\n" + kRest));
  std::filesystem::remove(path("A.csv"));
  const model::Problem stated = stated_problem(gains, path("gains.json"));
  EXPECT_EQ(value(stated, "A"), (numbers::Matrix{{0.2, -1.01}, {1, 0}}));
  // What is made of it states the same.
  EXPECT_EQ(bind::bind(stated).design->statement.hash, gains.statement.hash);
  EXPECT_EQ(gains.statement.files[0].matrices[0].elements[0], "2e-1");
}

TEST_F(DataFiles, AGainFileNoticesAnotherFileBesideIt) {
  write("A.csv", kCsvA);
  const model::Gains gains = gains_of(read("  A: {csv: A.csv}\n" + kRest));
  EXPECT_NO_THROW(stated_problem(gains, path("gains.json")));
  write("A.csv", "0.3,-1.01\n1,0\n");
  const InputError error = input_error([&] { stated_problem(gains, path("gains.json")); });
  EXPECT_NE(error.message().find("A.csv has changed since these gains were made"),
            std::string::npos);
  EXPECT_EQ(error.place().line, 4);
}

TEST_F(DataFiles, AnEditedGainFileIsRefused) {
  write("A.csv", kCsvA);
  model::Gains gains = gains_of(read("  A: {csv: A.csv}\n" + kRest));
  gains.statement.files[0].matrices[0].elements[0] = "0.3";
  EXPECT_NE(
      input_error([&] { parse_gains(gains_text(gains), "g.json"); }).message().find("was edited"),
      std::string::npos);
}

TEST_F(DataFiles, ALogIsHashedToo) {
  write("log.csv", "t,u\n0,1\n1,2\n");
  const std::string text =
      "problem: p\nmethod:\n  plant: {state: {x: {shape: scalar, start: 0}}, flow: {x: u}}\n"
      "  inputs: {u: {csv: log.csv, column: u}}\n";
  const model::Gains gains = gains_of(parse_problem(text, path("p.yaml"), library()));
  ASSERT_EQ(gains.statement.files.size(), 1U);
  EXPECT_EQ(gains.statement.files[0].sha256, sha256("t,u\n0,1\n1,2\n"));
  write("log.csv", "t,u\n0,1\n1,3\n");
  EXPECT_NE(input_error([&] { stated_problem(gains, path("gains.json")); })
                .message()
                .find("has changed since"),
            std::string::npos);
}

// Values of the command line

TEST_F(DataFiles, ASettingTakesThePlaceOfAValue) {
  const std::string data = "  A: [[0.2, -1.01], [1, 0]]\n" + kRest;
  EXPECT_EQ(value(read(data, {{"T2", "0.8"}}), "T2"), (numbers::Matrix{{0.8}}));
  EXPECT_EQ(value(read(data, {{"T2", "2*T1"}}), "T2"), (numbers::Matrix{{1}}));
  EXPECT_EQ(value(read(data, {{"A", "[[1, 2], [3, 4]]"}}), "A"), (numbers::Matrix{{1, 2}, {3, 4}}));
  EXPECT_EQ(value(read(data, {{"A", "[1, 2; 3, 4]"}}), "A"), (numbers::Matrix{{1, 2}, {3, 4}}));
  EXPECT_EQ(value(read(data, {{"delta", "0.05"}}), "delta"), (numbers::Matrix{{0.05}}));
  EXPECT_EQ(value(read(data, {{"QJ", "2*I"}}), "QJ"), (numbers::Matrix{{2, 0}, {0, 2}}));
  write("B.csv", "5,6\n7,8\n");
  EXPECT_EQ(value(read(data, {{"A", "{csv: B.csv}"}}), "A"), (numbers::Matrix{{5, 6}, {7, 8}}));
}

TEST_F(DataFiles, ASettingIsADefinitionOrAFunction) {
  const std::string text =
      "problem: p\nmethod:\n  data: {f: {shape: 1, of: {x: 1}}}\n  let: {k: 2, g(s): s}\n"
      "  report: {a: k*b, c: g(3), d: f(5)}\ndata: {f(x): x}\nlet: {b: 7}\n";
  const auto report = [&](const std::vector<model::Setting>& settings, std::size_t at) {
    const model::Instance instance =
        bind::bind(parse_problem(text, path("p.yaml"), library(), settings));
    return numbers::evaluate(instance.design->report[at].value.program, instance.values)(0, 0);
  };
  EXPECT_EQ(report({}, 0), 14);
  EXPECT_EQ(report({{"b", "5"}}, 0), 10);
  EXPECT_EQ(report({{"k", "3"}}, 0), 21);
  EXPECT_EQ(report({{"g(s)", "s^2"}}, 1), 9);
  EXPECT_EQ(report({{"f(z)", "2*z"}}, 2), 10);
  EXPECT_NE(input_error([&] {
              report({{"b(1)", "5"}}, 0);
            })
                .message()
                .find("a whole value"),
            std::string::npos);
  EXPECT_NE(input_error([&] {
              report({{"k(1)", "5"}}, 0);
            })
                .message()
                .find("a whole value"),
            std::string::npos);
}

TEST_F(DataFiles, ASettingMayBeOneOfTheSynthesis) {
  const std::string data = "  A: [[0.2, -1.01], [1, 0]]\n" + kRest;
  const model::Problem set = read(data, {{"margin", "1e-6"}, {"gain_bound", "{L: 2, F: 3}"}});
  EXPECT_EQ(set.synthesis.margin, 1e-6);
  EXPECT_EQ(set.synthesis.gain_bound, 3);
  EXPECT_EQ(set.synthesis.gain_bounds.size(), 2U);
  EXPECT_TRUE(set.synthesis.gain_bound_stated);
  EXPECT_FALSE(read(data, {{"gain_bound", "none"}}).synthesis.gain_bound);
  EXPECT_EQ(stated_problem(gains_of(set), path("gains.json")).synthesis.margin, 1e-6);
}

TEST_F(DataFiles, ASettingIsRefusedWithItsPlace) {
  const std::string data = "  A: [[0.2, -1.01], [1, 0]]\n" + kRest;
  struct Case {
    std::vector<model::Setting> settings;
    Place place;
    const char* says;
  };
  for (const Case& one :
       {Case{{{"T3", "1"}},
             {"--set T3"},
             "no datum, parameter or definition 'T3'; did you mean 'T1'?"},
        Case{{{"Delta", "1"}}, {"--set Delta"}, "did you mean 'delta'?"},
        Case{{{"T2", "0.5 +"}}, {"--set T2", 1, 6}, ""},
        Case{{{"T2", "Tx"}}, {"--set T2", 1, 1}, "unknown name 'Tx'"},
        Case{{{"T2", " "}}, {"--set T2"}, "there is no value"},
        Case{{{"margin", ""}}, {"--set margin"}, "there is no value"},
        Case{{{"margin", "2"}}, {"--set margin", 1, 1}, "so below 1"},
        Case{{{"gain_bound", "-1"}}, {"--set gain_bound", 1, 1}, "expected a positive number"},
        Case{{{"gain_bond", "1"}}, {"--set gain_bond"}, "did you mean 'gain_bound'?"},
        Case{{{"T2", "[[1, 2]]"}}, {"--set T2", 1, 1}, "is declared scalar; found 1 x 2"},
        Case{{{"C(1)", "[0.5, 0]"}}, {"--set C(1)"}, "a whole value, not an element"},
        Case{{{"A(1,2)", "-1"}}, {"--set A(1,2)"}, "--set 'A=VALUE'"},
        Case{{{"A[1,2]", "-1"}}, {"--set A[1,2]"}, "a whole value"},
        Case{{{"T2(1)", "0.65"}}, {"--set T2(1)"}, "--set 'T2=VALUE'"},
        Case{{{"delta(1)", "0.65"}}, {"--set delta(1)"}, "a whole value"},
        Case{{{"margin(1)", "0.1"}}, {"--set margin(1)"}, "a whole value"},
        Case{{{"horizon", "20"}}, {"--set horizon"}, "set in the problem file; --runs and --seed"},
        Case{{{"campaign.seed", "2"}}, {"--set campaign.seed"}, "'seed' is a key of the campaign"},
        Case{{{"T2", "1"}, {"T2", "2"}}, {"--set T2"}, "given twice"}}) {
    const InputError error = refused(data, one.settings);
    EXPECT_EQ(error.place(), one.place) << error.what();
    EXPECT_NE(error.message().find(one.says), std::string::npos) << error.what();
  }
}

TEST_F(DataFiles, AGainFileStatesSettings) {
  const std::string data = "  A: [[0.2, -1.01], [1, 0]]\n" + kRest;
  const model::Gains gains = gains_of(read(data, {{"T2", "8e-1"}, {"A", "[1, 2; 3, 4]"}}));
  const model::Problem stated = stated_problem(gains, path("gains.json"));
  EXPECT_EQ(value(stated, "T2"), (numbers::Matrix{{0.8}}));
  EXPECT_EQ(value(stated, "A"), (numbers::Matrix{{1, 2}, {3, 4}}));
  EXPECT_EQ(bind::bind(stated).design->statement.hash, gains.statement.hash);
}

// Definitions in data

TEST_F(DataFiles, DataUseTheDefinitionsOfTheProblem) {
  const std::string text =
      "problem: p\nmethod: sampled-data-hybrid\nlet: {w: 0.2, half(s): s/2, B: A*A}\n"
      "data: {A: \"[w, -1.01; 1, 0]\", C: [[0.5, -1]], T1: half(1), T2: 0.7, QF: I + 0*B}\n";
  const model::Problem problem = parse_problem(text, path("p.yaml"), library());
  EXPECT_EQ(value(problem, "A"), (numbers::Matrix{{0.2, -1.01}, {1, 0}}));
  EXPECT_EQ(value(problem, "T1"), (numbers::Matrix{{0.5}}));
  EXPECT_EQ(value(problem, "QF"), (numbers::Matrix{{1, 0}, {0, 1}}));
  // B needs A, which is not there yet.
  const InputError error = input_error([&] {
    bind::bind(
        parse_problem(replaced(text, "\"[w, -1.01; 1, 0]\"", "B"), path("p.yaml"), library()));
  });
  EXPECT_NE(error.message().find("'A'"), std::string::npos) << error.message();
}

}  // namespace
}  // namespace gainsmith::io
