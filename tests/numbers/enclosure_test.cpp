// Enclosures hold the true values: those of 100 digits from the same decimals.
#include "numbers/types/enclosure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/number.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/dense/dense.h"
#include "numbers/types/real.h"
#include "numerics/balance.h"

namespace gainsmith::numbers {
namespace {

using Wide = MatrixOf<Decimal100>;

expr::Program program(const std::string& text) {
  expr::Scope scope;
  scope.known = std::make_shared<KnownDoubles>(Values{});
  return expr::compile(expr::parse({text, "test"}), scope);
}

Wide truth(const std::string& text) {
  return evaluate<Decimal100>(program(text), ValuesOf<Decimal100>{});
}

template <class S>
Enclosed<S> enclosed(const std::string& text) {
  return enclose<S>(program(text), EnclosedValues<S>{});
}

template <class S>
bool contains(const Enclosed<S>& found, const Wide& exact) {
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    const Decimal100 apart = abs(Decimal100(as<Decimal100>(found.mid(i)) - exact(i)));
    // 100 digits have errors of their own.
    if (!(apart <=
          Decimal100(found.rad(i)) + abs(exact(i)) * Decimal100(1e-80) + Decimal100("1e-330")))
      return false;
  }
  return found.rows() == exact.rows() && found.cols() == exact.cols();
}

/// The largest radius in units of the largest element's rounding.
template <class S>
double width(const Enclosed<S>& found) {
  const double size = magnitudes<S>(found.mid).maxCoeff();
  return found.rad.maxCoeff() / (unit_roundoff<S>() * std::max(size, 1e-300));
}

/// Matrices as texts of decimals with a few digits, which no binary number holds.
class Texts {
 public:
  explicit Texts(unsigned seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  std::string number(double low, double high) { return brief(uniform(low, high), 7); }
  std::string matrix(int rows, int cols, double shift = 0, const std::vector<double>& units = {}) {
    std::string text = "[";
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < cols; ++j) {
        double value = uniform(-1, 1) + (i == j ? shift : 0);
        if (!units.empty())
          value *= units[static_cast<std::size_t>(i)] / units[static_cast<std::size_t>(j)];
        text += (j > 0 ? ", " : i > 0 ? "; " : "") + brief(value, 7);
      }
    return text + "]";
  }
  std::vector<double> units(int n, double decades) {
    std::vector<double> result;
    for (int i = 0; i < n; ++i) result.push_back(std::pow(10.0, uniform(-decades, decades)));
    return result;
  }

 private:
  std::mt19937 generator_;
};

/// Expressions with A, B square, C wide, v a column, w a positive one and x > 0.
const std::vector<std::string> kShapes = {"A*B - B*A",
                                          "A + B",
                                          "x*A/3",
                                          "A^3",
                                          "A^0",
                                          "inv(A)",
                                          "inv(A)*B",
                                          "pinv(C)",
                                          "pinv(C')",
                                          "expm(A)",
                                          "expm(0.01*A)",
                                          "expm(20*A)",
                                          "expm(-A')",
                                          "exp(4*tanh(A))",
                                          "log(w)",
                                          "sqrt(w)",
                                          "sin(A)",
                                          "cos(10*A)",
                                          "tanh(A)",
                                          "abs(A)",
                                          "sign(A)",
                                          "min(A, B)",
                                          "max(A, B)",
                                          "clip(A, -x, x)",
                                          "where(A > B, A, B)",
                                          "where(A >= B, 1, 0)",
                                          "trace(A)",
                                          "norm(v)",
                                          "norm(A)",
                                          "norm(C)",
                                          "svd(A)",
                                          "svd(C)",
                                          "x^3",
                                          "x^-2",
                                          "x^0.37",
                                          "x^(v(1))",
                                          "A.*B",
                                          "v./w",
                                          "A.^3",
                                          "w.^-2",
                                          "w.^0.37",
                                          "w.^v",
                                          "v - x",
                                          "floor(7*v)",
                                          "mod(5*v, x)",
                                          "mod(v, -x)",
                                          "atan2(A, B)",
                                          "max(v) + min(v)",
                                          "sat(v, x)",
                                          "complement(v, 1)",
                                          "[A, B; C, 7*C](2:3, 2:4)",
                                          "diag(v)*A",
                                          "diag(A)",
                                          "blkdiag(A, 1)",
                                          "He(A*B)",
                                          "ones(2, 3)*x",
                                          "x*I + A",
                                          "pi*A",
                                          "gramian(A, C, B, C, [0.1, 0.2])",
                                          "0*A",
                                          "A - A",
                                          "exp(log(w)) - w",
                                          "sqrt(abs(A - A))",
                                          "abs(x - 0.3)^0.1",
                                          "exp(tanh(A))*1e-200*1e-120"};

std::string written(const std::string& shape, int n, Texts& texts, double decades, double shift) {
  const auto units = texts.units(n, decades);
  const std::string A = texts.matrix(n, n, shift, units), B = texts.matrix(n, n, shift, units);
  const std::string C = texts.matrix(2, n), v = texts.matrix(n, 1);
  const std::string w = "(abs(" + texts.matrix(n, 1) + ") + 0.1*ones(" + std::to_string(n) +
                        ", 1))",
                    x = texts.number(0.1, 2);
  std::string result;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const bool alone =
        (i == 0 || std::isalpha(static_cast<unsigned char>(shape[i - 1])) == 0) &&
        (i + 1 == shape.size() || std::isalpha(static_cast<unsigned char>(shape[i + 1])) == 0);
    const char c = alone ? shape[i] : ' ';
    result += c == 'A'   ? A
              : c == 'B' ? B
              : c == 'C' ? C
              : c == 'v' ? v
              : c == 'w' ? w
              : c == 'x' ? x
                         : std::string(1, shape[i]);
  }
  return result;
}

