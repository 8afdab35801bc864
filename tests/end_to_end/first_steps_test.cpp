// What a new user stumbles over: starts that are missing, what never happens, folders that are not
// there, lists for columns.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// x' = -x from 1, sampled; nothing is drawn.
const std::string kDecay = R"(problem: decay
method:
  method: decay
  events: {sample: {every: 0.5}, far: {when: plant.x(1) > 3}}
  plant: {state: {x: {shape: 2, start: [1, 0]}}, output: {y: x(1)}, flow: {x: -x}}
  observer:
    state: {z: {shape: scalar, start: 0}, n: {shape: scalar, start: 0}}
    at: {sample: {z: y}, far: {n: n + 1}}
  claims: {small: {below: norm(x), bound: 2}}
campaign: {horizon: 4, runs: 200}
)";

TEST(FirstSteps, AMissingStartStopsRunsAlone) {
  const Folder folder;
  const std::string file = folder.file(
      "p.yaml",
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > I, decay: He(P*A) < 0}\n  minimize: trace(P)\n  gains: {K: P}\n"
      "  plant: {state: {x: n}, flow: {x: A*x}}\n  claims: {V: {nonincreasing: x'*P*x}}\n"
      "data: {A: [[-1, 1], [0, -2]]}\ncampaign: {horizon: 3}\n");
  const Outcome check = gainsmith({"check", file});
  EXPECT_EQ(check.exit, 0) << check.err;
  EXPECT_TRUE(has(check.out,
                  "note        no run can be made: the state 'x' has no start. verify, simulate "
                  "and the campaign of run will fail: add campaign: {initial: {x: ...}} with"))
      << check.out;
  const std::string gains = folder.path("gains.json");
  EXPECT_EQ(gainsmith({"synth", file, "-o", gains}).exit, 0);
  EXPECT_EQ(gainsmith({"explain", file}).exit, 0);
  for (const char* command : {"verify", "simulate"}) {
    const Outcome outcome = gainsmith({command, gains});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, ":9:19: the state 'x' has no start, and a run needs one"))
        << outcome.err;
  }
  EXPECT_EQ(gainsmith({"run", file, "-o", folder.path("out")}).exit, 2);
}

TEST(FirstSteps, ACampaignWithoutDrawsMakesOneRunAndClaimsNoConfidence) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kDecay);
  const Outcome outcome = gainsmith({"verify", file});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "held in 1 run (nothing is drawn)")) << outcome.out;
  EXPECT_TRUE(has(outcome.out,
                  "note        nothing is drawn in this campaign: all its runs are "
                  "equal"))
      << outcome.out;
  EXPECT_FALSE(has(outcome.out, "confidence")) << outcome.out;
  const auto json = gainsmith({"verify", file, "--json", "--runs", "1e3"}).json();
  EXPECT_EQ(json["runs"], 1);
  EXPECT_EQ(json["different_runs"], 1);
  EXPECT_TRUE(json["confidence"].is_null());
  EXPECT_TRUE(json["violation_probability_at_most"].is_null());
  const Outcome run = gainsmith({"run", file, "-o", folder.path("out")});
  EXPECT_TRUE(has(run.out, "held in 1 run (nothing is drawn)")) << run.out;
  EXPECT_TRUE(has(text_of(folder.path("out/p/summary.txt")), "nothing is drawn in this campaign"));
  EXPECT_TRUE(has(gainsmith({"check", file}).out, "nothing is drawn in this campaign"));
}

TEST(FirstSteps, ACampaignOfListsMakesNoRunTwice) {
  const Folder folder;
  const std::string file = folder.file(
      "p.yaml",
      replaced(kDecay, "runs: 200", "runs: 200, initial: {x: {list: [[1, 0], [0, 1], [1, 1]]}}"));
  const auto json = gainsmith({"verify", file, "--json"}).json();
  EXPECT_EQ(json["runs"], 3);
  EXPECT_TRUE(json["confidence"].is_null());
  EXPECT_EQ(gainsmith({"verify", file, "--json", "--runs", "2"}).json()["runs"], 2);
  const auto drawn =
      gainsmith({"verify",
                 folder.file("q.yaml", replaced(kDecay, "runs: 200",
                                                "runs: 20, initial: {x: {box: [-1, 1]}}")),
                 "--json"})
          .json();
  EXPECT_EQ(drawn["runs"], 20);
  EXPECT_TRUE(drawn["different_runs"].is_null());
  EXPECT_EQ(drawn["confidence"], 0.95);
}

