// Polynomials are the same function as the text, for all numbers of the data.
#include "linear/polynomial.h"

#include <gtest/gtest.h>

#include "linear/wide_state.h"
#include "support/text_problem.h"

namespace gainsmith::linear {
namespace {

using tests::TextProblem;

TextProblem plant() {
  TextProblem problem;
  problem.data("A", "n x n", "[0.2, -1.01; 1, 0]").data("C", "p x n", "[0.5, -1]");
  problem.data("L", "n x p", "[3; 4]").data("k", "scalar", "0.7");
  problem.state("z", "n").state("zh", "n").state("th", "p");
  problem.flow({{"z", "A*z"}, {"zh", "A*zh"}, {"th", "th"}}).timer("0.5", "1", "0", "1");
  return problem;
}

class PolynomialTest : public testing::Test {
 protected:
  /// The program's value at drawn numbers for all its inputs, in 100 digits.
  Wide value(const expr::Program& program, std::uint64_t seed) const {
    RandomStream random(0x501, seed);
    const hybrid::StateLayout layout = layout_of({{"z", {2, 1}}, {"zh", {2, 1}}, {"th", {1, 1}}});
    const numbers::ValuesOf<Decimal100> constants = {{"A", wide(drawn(random, 2, 2))},
                                                     {"C", wide(drawn(random, 1, 2))},
                                                     {"L", wide(drawn(random, 2, 1))},
                                                     {"k", wide(drawn(random, 1, 1))}};
    const Wide x = wide(drawn(random, 5, 1));
    return WideFunction(program, layout, constants)(x);
  }
  TextProblem problem_ = plant();
};

TEST_F(PolynomialTest, IsTheFunctionOfItsText) {
  for (const char* text :
       {"(z - zh)'*(A - L*C)'*(z - zh) + k^3*th", "(A - L*C)*z - (A*z - L*C*z)",
        "He(z*zh')*(z + L*th)*k", "-2*(k - 1)*(k + 1)*(A*A')'*z",
        "(z'*zh)*(C*z)*exp(k)*L - zh*(zh'*z)*(C*z)*exp(k)", "[z, zh]*[k; th] + A^2*zh",
        "[(z - k*zh)(2); th*(A*z - zh)(1)]", "[z*zh' - 2*A, L + k*z; z' - zh', th]"}) {
    const expr::Program program = problem_.program(text);
    Polynomials polynomials;
    const expr::Program again = polynomials.program(polynomials.of(program));
    EXPECT_EQ(again.shape(), program.shape()) << text;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Wide difference = value(program, seed) - value(again, seed);
      EXPECT_LT(largest_of(difference), Decimal100(1e-90)) << text;
    }
  }
}

TEST_F(PolynomialTest, WhatIsEqualForAllNumbersCancels) {
  for (const auto& [a, b] : tests::Pairs{{"(A - L*C)*(z - zh)", "A*z - L*C*z - (A - L*C)*zh"},
                                         {"(k*A)*z*th", "th*(A*(k*z))"},
                                         {"(z + zh)'*(z + zh)", "z'*z + z'*zh + zh'*z + zh'*zh"},
                                         {"L*(C*z)", "(L*C)*z"},
                                         {"L*(C*A)*z*th", "(C*A*z)*(th*L)"},
                                         {"z'*A*zh", "zh'*A'*z"},
                                         {"(L*z')*(zh*C)", "(zh'*z)*L*C"},
                                         {"z*(zh'*A*z)*z'", "(z*z'*A')*(zh*z')"},
                                         {"(z - k*zh)(2)", "z(2) - k*zh(2)"},
                                         {"[z - zh; k*th]", "[z; zeros(1, 1)] - [zh; -k*th]"}}) {
    Polynomials polynomials;
    const Polynomial left = polynomials.of(problem_.program(a));
    const Polynomial right = polynomials.of(problem_.program(b));
    std::map<Word, std::int64_t> rest = left.terms;
    for (const auto& [word, coefficient] : right.terms) rest[word] -= coefficient;
    for (const auto& [word, coefficient] : rest) EXPECT_EQ(coefficient, 0) << a;
  }
}

TEST_F(PolynomialTest, WhatDiffersDoesNotCancel) {
  Polynomials polynomials;
  const Polynomial left = polynomials.of(problem_.program("A*A'*z"));
  const Polynomial right = polynomials.of(problem_.program("A'*A*z"));
  EXPECT_NE(left.terms, right.terms);
}

}  // namespace
}  // namespace gainsmith::linear
