// The products in the gains' formulas that bounds are put on: what stands beside an inverse.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bind/small_problem.h"

namespace gainsmith::bind {
namespace {

/// A problem with n = 2, p = 1, symmetric unknowns P and Q(t), full ones Y(t) and Z, a scalar s.
Small with_gains(const std::string& gains) {
  return Small("problem: p\nmethod: small\ndata: {A: [[0, 1], [-2, -3]], C: [[1, 0]]}\n",
               "method: small\ndata: {A: n x n, C: p x n}\n"
               "unknowns:\n  P: symmetric n\n  D: diagonal p\n  s: scalar\n  Z: n x n\n"
               "  Y: {shape: n x p, of: tau, degree: 1}\n"
               "  Q: {shape: symmetric n, of: tau, degree: 1}\n"
               "let: {twice: 2*C', E(t): t*Y(t)}\n"
               "require: {p: P > 0}\ngains: {" +
                   gains + "}\n");
}

/// "inv(P) | all | nearest", or "all | inv(P) | nearest" when the inverse stands right.
std::vector<std::string> products(const model::Design::Gain& gain) {
  std::vector<std::string> texts;
  for (const model::Design::Product& product : gain.products) {
    const std::string inverse = "inv(" + product.inverse + ")";
    texts.push_back(
        (product.left ? inverse + " | " + product.all.text : product.all.text + " | " + inverse) +
        " | " + product.nearest.text);
  }
  return texts;
}

std::vector<std::string> products(const std::string& formula) {
  return products(with_gains(formula).design().gains.at(0));
}

using Texts = std::vector<std::string>;

TEST(GainProducts, AreWhatStandsBesideAnInverse) {
  EXPECT_EQ(products("L: inv(P)*C'"), Texts{"inv(P) | C' | C'"});
  EXPECT_EQ(products("L: inv(P)*C'*D*2"), Texts{"inv(P) | C'*D*2 | C'"});
  EXPECT_EQ(products("L: 3*inv(P)*C'"), Texts{"inv(P) | C' | C'"});
  EXPECT_EQ(products("L: Z*C'*inv(D)"), Texts{"Z*C' | inv(D) | C'"});
  EXPECT_EQ(products("L: inv(P)*C'*inv(D)"),
            (Texts{"inv(P) | C'*inv(D) | C'", "inv(P)*C' | inv(D) | C'"}));
  EXPECT_EQ(products("L: inv(P)*(Z*A + Z) - C'*C*inv(s)"),
            (Texts{"inv(P) | (Z*A + Z) | (Z*A + Z)", "C'*C | inv(s) | C"}));
  EXPECT_EQ(products("L: -(inv(P)*A)'"), Texts{"inv(P) | A | A"});
  EXPECT_EQ(products("L: inv(Z)*A"), Texts{"inv(Z) | A | A"});
}

TEST(GainProducts, NeedAnUnknownAndAFactor) {
  EXPECT_EQ(products("L: inv(A)*A"), Texts());
  EXPECT_EQ(products("L: inv(2*P)*A"), Texts());
  EXPECT_EQ(products("L: inv(P)"), Texts());
  EXPECT_EQ(products("L: inv(P) + Z"), Texts());
}

/// What stands in another gain's formula is bounded there.
TEST(GainProducts, AreThoseOfTheTextThoughAGainMayUseOthers) {
  const Small small = with_gains("V: W*L, L: inv(P)*C', W: A - L*C, A: A");
  EXPECT_EQ(products(small.design().gains.at(1)), Texts{"inv(P) | C' | C'"});
  EXPECT_EQ(products(small.design().gains.at(2)), Texts());
  EXPECT_EQ(small.design().gains.at(0).shape, (expr::Shape{2, 1}));
  EXPECT_TRUE(small.design().gains.at(0).formula.program.uses("P"));
  EXPECT_FALSE(small.design().gains.at(0).formula.program.uses("L"));
  EXPECT_TRUE(small.design().gains.at(3).formula.program.uses("A"));
  EXPECT_THROW(with_gains("L: L*2"), InputError);
  EXPECT_THROW(with_gains("L: W*2, W: L/2"), InputError);
}

TEST(GainProducts, AnInverseMayBeThatOfAFunction) {
  EXPECT_EQ(products("L(t): inv(Q(t))*Y(t)"), Texts{"inv(Q(t)) | Y(t) | Y(t)"});
  EXPECT_EQ(products("L(t): Z*inv(Q(2*t))"), Texts{"Z | inv(Q(2*t)) | Z"});
  EXPECT_EQ(products("L(t): inv(Y(t)'*Y(t))*C"), Texts());
}

Texts calls(const model::Design::Product::Factor& factor) {
  Texts texts;
  for (const auto& [first, length] : factor.calls)
    texts.push_back(factor.text.substr(first, length));
  return texts;
}

TEST(GainProducts, KnowWhereFunctionsAreCalled) {
  const Small small = with_gains(
      "L(t): \" inv(P)*(Y(t) + t*Y( 0 ))*C*Y(t)\", M(t): Z*Y(2) - inv(P)*Y(t*1)"
      ", N(t): inv(P)*E(t)*C");
  const model::Design::Gain& gain = small.design().gains.at(0);
  ASSERT_EQ(gain.products.size(), 1U);
  EXPECT_EQ(gain.products[0].all.text, "(Y(t) + t*Y( 0 ))*C*Y(t)");
  EXPECT_EQ(calls(gain.products[0].all), (Texts{"Y(t)", "Y( 0 )", "Y(t)"}));
  EXPECT_EQ(gain.products[0].nearest.text, "(Y(t) + t*Y( 0 ))");
  EXPECT_EQ(calls(gain.products[0].nearest), (Texts{"Y(t)", "Y( 0 )"}));
  EXPECT_EQ(gain.whole.text, "inv(P)*(Y(t) + t*Y( 0 ))*C*Y(t)");
  EXPECT_EQ(calls(gain.whole), (Texts{"Y(t)", "Y( 0 )", "Y(t)"}));
  const model::Design::Gain& behind = small.design().gains.at(2);
  EXPECT_EQ(calls(behind.products.at(0).all), Texts()) << "only what stands in the formula itself";
  EXPECT_EQ(behind.products[0].all.program->functions.size(), 1U);
}

TEST(GainProducts, AWholeSumStandsInParentheses) {
  const Small small = with_gains("L(t): C' + t*Y(t)");
  EXPECT_EQ(small.design().gains[0].whole.text, "(C' + t*Y(t))");
  EXPECT_EQ(calls(small.design().gains[0].whole), Texts{"Y(t)"});
}

TEST(GainProducts, HaveTheProgramsOfTheirFactors) {
  const Small small = with_gains("L: inv(P)*C'*D*2, I1: inv(P)*I*A");
  const auto& products = small.design().gains.at(0).products;
  numbers::Values values = small.instance.values;
  values["D"] = numbers::Matrix{{5}};
  const model::Design::Product& product = products.at(0);
  EXPECT_EQ(numbers::evaluate(product.all.program.value(), values), (numbers::Matrix{{10}, {0}}));
  EXPECT_EQ(numbers::evaluate(product.nearest.program.value(), values),
            (numbers::Matrix{{1}, {0}}));
  const model::Design::Product& identity = small.design().gains.at(1).products.at(0);
  EXPECT_TRUE(identity.all.program);
  EXPECT_FALSE(identity.nearest.program) << "I alone has no size";
  EXPECT_TRUE(is_same(small.design().gains[0].whole.program.value(),
                      small.design().gains[0].formula.program));
}

}  // namespace
}  // namespace gainsmith::bind
