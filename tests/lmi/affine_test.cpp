#include "lmi/affine.h"

#include <gtest/gtest.h>

#include <random>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "forall/variables.h"
#include "lmi/inequalities.h"
#include "support/expect_counts.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

constexpr const char* kProblem = R"(
problem: affine
method:
  method: affine
  data: {A: n x n, C: p x n}
  unknowns: {P: symmetric n, Y: n x p, g: scalar}
  require: {positive: P > 0}
data: {A: [[0.3, -1.2, 2], [4, 0.5, -1], [0.7, 0, 1]], C: [[1, -2, 0.5], [0, 1, 3]]}
)";

class AffineTest : public ::testing::Test {
 protected:
  expr::Program program(const std::string& text) {
    const model::Design& design = *yaml_.instance.design;
    expr::Scope scope;
    scope.dimensions = design.dimensions;
    for (const model::Design::Datum& datum : design.data)
      scope.symbols[datum.name] = {datum.shape, true};
    for (const model::Design::Unknown& unknown : design.unknowns)
      scope.symbols[unknown.name] = {unknown.shape};
    scope.symbols["tau"] = {};
    return expr::compile(expr::parse({text, "test"}), scope);
  }

  AffineForm form(const std::string& text) { return form(text, unknowns_); }

  AffineForm form(const std::string& text, const Unknowns& unknowns) {
    return evaluate_affine(program(text), unknowns, monomials_, yaml_.instance.values);
  }

  static double value(const forall::Monomial& monomial, double tau) {
    return monomial.empty() ? 1.0 : forall::evaluate(monomial.front().atom, tau);
  }

  /// The form at x and tau.
  numbers::Matrix at(const AffineForm& form, const std::vector<double>& x, double tau) const {
    numbers::Matrix sum = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
    for (const auto& [key, matrix] : expanded(form).terms)
      sum += value(monomials_[key.first], tau) *
             (key.second == 0 ? 1.0 : x[static_cast<std::size_t>(key.second) - 1]) *
             numbers::Matrix(matrix);
    return sum;
  }

  /// The form with numbers for its monomials, at x.
  numbers::Matrix at_numbers(const AffineForm& form, const std::vector<double>& x,
                             double tau) const {
    std::vector<double> values;
    for (int k = 0; k < monomials_.size(); ++k) values.push_back(value(monomials_[k], tau));
    return value_of(at_vertex(form, values), x);
  }

  /// Compares the affine form with the text evaluated over double at random points; unknowns stand
  /// in it by their scalars, and as matrices in products.
  void expect_same(const std::string& text) {
    expect_same(text, unknowns_);
    expect_same(text, matrices_);
  }

  void expect_same(const std::string& text, const Unknowns& unknowns) {
    const AffineForm affine = form(text, unknowns);
    const expr::Program direct = program(text);
    std::uniform_real_distribution<double> number(-2, 2);
    for (int trial = 0; trial < 5; ++trial) {
      std::vector<double> x;
      for (int i = 0; i < unknowns_.size(); ++i) x.push_back(number(generator_));
      const double tau = number(generator_);
      numbers::Values values = yaml_.instance.values;
      for (const auto& [name, matrix] : unknowns_.values(x)) values[name] = matrix;
      values["tau"] = numbers::Matrix::Constant(1, 1, tau);
      const numbers::Matrix expected = numbers::evaluate(direct, values);
      EXPECT_LT((at(affine, x, tau) - expected).cwiseAbs().maxCoeff(),
                1e-11 * (1 + expected.norm()))
          << text;
      EXPECT_LT((at_numbers(affine, x, tau) - expected).cwiseAbs().maxCoeff(),
                1e-11 * (1 + expected.norm()))
          << text;
    }
  }

  tests::YamlProblem yaml_{kProblem};
  Unknowns unknowns_ = Inequalities(yaml_.instance).unknowns;
  Unknowns matrices_ = Unknowns(
      model::unknown_matrices(*yaml_.instance.design, model::polynomials(*yaml_.instance.design)),
      1);
  forall::MonomialTable monomials_{{forall::testing::interval("tau", -2, 2)}};
  std::mt19937 generator_{7};
};

/// [tau, c; 0, tau]^k = [tau^k, k c tau^(k-1); 0, tau^k].
TEST_F(AffineTest, LargePowersOfFewFunctionsAreThose) {
  const AffineForm large = form("[tau, 2; 0, tau]^1000*C(1, 1)");
  ASSERT_EQ(large.terms.size(), 2U);
  numbers::Matrix expected(2, 2);
  const double tau = 0.999;
  expected << std::pow(tau, 1000), 2000 * std::pow(tau, 999), 0, std::pow(tau, 1000);
  EXPECT_LT((at(large, {}, tau) - expected).norm(), 1e-10 * expected.norm());
  EXPECT_EQ(form("(tau*eye(2))^1000000").terms.size(), 1U);
}

