// Unknowns that are functions of a scalar: coefficients, definition, refusals.
#include "model/function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "bind/binding.h"
#include "bind/small_problem.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "support/input_error.h"

namespace gainsmith::model {
namespace {

using bind::changed;
using bind::kSmallMethod;
using bind::kSmallProblem;
using bind::Small;
using tests::input_error;

std::string with_function(const std::string& declaration) {
  return changed(kSmallMethod, "X: n x m", "X: " + declaration);
}

/// "X(t)" of the design at t, or another text, the function and its coefficients given.
numbers::Matrix value_at(const Small& small, const Function& function,
                         const std::vector<numbers::Matrix>& coefficients, double t,
                         const std::string& text = "X(t)") {
  expr::Scope scope = small.design().names->design;
  scope.symbols["t"] = {};
  numbers::Values values = small.instance.values;
  values["t"] = numbers::Matrix::Constant(1, 1, t);
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    values[coefficient_name("X", k)] = coefficients[k];
  const expr::Program call = expr::compile(expr::parse({text, "test"}), scope);
  return numbers::evaluate(Bodies({function}).link(call), values);
}

TEST(UnknownFunction, IsThePolynomialOfItsCoefficients) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> draw(-2, 2);
  for (int degree = 0; degree <= 4; ++degree) {
    const Small small(
        kSmallProblem,
        with_function("{shape: n x m, of: tau, degree: " + std::to_string(degree) + "}"));
    std::vector<numbers::Matrix> coefficients;
    for (int k = 0; k <= degree; ++k)
      coefficients.push_back(numbers::Matrix::NullaryExpr(2, 1, [&] { return draw(random); }));
    for (const double t : {-1.5, 0.0, 0.3, 2.0}) {
      numbers::Matrix expected = numbers::Matrix::Zero(2, 1);
      for (std::size_t k = coefficients.size(); k-- > 0;) expected = expected * t + coefficients[k];
      const Function function = polynomials(small.design()).at(0);
      EXPECT_TRUE(value_at(small, function, coefficients, t).isApprox(expected, 1e-14)) << degree;
    }
  }
}

/// X(t) = sum_k C_k cos(k acos x), x = t over [0, T2] brought to [-1, 1].
TEST(UnknownFunction, HasChebyshevPolynomialsOnItsInterval) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> draw(-2, 2);
  for (const int degree : {0, 1, 2, 5, 30}) {
    const Small small(kSmallProblem, with_function("{shape: n x m, of: tau, in: [0, T2], degree: " +
                                                   std::to_string(degree) + "}"));
    const double T2 = small.instance.values.at("T2")(0, 0);
    const Function function = polynomials(small.design()).at(0);
    std::vector<numbers::Matrix> coefficients;
    for (int k = 0; k <= degree; ++k)
      coefficients.push_back(numbers::Matrix::NullaryExpr(2, 1, [&] { return draw(random); }));
    for (const double part : {0.0, 0.1, 0.5, 0.77, 1.0}) {
      numbers::Matrix expected = numbers::Matrix::Zero(2, 1);
      for (std::size_t k = 0; k < coefficients.size(); ++k)
        expected += std::cos(static_cast<double>(k) * std::acos(2 * part - 1)) * coefficients[k];
      EXPECT_TRUE(value_at(small, function, coefficients, part * T2).isApprox(expected, 1e-12))
          << degree << ": " << part;
    }
  }
}

/// Against the slope of a chord, which is off by the square of its width.
TEST(UnknownFunction, HasADerivative) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-2, 2);
  for (const std::string in : {"", "in: [T1/2, T2], "})
    for (const int degree : {0, 1, 2, 4}) {
      const Small small(kSmallProblem, with_function("{shape: n x m, of: tau, " + in +
                                                     "degree: " + std::to_string(degree) + "}"));
      const Function function = polynomials(small.design()).at(0);
      std::vector<numbers::Matrix> coefficients;
      for (int k = 0; k <= degree; ++k)
        coefficients.push_back(numbers::Matrix::NullaryExpr(2, 1, [&] { return draw(random); }));
      const auto at = [&](double t, const std::string& text) {
        return value_at(small, function, coefficients, t, text);
      };
      constexpr double kHalf = 1e-4;
      for (const double t : {0.3, 1.1}) {
        const numbers::Matrix slope = (at(t + kHalf, "X(t)") - at(t - kHalf, "X(t)")) / (2 * kHalf);
        EXPECT_LE((at(t, "derivative(X)(t)") - slope).norm(), 1e-5 * (1 + slope.norm()))
            << in << degree << ": " << t;
      }
    }
}

TEST(UnknownFunction, OnlyAnUnknownHasADerivative) {
  const auto message = [](const std::string& text) {
    return input_error([&] {
             Small(kSmallProblem, changed(with_function("{shape: n x m, of: tau, degree: 1}"),
                                          "K: b'*P", "K: " + text));
           })
        .message();
  };
  EXPECT_NE(message("derivative(P)(T1)*P").find("'P' is no unknown function"), std::string::npos);
  EXPECT_NE(message("derivative(X)").find("is written derivative(P)(s)"), std::string::npos);
  EXPECT_NE(message("\"derivative(X)(T1, 2)\"").find("is written derivative(P)(s)"),
            std::string::npos);
}