TEST(FirstSteps, OfRunsThatEndEarlyItIsNotSaidWhatNeverHappens) {
  const Folder folder;
  const std::string file = folder.file(
      "p.yaml", replaced(replaced(kDecay, "flow: {x: -x}", "flow: {x: x.^2}"), "0.5", "2"));
  const Outcome verify = gainsmith({"verify", file});
  EXPECT_NE(verify.exit, 0) << verify.out;
  EXPECT_FALSE(has(verify.out, "never happen")) << verify.out;
}

TEST(FirstSteps, WhatNeverHappensIsNamed) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", replaced(kDecay, "  observer:\n",
                                     "  observers:\n   idle: {state: {q: {shape: scalar, "
                                     "start: 1}}, output: {r: q}}\n   busy:\n"));
  const std::string idle = "the observer 'idle' never changes: it has no flow, and no map";
  const Outcome verify = gainsmith({"verify", file});
  EXPECT_EQ(verify.exit, 0) << verify.err;
  EXPECT_TRUE(has(verify.out, idle)) << verify.out;
  EXPECT_TRUE(has(verify.out, "the event 'far' never happens")) << verify.out;
  EXPECT_FALSE(has(verify.out, "'sample' never happens")) << verify.out;
  const Outcome simulate = gainsmith({"simulate", file, "-o", folder.path("r.csv")});
  EXPECT_EQ(simulate.exit, 0);
  EXPECT_TRUE(has(simulate.out, idle)) << simulate.out;
  EXPECT_TRUE(has(simulate.out, "note: the event 'far' never happens in this run")) << simulate.out;
  const std::string drawn = folder.path("r.svg");
  EXPECT_TRUE(has(gainsmith({"simulate", file, "--runs", "0:7", "--plot", drawn}).out,
                  "  note: the event 'far' never happens in any of these runs\n"));
  const std::string late = folder.file("q.yaml", replaced(kDecay, "every: 0.5", "every: 5"));
  const Outcome check = gainsmith({"check", late});
  EXPECT_EQ(check.exit, 0);
  EXPECT_TRUE(has(check.out, "the event 'sample' never happens: it is due after the horizon"))
      << check.out;
  EXPECT_FALSE(has(check.out, "'far'")) << check.out;
}

/// An event that a method of the program has for safety is no mistake of the user.
TEST(FirstSteps, EventsOfAMethodOfTheProgramAreNotNoted) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", R"(problem: p
method: nonlinear-observer
data: {low: [-2.5, -3], high: [2.5, 3], f(x): "[x(2); (1 - x(1)^2)*x(2) - x(1)]", h(x): x(1)}
campaign: {runs: 5, horizon: 5, initial: {x: {box: [-0.1, 0.1]}}}
)");
  const std::string gains = folder.path("g.json");
  ASSERT_EQ(gainsmith({"synth", file, "-o", gains}).exit, 0);
  const Outcome verify = gainsmith({"verify", gains});
  EXPECT_EQ(verify.exit, 0) << verify.err;
  EXPECT_FALSE(has(verify.out, "never happens")) << verify.out;
  EXPECT_FALSE(
      has(gainsmith({"simulate", gains, "-o", folder.path("r.csv")}).out, "never happens"));
}

/// int (x^2 - 2) dt falls from the start on: its start, 0, would tell nothing of a run.
TEST(FirstSteps, ACostThatIsNeverPositiveIsReportedAsAWhole) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", R"(problem: p
method:
  plant:  {state: {x: scalar}, flow: {x: -x}}
  claims: {energy: {cost: {flow: x^2 - 2}, below: x^2}}
campaign: {runs: 20, horizon: 3, initial: {x: {box: [0.5, 1]}}}
)");
  const Outcome verify = gainsmith({"verify", file, "--json"});
  ASSERT_EQ(verify.exit, 0) << verify.err;
  const auto worst = verify.json()["checks"][0]["worst"];
  EXPECT_EQ(worst["t"], 3) << verify.out;
  EXPECT_LT(worst["value"], -5) << verify.out;
  EXPECT_GT(worst["value"], -6) << verify.out;
}

TEST(FirstSteps, ANoteOnSeveralRunsIsPrintedOnceWithTheRuns) {
  const Folder folder;
  const std::string file = folder.file(
      "p.yaml",
      replaced(replaced(kDecay, "when: plant.x(1) > 3", "falls: plant.x(1) - 3"), "runs: 200",
               "runs: 4, initial: {x: {list: [[1, 0], [4, 0], [2, 0], [5, 0]]}}"));
  const std::string text =
      gainsmith({"simulate", file, "--runs", "0:3", "--plot", folder.path("r.svg")}).out;
  EXPECT_TRUE(has(text, "  note: the event 'far' never happens in the runs 0 and 2\n")) << text;
  EXPECT_EQ(text.find("never happens"), text.rfind("never happens")) << text;
}

