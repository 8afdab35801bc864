// Facial reduction, on faces planted in fractions.
#include "verdict/faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lmi/compile.h"
#include "numbers/dense/rational_algebra.h"
#include "support/yaml_problem.h"
#include "verdict/face_multipliers.h"
#include "verdict/printable.h"

namespace gainsmith::verdict {
namespace {

using numbers::RationalMatrix;

RationalMatrix zeros(Eigen::Index n) { return RationalMatrix::Constant(n, n, Rational(0)); }

RationalMatrix matrix(Eigen::Index n, std::initializer_list<Rational> elements) {
  RationalMatrix M(n, n);
  Eigen::Index e = 0;
  for (const Rational& x : elements) {
    M(e / n, e % n) = x;
    ++e;
  }
  return M;
}

RationalBlock block(bool strict, std::vector<std::pair<int, RationalMatrix>> terms) {
  return {static_cast<int>(terms.front().second.rows()), strict, true, std::move(terms)};
}

Faces faces_of(std::vector<RationalBlock> blocks, int unknowns) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < blocks.size(); ++k) names.push_back("b" + std::to_string(k + 1));
  return {std::move(blocks), std::move(names), unknowns};
}

TEST(FacesTest, OppositeNumbersLeaveAnEquation) {
  // x1 + 2 x2 >= 3, 6 >= 2 x1 + 4 x2, x1 > 0.
  Faces faces =
      faces_of({block(false, {{0, matrix(1, {-3})}, {1, matrix(1, {1})}, {2, matrix(1, {2})}}),
                block(false, {{0, matrix(1, {6})}, {1, matrix(1, {-2})}, {2, matrix(1, {-4})}}),
                block(true, {{1, matrix(1, {1})}})},
               2);
  faces.find_plain();
  ASSERT_FALSE(faces.excluded());
  EXPECT_EQ(faces.unknowns(), 1);
  EXPECT_EQ(faces.blocks()[0].size + faces.blocks()[1].size, 0);
  for (const int y : {-2, 0, 7}) {
    const auto x = faces.point({Rational(y)});
    EXPECT_EQ(x[0] + 2 * x[1], Rational(3));
    EXPECT_EQ(faces.blocks()[2].value({Rational(y)})(0, 0), x[0]);
  }
}

/// 2 x1 > 1 and 1 > 3 x1: multipliers 1 of the first and 2/3 of the second.
TEST(FacesTest, WhatExcludesTheBlocksAtOnceHasMultipliers) {
  Faces faces = faces_of({block(true, {{0, matrix(1, {-1})}, {1, matrix(1, {2})}}),
                          block(true, {{0, matrix(1, {1})}, {1, matrix(1, {-3})}})},
                         1);
  faces.find_plain();
  ASSERT_TRUE(faces.excluded());
  ASSERT_EQ(faces.chain().back().S.size(), 2U);
  EXPECT_EQ(faces.chain().back().S[0](0, 0), 1);
  EXPECT_EQ(faces.chain().back().S[1](0, 0), Rational(2) / 3);
}

/// P(1, 1) = 0 and P >= 0 leave P(1, 2) = 0, and [0, P(1, 2) - 1; *, 0] >= 0 leaves 1.
TEST(FacesTest, AChainHasTheMultipliersOfEachStepInAllRows) {
  Faces faces =
      faces_of({block(false, {{2, matrix(2, {0, 1, 1, 0})}, {3, matrix(2, {0, 0, 0, 1})}}),
                block(false, {{0, matrix(2, {0, -1, -1, 0})}, {2, matrix(2, {0, 1, 1, 0})}})},
               3);
  faces.find_plain();
  ASSERT_TRUE(faces.excluded());
  ASSERT_EQ(faces.chain().size(), 2U);
  const FaceOfBlock& first = faces.chain().front().faces.front();
  EXPECT_EQ(first.block, 0U);
  EXPECT_EQ(first.V, matrix(2, {1, 0, 0, 0}).leftCols(1));
  // What the first step leaves of the other block has the rows that it had.
  EXPECT_EQ(faces.chain().back().faces.front().block, 1U);
  EXPECT_EQ(faces.chain().back().faces.front().V.rows(), 2);
}

