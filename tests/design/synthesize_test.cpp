#include "design/synthesize.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "design/solve.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"
#include "support/yaml_problem.h"
#include "verdict/refutation.h"

namespace gainsmith::design {
namespace {

/// A certificate that no solution exists, exactly or up to the rounding of 100 digits.
bool is_certain(const model::CertificateRecord& certificate) {
  return certificate.is_about_problem() &&
         (certificate.exact || certificate.backward_error <= verdict::kNothing);
}

std::string lyapunov(const numbers::Matrix& A) {
  return "problem: lyapunov\nmethod:\n  method: lyapunov\n  data: {A: n x n}\n  unknowns: {P: "
         "symmetric n}\n"
         "  require: {positive: P > 0, stable: He(P*A) < 0}\ndata: {A: " +
         tests::matrix_yaml(A) + "}\n";
}

/// Data of which the arithmetic knows nothing, or only a wide range, exclude nothing.
TEST(SynthesizeTest, WhatIsNotKnownIsNoNo) {
  for (const char* A : {"-eye(2) + 0.1*pinv([1, 1; 1, 1])", "where(0.1 + 0.2 > 0.3, 1, -1)*eye(2)",
                        "-eye(2) - pinv([1, 2; 2, 4])", "(sign(sin(pi)) - 0.5)*eye(2)"}) {
    const model::Gains gains = synthesized(
        "problem: stable\nmethod:\n  method: lyapunov\n  data: {A: 2 x 2}\n  unknowns: {P: "
        "symmetric 2}\n  require: {positive: P > 0, stable: He(P*A) < 0}\ndata: {A: \"" +
        std::string(A) + "\"}\n");
    EXPECT_NE(gains.verdict, model::Verdict::no) << A;
  }
  for (const char* least :
       {"(100^60 + 0.5 - 10^120)", "sign(sqrt(2)^2 - 2)", "pinv([1, 2; 2, 4])(1, 1)"}) {
    const model::Gains gains = synthesized(
        std::string("problem: room\nmethod:\n  method: room\n  unknowns: {x: scalar}\n  require: "
                    "{low: \"x > ") +
        least + "\", high: x < 0.6}\n");
    EXPECT_NE(gains.verdict, model::Verdict::no) << least;
  }
}

/// A homogeneous LMI is feasible exactly when A is Hurwitz; the oracle is the eigenvalues.
TEST(SynthesizeTest, LyapunovDecidesStability) {
  std::mt19937 generator(5);
  std::normal_distribution<double> number;
  int stable_count = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 2 + trial % 3;
    numbers::Matrix A = numbers::Matrix::NullaryExpr(n, n, [&] { return number(generator); });
    const double abscissa = tests::spectral_abscissa(A);
    const double wanted = trial % 2 == 0 ? -0.2 : 0.2;
    A += (wanted - abscissa) * numbers::Matrix::Identity(n, n);
    const model::Gains found = synthesized(lyapunov(A));
    EXPECT_EQ(found.verdict, wanted < 0 ? model::Verdict::yes : model::Verdict::no) << A;
    if (found.verdict != model::Verdict::yes) {
      ASSERT_TRUE(found.certificate);
      EXPECT_TRUE(is_certain(*found.certificate));
      continue;
    }
    ++stable_count;
    const numbers::Matrix& P = *found.find("P");
    EXPECT_GT(tests::symmetric_eigenvalues(P)(0), 0);
    const numbers::Matrix PA = tests::product({P, A});
    EXPECT_LT(tests::symmetric_eigenvalues(PA + PA.transpose()).maxCoeff(), 0);
  }
  EXPECT_EQ(stable_count, 10);
}

/// The certificate of an infeasible problem, recomputed here from the text: Y_1 = He(A Y_2) up to
/// the rounding of its 17 digits, Y_1, Y_2 >= 0, not both zero.
TEST(SynthesizeTest, TheStoredMultipliersProveInfeasibility) {
  numbers::Matrix A(2, 2);
  A << 0.1, 1, -1, 0.1;
  const model::Gains found = synthesized(lyapunov(A));
  ASSERT_EQ(found.verdict, model::Verdict::no);
  ASSERT_TRUE(found.certificate);
  const auto& multipliers = found.certificate->multipliers;
  ASSERT_EQ(multipliers.size(), 2U);
  const numbers::Matrix& Y1 = multipliers[0].second;
  const numbers::Matrix& Y2 = multipliers[1].second;
  for (const numbers::Matrix* Y : {&Y1, &Y2})
    EXPECT_GE(tests::symmetric_eigenvalues(*Y)(0), -1e-12);
  const double size = Y1.trace() + Y2.trace();
  EXPECT_GT(size, 1e-3);
  const numbers::Matrix moved = tests::product({A, Y2}) + tests::product({Y2, A.transpose()});
  EXPECT_LT((Y1 - moved).norm(), 1e-6 * size);
}

/// H-infinity norm by the bounded-real lemma against a frequency sweep.
TEST(SynthesizeTest, TheBoundedRealLemmaGivesThePeakGain) {
  const model::Gains found = synthesized(
      "problem: hinf\nmethod:\n  method: bounded-real\n  data: {A: n x n, B: n x m, C: p x n}\n"
      "  unknowns: {P: symmetric n, g: scalar}\n  require:\n    positive: P > 0\n"
      "    gain: \"[He(P*A) + C'*C, P*B; *, -g*I] < 0\"\n  minimize: g\n"
      "data: {A: [[0, 1], [-4, -0.4]], B: [[0], [1]], C: [[1, 0]]}\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes);
  double peak = 0;
  for (int i = 0; i <= 200000; ++i) {
    const double w = 4.0 * i / 200000;
    peak = std::max(peak, 1 / std::hypot(4 - w * w, 0.4 * w));
  }
  EXPECT_NEAR(*found.objective, peak * peak, 1e-5 * peak * peak);
  EXPECT_LE(*found.objective_lower_bound, *found.objective);
  EXPECT_GE(*found.objective, peak * peak * (1 - 1e-9));
}

/// trace(P) has the infimum 0, which is not attained.
TEST(SynthesizeTest, AnObjectiveWithoutConstantsHasNoMinimum) {
  const model::Gains found = synthesized(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0, stable: He(P*A) < 0}\n  minimize: trace(P)\n"
      "data: {A: [[-1, 5], [0, -2]]}\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes);
  EXPECT_FALSE(found.objective);
  EXPECT_FALSE(found.objective_lower_bound);
  EXPECT_NE(found.solver.message.find("the objective was not used"), std::string::npos);
  for (const model::Margin& margin : found.margins) EXPECT_GT(margin.reached, margin.required);
}

TEST(SynthesizeTest, FeasibilityWithConstantDataIsDecidedBothWays) {
  const auto problem = [](const std::string& bound) {
    return "problem: p\nmethod:\n  method: m\n  data: {A: n x n, k: scalar}\n  unknowns: {P: "
           "symmetric n}\n"
           "  require: {box: I <= P, top: P <= k*I, stable: He(P*A) + I < 0}\n"
           "data: {A: [[-0.1, 0], [0, -2]], k: " +
           bound + "}\n";
  };
  // P11 > 5 is needed.
  EXPECT_EQ(synthesized(problem("5.5")).verdict, model::Verdict::yes);
  const model::Gains tight = synthesized(problem("4.5"));
  EXPECT_EQ(tight.verdict, model::Verdict::no);
  ASSERT_TRUE(tight.certificate);
  EXPECT_TRUE(is_certain(*tight.certificate));
  EXPECT_TRUE(tight.gains.empty());
}

/// The optimum lies on the boundary of one inequality alone; the solver's tolerance must not spoil
/// the verdict.
TEST(SynthesizeTest, ScalarInequalitiesThatHoldWithEqualityAreKept) {
  for (const char* relation : {"g >= 1", "g > 1", "-g <= -1", "3*g >= 3"}) {
    const model::Gains found = synthesized(
        std::string("problem: p\nmethod:\n  method: m\n  data: {a: scalar}\n  unknowns: {g: "
                    "scalar}\n  require: {bound: ") +
        relation + "}\n  minimize: a*g\ndata: {a: 2}\n");
    EXPECT_EQ(found.verdict, model::Verdict::yes) << relation << ": " << found.solver.message;
    ASSERT_TRUE(found.objective);
    EXPECT_NEAR(*found.objective, 2, 1e-5);
  }
}

/// u = K x for x' = a x + u, the gain being below -a; `more`: of the problem.
model::Gains feedback(const std::string& a, const std::string& more = "") {
  return synthesized(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, B: n x m}\n  unknowns: {P: symmetric "
      "n, "
      "Y: m x n}\n  require: {p: P > 0, s: He(A*P + B*Y) < 0}\n  gains: {K: Y*inv(P)}\n"
      "data: {A: [[" +
      a + "]], B: [[1]]}\n" + more);
}

/// What only the bound on the gain excludes is no "no".
TEST(SynthesizeTest, OnlyTheProblemItselfMakesItInfeasible) {
  EXPECT_EQ(feedback("1000", "synthesis: {gain_bound: none}\n").verdict, model::Verdict::yes);
  const model::Gains bounded = feedback("1000", "synthesis: {gain_bound: 10}\n");
  EXPECT_EQ(bounded.verdict, model::Verdict::undecided);
  EXPECT_GT(bounded.bound_only.value(), 1000);
  EXPECT_NE(bounded.solver.message.find("gain bound 10"), std::string::npos)
      << bounded.solver.message;
}

/// The default is in balanced units: the same plant in other units of time has the same answer.
TEST(SynthesizeTest, TheDefaultBoundIsInNoUnits) {
  const model::Gains slow = feedback("1");
  const model::Gains fast = feedback("2^20");
  EXPECT_EQ(fast.verdict, model::Verdict::yes);
  EXPECT_EQ((*fast.find("K"))(0, 0), std::ldexp((*slow.find("K"))(0, 0), 20));
  EXPECT_EQ(fast.solver.message, slow.solver.message);
}

/// Numbers at the end of the range of double are no certificate and no fault.
TEST(SynthesizeTest, WhatDoubleCannotBoundExcludesNothing) {
  const auto pair = [](const std::string& require) {
    return synthesized(
               "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar, y: scalar}\n  require: "
               "{" +
               require + "}\n")
        .verdict;
  };
  for (const char* feasible :
       {"a: x >= 1, b: 1e-324*y >= x", "a: x >= 1, b: 1e-320*y >= x",
        "a: x >= 1, b: 1e-200*1e-200*y >= x", "a: x > 0, b: x < 1e-324, c: y > 0",
        "a: x > 0, b: x < 1e-308, c: y > 0"})
    EXPECT_NE(pair(feasible), model::Verdict::no) << feasible;
  EXPECT_NE(pair("a: x <= 0, b: x >= 1e-308, c: y > 0, d: y <= 1"), model::Verdict::yes);
  // Tiny coefficients beside others are as good as any.
  EXPECT_EQ(pair("a: x + 1e-300*y > 1, b: x < 0, c: y < 1, d: y > -1"), model::Verdict::no);
}

/// The coefficient vanishes where tau is 0.893, which is no double.
TEST(SynthesizeTest, AKinkAtADecimalIsMet) {
  const model::Gains found = synthesized(
      "problem: kink\nmethod:\n  method: kink\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require:\n    positive: P > 0\n"
      "    decrease: {forall: \"tau in [0, 1.786]\", that: \"He(P*abs(tau - 0.893)*A) < 0\"}\n"
      "data: {A: [[-1.27]]}\n");
  EXPECT_EQ(found.verdict, model::Verdict::no) << found.solver.message;
}

/// The size of a solution is no reason: these are far from 1 and stand in units of their own.
TEST(SynthesizeTest, LargeSolutionsAreFound) {
  const model::Gains far = synthesized(
      "problem: p\nmethod: {method: m, data: {a: scalar}, unknowns: {x: scalar}, require: {a: x >= "
      "1, b: 1e-8*x >= a}}\n"
      "data: {a: 1}\n");
  EXPECT_EQ(far.verdict, model::Verdict::yes) << far.solver.message;
  EXPECT_GE((*far.find("x"))(0, 0), 1e8);
  const model::Gains found = synthesized(
      "problem: p\nmethod: {method: m, data: {A: n x n}, unknowns: {P: symmetric n}, require: {p: "
      "P >= 0, s: He(P*A) + I <= 0},\n"
      "  minimize: trace(P)}\ndata: {A: [[-1e-9, 1], [-1, -1e-9]]}\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes) << found.solver.message;
  // P = 5e8 I, and nothing smaller.
  EXPECT_NEAR(*found.objective, 1e9, 1e3);
}

/// Without unknowns the data decide: exp(-k tau) sin(tau) reaches its peak at tan(tau) = 1/k, which
/// is exp(-pi/4)/sqrt(2) = 0.32240 for k = 1.
TEST(SynthesizeTest, AMethodMayHaveNoUnknowns) {
  for (const char* minimize : {"", "  minimize: 3\n"}) {
    for (const double bound : {0.3225, 0.3223}) {
      const model::Gains found = synthesized(
          "problem: peak\nmethod:\n  method: peak\n  data: {bound: scalar}\n  require:\n"
          "    below: {forall: \"tau in [0, 2]\", that: \"exp(-tau)*sin(tau) < bound\"}\n" +
          std::string(minimize) + "data: {bound: " + std::to_string(bound) + "}\n");
      EXPECT_EQ(found.verdict, bound > 0.3224 ? model::Verdict::yes : model::Verdict::no);
    }
  }
}

TEST(SynthesizeTest, TheZeroSolutionIsRefused) {
  const InputError error = tests::input_error([] {
    synthesized(
        "problem: p\nmethod: {method: m, data: {A: n x n}, unknowns: {P: symmetric n}, require: "
        "{p: P >= 0, s: He(P*A) <= 0}}\n"
        "data: {A: [[-1, 0], [0, -1]]}\n");
  });
  EXPECT_NE(error.message().find("0 is a solution"), std::string::npos);
}

/// He(P*A) <= 0 has no interior for an oscillator: only P = p diag(3, 1) satisfies it, which a
/// certificate must not exclude.
TEST(SynthesizeTest, WhatHoldsWithoutInteriorIsNotRefuted) {
  const model::Gains found = synthesized(
      "problem: p\nmethod: {method: m, data: {A: n x n}, unknowns: {P: symmetric n}, require: {p: "
      "P > 0, s: He(P*A) <= 0}}\n"
      "data: {A: [[0, 1], [-3, 0]]}\n");
  EXPECT_NE(found.verdict, model::Verdict::no) << found.solver.message;
  EXPECT_FALSE(found.certificate && is_certain(*found.certificate));
}

TEST(SynthesizeTest, AScalarThatCostsNothingMayFillABlock) {
  const model::Gains found = synthesized(
      "problem: p\nmethod: {method: m, data: {A: n x n}, unknowns: {P: symmetric n, g: scalar}, "
      "require: {p: P > A, s: g > 1},\n"
      "  minimize: trace(P)}\ndata: {A: [[1, 1], [1, 3]]}\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes) << found.solver.message;
  EXPECT_GT((*found.find("g"))(0, 0), 1);
  EXPECT_NEAR(*found.objective, 4, 1e-5);
}

TEST(SynthesizeTest, FunctionsOfTauBeyondDoubleAreRefused) {
  const InputError error = tests::input_error([] {
    synthesized(
        "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n  "
        "require:\n"
        "    p: {forall: \"tau in [0, 10]\", that: exp(1000*tau)*P > A}\n  minimize: "
        "trace(P)\ndata: {A: [[1, 1], [1, 3]]}\nsynthesis: {forall: hull}\n");
  });
  EXPECT_NE(error.message().find("too large for double"), std::string::npos);
}

TEST(SynthesizeTest, OfAnUnboundedObjectiveAPointIsGiven) {
  const model::Gains found = synthesized(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {top: P < A}\n  minimize: trace(P)\ndata: {A: [[1, 0], [0, 1]]}\n");
  EXPECT_EQ(found.verdict, model::Verdict::yes);
  EXPECT_FALSE(found.objective_lower_bound);
  EXPECT_NE(found.solver.message.find("unbounded"), std::string::npos) << found.solver.message;
}

/// With w'A = phi w', phi the golden ratio: |Y w| >= (phi/w'B) |w|^2, so that |Y| >= sqrt(5). The
/// multipliers of the optimum are multiples of w w', which has no interior and no fractions.
TEST(SynthesizeTest, AnOptimumOnAnIrrationalEigenvectorIsShownByACertificate) {
  const model::Gains found = synthesized(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, B: n x m}\n"
      "  unknowns: {P: symmetric n, Y: m x n}\n"
      "  require: {pos: P > I, stab: He(A*P + B*Y) < 0}\n"
      "  minimize: \"sum(j in 1..n, abs(Y(1, j)))\"\n"
      "data: {A: [[0, 1], [1, 1]], B: [[0], [1]]}\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes);
  EXPECT_EQ(found.solver.status, "optimal");
  EXPECT_NEAR(*found.objective, std::sqrt(5), 3e-6);
  ASSERT_TRUE(found.objective_lower_bound);
  EXPECT_LE(*found.objective_lower_bound, std::sqrt(5) * (1 + 1e-15));
  EXPECT_GE(*found.objective_lower_bound, std::sqrt(5) * (1 - 3e-6));
  EXPECT_TRUE(found.optimum_multipliers.empty());
}

/// Multiplying the weights scales the solution and nothing else.
TEST(SynthesizeTest, GainsDoNotDependOnTheUnitsOfTheCost) {
  const auto gain = [](const std::string& weight) {
    const model::Gains found = synthesized(
        "problem: p\nmethod: sampled-data-hybrid\n"
        "data: {A: [[0.2, -1.01], [1, 0]], C: [[0.5, -1]], T1: 0.5, T2: 0.7, QF: " +
        weight + "*I, QJ: 0.01*" + weight + "*I}\nparameters: {delta: 0.03, a1: 100, a2: 1}\n");
    EXPECT_EQ(found.verdict, model::Verdict::yes) << weight;
    const numbers::Matrix* L = found.find("L");
    return L == nullptr ? numbers::Matrix(numbers::Matrix::Zero(2, 1)) : *L;
  };
  const numbers::Matrix one = gain("1");
  EXPECT_NEAR(one(1, 0), -1.6787, 1e-3);
  for (const char* weight : {"1e-4", "1e4"}) EXPECT_LT((gain(weight) - one).norm(), 1e-2);
}

/// x wants to be large in both gains; each stops at its own bound, in its own units.
TEST(SynthesizeTest, GainsStopAtTheirOwnBounds) {
  const std::string method =
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar, y: scalar, z: scalar}\n"
      "  require: {a: x < 1e6, b: y < 1e6, c: z < 7}\n  minimize: -x - y - z\n"
      "  gains: {L: x, H: y, F: z}\n";
  const tests::YamlProblem yaml(method + "synthesis: {gain_bound: {L: 0.25, H: 3}}\n");
  const model::Gains gains = synthesize(yaml.instance, {});
  EXPECT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.gains[0].second(0), 0.25, 1e-6);
  EXPECT_NEAR(gains.gains[1].second(0), 3, 1e-5);
  EXPECT_NEAR(gains.gains[2].second(0), 7, 1e-5);
  EXPECT_LE(gains.gains[0].second(0), 0.25);
  EXPECT_LE(gains.gains[1].second(0), 3);
  const InputError error = tests::input_error(
      [&] { tests::YamlProblem other(method + "synthesis: {gain_bound: {K: 1}}\n"); });
  EXPECT_NE(error.message().find("has no gain 'K'"), std::string::npos) << error.message();
}

TEST(SynthesizeTest, TheSameProblemGivesTheSameBits) {
  const std::string text =
      "problem: p\nmethod: output-predictor\ndata: {A: [[0.2, -1.01], [1, 0]], C: [[0.5, -1]], T1: "
      "0.5, T2: 0.6, QF: I}\n"
      "parameters: {a1: 1}\n";
  const model::Gains first = synthesized(text);
  const model::Gains second = synthesized(text);
  EXPECT_EQ(first.verdict, model::Verdict::yes);
  ASSERT_EQ(first.gains.size(), second.gains.size());
  for (std::size_t i = 0; i < first.gains.size(); ++i)
    EXPECT_EQ(first.gains[i].second, second.gains[i].second);
}

/// A plant with two outputs: every size that is 1 x 1 in the published example is not so here.
TEST(SynthesizeTest, MethodsWorkForSeveralOutputs) {
  for (const char* method :
       {"sampled-data-hybrid", "sampled-data-hybrid-from-t1", "output-predictor"}) {
    const model::Gains found =
        synthesized(std::string("problem: p\nmethod: ") + method +
                    "\ndata: {A: [[0, 1, 0], [-1, -0.1, 0.3], [0, 0.2, -0.5]], C: "
                    "[[1, 0, 0], [0, 0, 1]], T1: 0.1, T2: 0.3, QF: I}\n"
                    "parameters: {a1: 1}\n");
    EXPECT_EQ(found.verdict, model::Verdict::yes) << method << ": " << found.solver.message;
    ASSERT_NE(found.find("H"), nullptr) << method;
    EXPECT_EQ(found.find("H")->rows(), 2);
  }
}

TEST(SynthesizeTest, AnalysisOfGoodGainsSucceedsAndOfBadOnesGivesThemBack) {
  const auto analyse = [](const std::string& L) {
    return synthesized(
        "problem: p\nmethod: zero-order-hold\n"
        "data: {A: [[-1, 0.2], [0, -2]], C: [[1, 0]], T1: 0.1, T2: 0.2, L: " +
        L + "}\nparameters: {delta: 0.5, eta: 0.1}\n");
  };
  const model::Gains good = analyse("[0.1, 0]");
  EXPECT_EQ(good.verdict, model::Verdict::yes) << good.solver.message;
  const model::Gains bad = analyse("[-50, 0]");
  EXPECT_EQ(bad.verdict, model::Verdict::no) << bad.solver.message;
  ASSERT_NE(bad.find("L"), nullptr);
  EXPECT_EQ((*bad.find("L"))(0, 0), -50);
}

/// States in bad units: the largest margin is the same as in good ones.
TEST(SynthesizeTest, UnitsDoNotMatter) {
  for (const char* A : {"[[-1, 300], [0, -1]]", "[[-1, 32000], [0, -1]]",
                        "[[-1, 1e8], [-1e-8, -1]]", "[[-1, 1e7, 0], [0, -1, 1e7], [0, 0, -1]]"}) {
    const model::Gains found = synthesized(
        std::string("problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: "
                    "symmetric n}\n  require: {pos: P > 0, l: He(P*A) < 0}\ndata: {A: ") +
        A + "}\n");
    ASSERT_EQ(found.verdict, model::Verdict::yes) << A << ": " << found.solver.message;
    for (const model::Margin& margin : found.margins) EXPECT_GT(margin.reached, 0.01) << A;
  }
}

}  // namespace
}  // namespace gainsmith::design
