// Roots that are isolated, and a no by an eigenvalue.
#include "verdict/algebraic_multipliers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <string>

#include "support/linear_algebra.h"
#include "support/yaml_problem.h"

namespace gainsmith::verdict {
namespace {

Polynomial polynomial(std::initializer_list<int> coefficients) {
  return {coefficients.begin(), coefficients.end()};
}

double squared_error(const Polynomial& p, const Root& root) {
  const std::complex<double> l(nearest_double(root.re), nearest_double(root.im));
  std::complex<double> value = 0;
  for (std::size_t k = p.size(); k-- > 0;) value = value * l + nearest_double(p[k]);
  return std::norm(value);
}

TEST(AlgebraicRoot, IsIsolatedWithWhatIsExactOfIt) {
  const auto circle = roots({1, Rational(-6) / 5, 1});  // 3/5 +- 4/5 i
  ASSERT_EQ(circle.size(), 2U);
  for (const Root& root : circle) {
    EXPECT_TRUE(root.on_circle);
    EXPECT_FALSE(root.imaginary);
    EXPECT_EQ(root.squared_modulus().error, 0);
  }
  const Polynomial p = polynomial({-6, 3, -2, 1});  // (x - 2)(x^2 + 3)
  EXPECT_EQ(roots(p).size(), 3U);
  for (const Root& root : roots(p)) EXPECT_LT(squared_error(p, root), 1e-24);
  const auto factors = factors_to_try(p);
  ASSERT_EQ(factors.size(), 3U);
  EXPECT_EQ(factors[0], polynomial({-2, 1}));
  EXPECT_EQ(factors[1], polynomial({3, 0, 1}));
  for (const Root& root : roots(factors[1])) EXPECT_TRUE(root.imaginary);
  EXPECT_EQ(roots(factors[0])[0].re, 2);
  EXPECT_EQ(roots(factors[0])[0].h, 0);
}

TEST(AlgebraicRoot, OfMoreThanOneOrderIsNotToldApart) {
  const Polynomial p = polynomial({-4, 0, 3, 1});  // (x - 1)(x + 2)^2
  EXPECT_EQ(roots(p).size(), 1U);
  EXPECT_EQ(square_free(p), polynomial({-2, 1, 1}));
  EXPECT_EQ(roots(square_free(p)).size(), 2U);
}

TEST(AlgebraicRoot, FormsHaveTheirValueWithinTheirError) {
  for (const Root& root : roots(polynomial({-2, 0, 1}))) {  // conj(l) l = 2
    numerics::RationalMatrix X(2, 2);
    X << Rational(-2), Rational(1) / 3, Rational(1) / 3, Rational(1);
    const Root::Bounded value = form_at(root, X);
    EXPECT_NEAR(nearest_double(value.x), 2.0 / 3 * nearest_double(root.re), 1e-15);
    EXPECT_LT(value.error, Rational(1) / 1000000000);
  }
}

struct PosedText {
  tests::YamlProblem yaml;
  lmi::Inequalities of;
  lmi::Lmi lmi;

  explicit PosedText(const std::string& text)
      : yaml("problem: p\nmethod:\n  method: m\n" + text), of(yaml.instance), lmi(compile(of)) {}

  std::optional<AlgebraicCertificate> certificate() const { return algebraic_certificate(of, lmi); }

