// Inequalities for all states through the program, with the numbers of other tools and of proofs by
// hand beside them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

std::string stating(const std::string& method) {
  return "problem: p\nmethod:\n" + method + "  no campaign: nothing moves here\n";
}

std::string requirement(const std::string& inequality, const std::string& forall = "x in R^2") {
  return stating("  require: {p: {forall: " + forall + ", that: \"" + inequality + "\"}}\n");
}

/// The gain file, which `certify` proves.
nlohmann::json gains_of(const std::string& text) {
  const Folder folder;
  const Outcome outcome =
      gainsmith({"synth", folder.file("p.yaml", text), "-o", folder.path("g.json")});
  EXPECT_TRUE(outcome.exit == 0 || outcome.exit == 1) << outcome.err;
  const Outcome certified = gainsmith({"certify", folder.path("g.json"), "--claims"});
  EXPECT_EQ(certified.exit, 0) << certified.out;
  return nlohmann::json::parse(text_of(folder.path("g.json")));
}

std::string verdict(const std::string& text) { return gains_of(text)["verdict"]; }

std::string error_of(const std::string& text) {
  const Folder folder;
  const Outcome outcome =
      gainsmith({"synth", folder.file("p.yaml", text), "-o", folder.path("g.json")});
  EXPECT_EQ(outcome.exit, 2) << outcome.out;
  return outcome.err;
}

const std::string kOscillator =
    "  let:\n"
    "    f(x): \"[-x(2); x(1) - x(2) + x(1)^2*x(2)]\"\n"
    "    V(x): \"1.5*x(1)^2 - x(1)*x(2) + x(2)^2\"\n";

/// -V' >= eps x'x where V <= c: the largest c is 2.3021 for 1e-3 and 2.30448 for 0.
std::string region(const std::string& c, const std::string& eps) {
  return stating(kOscillator + "  require: {fall: {forall: x in R^2, where: V(x) <= " + c +
                 ", that: \"jacobian(V(x), x)*f(x) <= -" + eps + "*x'*x\"}}\n");
}

TEST(SumsOfSquares, TheRegionOfVanDerPolEndsWhereItEnds) {
  EXPECT_EQ(verdict(region("2.302", "0.001")), "yes");
  EXPECT_EQ(verdict(region("2.303", "0.001")), "no");
  EXPECT_EQ(verdict(region("2.3044", "0")), "yes");
  EXPECT_EQ(verdict(region("2.305", "0")), "no");
}

/// Drake's issue 12876: the region ends at 0.05, and 0.067 was accepted.
TEST(SumsOfSquares, ALevelThatToleranceAcceptedIsRefused) {
  const auto level = [](const std::string& c) {
    return stating(
        "  let: {U(x): \"100*x(1)^4 - 384*x(1)^2*x(2)^2 + 400*x(2)^4\"}\n"
        "  require: {fall: {forall: x in R^2, where: \"x'*x <= " +
        c + "\", that: \"8*U(x) - 8*U(x)^2 >= 0\"}}\n");
  };
  EXPECT_EQ(verdict(level("0.04999")), "yes");
  EXPECT_EQ(verdict(level("0.0501")), "no");
}

TEST(SumsOfSquares, ALowerBoundIsBracketed) {
  const nlohmann::json gains =
      gains_of(stating("  unknowns: {g: scalar}\n"
                       "  require: {bound: {forall: x in R^2, that: \"4*x(1)^2 - 2.1*x(1)^4 + "
                       "x(1)^6/3 + x(1)*x(2) - "
                       "4*x(2)^2 + 4*x(2)^4 >= g\"}}\n"
                       "  minimize: -g\n"));
  const double least = 1.0316284534898774;  // the six-hump camel
  EXPECT_EQ(gains["verdict"], "yes");
  EXPECT_EQ(gains["status"], "optimal");
  EXPECT_GE(gains["objective"].get<double>(), least);
  EXPECT_LE(gains["objective"].get<double>(), least + 1e-7);
  EXPECT_LE(gains["objective_lower_bound"].get<double>(), least);
  EXPECT_GE(gains["objective_lower_bound"].get<double>(), least - 1e-7);
}