TEST(UnknownFunction, OnlyAPolynomialHasADerivative) {
  const Small small(kSmallProblem, with_function("{shape: n x m, of: tau, degree: 1}"));
  const expr::Program slope =
      expr::compile(expr::parse({"derivative(X)(T1)", "slope"}), small.design().names->design);
  Bodies bodies(polynomials(small.design()));
  EXPECT_NO_THROW(bodies.link(slope));
  bodies.set("X", expr::Body{});
  const InputError error = input_error([&] { bodies.link(slope); });
  EXPECT_NE(error.message().find("the derivative(X) is not known"), std::string::npos);
  EXPECT_EQ(error.place().file, "slope");
}

TEST(UnknownFunction, ItsIntervalHasALength) {
  const std::string text = with_function("{shape: n x m, of: tau, in: [T1, T1], degree: 1}");
  EXPECT_NE(input_error([&] { Small(kSmallProblem, text); }).message().find("X"),
            std::string::npos);
}

TEST(UnknownFunction, ItsCoefficientsStandInItsPlaceAmongTheUnknowns) {
  const Small small(kSmallProblem, with_function("{shape: symmetric n, of: tau, degree: m + 1}"));
  const auto structure = Structure::symmetric;
  const std::vector<Function> functions = polynomials(small.design());
  EXPECT_EQ(unknown_matrices(small.design(), functions),
            (std::vector<UnknownMatrix>{{"P", {2, 2}, structure},
                                        {"X_0", {2, 2}, structure},
                                        {"X_1", {2, 2}, structure},
                                        {"X_2", {2, 2}, structure},
                                        {"g", {1, 1}, Structure::scalar}}));
  ASSERT_EQ(functions.size(), 1U);
  EXPECT_EQ(functions[0].signature(), "X(tau)");
  EXPECT_EQ(functions[0].text(), "X_0 + X_1*tau + X_2*tau^2");
  EXPECT_EQ(functions[0].text(), polynomial_text("X", "tau", 2));
}

TEST(UnknownFunction, TheDegreeMayUseDataAndParametersAndIs0Without) {
  const Small from_data(kSmallProblem,
                        with_function("{shape: n x m, of: tau, degree: 2*T2 + rate}"));
  EXPECT_EQ(polynomials(from_data.design()).at(0).size(), 4U);
  const Small without(kSmallProblem, with_function("{shape: n x m, of: tau}"));
  EXPECT_EQ(polynomials(without.design()).at(0).text(), "X_0");
}

/// A basis in place of the declared polynomial: weights of two vertices.
Function weighted(const Function& polynomial) {
  const auto weight = [&](const std::string& text) {
    expr::Scope scope;
    scope.symbols[polynomial.variable] = {};
    return expr::compile(expr::parse({text, "test"}), scope);
  };
  Function result = polynomial;
  result.basis = {
      Basis::Kind::weights, {weight("1 - tau"), weight("tau")}, {"(1 - tau)", "(tau)"}, {}};
  return result;
}

TEST(UnknownFunction, MayHaveAnotherBasis) {
  const Small small(kSmallProblem, with_function("{shape: n x m, of: tau, degree: 3}"));
  const Function function = weighted(polynomials(small.design()).at(0));
  EXPECT_EQ(function.text(), "(1 - tau)*X_0 + (tau)*X_1");
  EXPECT_EQ(unknown_matrices(small.design(), {function}),
            (std::vector<UnknownMatrix>{{"P", {2, 2}, Structure::symmetric},
                                        {"X_0", {2, 1}},
                                        {"X_1", {2, 1}},
                                        {"g", {1, 1}, Structure::scalar}}));
  const numbers::Matrix a{{1}, {2}};
  const numbers::Matrix b{{5}, {7}};
  EXPECT_TRUE(value_at(small, function, {a, b}, 0.25).isApprox(0.75 * a + 0.25 * b, 1e-15));
}

/// The body and the text of a function are the same.
TEST(UnknownFunction, ItsTextIsItsBody) {
  const Small small(kSmallProblem, with_function("{shape: n x m, of: tau, degree: 3}"));
  const Function polynomial = polynomials(small.design()).at(0);
  const Small other(kSmallProblem,
                    with_function("{shape: n x m, of: tau, in: [-1, T2/3], degree: 3}"));
  const Function chebyshev = polynomials(other.design()).at(0);
  EXPECT_EQ(chebyshev.text(),
            "X_0 + X_1*chebyshev(1, tau, -1, T2/3) + X_2*chebyshev(2, tau, -1, T2/3) + "
            "X_3*chebyshev(3, tau, -1, T2/3)");
  for (const Function& function : {polynomial, weighted(polynomial), chebyshev}) {
    expr::Scope scope = small.design().names->known;
    scope.symbols[function.variable] = {};
    for (const std::string& coefficient : function.coefficients())
      scope.symbols[coefficient] = {function.shape};
    const expr::Program text = expr::compile(expr::parse({function.text(), "test"}), scope);
    numbers::Values values = small.instance.values;
    values[function.variable] = numbers::Matrix::Constant(1, 1, 0.3);
    for (std::size_t k = 0; k < function.size(); ++k)
      values[coefficient_name("X", k)] = numbers::Matrix{{0.1 + static_cast<double>(k)}, {-0.7}};
    EXPECT_EQ(numbers::evaluate(text, values), numbers::evaluate(function.body().program, values))
        << function.text();
  }
}