template <class S>
class EnclosureOf : public testing::Test {};
using Scalars = testing::Types<double, DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(EnclosureOf, Scalars);

TYPED_TEST(EnclosureOf, HoldsTheTruthForEveryOperation) {
  const int trials = std::is_same_v<TypeParam, double> ? 12 : 2;
  for (int trial = 0; trial < trials; ++trial) {
    Texts texts(static_cast<unsigned>(100 + trial));
    for (const std::string& shape : kShapes) {
      const double decades = trial % 4 == 3 ? 6 : 0;
      const std::string text = written(shape, 2 + trial % 4, texts, decades, 2);
      try {
        EXPECT_TRUE(contains(enclosed<TypeParam>(text), truth(text))) << shape << "\n" << text;
      } catch (const expr::EvaluationError& error) {
        ADD_FAILURE() << shape << ": " << error.what();
      }
    }
  }
}

TYPED_TEST(EnclosureOf, RadiiAreThoseOfAFewRoundings) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Texts texts(seed);
    for (const std::string& shape : kShapes) {
      // Differences of equals, zeros and what underflows have no size of their own.
      if (shape.find("- A") != std::string::npos ||
          shape.find("log(w)) - w") != std::string::npos || shape[0] == '0' ||
          shape.find("1e-200") != std::string::npos)
        continue;
      const auto found = enclosed<TypeParam>(written(shape, 3, texts, 0, 3));
      EXPECT_LE(width(found), shape == "expm(20*A)" ? 1e6 : 2e4) << shape;
    }
  }
}

TYPED_TEST(EnclosureOf, BasesAreOrthonormalAndSpan) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Texts texts(seed);
    const std::string C = texts.matrix(2, 4), D = texts.matrix(4, 2);
    for (const std::string& zero :
         {C + "*null(" + C + ")", "null(" + C + ")'*null(" + C + ") - eye(2)",
          "orth(" + D + ")'*orth(" + D + ") - eye(2)",
          "orth(" + D + ")*orth(" + D + ")'*" + D + " - " + D}) {
      const auto found = enclosed<TypeParam>(zero);
      EXPECT_TRUE(contains(found, Wide::Zero(found.rows(), found.cols()))) << zero;
      EXPECT_LE(found.rad.maxCoeff(), 1e4 * unit_roundoff<TypeParam>()) << zero;
    }
  }
}

TYPED_TEST(EnclosureOf, NearSingularMatricesHoldTheTruthOrSayNothing) {
  for (int power = 2; power <= 170; power += 7) {
    const std::string text = "inv([1, 1; 1, 1 + 1e-" + std::to_string(power) + "])";
    Enclosed<TypeParam> found;
    try {
      found = enclosed<TypeParam>(text);
    } catch (const expr::EvaluationError&) {
      ADD_FAILURE() << "a matrix that is not singular: " << text;
      continue;
    }
    if (power <= 2 || found.is_known()) {
      EXPECT_TRUE(found.is_known());
      EXPECT_TRUE(contains(found, truth(text))) << text;
    }
    if (power > 155) {
      EXPECT_FALSE(found.is_known()) << text;
    }
  }
}