TEST_F(AffineTest, PowersThatExplodeAreRefused) {
  for (const char* text : {"(A + tau*eye(3))^100000", "(1 + tau)^101", "(cos(tau) + 2)^1000"}) {
    const InputError error = tests::input_error([&] { form(text); });
    EXPECT_NE(error.message().find("expands to more than 100 functions"), std::string::npos)
        << text << ": " << error.what();
    EXPECT_EQ(error.place(), (Place{"test", 1, 1}));
  }
  EXPECT_NE(tests::input_error([&] { form("tau^2000000"); }).message().find("above 1000000"),
            std::string::npos);
  EXPECT_EQ(form("(1 + tau)^99").terms.size(), 100U);
}

TEST_F(AffineTest, AgreesWithTheTextOverDouble) {
  for (const char* text : {"P",
                           "He(P*A - Y*C)",
                           "[P, Y; *, g*I]",
                           "-P/2 + 3*A'*P*A",
                           "trace(P) + 2*g",
                           "diag([g, 2*g, 1])",
                           "diag(P)",
                           "P(1:2, :)",
                           "Y'",
                           "ones(2, 2)*g",
                           "expm(A)*P",
                           "blkdiag(P, g)",
                           "inv(A)'*Y*C - Y*C",
                           "(1/3)*P + eye(3)",
                           "[g, 1; 1, g]*C",
                           "C*P*C' + trace(Y*C)*I",
                           "(g + 1)*inv(A)",
                           "(C(1, :)*P*C(2, :)')*A",
                           "P.*A - (Y*C)./(A.*A + ones(3, 3))",
                           "(P*A)(2:3, 1:2)",
                           "[Y', C*P; P, 2*P*A]",
                           "P^1 - P",
                           "sum(P)",
                           "diag(Y(:, 1))*A"})
    expect_same(text);
}

TEST_F(AffineTest, ProductsWithTheSameSideAreOne) {
  const auto products = [this](const std::string& text) {
    const AffineForm affine = form(text, matrices_);
    EXPECT_EQ(form(text).terms.size(), expanded(affine).terms.size()) << text;
    return affine.products.size();
  };
  tests::expect_counts(products, {{"P*A + 0.3*P", 1},
                                  {"A'*P*A - 2*(A'*P)", 1},
                                  {"He(P*A)", 2},
                                  {"Y*C - 3*(Y*C) + 2*(Y*C)", 0},
                                  {"tau*P + tau*(P*A) + P", 2},
                                  {"diag(P)", 0}});
}

TEST_F(AffineTest, ProductsAreTheSameFormAsTheirTerms) {
  const std::string text = "tau*(P*A)' + Y*C - g*A";
  EXPECT_TRUE(is_same(form(text, matrices_), form(text)));
  EXPECT_FALSE(is_same(form(text, matrices_), form("Y*C")));
  EXPECT_FALSE(form("P", matrices_).is_constant());
  EXPECT_TRUE(form("P", matrices_).has_unknown());
  EXPECT_EQ(monomials_in(form(text, matrices_)), monomials_in(form(text)));
}

TEST_F(AffineTest, AgreesWithTheTextForFunctionsOfTau) {
  for (const char* text : {"exp(0.3*tau)*P", "(1.01*exp(0.2*tau) - 1)*(Y*C + P)", "tau*P + tau^2*A",
                           "sin(2*tau + 0.3)*P", "cos(1 - 3*tau)*A",
                           "exp(tau)*sin(tau)*tau*P - exp(-tau)*cos(2*tau)*g*A",
                           "[cos(tau), sin(tau); -sin(tau), cos(tau)]^2*C*P",
                           "exp(-2*tau)*exp(2*tau)*P", "expm(A*tau)'*P*expm(A*tau)",
                           "expm(eye(3) + A*tau/2)*Y", "[P, (P*expm(tau*(A - A')))'; *, P]"})
    expect_same(text);
}

TEST_F(AffineTest, AProductOfUnknownsIsRefusedWithItsPlace) {
  const InputError error = tests::input_error([&] { form("P + Y*C*P"); });
  EXPECT_EQ(error.place().column, 5);
  EXPECT_NE(error.message().find("not affine"), std::string::npos) << error.what();
  EXPECT_NE(error.message().find("inv(P)*Y"), std::string::npos) << error.what();
  EXPECT_NE(error.message().find("Y(1,1)"), std::string::npos) << error.what();
}

TEST_F(AffineTest, NonlinearFunctionsOfUnknownsAreRefused) {
  for (const char* text :
       {"inv(P)", "exp(g)*A", "expm(P)", "A/g", "P^2", "abs(Y)", "max(g, 1)*A", "norm(Y)"})
    EXPECT_NE(tests::input_error([&] { form(text); }).message().find("not affine"),
              std::string::npos)
        << text;
}

TEST_F(AffineTest, FunctionsOfTauThatAreNoAtomsAreRefused) {
  for (const char* text : {"exp(tau^2)*P", "P/tau", "sqrt(tau)*P", "expm(A*tau^2)"})
    EXPECT_NE(tests::input_error([&] { form(text); }).message().find("forall"), std::string::npos)
        << text;
}

}  // namespace
}  // namespace gainsmith::lmi
