// Jets hold values, slopes and second derivatives at every point of the piece.
#include "numbers/types/jet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {
namespace {

using Wide = MatrixOf<Decimal100>;

expr::Program program_in_t(const std::string& text) {
  expr::Scope scope;
  scope.symbols["t"] = {};
  return expr::compile(expr::parse({text, "test"}), scope);
}

Wide at(const expr::Program& f, const Decimal100& t) {
  ValuesOf<Decimal100> values;
  values["t"] = Wide::Constant(1, 1, t);
  return evaluate<Decimal100>(f, values);
}

void expect_inside(const Enclosed<double>& enclosure, const Wide& exact, const std::string& what) {
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    const Decimal100 apart = abs(Decimal100(exact(i) - Decimal100(enclosure.mid(i))));
    EXPECT_LE(apart, Decimal100(enclosure.rad(i)) * Decimal100(1 + 1e-12) +
                         abs(exact(i)) * Decimal100(1e-20) + Decimal100(1e-20))
        << what << ", element " << i;
  }
}

/// On pieces of many widths; derivatives of the exact function by differences of width 1e-25.
void expect_enclosed(const std::string& text, double low, double high, bool smooth = true) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const expr::Program f = program_in_t(text);
  for (const double part : {1.0, 0.3, 1e-3, 1e-9}) {
    const double a = low + (high - low) * (1 - part) * unit(generator);
    const double b = std::min(high, a + part * (high - low));
    expr::Evaluator<JetAlgebra> evaluator(f);
    const Jet variable = variable_jet(a, b);
    evaluator.set("t", variable);
    const Jet jet = evaluator.run();
    if (part <= 1e-3 && smooth) {
      EXPECT_TRUE(jet.derivative(2).is_known()) << text;
    }
    for (int trial = 0; trial < 3; ++trial) {
      const Decimal100 t = Decimal100(a) + (Decimal100(b) - Decimal100(a)) * unit(generator);
      const Decimal100 h("1e-25");
      const Wide before = at(f, t - h), middle = at(f, t), after = at(f, t + h);
      const std::string what = text + " on [" + std::to_string(a) + ", " + std::to_string(b) + "]";
      expect_inside(jet.value(), middle, "value of " + what);
      expect_inside(jet.derivative(1), (after - before) / Decimal100(2 * h), "slope of " + what);
      expect_inside(jet.derivative(2), (after - 2 * middle + before) / Decimal100(h * h),
                    "bend of " + what);
    }
  }
}

TEST(Jet, SmoothFunctionsOfEveryOperation) {
  const std::string A = "[0.1, 1, 0; -4, -0.7, 2; 0.3, 0, -9]";
  const std::string X = "[1, t; sin(t), 3 + t^2]";
  const std::vector<std::string> texts = {"t",
                                          "t^3 - 2*t",
                                          "1/(1 + t)",
                                          "exp(-3*t)",
                                          "log(1 + t)",
                                          "sqrt(0.5 + t)",
                                          "tanh(2*t)",
                                          "cos(7*t)*sin(3*t)",
                                          "(1 + t)^0.37",
                                          "(1 + t)^-2",
                                          "(1 + t)^t",
                                          "2^(3*t)",
                                          "expm(" + A + "*t)",
                                          "expm(-t*" + A + "')",
                                          "expm(" + A + "*(2 - t^2))",
                                          "expm(" + A + "*t/3)",
                                          "expm(2*(t*" + A + "))",
                                          "expm(" + X + ")",
                                          "inv(" + X + ")",
                                          X + "^3",
                                          "pinv([1; t])",
                                          X + "'*" + X,
                                          "norm([1, t, t^2])",
                                          "trace(" + X + ")",
                                          "[t, 1; 2, 3](1, :)",
                                          "diag([t, t^2])",
                                          "diag(" + X + ")",
                                          "He(" + X + ")/(2 + t)",
                                          "t*ones(2, 2) + t*eye(2)",
                                          "-[t, exp(t)]",
                                          "where(t >= -1, t^2, 1)",
                                          "max(t^2, -1)",
                                          "abs(1 + t)",
                                          "[t, t^2].*[1 - t, exp(t)]",
                                          "[t, 1]./[2 + t, 1 + t^2]",
                                          "[t - 2, t].^5",
                                          "[1 + t, 2 + t].^0.37",
                                          "[1 + t, 2].^[t, t^2]",
                                          "atan2([t, t - 3], [1 + t^2, -t])",
                                          "mod(t + 0.1, 3)",
                                          "mod(-5, 8 + t)",
                                          "floor(t/2 + 0.2)",
                                          "skew([t; t^2; exp(t)])"};
  for (const std::string& text : texts) expect_enclosed(text, 0, 1);
}

/// Kinks and cusps: where a slope or a bend exists it is enclosed, at the kink nothing is claimed.
TEST(Jet, KinksAndCusps) {
  for (const char* text : {"abs(t - 0.3)",
                           "max(t, 1 - 2*t)",
                           "min(t, 0.25)",
                           "clip(5*t, 1, 2)",
                           "where(t > 0.3, 1, 3)*t",
                           "sign(t - 0.6)",
                           "abs(t - 0.3)^0.1",
                           "sqrt(abs(t - 0.3))",
                           "norm([t - 0.3; 2*t - 0.6])",
                           "floor(3*t)",
                           "mod(3*t, 1)",
                           "mod(2, 0.3 + t)",
                           "mod(-3*t, -0.7)",
                           "atan2(t - 0.3, -1)",
                           "atan2(0.3 - t, t - 0.5)",
                           "[t - 0.3, t].^4",
                           "max([t; 1 - t; 0.5])",
                           "sat([t; 2*t], 1)",
                           "complement([t - 0.3; 1], 1)",
                           "norm([1, t; t, 0.5])",
                           "svd([1, t; t, 0.5])"})
    expect_enclosed(text, 0, 1, false);
}

/// The bend of an exponential over a short piece is not far above the true one.
TEST(Jet, BendsAreTight) {
  const expr::Program f = program_in_t("expm([0, 1; -1, 0]*t)");
  expr::Evaluator<JetAlgebra> evaluator(f);
  const Jet variable = variable_jet(20, 20.1);
  evaluator.set("t", variable);
  EXPECT_LE(magnitudes(evaluator.run().derivative(2)).maxCoeff(), 1.3);
}

/// Over a long piece too an element that may be 0 does not widen the others.
TEST(Jet, ElementsThatMayBeZeroDoNotWidenAnExponential) {
  const expr::Program f = program_in_t("expm([0.3, (0.1*3 - 0.3)^2; 0.5, 0.3]*t)");
  expr::Evaluator<JetAlgebra> evaluator(f);
  const Jet variable = variable_jet(0, 2);
  evaluator.set("t", variable);
  EXPECT_LE(magnitudes(evaluator.run().value()).maxCoeff(), 5);
}

}  // namespace
}  // namespace gainsmith::numbers