TEST(UnknownFunction, IsACallUntilItIsLinked) {
  const Small small(kSmallProblem, changed(with_function("{shape: n x m, of: tau, degree: 3}"),
                                           "K: b'*P", "K: X(T1)'*P"));
  const expr::Program& program = small.design().gains[0].formula.program;
  ASSERT_EQ(program.functions.size(), 1U);
  EXPECT_EQ(program.functions[0].name, "X");
  EXPECT_FALSE(program.uses("X_0"));
  const Bodies bodies(polynomials(small.design()));
  const expr::Program linked = bodies.link(program);
  EXPECT_TRUE(linked.functions.empty());
  EXPECT_TRUE(linked.uses("X_3"));
  EXPECT_THROW(Bodies().link(program), std::logic_error);
}

/// Ends of ranges are known before the unknowns are.
TEST(UnknownFunction, IsNotKnownBeforehand) {
  const auto message = [](const std::string& text, const std::string& from, const std::string& to) {
    const std::string method = with_function("{shape: m x m, of: tau, degree: 1}");
    const bool in_problem = text == "problem";
    return input_error([&] {
             Small(in_problem ? changed(kSmallProblem, from, to) : kSmallProblem,
                   in_problem ? method : changed(method, from, to));
           })
        .message();
  };
  const std::string unknown = "unknown function 'X'";
  EXPECT_EQ(message("method", "[0, T2]", "[0, X(1)]").substr(0, 20), unknown);
  EXPECT_EQ(message("problem", "campaign:", "search: {largest: {T1: [0, X(1)]}}\ncampaign:")
                .substr(0, 20),
            unknown);
  EXPECT_EQ(message("problem", "campaign:", "negotiable: {T1: [0, X(1)]}\ncampaign:").substr(0, 20),
            unknown);
  EXPECT_EQ(message("problem", "trace(P): {value: T1", "trace(P): {value: X(1)").substr(0, 20),
            unknown);
}

/// A box whose ends follow from gains is checked when they are known.
TEST(UnknownFunction, MayStandInTheCampaign) {
  const std::string method = with_function("{shape: m x m, of: tau, degree: 1}");
  EXPECT_NO_THROW(
      Small(changed(kSmallProblem, "{box: [-1, [1, 2]]}", "{box: [-X(1), X(2)]}"), method));
  EXPECT_NO_THROW(Small(changed(kSmallProblem, "first: T1", "first: X(1)"), method));
}

TEST(UnknownFunction, WrongDegreesAreRefusedAtTheirPlace) {
  for (const std::string degree : {"-1", "31", "1/2", "1e300"}) {
    const std::string method = with_function("{shape: n x m, of: tau, degree: " + degree + "}");
    const InputError error = input_error([&] { const Small small(kSmallProblem, method); });
    EXPECT_NE(error.message().find("the degree of X must be a whole number from 0 to 30"),
              std::string::npos)
        << error.what();
    EXPECT_EQ(error.place().line, 13);
    EXPECT_EQ(error.place().column, 63) << degree;
  }
}

TEST(UnknownFunction, NamesOfItsCoefficientsAreTaken) {
  const auto message = [](const std::string& declaration, const std::string& from,
                          const std::string& to) {
    const std::string method = changed(with_function(declaration), from, to);
    return input_error([&] { const Small small(kSmallProblem, method); }).message();
  };
  EXPECT_EQ(message("{shape: n x m, of: tau}", "g: scalar", "g: scalar, X_7: n"),
            "'X_7' is the name of a coefficient of X, which is a function");
  EXPECT_NE(message("{shape: n x m, of: 1t}", "", "").find("'1t' is no name"), std::string::npos);
  EXPECT_NE(message("{shape: n x m, of: exp}", "", "").find("a word of the language"),
            std::string::npos);
  EXPECT_NE(message("{shape: n x m, degree: 1}", "", "").find("only of an unknown that is a"),
            std::string::npos);
  const std::string harmless = changed(with_function("{shape: n x m, of: tau}"), "g: scalar",
                                       "g: scalar, X_: n, X_a: n, X_0_: n");
  EXPECT_EQ(Small(kSmallProblem, harmless).design().unknowns.size(), 6U);
}

}  // namespace
}  // namespace gainsmith::model