TYPED_TEST(EnclosureOf, WhatIsExactHasNoRadius) {
  for (const char* text :
       {"0.5*[1, 2; 3, 4] - 2*I", "[1, 0; 0, 1]*[3, 0.25]'", "He([1, 2; 3, 4])", "abs(-3)", "2^10",
        "zeros(2, 2) + 0.125*I", "max(1, 2)", "[1, 2; 3, 4](2, :)", "sign(0)", "sqrt(0)",
        "expm(zeros(3))", "trace([1, 2; 3, 4])", "norm([0, -3, 0](1, 2))", "-5e-1", "1e3 - 1000"})
    EXPECT_TRUE(enclosed<TypeParam>(text).is_exact()) << text;
  EXPECT_FALSE(enclosed<TypeParam>("0.1").is_exact());
}

TYPED_TEST(EnclosureOf, WhatIsNotCertainIsBothOrNothing) {
  // 0.1 + 0.2 - 0.3 is 0 but for its radius.
  const std::string zero = "(0.1 + 0.2 - 0.3)";
  for (const std::string& text : {"abs" + zero, "sign" + zero, "max(" + zero + ", 0)",
                                  "where(" + zero + " > 0, 3, 5)", "sqrt" + zero, zero + "^0.1"})
    EXPECT_TRUE(
        contains(enclosed<TypeParam>(text), truth("0*" + text + (text[0] == 'w' ? " + 5" : ""))))
        << text;
  for (const std::string& text :
       {"1/" + zero, "log" + zero, zero + "^-2", "inv(" + zero + "*eye(2))"})
    EXPECT_FALSE(enclosed<TypeParam>(text).is_known()) << text;
}

TEST(Enclosure, DecimalsOfTheScalar) {
  for (const char* exact :
       {"0", "1", "-3", "0.5", "1.25", "9007199254740991", "1e15", "25e-2", "0.0", "4.50"})
    EXPECT_TRUE(is_exact_decimal(exact)) << exact;
  for (const char* rounded : {"0.1", "1e-3", "9007199254740993", "1e16", "0.3", "1e-400", "pi"})
    EXPECT_FALSE(is_exact_decimal(rounded)) << rounded;
}

TEST(Enclosure, RandomSumsOfEnclosedInputsHoldEveryPoint) {
  Texts texts(7);
  for (int trial = 0; trial < 200; ++trial) {
    const double r = std::pow(10.0, texts.uniform(-12, 0));
    const Matrix mid = Matrix::NullaryExpr(3, 3, [&] { return texts.uniform(-1, 1); });
    const Matrix inside = mid + Matrix::NullaryExpr(3, 3, [&] { return r * texts.uniform(-1, 1); });
    expr::Scope scope;
    scope.symbols["A"] = {{3, 3}, true};
    for (const char* text :
         {"A*A", "expm(A)", "inv(A + 4*I)", "sin(A)", "exp(4*tanh(A))", "sqrt(abs(A))",
          "tanh(A)*A'", "norm(A)", "svd(A)", "max(A, 0.1)", "abs(A)^2", "A/(3 + A(1, 2))",
          "(2 + A(1, 1))^(A(2, 2))", "log(A(1, 1) + 3)"}) {
      const auto compiled = expr::compile(expr::parse({text, "test"}), scope);
      EnclosedValues<double> values;
      values["A"] = {mid, Matrix::Constant(3, 3, r)};
      ValuesOf<Decimal100> point;
      point["A"] = inside.cast<Decimal100>();
      EXPECT_TRUE(
          contains(enclose<double>(compiled, values), evaluate<Decimal100>(compiled, point)))
          << text << " radius " << r;
    }
  }
}

/// Units that are powers of two change no digit of an exponential.
TEST(Balance, UnitsDoNotChangeADigit) {
  Texts texts(11);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 1 + trial % 6;
    Matrix A = Matrix::NullaryExpr(n, n, [&] {
      return texts.uniform(0, 1) < 0.35
                 ? 0
                 : std::floor(texts.uniform(-9, 9)) / (trial % 2 == 0 ? 1 : 3);
    });
    const Matrix expected = exponential(A);
    EnclosedValues<double> values;
    for (int other = 0; other < 5; ++other) {
      std::vector<int> units;
      for (int i = 0; i < n; ++i) units.push_back(static_cast<int>(texts.uniform(-40, 40)));
      const auto scale = [](double x, int exponent) { return std::ldexp(x, exponent); };
      const Matrix found = exponential(numerics::in_units(A, units, scale));
      EXPECT_EQ(found, numerics::in_units(expected, units, scale)) << A;
    }
  }
}