/// The coefficients of B have to fit the equilibria 0 and (+-sqrt(3), 0) exactly.
TEST(SumsOfSquares, ABarrierIsZeroWhereItMustBe) {
  const nlohmann::json gains = gains_of(stating(
      "  unknowns: {B: {shape: scalar, of: {x: 2}, degree: 4}}\n"
      "  let: {f(x): \"[x(2); -x(1) + x(1)^3/3 - x(2)]\"}\n"
      "  require:\n"
      "    start: {forall: x in R^2, where: \"(x(1)-1.5)^2 + x(2)^2 <= 0.25\", that: B(x) <= 0}\n"
      "    unsafe: {forall: x in R^2, where: \"(x(1)+1)^2 + (x(2)+1)^2 <= 0.16\", that: B(x) >= "
      "0.1}\n"
      "    fall: {forall: x in R^2, that: \"jacobian(B(x), x)*f(x) <= 0\"}\n"));
  EXPECT_EQ(gains["verdict"], "yes");
  ASSERT_EQ(gains["sums_of_squares"].size(), 3U);
  EXPECT_EQ(gains["sums_of_squares"][2]["name"], "fall");
}

TEST(SumsOfSquares, AnAngleIsSineAndCosine) {
  EXPECT_EQ(verdict(stating(
                "  unknowns: {V: {shape: scalar, of: {z: 3}, degree: [0, 2]}}\n"
                "  let: {f(z): \"[z(2)*z(3); -z(1)*z(3); -z(1) - z(3)]\"}\n"
                "  require:\n"
                "    zero: \"V([0; 1; 0]) == 0\"\n"
                "    positive: {forall: z in R^3, where: z(1)^2 + z(2)^2 == 1, that: \"V(z) >= "
                "0.1*(z(1)^2 + (1 - z(2))^2 + z(3)^2)\"}\n"
                "    fall: {forall: z in R^3, where: z(1)^2 + z(2)^2 == 1, that: \"jacobian(V(z), "
                "z)*f(z) <= 0\"}\n")),
            "yes");
}

TEST(SumsOfSquares, OfIntervalsAndSets) {
  const auto bound = [](const std::string& forall, const std::string& p) {
    return gains_of(stating("  unknowns: {a: scalar}\n  require: {on: {forall: " + forall +
                            ", by: sos, that: \"" + p + " + a >= 0\"}}\n  minimize: a\n"));
  };
  EXPECT_NEAR(bound("\"t in [0, 2]\"", "t^3 - 3*t")["objective"].get<double>(), 2, 1e-7);
  EXPECT_NEAR(bound("[\"t in [0, 2]\", \"k in {1, 3}\"]", "t^3 - k*t")["objective"].get<double>(),
              2, 1e-7);
  EXPECT_NEAR(
      bound("\"x in [[-1; -1], [1; 2]]\"", "x(1)^2*x(2) - x(2)^3/3")["objective"].get<double>(),
      8.0 / 3, 1e-7);
}

TEST(SumsOfSquares, ANoSaysWhatItIsAbout) {
  const std::string motzkin = "x(1)^4*x(2)^2 + x(1)^2*x(2)^4 - 3*x(1)^2*x(2)^2 + 1 >= 0";
  const nlohmann::json no = gains_of(requirement(motzkin));
  EXPECT_EQ(no["verdict"], "no");
  EXPECT_EQ(no["certificate"]["about"], "sums of squares");
  EXPECT_TRUE(has(no["solver"]["message"], "the coefficient of x(1)^2*x(2)^2 is -3"));
  const nlohmann::json wrong = gains_of(requirement("x(1)^4 - 3*x(1)*x(2) + x(2)^4 >= 0"));
  EXPECT_EQ(wrong["verdict"], "no");
  EXPECT_TRUE(has(wrong["solver"]["message"], "'p' is false at x(1) = "));
}