  /// Recomputed in double: weights that are not negative, and the sum of all z*B(x)z for random x,
  /// which is to be 0 or less, relative to the sizes of the terms.
  double relative_sum(const AlgebraicCertificate& found, std::mt19937& generator) const {
    std::normal_distribution<double> number;
    std::vector<double> x;
    for (int i = 0; i < lmi.unknowns; ++i) x.push_back(number(generator));
    const std::complex<double> l(nearest_double(found.root.re), nearest_double(found.root.im));
    double sum = 0, size = 0;
    for (const AlgebraicMultiplier& multiplier : found.multipliers) {
      const double c = nearest_double(multiplier.W(0, 0)) +
                       2 * nearest_double(multiplier.W(0, 1)) * l.real() +
                       nearest_double(multiplier.W(1, 1)) * std::norm(l);
      EXPECT_GE(c, -1e-15);
      Eigen::VectorXcd z = Eigen::VectorXcd::Zero(multiplier.Z.rows());
      for (Eigen::Index j = multiplier.Z.cols(); j-- > 0;)
        for (Eigen::Index i = 0; i < z.size(); ++i)
          z[i] = z[i] * l + nearest_double(multiplier.Z(i, j));
      const double part = c * z.dot(lmi.blocks[multiplier.block].value(x) * z).real();
      sum += part;
      size += std::abs(part);
    }
    return sum / size;
  }
};

std::string lyapunov_text(const std::string& A, const std::string& decrease = "He(P*A) < 0") {
  return "  data: {A: n x n}\n  unknowns: {P: symmetric n}\n  require: {positive: P > 0, decrease: "
         "\"" +
         decrease + "\"}\ndata: {A: " + A + "}\n";
}

TEST(AlgebraicMultipliers, ExcludeWhatAnUnstableMatrixExcludes) {
  std::mt19937 generator(63);
  std::uniform_int_distribution<int> element(-9, 9);
  int unstable = 0;
  for (int n = 1; n <= 6; ++n)
    for (int repetition = 0; repetition < 4; ++repetition) {
      const numbers::Matrix A =
          numbers::Matrix::NullaryExpr(n, n, [&] { return element(generator) / 10.0; });
      if (A.isZero()) continue;
      const double abscissa = A.eigenvalues().real().maxCoeff();
      const PosedText posed(lyapunov_text(tests::matrix_yaml(A)));
      const auto found = posed.certificate();
      EXPECT_EQ(found.has_value(), abscissa > -1e-12) << A;
      if (!found) continue;
      ++unstable;
      EXPECT_EQ(found->matrix.front(), 'A');
      EXPECT_GE(nearest_double(found->root.re), 0);
      EXPECT_LT(posed.relative_sum(*found, generator), 1e-12);
    }
  EXPECT_GT(unstable, 10);
}

TEST(AlgebraicMultipliers, KnowTheLimitOfStability) {
  for (const auto& [text, excluded] : std::vector<std::pair<std::string, bool>>{
           {lyapunov_text("[[0, 1], [-1, 0]]"), true},
           {lyapunov_text("[[0, 1, 0], [-3, 0, 0], [0, 1, -2]]"), true},
           {lyapunov_text("[[0, 1], [0, 0]]"), true},
           {lyapunov_text("[[-1e-9, 1], [-1, -1e-9]]"), false},
           {lyapunov_text("[[0, 1], [-1, 0]]", "He(P*A) <= 0"), false},
           {lyapunov_text("[[0.6, 0.8], [-0.8, 0.6]]", "A'*P*A - P < 0"), true},
           {lyapunov_text("[[0.6, 0.8], [-0.8, 0.6]]", "A'*P*A - P <= 0"), false},
           {lyapunov_text("[[0.6, 0.7999999], [-0.8, 0.6]]", "A'*P*A - P < 0"), false},
           {lyapunov_text("[[0.5, 1], [0, 1]]", "[P, A'*P; *, P] > 0"), true},
           {lyapunov_text("[[-1, 1], [0, -2]]", "He(P*A) + 2*P < 0"), true},
           {lyapunov_text("[[-1, 1], [0, -2]]", "He(P*A) + 1.9999*P < 0"), false}})
    EXPECT_EQ(PosedText(text).certificate().has_value(), excluded) << text;
}

TEST(AlgebraicMultipliers, SeeModesThatNoGainMoves) {
  const auto observer = [](const std::string& A) {
    return PosedText(
        "  data: {A: n x n, C: p x n}\n  unknowns: {P: symmetric n, Y: n x p}\n  require: "
        "{positive: "
        "P > I, decrease: He(P*A - Y*C) < 0}\ndata: {C: [[1, 0, 0]], A: " +
        A + "}\n");
  };
  const auto found = observer("[[0, 1, 0], [-1, -1, 0], [1, 2, 0.3]]").certificate();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->root.re, Rational(3) / 10);
  EXPECT_FALSE(observer("[[0, 1, 0], [-1, -1, 0], [1, 2, -0.3]]").certificate());
}

}  // namespace
}  // namespace gainsmith::verdict