TEST(FirstSteps, AListIsAColumnWhereATextIsTaken) {
  const Folder folder;
  const std::string text =
      replaced(replaced(kDecay, "flow: {x: -x}", "flow: {x: \"[x(2); -x(1)]\"}"), "start: [1, 0]",
               "start: \"[1; 0]\"");
  const std::string list = replaced(replaced(kDecay, "flow: {x: -x}", "flow: {x: [x(2), -x(1)]}"),
                                    "y: x(1)", "y: [x(1), x(2)]");
  const auto table = [&](const std::string& problem) {
    return gainsmith({"simulate", folder.file("p.yaml", problem), "--step", "0.5"});
  };
  const Outcome quoted =
      table(replaced(replaced(text, "y: x(1)", "y: \"[x(1); x(2)]\""), "z: y", "z: y(1)"));
  const Outcome listed = table(replaced(list, "z: y", "z: y(1)"));
  EXPECT_EQ(quoted.exit, 0) << quoted.err;
  EXPECT_EQ(listed.out, quoted.out) << listed.err;
  const Outcome row = table(replaced(kDecay, "start: [1, 0]", "start: [[1, 0]]"));
  EXPECT_EQ(row.exit, 2);
  EXPECT_TRUE(has(row.err, "a column is written [a; b]")) << row.err;
}

TEST(FirstSteps, AnUncertainMatrixTakesListsForTheEndsOfItsBox) {
  const Folder folder;
  const std::string file = folder.file(
      "p.yaml",
      "problem: p\nmethod:\n  method: m\n  data: {C: 1 x 2, b: 2}\n"
      "  plant: {state: {x: {shape: 2, start: 0}}, output: {y: C*x}, flow: {x: b - x}}\n"
      "  claims: {y: {below: y, bound: 3.5}}\ndata: {C: [1, 0], b: [1, 1]}\n"
      "uncertain: {C: {box: [[1, 0], [2, 0.5]]}, b: {box: [[0, 1], [1, 1]]}}\n"
      "campaign: {horizon: 3, runs: 5}\n");
  const Outcome outcome = gainsmith({"verify", file});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
}

TEST(FirstSteps, DefinitionsStandInEachPassOfALoop) {
  const Folder folder;
  const auto last = [&](const std::string& map) {
    const Outcome outcome = gainsmith(
        {"simulate",
         folder.file("p.yaml", replaced(replaced(kDecay, "sample: {z: y}", "sample: " + map),
                                        "horizon: 4", "horizon: 0.6")),
         "--json"});
    EXPECT_EQ(outcome.exit, 0) << map << outcome.err;
    const auto json = outcome.json();
    for (std::size_t k = 0; k < json["columns"].size(); ++k)
      if (json["columns"][k] == "z") return json["rows"].back()[k].get<double>();
    return -1.0;
  };
  // z = 0, 1, 3, 7.
  EXPECT_EQ(last("{repeat: {let: {d: z + 1}, z: z + d}, times: 3}"), 7);
  EXPECT_EQ(last("{let: {d: z + 1}, repeat: {z: z + d}, times: 3}"), 7);
  EXPECT_EQ(last("{repeat: {let: {d: z + 1}, z: z + d}, until: d > 7, at_most: 9}"), 7);
  EXPECT_EQ(last("[{let: {d: z + 1}, z: z + d}, {let: {d: 2*z}, z: z + d}]"), 3);
  const Outcome twice = gainsmith(
      {"check", folder.file("q.yaml", replaced(kDecay, "sample: {z: y}",
                                               "sample: {let: {d: 1}, repeat: {let: {d: 2}, z: "
                                               "z + d}, times: 3}"))});
  EXPECT_TRUE(has(twice.err, "'d' is defined twice here; first in line 8")) << twice.err;
}

TEST(FirstSteps, EqualNamesInPlantAndObserverAreShownAtBothPlaces) {
  const Folder folder;
  const Outcome outcome = gainsmith(
      {"check", folder.file("p.yaml", replaced(kDecay, "state: {z:", "state: {x: 2, z:"))});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.err,
                  "p.yaml:7:13: 'x' names a state of the observer here, but it already names a "
                  "state of the plant, in line 5"))
      << outcome.err;
}

TEST(FirstSteps, AMissingCommaBeforeASignIsSeen) {
  const Folder folder;
  for (const char* written : {"A: \"[1 -1; 2 -1]\"", "A: [[-1 -2, 1], [0, -3]]"}) {
    const Outcome outcome =
        gainsmith({"synth", folder.file("p.yaml",
                                        "problem: p\nmethod: {data: {A: n x k}, report: "
                                        "{a: A}}\ndata:\n  " +
                                            std::string(written) + "\n")});
    EXPECT_EQ(outcome.exit, 2) << written;
    EXPECT_TRUE(has(outcome.err, "a comma is missing before '-'")) << outcome.err;
  }
}