TEST(SumsOfSquares, WhatIsNoPolynomialIsRefusedAtItsPlace) {
  EXPECT_TRUE(has(error_of(requirement("sin(x) + 2 >= 0", "x in R")), "p.yaml:3:"));
  EXPECT_TRUE(has(error_of(requirement("sin(x) + 2 >= 0", "x in R")), "s^2 + c^2 == 1"));
  EXPECT_TRUE(has(error_of(requirement("1/(1 + x^2) >= 0", "x in R")), "multiply the inequality"));
  EXPECT_TRUE(
      has(error_of(stating("  unknowns: {c: scalar}\n"
                           "  require: {p: {forall: x in R, where: x^2 <= c, that: x <= 1}}\n")),
          "p.yaml:4:"));
  EXPECT_TRUE(
      has(error_of(stating("  require: {p: {forall: x in R, degree: two, that: x^2 >= 0}}\n")),
          "degree: expected a whole number"));
  EXPECT_TRUE(has(error_of(stating("  require: {p: {forall: x in R, by: sum, that: x^2 >= 0}}\n")),
                  "by: expected sos"));
  EXPECT_TRUE(has(error_of(stating("  unknowns: {P: symmetric 2}\n"
                                   "  require: {p: {where: 1 > 0, that: P > 0}}\n")),
                  "add by: sos"));
  EXPECT_TRUE(has(error_of(stating("  unknowns: {V: {shape: scalar, of: {x: 2}}}\n"
                                   "  require: {p: {forall: x in R^2, that: V(x) >= x'*x}}\n")),
                  "a polynomial needs its degree"));
}

/// What no equation of a monomial bounds has a minimum nevertheless, and lambda_max is refused.
TEST(SumsOfSquares, ObjectivesAreNotCalledUnbounded) {
  const nlohmann::json gains =
      gains_of(stating("  unknowns: {a: scalar}\n"
                       "  require: {least: a >= 1, p: {forall: x in R, that: x^2 + a >= 0}}\n"
                       "  minimize: a\n"));
  EXPECT_EQ(gains["verdict"], "yes");
  EXPECT_GE(gains["objective"].get<double>(), 1);
  EXPECT_FALSE(has(gains["solver"]["message"], "unbounded"));
  EXPECT_TRUE(has(error_of(stating("  unknowns: {P: symmetric 2}\n"
                                   "  require: {p: {forall: x in R, that: \"P >= x^2*eye(2)\"}}\n"
                                   "  minimize: \"lambda_max(P, eye(2))\"\n")),
                  "beside sums of squares"));
}

TEST(SumsOfSquares, ALimitOfTimeLeavesAFile) {
  const Folder folder;
  const std::string text = stating(
      "  unknowns: {g: scalar}\n"
      "  require: {p: {forall: x in R^8, that: \"(x'*x)^3 + x(1)^5 - x(2)^3*x(4) >= g\"}}\n"
      "  minimize: -g\n");
  const Outcome outcome = gainsmith(
      {"synth", folder.file("p.yaml", text), "--time", "0.5", "-o", folder.path("g.json")});
  EXPECT_EQ(outcome.exit, 3) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(text_of(folder.path("g.json")))["verdict"], "undecided");
}