/// An element that may be 0 does not decide on the units of the others, however small its radius.
TEST(Balance, ElementsThatMayBeZeroDoNotWidenAnExponential) {
  for (const double other : {0.0, 1e-13})
    for (const double rad : {1e-12, 1e-32, 1e-48, 1e-200, 1e-300, kTiny}) {
      Enclosed<double> A = exactly<double>(Matrix{{0.3, std::min(other, rad / 2)}, {0.5, 0.3}});
      A.rad(0, 1) = rad;
      EnclosedValues<double> values{{"A", A}};
      expr::Scope scope;
      scope.symbols["A"] = {{2, 2}, true};
      const auto found =
          enclose<double>(expr::compile(expr::parse({"expm(A)", "test"}), scope), values);
      EXPECT_TRUE(contains(found, truth("expm([0.3, 0; 0.5, 0.3])")));
      EXPECT_LT(found.rad(1, 0), 1e-15 + rad) << rad;
      EXPECT_LT(found.rad(0, 1), 1e-18 + 2 * rad) << rad;
    }
}

/// A product with a diagonal of powers of two is exact, in other units too.
TEST(Enclosure, APowerOfTwoScalesExactly) {
  for (const char* text : {"[8, 0; 0, -0.125]*[3, 5; 7, 0]", "[3, 5; 7, 0]*[0.25, 0; 0, 2]"}) {
    EXPECT_TRUE(enclosed<double>(text).is_exact()) << text;
    EXPECT_TRUE(enclosed<DoubleDouble>(text).is_exact()) << text;
    EXPECT_TRUE(contains(enclosed<Decimal100>(text), truth(text))) << text;
  }
}

/// Balanced, a matrix is about as small as its strongly connected parts.
TEST(Balance, UnitsAloneDoNotMakeAMatrixLarge) {
  const auto norm = [](const Matrix& A) {
    const auto scale = [](double x, int exponent) { return std::ldexp(x, exponent); };
    return numerics::in_units(Matrix(A.cwiseAbs()), numerics::balance(A.cwiseAbs()), scale)
        .rowwise()
        .sum()
        .maxCoeff();
  };
  EXPECT_LE(norm(Matrix{{-1, 1e8}, {-1e-8, -1}}), 4);
  EXPECT_LE(norm(Matrix{{-1, 1e8}, {0, -1}}), 4);
  EXPECT_LE(norm(Matrix{{-1, 1e7, 0}, {0, -1, 1e7}, {0, 0, -1}}), 4);
  EXPECT_LE(norm(Matrix{{0, 1e10, 0}, {-1e-10, -3, 0}, {-3, -3e10, -2}}), 12);
  EXPECT_LE(norm(Matrix{{0, 1e16}, {-1e-16, 0}}), 3);
  EXPECT_LE(norm(Matrix{{0, 1e300}, {0, 0}}), 1);
}

TEST(Balance, BadlyScaledExponentials) {
  for (const char* text :
       {"expm([-1, 1e8; -1e-8, -1])", "expm([0, 1e16; -1e-16, 0])", "expm([-1, 32000; 0, -1])",
        "expm([0, 1e10, 0; -1e-10, -3, 0; -3, -3e10, -2])",
        "expm([-1, 1e7, 0; 0, -1, 1e7; 0, 0, -1])", "expm([0, 1, 0; -25, -1, 1e12; 0, 0, -40])"}) {
    const Wide exact = truth(text);
    const Matrix found = evaluate(program(text), Values{});
    for (Eigen::Index i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(found(i), static_cast<double>(exact(i)),
                  1e-12 * std::abs(static_cast<double>(exact(i))))
          << text;
    EXPECT_TRUE(contains(enclosed<double>(text), exact)) << text;
    EXPECT_LE((enclosed<double>(text).rad.array() - 1e-11 * found.array().abs()).maxCoeff(), 0)
        << text;
  }
  // By hand: cos(1), and the last element decays by itself.
  EXPECT_NEAR(evaluate(program("expm([0, 1e16; -1e-16, 0])"), Values{})(0, 0), std::cos(1.0),
              1e-14);
  EXPECT_NEAR(evaluate(program("expm([0, 1e10, 0; -1e-10, -3, 0; -3, -3e10, -2])"), Values{})(2, 2),
              std::exp(-2.0), 1e-14);
}

}  // namespace
}  // namespace gainsmith::numbers
