// Sums of squares of random polynomials that have rational zeros in common, and a little less.
#include <gtest/gtest.h>

#include "base/random.h"
#include "numbers/dense/rational_algebra.h"
#include "sos/squares.h"

namespace gainsmith::sos {
namespace {

using polynomial::PolynomialMatrix;
using polynomial::Term;
using tests::Answer;
using tests::ask;

/// Whole numbers of a stream.
class Draws {
 public:
  explicit Draws(std::uint64_t run) : stream_(20261202, run) {}
  int between(int low, int high) {
    return low + static_cast<int>(stream_.uniform() * (high - low + 1));
  }

 private:
  RandomStream stream_;
};

struct Drawn {
  Polynomial p;  ///< a sum of squares
  bool has_zero = false;
};

Rational value_at(const Monomial& monomial, const std::vector<Rational>& point) {
  Rational value = 1;
  for (std::size_t i = 0; i < point.size(); ++i)
    for (int e = monomial.exponent(i); e > 0; --e) value *= point[i];
  return value;
}

Drawn draw(std::uint64_t run) {
  Draws draws(run);
  const auto n = static_cast<std::size_t>(draws.between(1, 3));
  const int half = draws.between(1, n == 3 ? 2 : 3);
  const auto basis = polynomial::monomials(n, 0, half);
  const auto size = static_cast<Eigen::Index>(basis.size());
  std::vector<std::vector<Rational>> zeros(static_cast<std::size_t>(
      draws.between(0, static_cast<int>(std::min<Eigen::Index>(3, size - 1)))));
  for (auto& zero : zeros)
    for (std::size_t i = 0; i < n; ++i)
      zero.emplace_back(Integer(draws.between(-6, 6)), Integer(draws.between(1, 5)));
  numbers::RationalMatrix V(static_cast<Eigen::Index>(zeros.size()), size);
  for (Eigen::Index z = 0; z < V.rows(); ++z)
    for (Eigen::Index k = 0; k < size; ++k)
      V(z, k) = value_at(basis[static_cast<std::size_t>(k)], zeros[static_cast<std::size_t>(z)]);
  const numbers::RationalMatrix W = numbers::rational_kernel(V);
  Drawn result;
  for (Eigen::Index square = 0; square < W.cols() + 1; ++square) {
    Polynomial q;
    for (Eigen::Index j = 0; j < W.cols(); ++j) {
      const Rational c = draws.between(-5, 5);
      for (Eigen::Index k = 0; k < size; ++k)
        q.add(Term{basis[static_cast<std::size_t>(k)], 0}, Rational(c * W(k, j)));
    }
    result.p += q * q;
  }
  result.has_zero = !zeros.empty();
  return result;
}

Statement statement(const Polynomial& p) { return {"p", PolynomialMatrix::Constant(1, 1, p)}; }

TEST(RandomSumsOfSquares, AreFoundInFractionsAndALittleLessNever) {
  constexpr std::uint64_t kRuns = 100;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    const Drawn drawn = draw(run);
    EXPECT_EQ(ask(statement(drawn.p)), Answer::yes) << "run " << run;
    if (!drawn.has_zero) continue;
    Polynomial less = drawn.p;
    less -= Polynomial(Rational(1, 1000000));
    EXPECT_NE(ask(statement(less)), Answer::yes) << "run " << run;
  }
}

}  // namespace
}  // namespace gainsmith::sos
