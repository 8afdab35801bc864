#include "hybrid/affine.h"

#include <gtest/gtest.h>

#include "support/text_problem.h"

namespace gainsmith::hybrid {
namespace {

/// The operation that is not affine in x (2 x 1) and s (1 x 1), "" when there is none. M is
/// constant.
std::string culprit(const std::string& text) {
  tests::TextProblem problem;
  problem.data("M", "2 x 2", "[1, 2; 3, 5]").state("x", "2").state("s", "scalar");
  const expr::Program program = problem.program(text);
  const auto* at =
      first_not_affine(program, [](const std::string& name) { return name == "x" || name == "s"; });
  return at == nullptr ? "" : expr::to_string(at->op);
}

TEST(Affine, SumsAndProductsWithConstantsAreAffine) {
  for (const char* text : {"M*x", "x + [1; 2]", "-x/trace(M)", "exp(M)*x - M*[s; s]", "x(1) - 3*s",
                           "s*I + M", "trace(M*[x, x])", "[x; s; 1]", "x'*M", "inv(M)*expm(M)*x",
                           "diag(x)", "where(trace(M) > 0, x, M*x)", "M^3*x", "s^1"})
    EXPECT_EQ(culprit(text), "") << text;
}

TEST(Affine, OtherFunctionsOfTheStateAreNot) {
  EXPECT_EQ(culprit("s*x"), "product");
  EXPECT_EQ(culprit("x'*x"), "product");
  EXPECT_EQ(culprit("x/s"), "quotient");
  EXPECT_EQ(culprit("[0; s^2]"), "power");
  EXPECT_EQ(culprit("M*sin(x)"), "sin");
  EXPECT_EQ(culprit("abs(s)"), "abs");
  EXPECT_EQ(culprit("where(s > 0, 1, 2)"), "where");
  EXPECT_EQ(culprit("inv(M + s*I)"), "inv");
}

}  // namespace
}  // namespace gainsmith::hybrid
