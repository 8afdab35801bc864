// Ten and more broken files: exit 2, one message with its place, nothing written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <regex>
#include <set>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

const std::string kGood = "ferrante-seuret-2021/t2-0.70.yaml";

struct Broken {
  const char* name;
  const char* pattern;  ///< replaced in the good problem
  const char* replacement;
  const char* message;  ///< in the error
  int line;             ///< where
  int column;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class BadInput : public ::testing::TestWithParam<Broken> {};

TEST_P(BadInput, IsRefusedWithItsPlace) {
  const Broken& broken = GetParam();
  const std::string good = text_of(problem(kGood));
  const std::string text = std::regex_replace(good, std::regex(broken.pattern), broken.replacement,
                                              std::regex_constants::format_first_only);
  ASSERT_NE(text, good);
  const Folder folder;
  const std::string file = folder.file("broken.yaml", text);
  const std::string place =
      file + ":" + std::to_string(broken.line) + ":" + std::to_string(broken.column) + ":";
  for (const char* command : {"check", "synth"}) {
    std::vector<std::string> arguments = {command, file};
    if (std::string(command) == "synth")
      arguments.insert(arguments.end(), {"-o", folder.path("gains.json")});
    const Outcome outcome = gainsmith(arguments);
    EXPECT_EQ(outcome.exit, 2) << outcome.out;
    EXPECT_NE(outcome.err.find(broken.message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(place), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"broken.yaml"});
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadInput,
    ::testing::Values(
        Broken{"misspelt_key", "parameters:", "paramters:", "did you mean 'parameters'?", 12, 1},
        Broken{"misspelt_datum", "  QF: I", "  QG: I", "did you mean", 10, 3},
        Broken{"misspelt_parameter", "eta:", "eat:", "did you mean 'eta'?", 12, 27},
        Broken{"wrong_shape", "C: \\[\\[0.5, -1\\]\\]", "C: [[0.5, -1, 2]]", "1 x 3", 7, 3},
        Broken{"not_a_number", "\\[1, 0\\]\\]", "[.nan, 0]]", "must be finite", 6, 22},
        Broken{"asymmetric", "QF: I", "QF: [[1, 2], [0, 1]]", "must be symmetric", 10, 17},
        Broken{"crossed_interval", "T1: 0.5", "T1: 0.9", "expected 0 < T1 <= T2", 9, 3},
        Broken{"unknown_method", "method: sampled-data-hybrid", "method: sampled-data-hibrid",
               "did you mean 'sampled-data-hybrid'?", 4, 9},
        Broken{"yaml_error", "\\[1, 0\\]\\]", "[1, 0]", "a ']' is missing", 6, 6},
        Broken{"ragged", "\\[1, 0\\]\\]", "[1]]", "1 element, the first row has 2", 6, 21},
        Broken{"unknown_name", "QJ: 0.01\\*I", "QJ: 0.01*J", "unknown name 'J'", 11, 12},
        Broken{"negative", "delta: 0.03", "delta: -1", "expected delta > 0", 12, 14},
        Broken{"bad_law", "  horizon: 100", "  horizon: 100\n  sampling: [unifrm]",
               "did you mean 'uniform'?", 16, 14},
        Broken{"negative_horizon", "horizon: 100", "horizon: -3", "must be positive", 15, 12},
        Broken{"law_outside", "  horizon: 100", "  horizon: 100\n  sampling: [{constant: 5}]",
               "outside [0.5, 0.7]", 16, 25},
        Broken{"reversed_box", "box: \\[-10, 10\\]", "box: [10, -10]", "low end above", 17, 20},
        Broken{"decimal_comma", "T1: 0.5", "T1: 0,5", "a decimal is written with a point: 0.5", 8,
               8},
        Broken{"unit", "T1: 0.5", "T1: 500ms", "for 500 ms write 500e-3", 8, 10},
        Broken{"no_comma", "C: \\[\\[0.5, -1\\]\\]", "C: \"[0.5 1]\"", "a comma is missing", 7, 12},
        Broken{"null", "T1: 0.5", "T1: null", "YAML reads null and ~ as nothing", 8, 7},
        Broken{"tab", "  T1: 0.5", "\tT1: 0.5", "no tab in the indentation", 8, 1},
        Broken{"alias", "QJ: 0.01\\*I", "QJ: *I", "begins with '*' must be quoted", 11, 7},
        Broken{"no_state", "zh: 0", "zz: 0", "is no state", 18, 5}),
    [](const ::testing::TestParamInfo<Broken>& broken) { return std::string(broken.param.name); });

TEST(BadInputTest, AnUnknownThatNothingDeterminesIsRefused) {
  const Folder folder;
  const std::string file = folder.file(
      "free.yaml",
      "problem: free\nmethod:\n  method: free\n  unknowns:\n    x: scalar\n    y: scalar\n"
      "  require: {above: x > 1}\n  gains: {L: y}\n");
  for (const char* command : {"check", "synth", "run"}) {
    const Outcome outcome = gainsmith({command, file});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(
        (outcome.out + outcome.err).find("free.yaml:6:5: the unknown y is used by no inequality"),
        std::string::npos)
        << outcome.out << outcome.err;
  }
}

TEST(BadInputTest, MissingEmptyAndUnreadableFiles) {
  const Folder folder;
  std::filesystem::create_directory(folder.path("folder"));
  for (const std::string& file :
       {folder.path("missing.yaml"), folder.file("empty.yaml", ""), folder.path("folder"),
        folder.file("binary.yaml", std::string("\x00\x01\x02\xff", 4))}) {
    const Outcome outcome = gainsmith({"check", file});
    EXPECT_EQ(outcome.exit, 2) << file;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
  }
}

TEST(BadInputTest, GainFilesThatAreTruncatedOrEdited) {
  const Folder folder;
  const std::string path = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", path}).exit, 0);
  const std::string text = text_of(path);
  const std::string half = folder.file("half.json", text.substr(0, text.size() / 2));
  const Outcome truncated = gainsmith({"verify", half});
  EXPECT_EQ(truncated.exit, 2);
  EXPECT_TRUE(std::regex_search(truncated.err, std::regex("half.json:[0-9]+:[0-9]+: ")))
      << truncated.err;
  const std::string edited =
      folder.file("edited.json", std::regex_replace(text, std::regex("T2: 0\\.7"), "T2: 0.9"));
  const Outcome changed = gainsmith({"verify", edited});
  EXPECT_EQ(changed.exit, 2);
  EXPECT_NE(changed.err.find("sha256"), std::string::npos) << changed.err;
}

/// Edits of the document that a reader could take for something that it does not say.
TEST(BadInputTest, GainFilesThatSayWhatNoProgramWrote) {
  const Folder folder;
  const std::string path = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", path}).exit, 0);
  const std::string text = text_of(path);
  const auto refusal = [&](const std::string& edited) {
    EXPECT_NE(edited, text);
    const Outcome outcome = gainsmith({"verify", folder.file("edited.json", edited), "--json"});
    EXPECT_EQ(outcome.exit, 2) << outcome.out;
    return outcome.err;
  };
  const auto with = [&](const std::string& key) {
    return refusal("{" + key + "," + text.substr(1));
  };
  EXPECT_NE(with("\"verdict\": \"no\"").find("edited.json:4:3: the key 'verdict' is given twice"),
            std::string::npos);
  EXPECT_NE(with("\"comment\": 1").find("edited.json:1:2: unknown key 'comment'"),
            std::string::npos);
  EXPECT_NE(with("\"searched\": {\"T2\": 0.1}").find("searched.T2: no search set it"),
            std::string::npos);
  for (const char* key : {"gains", "unknowns"}) {
    auto document = nlohmann::ordered_json::parse(text);
    document[key]["Q"] = 1;
    EXPECT_NE(refusal(document.dump()).find("unknown name 'Q'"), std::string::npos);
  }
  auto document = nlohmann::ordered_json::parse(text);
  document["gainsmith"] = "99";
  EXPECT_NE(refusal(document.dump()).find("expected the version"), std::string::npos);
}

TEST(BadInputTest, ASearchedValueThatIsNotWhatTheSearchFound) {
  const Folder folder;
  const std::string path = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"bisect", problem(kGood), "--largest", "T2", "--in", "0.5", "0.8",
                       "--tolerance", "0.05", "-o", path})
                .exit,
            0);
  auto document = nlohmann::ordered_json::parse(text_of(path));
  ASSERT_EQ(gainsmith({"verify", path, "--runs", "2"}).exit, 0);
  document["searched"]["T2"] = document["searched"]["T2"].get<double>() - 0.1;
  const Outcome outcome = gainsmith({"verify", folder.file("edited.json", document.dump())});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.err.find("is not what the search found"), std::string::npos) << outcome.err;
  document["searched"] = {{"T1", 0.4}};
  const Outcome other = gainsmith({"verify", folder.file("edited.json", document.dump())});
  EXPECT_EQ(other.exit, 2);
  EXPECT_NE(other.err.find("did not set it"), std::string::npos) << other.err;
}

