// Multipliers that are nearly a certificate become one, whatever their rank.
#include "verdict/refined_multipliers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/eigen_scalars.h"
#include "base/random.h"

namespace gainsmith::verdict {
namespace {

using Matrix100 = numbers::MatrixOf<Decimal100>;

Matrix100 drawn(RandomStream& random, int rows, int columns) {
  Matrix100 matrix(rows, columns);
  for (Eigen::Index e = 0; e < matrix.size(); ++e) matrix(e) = Decimal100(2 * random.uniform() - 1);
  return matrix;
}

Decimal100 inner(const Matrix100& a, const Matrix100& b) {
  Decimal100 sum(0);
  for (Eigen::Index e = 0; e < a.size(); ++e) sum += a(e) * b(e);
  return sum;
}

ExactElements<Decimal100> elements_of(const Matrix100& B) {
  ExactElements<Decimal100> result;
  for (int c = 0; c < B.cols(); ++c)
    for (int r = 0; r < B.rows(); ++r) result.push_back({r, c, B(r, c), 0});
  return result;
}

Matrix100 gram_of(const Matrix100& L) { return L.lazyProduct(L.transpose()); }

/// A unit vector w with L' w = 0 (Gram and Schmidt).
Matrix100 beside(RandomStream& random, const Matrix100& L) {
  std::vector<Matrix100> basis;
  const auto add = [&](Matrix100 q) {
    for (const Matrix100& b : basis) q -= b * inner(b, q);
    basis.push_back(q / sqrt(inner(q, q)));
  };
  for (Eigen::Index c = 0; c < L.cols(); ++c) add(L.col(c));
  add(drawn(random, static_cast<int>(L.rows()), 1));
  return basis.back();
}

/// Blocks B_ki of two blocks for which Y_k = L_k L_k' is a certificate up to 100 digits.
struct Planted {
  std::vector<Matrix100> L;
  std::vector<ExactBlock<Decimal100>> blocks;

  Planted(RandomStream& random, int n, int rank, int unknowns) {
    for (int k = 0; k < 2; ++k) L.push_back(drawn(random, n, rank));
    blocks.resize(2);
    for (auto& block : blocks) block.size = n;
    for (int i = 1; i <= unknowns; ++i) {
      std::vector<Matrix100> B;
      Decimal100 residual(0), weight(0);
      for (int k = 0; k < 2; ++k) {
        const Matrix100 half = drawn(random, n, n);
        B.push_back(half + half.transpose());
        residual += inner(B.back(), gram_of(L[static_cast<std::size_t>(k)]));
      }
      weight = inner(Matrix100::Identity(n, n), gram_of(L[0]));
      for (int r = 0; r < n; ++r) B[0](r, r) -= residual / weight;
      for (std::size_t k = 0; k < 2; ++k) blocks[k].terms.emplace_back(i, elements_of(B[k]));
    }
  }

  /// The multipliers with factors that are off by so much.
  std::vector<FactoredMultiplier> near(RandomStream& random, double by) const {
    std::vector<FactoredMultiplier> result;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto n = static_cast<int>(L[k].rows());
      Matrix100 off = drawn(random, n, static_cast<int>(L[k].cols()));
      off = L[k] + off * Decimal100(by);
      result.push_back({&blocks[k], off});
    }
    return result;
  }

  double residual(const std::vector<FactoredMultiplier>& multipliers) const {
    double worst = 0;
    for (std::size_t i = 0; i < blocks[1].terms.size(); ++i) {
      Decimal100 sum(0);
      for (const FactoredMultiplier& one : multipliers)
        sum += inner(dense(one.block->terms[i].second, one.block->size).mid, one.value());
      worst = std::max(worst, std::abs(static_cast<double>(sum)));
    }
    return worst;
  }
};

TEST(RefinedMultipliers, LoseTheirResidualAndKeepTheirRank) {
  for (int rank = 1; rank <= 4; ++rank)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      RandomStream random(0x901, seed);
      const Planted planted(random, 4, rank, 4);
      auto multipliers = planted.near(random, 1e-6);
      ASSERT_GT(planted.residual(multipliers), 1e-9);
      ASSERT_TRUE(refine(multipliers, 4)) << rank << ' ' << seed;
      EXPECT_LT(planted.residual(multipliers), 1e-57) << rank << ' ' << seed;
      for (std::size_t k = 0; k < 2; ++k) {
        const Matrix100 moved = multipliers[k].value() - gram_of(planted.L[k]);
        for (Eigen::Index e = 0; e < moved.size(); ++e)
          EXPECT_LT(std::abs(static_cast<double>(moved(e))), 1e-3);
        EXPECT_TRUE((moved - moved.transpose()).isZero(Decimal100(0)));
        // >= 0: the quadratic form at random vectors, and 0 where the rank is 1.
        for (int t = 0; t < 10; ++t) {
          const Matrix100 v = drawn(random, 4, 1);
          const auto form = static_cast<double>(inner(gram_of(v), multipliers[k].value()));
          EXPECT_GE(form, -1e-90);
        }
        if (rank > 1) continue;
        const Matrix100 Y = multipliers[k].value();
        EXPECT_LT(std::abs(static_cast<double>(Decimal100(Y(0, 0) * Y(1, 1) - Y(0, 1) * Y(1, 0)))),
                  1e-57);
      }
    }
}

/// A block w w' of an unknown of its own leaves only certificates with w' Y w = 0: multipliers of
/// full rank, which are off by so much in the direction w, lose it.
TEST(RefinedMultipliers, OfFullRankLoseADirectionThatNoCertificateHas) {
  constexpr int kSize = 4, kUnknowns = 3;
  for (const double off : {1e-10, 1e-13, 1e-16})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      RandomStream random(0x903, seed);
      Planted planted(random, kSize, kSize - 1, kUnknowns);
      const Matrix100 w = beside(random, planted.L[0]);
      planted.blocks[0].terms.emplace_back(kUnknowns + 1, elements_of(gram_of(w)));
      std::vector<FactoredMultiplier> multipliers = planted.near(random, off * 1e-4);
      Matrix100 whole(kSize, kSize);
      whole << multipliers[0].L, w * Decimal100(off);
      multipliers[0].L = whole;
      const auto along_w = [&] {
        return std::abs(static_cast<double>(inner(gram_of(w), multipliers[0].value())));
      };
      ASSERT_GT(along_w(), 0.9 * off * off);
      EXPECT_TRUE(refine(multipliers, kUnknowns + 1)) << off << ' ' << seed;
      EXPECT_LT(along_w(), 1e-70) << off << ' ' << seed;
      EXPECT_LT(planted.residual(multipliers), 1e-57) << off << ' ' << seed;
    }
}

/// Where no certificate is near, none is made.
TEST(RefinedMultipliers, FarFromACertificateThereIsNone) {
  // <I, Y> = 0 asks for Y = 0.
  ExactBlock<Decimal100> block;
  block.size = 2;
  block.terms.emplace_back(1, elements_of(Matrix100::Identity(2, 2)));
  std::vector<FactoredMultiplier> multipliers = {{&block, Matrix100::Identity(2, 2)}};
  EXPECT_FALSE(refine(multipliers, 1));
}

}  // namespace
}  // namespace gainsmith::verdict
