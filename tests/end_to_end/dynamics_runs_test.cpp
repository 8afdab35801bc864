// Runs of dynamics with events through the program: to the accuracy that a campaign asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

/// x = tan(t) and z = 1e-6 tan(t), with what stands under `campaign`.
std::string tangent(const std::string& campaign) {
  return "problem: tangent\n"
         "method:\n"
         "  method: tangent\n"
         "  plant:\n"
         "    state: {x: {shape: scalar, start: 0}}\n"
         "    flow: {x: 1 + x^2}\n"
         "  observers:\n"
         "    small:\n"
         "      state: {z: {shape: scalar, start: 0}}\n"
         "      flow: {z: 1e-6*(1 + (1e6*z)^2)}\n"
         "  claims: {below: {shrinks: 2 - small.z, to: 10}}\n"
         "campaign: {runs: 1, horizon: 1.5, " +
         campaign +
         "}\n"
         "expect:\n"
         "  run: [{at: {t: 1.5}, value: x - 14.101419947171719, is: 0, absolute: 1e-6}]\n";
}

struct Simulated {
  double x = 0, z = 0;  ///< their errors
  std::ptrdiff_t rows = 0;
};

Simulated simulated(const std::string& campaign) {
  const Folder folder;
  const Outcome outcome =
      gainsmith({"simulate", folder.file("tangent.yaml", tangent(campaign)), "--judge"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("judged: the run satisfies the texts"),
            std::string::npos)
      << outcome.err;
  const std::vector<double> last = last_row(outcome.out);
  return {std::abs(last[3] - std::tan(1.5)), std::abs(1e6 * last[4] - std::tan(1.5)),
          std::count(outcome.out.begin(), outcome.out.end(), '\n')};
}

/// A state of 1e-15 beside the absolute accuracy of 1e-10, so that the repeated run escapes.
TEST(DynamicsRuns, AClaimThatOneOfBothRunsDoesNotComeToIsUndecided) {
  const Folder folder;
  const std::string problem =
      folder.file("small.yaml",
                  "problem: small\n"
                  "method:\n"
                  "  method: small\n"
                  "  plant:\n"
                  "    state: {x: {shape: 1, start: 2e-15}}\n"
                  "    flow: {x: \"15*(-x - 1e15*x^2 + 1e-15*(1.5 + sin(t)))\"}\n"
                  "  events: {fin: {at: [9.5]}}\n"
                  "  claims: {low: {below: x, bound: 1e-16, over: fin}}\n"
                  "campaign: {horizon: 10}\n");
  const Outcome replayed = gainsmith({"simulate", problem, "-o", folder.path("run.csv")});
  EXPECT_EQ((replayed.out + replayed.err).find("held"), std::string::npos) << replayed.out;
  const Outcome verified = gainsmith({"verify", problem});
  EXPECT_EQ(verified.out.find("held"), std::string::npos) << verified.out;
}

TEST(DynamicsRuns, AClaimThatAnEscapeKeepsFromItsEventIsViolated) {
  const Folder folder;
  const std::string problem =
      folder.file("escape.yaml",
                  "problem: escape\n"
                  "method:\n"
                  "  method: escape\n"
                  "  plant: {state: {x: {shape: scalar, start: 0}}, flow: {x: 1 + x^2}}\n"
                  "  events: {fin: {at: [9.5]}}\n"
                  "  claims: {low: {below: x, bound: 1, over: fin}}\n"
                  "campaign: {horizon: 10}\n");
  const Outcome replayed = gainsmith({"simulate", problem, "-o", folder.path("run.csv")});
  EXPECT_NE((replayed.out + replayed.err).find("low          violated"), std::string::npos)
      << replayed.out;
  EXPECT_NE(gainsmith({"verify", problem}).out.find("violated in 1 of 1"), std::string::npos);
}

TEST(DynamicsRuns, TheAccuracyIsThatOfTheCampaign) {
  const Simulated usual = simulated("seed: 1");
  const Simulated coarse = simulated("accuracy: {relative: 1e-4}");
  const Simulated sharp = simulated("accuracy: {relative: 1e-12}");
  EXPECT_LT(coarse.rows, usual.rows);
  EXPECT_LT(usual.rows, sharp.rows);
  EXPECT_LT(usual.x, coarse.x / 100);
  EXPECT_LT(sharp.x, usual.x / 10);
}

/// With 1 for x the steps are those that z asks for: 1e-10 is much of a state of size 1e-6.
TEST(DynamicsRuns, AStateHasAnAccuracyOfItsOwn) {
  const Simulated rough =
      simulated("accuracy: {relative: 1e-10, absolute: {x: 1, small.z: 1e-10}}");
  const Simulated fine = simulated("accuracy: {relative: 1e-10, absolute: {x: 1, z: 1e-16}}");
  EXPECT_GT(rough.z, 100 * fine.z);
}

/// A run to 1e-4 does not decide what is expected to 1e-6; one to 1e-12 does.
TEST(DynamicsRuns, WhatIsExpectedIsDecidedToTheAccuracy) {
  const Folder folder;
  const auto run = [&](const std::string& campaign) {
    return gainsmith(
        {"run", folder.file("tangent.yaml", tangent(campaign)), "-o", folder.path("out")});
  };
  EXPECT_EQ(run("accuracy: {relative: 1e-12}").exit, 0);
  const Outcome coarse = run("accuracy: {relative: 1e-4}");
  EXPECT_NE(coarse.exit, 0) << coarse.out;
}

/// Whoever makes the runs, in packs or carefully, linear or not.
TEST(DynamicsRuns, AValueThatStartsAtZeroHasShrunk) {
  const Folder folder;
  for (const std::string pull : {"k*sin(x(1))", "k*x(1)"})
    for (const std::string value : {"norm(e)", "e'*e", "norm(e)^3", "max(abs(e))"}) {
      const std::string text =
          "problem: p\n"
          "method:\n"
          "  let: {k: 9.81, f(x): \"[x(2); -" +
          pull +
          " - 0.1*x(2)]\"}\n"
          "  events: {sample: {every: [0.05, 0.2]}}\n"
          "  noise: {w: {normal: 0.01, new at: sample}}\n"
          "  plant: {state: {x: {shape: 2, start: [1, 0]}}, output: {y: {value: x(1) + w, at: "
          "sample}}, "
          "flow: {x: f(x)}}\n"
          "  observer: {state: {xh: {shape: 2, start: [1, 0]}}, flow: {xh: f(xh)}, "
          "at: {sample: {xh: \"xh + [0.1; 0]*(y - xh(1))\"}}}\n"
          "  signals: {e: x - xh}\n"
          "  claims: {small: {shrinks: \"" +
          value +
          "\", to: 0.5}}\n"
          "campaign: {horizon: 3, runs: 20}\n";
      const Outcome outcome = gainsmith({"verify", folder.file("p.yaml", text)});
      EXPECT_EQ(outcome.exit, 0) << pull << " " << value << outcome.out << outcome.err;
    }
}

/// Two integrations escape a little apart.
TEST(DynamicsRuns, AnObserverThatEscapesViolatesItsClaims) {
  const Folder folder;
  const std::string text =
      "problem: p\n"
      "method:\n"
      "  plant: {state: {x: {shape: 1, start: 1}}, output: {y: x}, flow: {x: -sin(x)}}\n"
      "  observer: {state: {z: {shape: 1, start: 0}}, flow: {z: -sin(z) - 30*(y - z)}}\n"
      "  signals: {e: x - z}\n"
      "  claims: {small: {shrinks: norm(e), to: 0.5}}\n"
      "campaign: {horizon: 30, runs: 5, initial: {x: {box: [-1, 1]}}}\n";
  const Outcome outcome = gainsmith({"verify", folder.file("p.yaml", text)});
  EXPECT_EQ(outcome.exit, 1) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "violated in 5 of 5 runs")) << outcome.out;
}

