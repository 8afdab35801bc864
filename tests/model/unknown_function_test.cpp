// Unknowns that are functions of a scalar: coefficients, definition, refusals.
#include "model/unknown_function.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "expr/compile.h"
#include "expr/parser.h"
#include "numbers/real.h"
#include "model/small_problem.h"
#include "support/input_error.h"

namespace gainsmith::model {
namespace {

using tests::input_error;

std::string with_function(const std::string& declaration) {
  return changed(kSmallMethod, "X: n x m", "X: " + declaration);
}

/// "X(t)" of the instance at t, the coefficients given.
numbers::Matrix value_at(const Instance& instance, const std::vector<numbers::Matrix>& coefficients,
                      double t) {
  expr::Scope scope = instance.design_scope();
  scope.symbols["t"] = {expr::Shape{}, std::nullopt};
  numbers::Values values = instance.known_values();
  values["t"] = numbers::Matrix::Constant(1, 1, t);
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    values[coefficient_name("X", k)] = coefficients[k];
  return numbers::evaluate(expr::compile(expr::parse({"X(t)", "test"}), scope), values);
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
      EXPECT_TRUE(value_at(small.instance, coefficients, t).isApprox(expected, 1e-14)) << degree;
    }
  }
}

TEST(UnknownFunction, ItsCoefficientsStandInItsPlaceAmongTheUnknowns) {
  const Small small(kSmallProblem, with_function("{shape: symmetric n, of: tau, degree: m + 1}"));
  const auto structure = Structure::symmetric;
  EXPECT_EQ(small.instance.unknowns,
            (std::vector<UnknownMatrix>{{"P", {2, 2}, structure},
                                        {"X_0", {2, 2}, structure},
                                        {"X_1", {2, 2}, structure},
                                        {"X_2", {2, 2}, structure},
                                        {"g", {1, 1}, Structure::scalar}}));
  ASSERT_EQ(small.instance.functions.size(), 1U);
  EXPECT_EQ(small.instance.functions[0].signature(), "X(tau)");
  EXPECT_EQ(small.instance.functions[0].text, "X_0 + X_1*tau + X_2*tau^2");
}

TEST(UnknownFunction, TheDegreeMayUseDataAndParametersAndIs0Without) {
  const Small from_data(kSmallProblem,
                        with_function("{shape: n x m, of: tau, degree: 2*T2 + rate}"));
  EXPECT_EQ(from_data.instance.functions.at(0).coefficients.size(), 4U);
  const Small without(kSmallProblem, with_function("{shape: n x m, of: tau}"));
  EXPECT_EQ(without.instance.functions.at(0).text, "X_0");
}

TEST(UnknownFunction, CanBeDefinedAnew) {
  Small small(kSmallProblem, with_function("{shape: n x m, of: tau, degree: 3}"));
  redefine(small.instance, "X", 2, "(1 - tau)*X_0 + tau*X_1", {"gains.json"});
  EXPECT_EQ(small.instance.unknowns,
            (std::vector<UnknownMatrix>{{"P", {2, 2}, Structure::symmetric},
                                        {"X_0", {2, 1}},
                                        {"X_1", {2, 1}},
                                        {"g", {1, 1}, Structure::scalar}}));
  const numbers::Matrix a{{1}, {2}};
  const numbers::Matrix b{{5}, {7}};
  EXPECT_TRUE(value_at(small.instance, {a, b}, 0.25).isApprox(0.75 * a + 0.25 * b, 1e-15));
  EXPECT_THROW(redefine(small.instance, "P", 1, "P_0", {}), std::logic_error);
}

TEST(UnknownFunction, ANewDefinitionMustFit) {
  const auto message = [](const std::string& text) {
    Small small(kSmallProblem, with_function("{shape: n x m, of: tau, degree: 1}"));
    return input_error([&] { redefine(small.instance, "X", 2, text, {"g.json"}); }).message();
  };
  EXPECT_NE(message("X_0 + X_2*tau").find("unknown name 'X_2'"), std::string::npos);
  EXPECT_NE(message("X_0'").find("X(tau) is 2 x 1, but 'X_0'' is 1 x 2"), std::string::npos);
  EXPECT_NE(message("X_0 +").find("expected"), std::string::npos);
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
  EXPECT_EQ(Small(kSmallProblem, harmless).instance.unknowns.size(), 6U);
}

}  // namespace
}  // namespace gainsmith::model