/// What is left has no unknowns: [1, 2; 2, 3] is not positive.
TEST(FacesTest, NumbersAreExcludedByAVector) {
  Faces faces = faces_of({block(true, {{0, matrix(2, {1, 2, 2, 3})}})}, 0);
  faces.exclude_numbers();
  ASSERT_TRUE(faces.excluded());
  const RationalMatrix& v = faces.chain().back().faces.front().V;
  EXPECT_LE((v.transpose() * matrix(2, {1, 2, 2, 3}) * v)(0, 0), 0);

  Faces holding = faces_of({block(true, {{0, matrix(2, {2, 1, 1, 2})}})}, 0);
  holding.exclude_numbers();
  EXPECT_FALSE(holding.excluded());
}

TEST(FacesTest, OppositeMatricesLeaveTheirElements) {
  // [x1, x2 - 1; *, x3] >= 0 and three times its negative.
  const auto terms = [](const Rational& by) {
    return std::vector<std::pair<int, RationalMatrix>>{{0, by * matrix(2, {0, -1, -1, 0})},
                                                       {1, by * matrix(2, {1, 0, 0, 0})},
                                                       {2, by * matrix(2, {0, 1, 1, 0})},
                                                       {3, by * matrix(2, {0, 0, 0, 1})}};
  };
  Faces faces = faces_of({block(false, terms(1)), block(false, terms(-3))}, 3);
  faces.find_plain();
  ASSERT_FALSE(faces.excluded());
  EXPECT_EQ(faces.unknowns(), 0);
  EXPECT_EQ(faces.point({}), (std::vector<Rational>{0, 1, 0}));
  Faces strict = faces_of({block(true, terms(1)), block(false, terms(-3))}, 3);
  strict.find_plain();
  EXPECT_TRUE(strict.excluded());
}

TEST(FacesTest, NumbersThatCrossExclude) {
  const auto bracket = [](const Rational& high) {
    Faces faces = faces_of({block(false, {{0, matrix(1, {-1})}, {1, matrix(1, {1})}}),
                            block(false, {{0, matrix(1, {high})}, {1, matrix(1, {-1})}})},
                           1);
    faces.find_plain();
    return faces;
  };
  const Rational little = power_of_ten(-50);
  EXPECT_TRUE(bracket(1 - little).excluded());
  EXPECT_FALSE(bracket(1).excluded());
  EXPECT_EQ(bracket(1).unknowns(), 0);
  EXPECT_EQ(bracket(1 + little).unknowns(), 1);
  EXPECT_EQ(bracket(1 + little).steps(), 0U);
}

TEST(FacesTest, AZeroOnTheDiagonalEmptiesItsRowAndGoesOn) {
  // [0, x1; *, x2] >= 0 leaves x1 = 0, and then [x1, x3; *, 1] >= 0 that x3 = 0.
  std::vector<RationalBlock> blocks = {
      block(false, {{1, matrix(2, {0, 1, 1, 0})}, {2, matrix(2, {0, 0, 0, 1})}}),
      block(false, {{0, matrix(2, {0, 0, 0, 1})},
                    {1, matrix(2, {1, 0, 0, 0})},
                    {3, matrix(2, {0, 1, 1, 0})}})};
  Faces faces = faces_of(blocks, 3);
  faces.find_plain();
  ASSERT_FALSE(faces.excluded());
  EXPECT_EQ(faces.steps(), 2U);
  EXPECT_EQ(faces.free(), std::vector<int>{2});
  EXPECT_EQ(faces.point({5}), (std::vector<Rational>{0, 5, 0}));
  // With x3 >= 1 beside them there is nothing.
  blocks.push_back(block(false, {{0, matrix(1, {-1})}, {3, matrix(1, {1})}}));
  Faces none = faces_of(blocks, 3);
  none.find_plain();
  EXPECT_TRUE(none.excluded());
}

TEST(FacesTest, WhatIsOnlyRoundedDecidesNothing) {
  RationalBlock rounded =
      block(false, {{0, matrix(2, {0, 1, 1, 0})}, {1, matrix(2, {1, 0, 0, 0})}});
  rounded.exact = false;
  Faces faces = faces_of({rounded}, 1);
  faces.find_plain();
  EXPECT_FALSE(faces.excluded());
  EXPECT_EQ(faces.steps(), 0U);
}