TEST(FirstSteps, AGainBeyondItsStatedBoundIsNamed) {
  const Folder folder;
  const std::string file = folder.file(
      "p.yaml",
      "problem: p\nmethod:\n  unknowns: {P: symmetric 2, g: scalar}\n  require: {p: P > I, g: "
      "g > 20}\n  minimize: trace(P) + g\n  gains: {K: g^2*inv(P)}\nsynthesis: {gain_bound: "
      "100}\n");
  const Outcome outcome = gainsmith({"synth", file});
  EXPECT_TRUE(has(outcome.out, "the gain bound 100 is not kept: K has the norm 400"))
      << outcome.out << outcome.err;
}

TEST(FirstSteps, AProblemReportsBesideItsMethod) {
  const Folder folder;
  const std::string text =
      "problem: p\nmethod: lqr\ndata: {A: [[0, 1], [0, 0]], B: [[0], [1]]}\n"
      "no campaign: a number\nreport: {riccati: \"trace(care(A, B, Q, R))\"}\n";
  const Outcome outcome = gainsmith({"synth", folder.file("p.yaml", text)});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "riccati = 3.4641")) << outcome.out;  // 2 sqrt(3), by hand
  EXPECT_TRUE(has(outcome.out, "poles = ")) << outcome.out;
  const Outcome twice =
      gainsmith({"synth", folder.file("p.yaml", replaced(text, "riccati:", "poles:"))});
  EXPECT_EQ(twice.exit, 2);
  EXPECT_TRUE(has(twice.err, "p.yaml:5:10: report: 'poles' is in the report of the method"))
      << twice.err;
}

TEST(FirstSteps, KeysAtTheWrongLevelAreToldWhereTheyBelong) {
  const Folder folder;
  const auto said = [&](const std::string& text) {
    return gainsmith({"check", folder.file("p.yaml", text)}).err;
  };
  EXPECT_TRUE(has(said(kDecay + "observers: {second: {}}\n"), "it belongs to the method"));
  EXPECT_TRUE(has(said(replaced(kDecay, "  claims:", "  compare: []\n  claims:")),
                  "it belongs to the problem, beside 'method'"));
}

TEST(FirstSteps, FoldersOfOutputsAreMade) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", kDecay);
  EXPECT_EQ(gainsmith({"simulate", file, "-o", folder.path("a/b/run.csv"), "--plot",
                       folder.path("c/run.svg")})
                .exit,
            0);
  EXPECT_TRUE(std::filesystem::exists(folder.path("a/b/run.csv")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("c/run.svg")));
  EXPECT_EQ(gainsmith({"synth", file, "-o", folder.path("d/gains.json")}).exit, 0);
  EXPECT_EQ(
      gainsmith({"run", file, "-o", folder.path("e/f"), "--junit", folder.path("g/j.xml")}).exit,
      0);
  EXPECT_TRUE(std::filesystem::exists(folder.path("e/f/p/gains.json")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("g/j.xml")));
  const Outcome outcome = gainsmith({"synth", file, "-o", file + "/gains.json"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.err, "cannot make the folder '" + file + "'")) << outcome.err;
  EXPECT_TRUE(has(gainsmith({"synth", file, "-o", folder.path("d")}).err, "this is a folder"));
}

TEST(FirstSteps, ProblemsOfOneNameGoToFoldersOfTheirOwn) {
  const Folder folder;
  for (const char* name : {"A", "B"}) std::filesystem::create_directory(folder.path(name));
  const std::string a = folder.file("A/x.yaml", kDecay);
  const std::string b = folder.file("B/x.yaml", replaced(kDecay, "bound: 2", "bound: 0.5"));
  const Outcome outcome = gainsmith({"run", a, b, "-o", folder.path("out")});
  EXPECT_EQ(outcome.exit, 1) << outcome.out << outcome.err;
  EXPECT_TRUE(has(text_of(folder.path("out/A/x/summary.txt")), "held"));
  EXPECT_TRUE(has(text_of(folder.path("out/B/x/summary.txt")), "violated"));
}

TEST(FirstSteps, ToleranceIsSaidInTheReport) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", replaced(kDecay, "{below: norm(x), bound: 2}",
                                     "{below: x(1)*exp(t), bound: 1, tolerance: 1e-6}"));
  const Outcome outcome = gainsmith({"verify", file});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "within a tolerance of 1e-06 of the bound")) << outcome.out;
  EXPECT_EQ(gainsmith({"verify", file, "--json"}).json()["checks"][0]["tolerance"], 1e-6);
}

}  // namespace
}  // namespace gainsmith::tests
