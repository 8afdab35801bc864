#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "bind/stated.h"
#include "design/solve.h"
#include "design/synthesize.h"
#include "expr/binding/compile.h"
#include "expr/program/evaluate.h"
#include "expr/text/parser.h"
#include "model/stated.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

/// The reset observer of a rotation, post-sample form: with y = z1 the samples that are pi apart
/// see the same direction only.
std::string reset_observer(double T2, const std::string& way) {
  return "problem: reset\nmethod:\n  method: reset\n"
         "  data: {A: n x n, C: p x n, T1: scalar, T2: scalar}\n"
         "  unknowns: {P: symmetric n, Z: n x p}\n"
         "  require:\n"
         "    positive: P > 0\n"
         "    step: {forall: \"tau in [T1, T2]\", that: \"[P, ((P - Z*C)*expm(A*tau))'; *, P] > "
         "0\"}\n"
         "  gains: {F: inv(P)*Z}\n"
         "data: {A: [[0, 1], [-1, 0]], C: [[1, 0]], T1: 0.1, T2: " +
         std::to_string(T2) + "}\nsynthesis: {forall: " + way + "}\n";
}

/// No gain contracts at pi, which is no decimal; near it some do, by less than any digits show.
TEST(ForallTest, ExchangeDoesNotAcceptWhatAGridDoesNotSee) {
  for (const char* way : {"exchange", "auto"})
    EXPECT_EQ(synthesized(reset_observer(3.0, way)).verdict, model::Verdict::yes);
  const model::Gains found = synthesized(reset_observer(4.0, "exchange"));
  EXPECT_EQ(found.verdict, model::Verdict::undecided) << found.solver.message;
  EXPECT_FALSE(found.certificate);
}