TEST(FacesTest, DependentUnknownsAreSetToZero) {
  Faces faces = faces_of({block(true, {{1, matrix(2, {1, 0, 0, 0})},
                                       {2, matrix(2, {0, 0, 0, 1})},
                                       {3, matrix(2, {2, 0, 0, -3})}})},
                         4);
  faces.drop_dependent();
  EXPECT_EQ(faces.free(), (std::vector<int>{1, 2}));
  EXPECT_EQ(faces.point({5, 6}), (std::vector<Rational>{5, 6, 0, 0}));
}

/// B(x) = U diag(D(x), 0) U' with D(x) = D_0 + x D_1: the last columns of U^-T are the range of a
/// multiplier of rank n - r, which a solver's rounding hides.
class PlantedFace : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    std::mt19937 generator(static_cast<unsigned>(GetParam()));
    const auto between = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(generator);
    };
    n_ = between(2, 5);
    r_ = between(1, n_ - 1);
    U_ = RationalMatrix::Identity(n_, n_);
    for (int k = 0; k < n_ + 2; ++k) {
      const int i = between(0, n_ - 1);
      const int j = (i + between(1, n_ - 1)) % n_;
      U_.row(i) += Rational(between(-3, 3)) * U_.row(j);
    }
    for (int i = 0; i < n_; ++i) U_.row(i) *= power_of_ten(between(-2, 2));
    for (int i = 0; i <= 1; ++i) {
      RationalMatrix D = zeros(n_);
      for (int k = 0; k < r_; ++k) D(k, k) = Rational(between(1, 5));
      const RationalMatrix half = U_.lazyProduct(D);
      terms_.emplace_back(i, half.lazyProduct(U_.transpose()));
    }
    const RationalMatrix V = numbers::rational_inverse(U_)->transpose().rightCols(n_ - r_);
    RationalMatrix S = zeros(n_ - r_);
    for (int k = 0; k < n_ - r_; ++k) S(k, k) = Rational(between(1, 5));
    const RationalMatrix half = V.lazyProduct(S);
    const RationalMatrix Y = half.lazyProduct(V.transpose());
    std::uniform_real_distribution<double> noise(-1e-20, 1e-20);
    Rational size = 0;
    for (int i = 0; i < n_; ++i) size = std::max(size, Y(i, i));
    found_.Y = {numbers::MatrixOf<DoubleDouble>(n_, n_)};
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j <= i; ++j)
        found_.Y[0](i, j) = found_.Y[0](j, i) =
            nearest_double_double(Rational(Y(i, j) / size)) + DoubleDouble(noise(generator));
    found_.rows = {std::vector<int>(static_cast<std::size_t>(n_), 0)};
  }

  int n_ = 0;
  int r_ = 0;
  RationalMatrix U_;
  std::vector<std::pair<int, RationalMatrix>> terms_;
  FoundMultipliers found_;
};

TEST_P(PlantedFace, IsFoundThroughTheRounding) {
  Faces faces = faces_of({block(false, terms_)}, 1);
  const ExactMultipliers exact = exact_multipliers(faces, found_);
  ASSERT_EQ(exact.say, ExactMultipliers::Say::restricts);
  faces.restrict_to(exact);
  ASSERT_FALSE(faces.excluded());
  EXPECT_EQ(faces.unknowns(), 1);
  // Not less than the face; where a part of the multiplier is small, a face of it that is larger.
  EXPECT_GE(faces.blocks()[0].size, r_);
  EXPECT_LT(faces.blocks()[0].size, n_);
  const RationalMatrix left = faces.blocks()[0].value({Rational(1)});
  EXPECT_TRUE(numbers::is_rational_semidefinite(left));
  EXPECT_EQ(numbers::is_rational_definite(left), faces.blocks()[0].size == r_);
}

TEST_P(PlantedFace, ExcludesWhereTheBlockIsStrict) {
  const Faces faces = faces_of({block(true, terms_)}, 1);
  const ExactMultipliers exact = exact_multipliers(faces, found_);
  ASSERT_EQ(exact.say, ExactMultipliers::Say::excludes);
  // The proof again, from the multiplier that is given.
  const RationalMatrix half = exact.faces[0].V.lazyProduct(exact.S[0]);
  const RationalMatrix Y = half.lazyProduct(exact.faces[0].V.transpose());
  EXPECT_TRUE(numbers::is_rational_semidefinite(Y));
  for (const auto& [i, B] : terms_) {
    EXPECT_EQ(RationalMatrix(B.lazyProduct(Y)).trace(), 0);
  }
}