TEST(SumsOfSquares, AGainFileIsCheckedAtItsUnknowns) {
  const Folder folder;
  const std::string text = stating(
      "  unknowns: {V: {shape: scalar, of: {x: 2}, degree: [2, 4]}}\n"
      "  let: {f(x): \"[-x(1) - x(1)^3 - 0.5*x(2); 0.5*x(1) - x(2) - x(2)^3]\"}\n"
      "  require:\n"
      "    positive: {forall: x in R^2, that: \"V(x) >= 0.1*x'*x\"}\n"
      "    fall: {forall: x in R^2, that: \"jacobian(V(x), x)*f(x) <= -0.1*x'*x\"}\n");
  const std::string file = folder.file("p.yaml", text);
  ASSERT_EQ(gainsmith({"synth", file, "-o", folder.path("g.json")}).exit, 0);
  const Outcome shown = gainsmith({"check", folder.path("g.json")});
  EXPECT_EQ(shown.exit, 0);
  EXPECT_TRUE(has(shown.out, "with the unknowns of the file")) << shown.out;
  ASSERT_EQ(gainsmith({"synth", file, "-o", folder.path("h.json")}).exit, 0);
  auto first = nlohmann::json::parse(text_of(folder.path("g.json")));
  auto second = nlohmann::json::parse(text_of(folder.path("h.json")));
  first.erase("timings");
  second.erase("timings");
  EXPECT_EQ(first, second);
}

/// All solutions but 0 fail, by moments whose sum is 0: x+ = J x after [T1, T2] of x' = A x.
TEST(SumsOfSquares, AStrictInequalityIsExcludedByMomentsThatAddUpToNothing) {
  const auto dwell = [](const std::string& T1, const std::string& T2) {
    return stating(
        "  unknowns: {P: {shape: symmetric 2, of: s, degree: 2}}\n"
        "  let: {A: \"[-1, 0.1; 0, 1.2]\", J: \"[1.2, 0; 0, 0.5]\"}\n"
        "  require:\n"
        "    flow: {forall: \"s in [0, " +
        T2 +
        "]\", by: sos,\n"
        "      that: \"derivative(P)(s) + He(P(s)*A) < 0\"}\n"
        "    jump: {forall: \"T in [" +
        T1 + ", " + T2 +
        "]\", by: sos, that: \"J'*P(0)*J - P(T) < 0\"}\n"
        "    positive: P(0) > 0\n");
  };
  EXPECT_EQ(verdict(dwell("0.3", "0.4")), "yes");
  // Moments that are not 0 say nothing where they are 0 for a constant.
  EXPECT_EQ(verdict(requirement("(x(1) - x(2))^2 + 1 > 0")), "yes");
  EXPECT_EQ(verdict(requirement("x(1)^4 + x(2)^4 + 1 > 2*x(1)^2*x(2)^2")), "yes");
  EXPECT_EQ(verdict(requirement("[1, 0; 0, (x(1) - x(2))^2 + 1] > 0")), "yes");
  EXPECT_EQ(verdict(dwell("0.1824", "0.8")), "no");
}

/// V and 1e-8 V are the same function; the program of one was not solved.
TEST(SumsOfSquares, TheSizeOfALyapunovFunctionDoesNotMatter) {
  for (const char* small : {"1", "1e-5", "1e-10"})
    EXPECT_EQ(
        verdict(stating("  unknowns: {V: {shape: scalar, of: {x: 2}, degree: [2, 4]}}\n"
                        "  let: {f(x): \"[-x(1) - x(1)^3 - 5*x(2); 0.5*x(1) - x(2) - x(2)^3]\"}\n"
                        "  require:\n"
                        "    positive: {forall: x in R^2, that: \"V(x) >= " +
                        std::string(small) +
                        "*x'*x\"}\n"
                        "    fall: {forall: x in R^2, that: \"jacobian(V(x), x)*f(x) <= -" +
                        small + "*x'*x\"}\n")),
        "yes")
        << small;
}

TEST(SumsOfSquares, ACoefficientThatAnotherInequalityForcesIsTold) {
  const nlohmann::json gains = gains_of(
      stating("  parameters: {half: 1}\n"
              "  unknowns: {V: {shape: scalar, of: {x: 2}, degree: [2, 4]}}\n"
              "  let: {f(x): \"[-x(1) + x(1)*x(2); -x(2)]\"}\n"
              "  require:\n"
              "    positive: {forall: x in R^2, that: \"V(x) >= 0.01*(x'*x)^half\"}\n"
              "    fall: {forall: x in R^2, that: \"jacobian(V(x), x)*f(x) <= -0.01*x'*x\"}\n"));
  EXPECT_EQ(gains["verdict"], "no");
  EXPECT_TRUE(has(gains["solver"]["message"], "'fall' leaves one value of V_")) << gains["solver"];
}