TEST(DynamicsRuns, ACopyLeavesOutAnEvent) {
  const Folder folder;
  const std::string text =
      "problem: p\n"
      "method:\n"
      "  plant: {state: {x: {shape: 1, start: 1}}, output: {y: x}, flow: {x: -x}}\n"
      "  observers:\n"
      "    a: {state: {xh: {shape: 1, start: 0}}, mode: {q: 0}, flow: {xh: y - 2*xh}, "
      "events: {far: {when: q == 0 and xh >= 0.1}}, at: {far: {q: 1}}}\n"
      "    b: {like: a, events: {far: none}, at: {far: none}}\n"
      "campaign: {horizon: 2, runs: 1}\n";
  const Outcome outcome = gainsmith({"check", folder.file("p.yaml", text)});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "events      a.far\n")) << outcome.out;
}

/// A family of observers, its members written out, and one observer with a column for each.
TEST(DynamicsRuns, ABankOfObserversIsThatOfItsMembers) {
  const Folder folder;
  const auto errors = [&](const std::string& observers, const std::string& claims) {
    const std::string text =
        "problem: bank\n"
        "method:\n"
        "  data: {l: {shape: scalar, for: i in 1..N}}\n"
        "  let: {A: \"[0, 1; -1, 0]\", K(g): \"[2*g; g^2]\"}\n"
        "  plant: {state: {x: {shape: 2, start: [1, 0]}}, output: {y: x(1)}, flow: {x: A*x}}\n"
        "  observers:\n" +
        observers + "  claims: {" + claims +
        "}\ndata: {l: [2, 5]}\ncampaign: {runs: 3, horizon: 3, initial: {x: {box: [0.5, 1]}}}\n";
    const Outcome outcome = gainsmith({"verify", folder.file("bank.yaml", text), "--json"});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    std::vector<double> values;
    for (const auto& claim : nlohmann::json::parse(outcome.out)["checks"])
      values.push_back(claim["worst"]["value"]);
    return values;
  };
  const std::string flow = "flow: {z: \"A*z + K(l(";
  const std::string rest = "))*(y - z(1))\"}}\n";
  const std::string start = "state: {z: {shape: 2, start: 0}}, ";
  const std::string claim = "small: {shrinks: norm(x - z), to: 1}";
  const auto family = errors("    o: {for: i in 1..N, " + start + flow + "i" + rest, claim);
  EXPECT_EQ(family, errors("    o_1: {" + start + flow + "1" + rest + "    o_2: {" + start + flow +
                               "2" + rest,
                           claim));
  const auto columns = errors(
      "    o: {state: {z: {shape: 2 x N, start: 0}}, flow: {z: \"horzcat(i in 1..N, A*z(:, i) + "
      "K(l(i))*(y - z(1, i)))\"}}\n",
      "first: {shrinks: \"norm(x - z(:, 1))\", to: 1}, second: {shrinks: \"norm(x - z(:, 2))\", "
      "to: 1}");
  ASSERT_EQ(family.size(), columns.size());
  for (std::size_t k = 0; k < family.size(); ++k)
    EXPECT_NEAR(family[k], columns[k], 1e-9 * columns[k]);
}

TEST(DynamicsRuns, WhatCannotBeIsRefused) {
  const Folder folder;
  const auto refused = [&](const std::string& campaign, const std::string& message) {
    const Outcome outcome =
        gainsmith({"check", folder.file("tangent.yaml", tangent("accuracy: " + campaign))});
    EXPECT_EQ(outcome.exit, 2) << campaign;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  refused("{relative: 1e-13}", "relative: expected a number from 1e-12 to 0.01, found 1e-13");
  refused("{absolute: 0}", "absolute: expected a number from 1e-100");
  refused("{absolute: {small.zz: 1e-3}}", "small.zz");
  refused("{relativ: 1e-6}", "relative");
}

}  // namespace
}  // namespace gainsmith::tests