TEST_P(PlantedFace, IsNotFoundWhereARelativeChangeOf1e15HasRemovedIt) {
  // On the face the block is now positive, so no multiplier is near.
  const RationalMatrix V = numbers::rational_inverse(U_)->transpose().rightCols(n_ - r_);
  const RationalMatrix square = U_.lazyProduct(U_.transpose());
  terms_[0].second += power_of_ten(-15) * square;
  const Faces faces = faces_of({block(false, terms_)}, 1);
  EXPECT_EQ(exact_multipliers(faces, found_).say, ExactMultipliers::Say::nothing);
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlantedFace, testing::Range(1, 31));

/// x1 + x2 / 10^6 + 3 x3 = 1, x4 = 1/8, near a point.
TEST(PrintableTest, DecimalsAreExactlyInTheSpace) {
  Faces faces = faces_of({block(false, {{0, matrix(1, {-1})},
                                        {1, matrix(1, {1})},
                                        {2, matrix(1, {power_of_ten(-6)})},
                                        {3, matrix(1, {3})}}),
                          block(false, {{0, matrix(1, {1})},
                                        {1, matrix(1, {-1})},
                                        {2, matrix(1, {-power_of_ten(-6)})},
                                        {3, matrix(1, {-3})}}),
                          block(false, {{0, matrix(1, {Rational(-1, 8)})}, {4, matrix(1, {1})}}),
                          block(false, {{0, matrix(1, {Rational(1, 8)})}, {4, matrix(1, {-1})}})},
                         4);
  faces.find_plain();
  ASSERT_EQ(faces.unknowns(), 2);
  for (const int digits : {4, 8, 12, 15}) {
    const auto x =
        printable_point(faces, {Rational(1, 3), Rational(2.0e5)}, {1, 1e6, 1, 1}, digits);
    ASSERT_TRUE(x) << digits;
    std::vector<Rational> printed;
    for (const double value : *x) printed.push_back(printed_fraction(value));
    EXPECT_EQ(Rational(printed[0] + printed[1] * power_of_ten(-6) + 3 * printed[2]), 1);
    EXPECT_EQ(printed[3], Rational(1, 8));
    EXPECT_NEAR((*x)[0], 1.0 / 3, 3 * std::pow(10, 1 - digits));
    EXPECT_NEAR((*x)[1], 2e5, 3e6 * std::pow(10, 1 - digits));
  }
}

/// 3 x = 1 has no decimals.
TEST(PrintableTest, ThereMayBeNone) {
  Faces faces = faces_of({block(false, {{0, matrix(1, {-1})}, {1, matrix(1, {3})}}),
                          block(false, {{0, matrix(1, {1})}, {1, matrix(1, {-3})}})},
                         1);
  faces.find_plain();
  ASSERT_EQ(faces.unknowns(), 0);
  EXPECT_FALSE(printable_point(faces, {}, {1}, 15));
}

TEST(RationalBlocksTest, AreWhatTheFileSaysOrSayThatTheyAreNot) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, r: {shape: scalar, default: "
      "sqrt(2)}}\n  unknowns: {P: symmetric n}\n  require:\n    exact: He(P*A) <= 0.1*eye(n)\n"
      "    ends: {forall: \"t in [0, 0.3]\", that: \"t*P > 0\"}\n    root: r*P > 0\n"
      "data: {A: [[0.1, 2], [0, 1/3]]}\n");
  const lmi::Inequalities of(yaml.instance);
  const lmi::Lmi lmi = compile(of);
  const auto blocks = rational_blocks(of, lmi.blocks);
  ASSERT_EQ(blocks.size(), lmi.blocks.size());
  const std::vector<Rational> x = {Rational(1, 7), Rational(2), Rational(3)};
  const RationalMatrix value = blocks[0].value(x);
  EXPECT_EQ(value(0, 0), Rational(1, 10) - 2 * Rational(1, 10) * x[0]);
  EXPECT_EQ(value(1, 1), Rational(1, 10) - 2 * (2 * x[1] + x[2] / 3));
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    EXPECT_EQ(blocks[k].exact, lmi.blocks[k].name != "root");
    if (lmi.blocks[k].name == "ends") {
      const Rational factor = blocks[k].value(x)(0, 0) / x[0];
      EXPECT_TRUE(factor == 0 || factor == Rational(3, 10)) << factor;
    }
  }
}

}  // namespace
}  // namespace gainsmith::verdict
