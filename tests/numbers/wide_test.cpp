// Real over 31 and 100 digits: what double cannot give.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {
namespace {

template <class Scalar>
MatrixOf<Scalar> value(const std::string& text) {
  return evaluate<Scalar>(expr::compile(expr::parse({text, "test"}), {}), ValuesOf<Scalar>{});
}

template <class Scalar>
double size(const Scalar& x) {
  return std::abs(static_cast<double>(x));
}

/// The Hilbert matrix of size n as a text.
std::string hilbert(int n) {
  std::string text = "[";
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
      text += (j > 1 ? ", 1/" : i > 1 ? "; 1/" : "1/") + std::to_string(i + j - 1);
  return text + "]";
}

template <class Scalar>
class Wide : public testing::Test {};
using WideScalars = testing::Types<DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(Wide, WideScalars);

TYPED_TEST(Wide, DecimalsAreRoundedFromTheirText) {
  EXPECT_EQ(value<TypeParam>("0.1")(0, 0), *parse_as<TypeParam>("0.1"));
  EXPECT_NE(value<TypeParam>("0.1")(0, 0), TypeParam(0.1));
  EXPECT_LT(size(value<TypeParam>("10*0.1 - 1")(0, 0)),
            4 * size(std::numeric_limits<TypeParam>::epsilon()));
}

TYPED_TEST(Wide, KnownConstantsToTheLastDigits) {
  // The digits of pi and e.
  const TypeParam pi = *parse_as<TypeParam>(
      "3."
      "1415926535897932384626433832795028841971693993751058209749445923078164062862089986280"
      "3482534211706798214808651328230664709384460955058223172535940812848111745028410270193");
  const TypeParam e = *parse_as<TypeParam>(
      "2."
      "7182818284590452353602874713526624977572470936999595749669676277240766303535475945713"
      "8217852516642742746639193200305992181741359662904357290033429526059563073813232862794");
  const double few = 8 * size(std::numeric_limits<TypeParam>::epsilon());
  EXPECT_LE(size(TypeParam(value<TypeParam>("pi")(0, 0) - pi)), few);
  EXPECT_LE(size(TypeParam(value<TypeParam>("exp(1)")(0, 0) - e)), few);
  EXPECT_LE(size(TypeParam(value<TypeParam>("expm([1, 0; 0, 0])")(0, 0) - e)), few);
}

TYPED_TEST(Wide, AnInverseThatDoubleRefuses) {
  const int n = 12;
  EXPECT_THROW(value<double>("inv(" + hilbert(n) + ")"), expr::EvaluationError);
  // The inverse of the Hilbert matrix has whole elements; the first one is n^2.
  const auto inverse = value<TypeParam>("inv(" + hilbert(n) + ")");
  EXPECT_LT(size(TypeParam(inverse(0, 0) - TypeParam(n * n))), 1e-8);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const TypeParam half = inverse(i, j) + TypeParam(0.5);
      EXPECT_LT(size(TypeParam(floor(half) - inverse(i, j))), 1e-6 * (1 + size(inverse(i, j))));
    }
}

TYPED_TEST(Wide, AMatrixThatIsSingularInAnyArithmeticIsRefused) {
  EXPECT_THROW(value<TypeParam>("inv([0.1, 0.3; 0.2, 0.6])"), expr::EvaluationError);
}

TYPED_TEST(Wide, LargeExponentialsKeepTheirDigits) {
  // The rotation by 100, and a growth by e^40 with a fast decay beside it.
  const auto turned =
      value<TypeParam>("expm([0, 100; -100, 0]) - [cos(100), sin(100); -sin(100), cos(100)]");
  EXPECT_LT(size(turned.cwiseAbs().maxCoeff()),
            1e4 * size(std::numeric_limits<TypeParam>::epsilon()));
  const auto grown = value<TypeParam>(
      "exp(-40)*expm([40, 3; 0, -500]) - [1, 3/540*(1 - exp(-540)); 0, exp(-540)]");
  EXPECT_LT(size(grown.cwiseAbs().maxCoeff()),
            1e6 * size(std::numeric_limits<TypeParam>::epsilon()));
}

}  // namespace
}  // namespace gainsmith::numbers