TEST(BadInputTest, AnOutputThatCannotBeWrittenLeavesNothing) {
  const Folder folder;
  const std::string file = folder.file("no-folder", "");
  const Outcome outcome = gainsmith({"synth", problem(kGood), "-o", file + "/gains.json"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_EQ(folder.names().size(), 1U);
}

/// Names are texts that another program could obey: a terminal, a compiler, a browser.
TEST(HostileNames, ControlCharactersAreRefusedAtTheirPlace) {
  const std::string base =
      "problem: p\nmethod:\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {decay: He(P*A) < 0}\n  gains: {L: P}\n"
      "  plant: {state: {x: {shape: n, start: [1, 1]}}, flow: {x: A*x}}\n"
      "  claims: {small: {below: norm(x), bound: 9}}\n"
      "data: {A: [[-1, 0], [0, -2]]}\nreport: {trace: trace(P)}\nunits: {x: m}\n"
      "campaign: {runs: 4, horizon: 1}\n";
  const Folder folder;
  ASSERT_EQ(gainsmith({"run", folder.file("good.yaml", base), "-o", folder.path("good")}).exit, 0);
  for (const char* word :
       {"problem: p", "decay", "small", "trace: ", "L: P", "x: m", "x: {shape"}) {
    for (const std::string hostile : {"\\n", "\\r", "\\e[2J", "\\x9b2J", "\\u2028", "\\u202e"}) {
      SCOPED_TRACE(word + hostile);
      std::string text = base;
      const std::size_t at = text.find(word);
      const std::string part = word;
      const std::size_t colon = part.find(':');
      // The problem's name is a value, the others are keys.
      const std::string key = colon == std::string::npos ? part : part.substr(0, colon);
      text = part == "problem: p" ? with(text, "problem: p", "problem: \"p" + hostile + "\"")
                                  : text.replace(at, key.size(), "\"" + key + hostile + "\"");
      const Outcome outcome = gainsmith({"check", folder.file("bad.yaml", text)});
      EXPECT_EQ(outcome.exit, 2);
      EXPECT_TRUE(std::regex_search(outcome.err,
                                    std::regex("bad.yaml:[0-9]+:[0-9]+: .*control characters")))
          << outcome.err;
      for (const char* byte : {"\x1b", "\r", "\xc2\x9b", "\xe2\x80"})
        EXPECT_EQ((outcome.out + outcome.err).find(byte), std::string::npos) << outcome.err;
    }
  }
}

TEST(HostileNames, GainFilesFromStrangersAreNoPrograms) {
  const Folder folder;
  const std::string path = folder.path("gains.json");
  ASSERT_EQ(gainsmith({"synth", problem(kGood), "-o", path}).exit, 0);
  const auto good = nlohmann::ordered_json::parse(text_of(path));
  const auto refused = [&](const nlohmann::ordered_json& document) {
    for (const char* target : {"python", "c", "matlab", "latex", "csv"}) {
      const Outcome outcome = gainsmith({"export", folder.file("evil.json", document.dump()),
                                         "--to", target, "-o", folder.path("evil")});
      EXPECT_EQ(outcome.exit, 2) << target;
      EXPECT_EQ((outcome.out + outcome.err).find("\x1b"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"evil.json", "gains.json"}));
  };
  auto document = good;
  document["problem"] = "p\nimport os";
  refused(document);
  document = good;
  document["margins"][0]["name"] = "p\nimport os";
  refused(document);
  document = good;
  document["solver"]["message"] = "\x1b[2J";
  refused(document);
  document = good;
  document["gains"]["../../x"] = 1;
  refused(document);
  document = good;
  document["gains"]["L\n}"] = 1;
  refused(document);
}

/// What is printable is a name: files that are made of it stay what they are.
TEST(HostileNames, PrintableOnesStayTexts) {
  const std::string names[] = {"*/ EVIL /*",
                               R"(\"\"\" EVIL)",
                               "%} EVIL",
                               "</script><script>EVIL</script>",
                               R"(\\end{verbatim} EVIL)",
                               R"(EVIL\\)",
                               "coding: utf-7 +AAo-EVIL",
                               "`EVIL`",
                               "';EVIL;'",
                               "<!--EVIL",
                               "]]>EVIL"};
  const Folder folder;
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const std::string quoted = "\"" + name + "\"";
    const std::string file = folder.file(
        "p.yaml",
        "problem: " + quoted +
            "\nmethod:\n  data: {A: n x n, C: p x n, L: n x p}\n"
            "  unknowns: {P: symmetric n}\n  require: {" +
            quoted +
            ": He(P*(A - L*C)) < 0, b: P > I}\n"
            "  gains: {L: L}\n  events: {" +
            quoted +
            ": {every: 0.1}}\n"
            "  plant: {state: {x: {shape: n, start: [1, 1]}}, output: {y: C*x}, flow: {x: A*x}}\n"
            "  observer: {state: {xh: {shape: n, start: 0}}, flow: {xh: A*xh + L*(y - C*xh)}, at: "
            "{" +
            quoted +
            ": {xh: xh/2}}}\n"
            "  claims: {small: {below: norm(x), bound: 9}}\n"
            "data: {A: [[-1, 0], [0, -2]], C: [[1, 0]], L: [[1], [0]]}\nreport: {" +
            quoted +
            ": trace(P)}\n"
            "units: {xh: " +
            quoted + ", y: " + quoted + "}\ncampaign: {runs: 4, horizon: 1}\n");
    const std::string out = folder.path("out");
    const Outcome run = gainsmith({"run", file, "-o", out});
    ASSERT_EQ(run.exit, 0) << run.out << run.err;
    ASSERT_EQ(gainsmith({"report", out, "-o", folder.path("page.html")}).exit, 0);
    const std::string page = text_of(folder.path("page.html"));
    EXPECT_FALSE(has(page, "<script>EVIL")) << "a script of a stranger";
    EXPECT_FALSE(has(page, "<!--EVIL"));
    const std::string gains = out + "/p/gains.json";
    for (const std::string target : {"python", "c", "matlab", "latex", "json", "csv", "mat"}) {
      const std::string to = folder.path("made." + target);
      ASSERT_EQ(gainsmith({"export", gains, "--to", target, "-o", to}).exit, 0) << target;
      if (target == "csv" || target == "mat") continue;
      const std::string text = text_of(to);
      EXPECT_FALSE(std::regex_search(text, std::regex("(^|\n)[^\n#%*/ '\"{]*EVIL"))) << text;
      if (target == "python") {
        EXPECT_EQ(std::system(
                      ("python3 -c \"import ast, sys; ast.parse(open('" + to + "', 'rb').read())\"")
                          .c_str()),
                  0)
            << text;
      }
    }
  }
}

TEST(HostileNames, ResultsStayInTheirFolder) {
  const Folder folder;
  const std::string text =
      "problem: p\nmethod:\n  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: -x}}\n"
      "  claims: {small: {below: x, bound: 2}}\ncampaign: {runs: 4, horizon: 1}\n";
  std::filesystem::create_directories(folder.path("deep/in"));
  for (const std::string name : {"...yaml", "..yaml", "deep/...yaml"})
    ASSERT_EQ(gainsmith({"run", folder.file(name, text), "-o", folder.path("deep/in/out")}).exit, 0)
        << name;
  const Outcome both = gainsmith({"run", folder.path("...yaml"), folder.path("deep/...yaml"), "-o",
                                  folder.path("deep/in/out2")});
  EXPECT_EQ(both.exit, 0) << both.err;
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path("")))
    if (entry.path().filename() == "gains.json" || entry.path().filename() == "result.json")
      found.insert(
          entry.path().parent_path().parent_path().lexically_relative(folder.path("")).string());
  for (const std::string& one : found) EXPECT_TRUE(one.starts_with("deep/in/out")) << one;
  EXPECT_FALSE(found.empty());
}

TEST(HostileNames, FilesAreNamedSoThatATerminalSurvives) {
  const Folder folder;
  const std::string file = folder.file("a\x1b[2Jb.yaml", "problem: p\n");
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"run", folder.path(""), "-o", folder.path("out")}, {"check", file}, {"synth", file}}) {
    const Outcome outcome = gainsmith(command);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_EQ((outcome.out + outcome.err).find("\x1b"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace gainsmith::tests