TEST(SumsOfSquares, AnInequalityMayBeOneOfItsSet) {
  EXPECT_EQ(verdict(stating("  require: {p: {forall: x in R, where: x >= 1, that: x >= 1}}\n")),
            "yes");
  EXPECT_EQ(verdict(stating("  require: {p: {forall: \"x in [0, 1]\", by: sos, that: "
                            "\"x*(1 - x) >= 0\"}}\n")),
            "yes");
}

TEST(SumsOfSquares, ADegreeBelowThatOfTheInequalityIsRefused) {
  EXPECT_TRUE(has(error_of(stating("  require: {p: {forall: x in R^2, degree: 2, that: \"x(1)^4 + "
                                   "x(2)^2 >= 0\"}}\n")),
                  "the degree of 'p' is 4"));
}

TEST(SumsOfSquares, APlaneShowsTheRegionAndTheField) {
  const Folder folder;
  ASSERT_EQ(gainsmith({"init", "region-of-attraction"}).exit, 0);
  const std::string file = folder.file("p.yaml", gainsmith({"init", "region-of-attraction"}).out);
  ASSERT_EQ(gainsmith({"synth", file, "-o", folder.path("g.json")}).exit, 0);
  ASSERT_EQ(gainsmith({"simulate", folder.path("g.json"), "--runs", "0:3", "--phase", "x1,x2",
                       "--plot", folder.path("p.svg")})
                .exit,
            0);
  const std::string picture = text_of(folder.path("p.svg"));
  EXPECT_TRUE(has(picture, "stays: 2.30")) << picture.substr(0, 2000);
  EXPECT_TRUE(has(picture, "#b8b8b8"));
  EXPECT_EQ(gainsmith({"report", folder.path("g.json"), "-o", folder.path("r.html")}).exit, 0);
  EXPECT_TRUE(has(text_of(folder.path("r.html")), "As sums of squares"));
}

/// A bound that is edited to a false one is not solved anew: the file has no other gains.
TEST(SumsOfSquares, AnEditedBoundIsNotConfirmed) {
  const Folder folder;
  const std::string file =
      folder.file("p.yaml", stating("  unknowns: {g: scalar}\n"
                                    "  require: {p: {forall: x in R, that: x^4 - x^2 + x >= g}}\n"
                                    "  minimize: -g\n"));
  const Outcome synth = gainsmith({"synth", file, "-o", folder.path("g.json")});
  ASSERT_EQ(synth.exit, 0) << synth.err;
  EXPECT_TRUE(has(synth.out, "unknowns    g = -1.0547")) << synth.out;
  EXPECT_EQ(gainsmith({"check", folder.path("g.json")}).exit, 0);
  auto edited = nlohmann::json::parse(text_of(folder.path("g.json")));
  edited["unknowns"]["g"] = -1.05;
  edited.erase("proof");
  if (edited.contains("decimals")) edited.erase("decimals");
  const std::string bad = folder.file("b.json", edited.dump());
  EXPECT_NE(gainsmith({"check", bad}).exit, 0);
  EXPECT_NE(gainsmith({"certify", bad}).exit, 0);
}

TEST(SumsOfSquares, ExplainNamesTheInequality) {
  const Folder folder;
  const Outcome outcome = gainsmith({"explain", folder.file("p.yaml", region("2.5", "0.001"))});
  EXPECT_TRUE(has(outcome.out, "fall cannot hold as sums of squares of these degrees"))
      << outcome.out;
}

}  // namespace
}  // namespace gainsmith::tests