/// The smallest eigenvalue is least at t = 0, the margin at its largest correlation, t = 0.139.
TEST(ForallTest, TheMarginIsTheSmallestOnTheWholeInterval) {
  const model::Gains found = synthesized(
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n  require:\n    size: 1 < x < 2\n"
      "    sign: {forall: \"t in [0, 1]\", that: \"x*[1, 0.5*t*(1 - t); *, 0.01 + t^3] > 0\"}\n"
      "no campaign: static\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes) << found.solver.message;
  double least = 1;
  for (int i = 0; i <= 100000; ++i) {
    const double t = 1e-5 * i;
    least = std::min(least, 1 - 0.5 * t * (1 - t) / std::sqrt(0.01 + t * t * t));
  }
  const auto margin = std::find_if(found.margins.begin(), found.margins.end(),
                                   [](const model::Margin& each) { return each.name == "sign"; });
  ASSERT_NE(margin, found.margins.end());
  EXPECT_NEAR(margin->reached, least, 1e-9) << margin->worst_point;
}

/// In these units the minima draw on: each fails a little between the points of the exchange.
TEST(ForallTest, AMinimumThatDrawsOnEndsAtAPointNearIt) {
  const model::Gains found = synthesized(
      "problem: p\nmethod: clock-dependent-reset\ndata:\n"
      "  A: [[2.8, -1.08002495835528235252410888671875e-13], [15832967439974.4, -3.7]]\n"
      "  C: [[6710886.4, 4.76837158203125e-7]]\n  T1: 0.4\n  T2: 0.9\n"
      "  QF: [[8796093022208, 0], [0, 8.5265128291212022304534912109375e-14]]\n"
      "  QJ: [[8796093022208, 0], [0, 1.7053025658242404460906982421875e-14]]\n"
      "no campaign: a synthesis alone\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes) << found.solver.message;
  EXPECT_NEAR(*found.objective, 21.170929, 2e-3);
}

TEST(ForallTest, TheWorstPointIsOnTheWholeInterval) {
  const model::Gains found = synthesized(reset_observer(3.0, "exchange"));
  ASSERT_EQ(found.verdict, model::Verdict::yes);
  const numbers::Matrix& P = *found.find("P");
  const numbers::Matrix& Z = *found.find("Z");
  double worst = 1e300;
  for (int i = 0; i <= 2000; ++i) {
    const double tau = 0.1 + 2.9 * i / 2000;
    numbers::Matrix E(2, 2);
    E << std::cos(tau), std::sin(tau), -std::sin(tau), std::cos(tau);
    numbers::Matrix C(1, 2);
    C << 1, 0;
    const numbers::Matrix S = tests::product({P - tests::product({Z, C}), E});
    numbers::Matrix M(4, 4);
    M << P, S.transpose(), S, P;
    worst = std::min(worst, tests::symmetric_eigenvalues(M)(0));
  }
  for (const model::Margin& margin : found.margins) {
    if (margin.name != "step") continue;
    EXPECT_LE(margin.smallest_eigenvalue, worst * (1 + 1e-9));
    EXPECT_NEAR(margin.smallest_eigenvalue, worst, 1e-4 * worst);
  }
}

/// Example 2 of Tran, Bernard, Marconi with constant gains: the unobservable part of a plant whose
/// jumps bring it back. Below: contraction factors to either side of the limit.
std::string detectability(const std::string& interval, double rho, double kappa,
                          const std::string& way) {
  return "problem: example-2\nmethod:\n  method: example-2\n"
         "  data: {F: n x n, H: p x n, rho: scalar, kappa: scalar}\n"
         "  unknowns: {Q: symmetric 2, Y: 2 x 1, K: 2 x 1}\n"
         "  let:\n"
         "    J(tau): expm(F*tau)\n"
         "    S(tau): Q*J(tau) - Y*H*J(tau) - K*[1, 0]*J(tau)\n"
         "  require:\n"
         "    metric: I <= Q <= kappa*I\n"
         "    step: {forall: \"tau in " +
         interval +
         "\", that: \"[rho^2*Q, S(tau)'; *, Q] > 0\"}\n"
         "data: {F: [[0, -2], [2, 0]], H: [[1, 0]], rho: " +
         std::to_string(rho) + ", kappa: " + std::to_string(kappa) +
         "}\nsynthesis: {forall: " + way + "}\n";
}

TEST(ForallTest, ContractionFactorsOfConstantGains) {
  EXPECT_EQ(synthesized(detectability("[0.1, 1.4]", 0.9662, 1e4, "exchange")).verdict,
            model::Verdict::yes);
  EXPECT_EQ(synthesized(detectability("[0.1, 1.4]", 0.9659, 1e4, "exchange")).verdict,
            model::Verdict::no);
  EXPECT_EQ(synthesized(detectability("[0.1, 1.4]", 0.9750, 100, "hull")).verdict,
            model::Verdict::yes);
  const model::Gains box = synthesized(detectability("[0.1, 1.4]", 0.97, 100, "hull"));
  EXPECT_EQ(box.verdict, model::Verdict::undecided);
  EXPECT_NE(box.solver.message.find("hull"), std::string::npos);
  EXPECT_EQ(box.certificate.value().about, "hull");
  EXPECT_TRUE(box.certificate.value().exact);  // of the corners as they are in double
}

TEST(ForallTest, SlicesTightenTheHull) {
  const std::string text = detectability("[0.1, 1.4]", 0.97, 1e4, "{way: hull, slices: 16}");
  EXPECT_EQ(synthesized(text).verdict, model::Verdict::yes);
}

/// Gains at the vertices of the box of (cos 2 tau, sin 2 tau) reach a contraction that constant
/// gains on the same box do not.
TEST(ForallTest, GainsAtTheVerticesOfTheBox) {
  const auto text = [](double rho, const std::string& way) {
    return "problem: example-2\nmethod: detectability\n"
           "data: {F: [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, -2], [0, 0, 2, 0]],\n"
           "  Hc: [[1, 0, 0, 0]], Hd: [[0, 0, 1, 0]], T1: 0.1, T2: 1.4,\n"
           "  J: [[0, 0, 1, 0], [0, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],\n"
           "  Do: [[1, 0], [0, 1], [0, 0], [0, 0]], Dno: [[0, 0], [0, 0], [1, 0], [0, 1]]}\n"
           "parameters: {kappa: 100, rho: " +
           std::to_string(rho) + "}\nsynthesis: {forall: " + way + "}\n";
  };
  EXPECT_EQ(synthesized(text(0.8, "hull")).verdict, model::Verdict::undecided);
  const model::Gains none = synthesized(text(0.3, "vertex_gains"));
  EXPECT_EQ(none.verdict, model::Verdict::undecided);
  EXPECT_EQ(none.certificate.value().about, "vertices");
  EXPECT_NE(none.solver.message.find("only sufficient"), std::string::npos);

  const tests::YamlProblem yaml(text(0.8, "vertex_gains"));
  const model::Gains found = synthesize(yaml.instance, {});
  ASSERT_EQ(found.verdict, model::Verdict::yes) << found.solver.message;
  ASSERT_EQ(found.gain_functions.size(), 1U);
  EXPECT_EQ(found.gain_functions[0].kind, model::GainFunction::Kind::vertices);

  // As an observer evaluates them: the norm of A(tau) in the metric Q is below rho everywhere.
  const model::Stated stated = bind::state(yaml.instance, found);
  expr::Scope scope;
  scope.symbols["s"] = {};
  scope.functions["Ldno"] = {2, 1};
  const auto gain = stated.bodies.link(expr::compile(expr::parse({"Ldno(s)", "test"}), scope));
  const numbers::Matrix U = tests::cholesky_factor(*found.find("Q")).transpose();
  const numbers::Matrix U_inverse = tests::inverse(U);
  for (int i = 0; i <= 500; ++i) {
    const double tau = 0.1 + 1.3 * i / 500;
    numbers::Values values = stated.values;
    values["s"] = numbers::Matrix::Constant(1, 1, tau);
    const numbers::Matrix L = numbers::evaluate(gain, values);
    numbers::Matrix E(2, 2);
    E << std::cos(2 * tau), -std::sin(2 * tau), std::sin(2 * tau), std::cos(2 * tau);
    numbers::Matrix seen(2, 2);  // Jono = [1 0; 0 0] E
    seen << 1, 0, 0, 0;
    const numbers::Matrix row = seen.topRows(1);
    const numbers::Matrix gains =
        tests::product({L, row}) + tests::product({*found.find("Kno"), seen});
    const numbers::Matrix A = tests::product({numbers::Matrix::Identity(2, 2) - gains, E});
    EXPECT_LT(tests::singular_values(tests::product({U, A, U_inverse}))(0), 0.8) << tau;
  }
}

/// x' = (A0 + k A1) x, k in a box or polytope: one P, imposed at the vertices.
TEST(ForallTest, PolytopesAndBoxesAreImposedAtTheirVertices) {
  const auto text = [](const std::string& forall, const std::string& matrix) {
    return "problem: p\nmethod:\n  method: p\n  data: {A1: 2 x 2, A2: 2 x 2}\n"
           "  unknowns: {P: symmetric 2}\n  require:\n    positive: P > 0\n"
           "    stable: {forall: " +
           forall + ", that: \"He(P*" + matrix +
           ") < 0\"}\n"
           "data: {A1: [[0, 1], [-2, -1]], A2: [[0, 1], [-5.8, -1]]}\n";
  };
  EXPECT_EQ(synthesized(text("\"A in conv{A1, A2}\"", "A")).verdict, model::Verdict::yes);
  EXPECT_EQ(synthesized(text("\"A in conv{A1, A2 - [0, 0; 0.1, 0]}\"", "A")).verdict,
            model::Verdict::no);
  EXPECT_EQ(
      synthesized(text("[\"k in [0, 1.9]\", \"s in [0, 2]\"]", "[0, 1; -2 - k*s, -1]")).verdict,
      model::Verdict::yes);
  EXPECT_EQ(synthesized(text("[\"k in [0, 2]\", \"s in [0, 2]\"]", "[0, 1; -2 - k*s, -1]")).verdict,
            model::Verdict::no);
  const std::string square = text("\"A in conv{A1, A2}\"", "A*A");
  EXPECT_NE(tests::input_error([&] { synthesized(square); }).message().find("not affine in A"),
            std::string::npos);
}

/// A wave that equidistant points meet at one phase: what lies between the points of the exchange
/// is bounded.
TEST(ForallTest, AWaveBetweenThePointsIsNotMissed) {
  for (const int k : {48, 96, 144}) {
    const auto found = synthesized(
        "problem: p\nmethod:\n  method: p\n  data: {k: scalar}\n  unknowns: {x: scalar}\n  "
        "require:\n"
        "    below: {forall: \"t in [0, 1]\", that: \"-x < 1 - 0.5*t + cos(2*pi*k*t)\"}\n"
        "  minimize: x\ndata: {k: " +
        std::to_string(k) + "}\nsynthesis: {gain_bound: none, forall: exchange}\n");
    ASSERT_EQ(found.verdict, model::Verdict::yes) << found.solver.message;
    EXPECT_NE(found.solver.message.find("checked between them"), std::string::npos);
    // The last trough is half a period before the end, where 0.5*t has fallen by 1/(4 k).
    EXPECT_NEAR(*found.objective, 0.5 - 0.25 / k, 1e-4);
  }
}

TEST(ForallTest, APoleInTheIntervalIsNoYes) {
  const auto found = synthesized(
      "problem: p\nmethod:\n  method: p\n  unknowns: {x: scalar}\n  require:\n"
      "    above: {forall: \"t in [0, 1]\", that: \"x > 1/(t - 0.3)\"}\n"
      "  minimize: x\nsynthesis: {gain_bound: none, forall: exchange}\n");
  EXPECT_NE(found.verdict, model::Verdict::yes) << found.solver.message;
}

/// At t = 0 equality is left, and just beside it nothing: the point on the face shows where.
TEST(ForallTest, AFaceIsLeftWhereItFailsBetweenThePoints) {
  const auto found = synthesized(
      "problem: p\nmethod:\n  method: p\n  unknowns: {x: scalar}\n  require:\n"
      "    above: {forall: \"t in [0, 1]\", that: \"x >= 1 + 1e-6*(exp(-1e5*t) - exp(-3e5*t))\"}\n"
      "    below: x <= 1\n");
  EXPECT_EQ(found.verdict, model::Verdict::no) << found.solver.message;
}

/// Dependence that no hull takes: the auto way falls back to exchange.
TEST(ForallTest, AnyDependenceOnTheVariable) {
  const auto found = synthesized(
      "problem: p\nmethod:\n  method: p\n  unknowns: {x: scalar}\n  require:\n"
      "    above: {forall: \"t in [0.2, 3]\", that: \"x > sqrt(t)/(1 + t^2)\"}\n"
      "  minimize: x\nsynthesis: {gain_bound: none}\n");
  ASSERT_EQ(found.verdict, model::Verdict::yes) << found.solver.message;
  // The largest value of sqrt(t)/(1 + t^2) is at t = 1/sqrt(3).
  EXPECT_NEAR(*found.objective, std::pow(3, 0.75) / 4, 1e-6);
}

}  // namespace
}  // namespace gainsmith::design
