// Random sets to project onto, for the tests of the projections.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <random>

#include "numerics/matrix.h"

namespace gainsmith::numerics {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  bool coin() { return below(2) == 0; }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  Matrix matrix(Eigen::Index rows, Eigen::Index cols) {
    Matrix result(rows, cols);
    for (double& value : result.reshaped()) value = number();
    return result;
  }
  /// B diag B' with a condition of 1 to 1e8, in axes of its own or along the coordinates.
  Matrix definite(Eigen::Index n) {
    const double decades = below(9);
    Matrix B = Matrix::Identity(n, n);
    if (coin()) B = Eigen::HouseholderQR<Matrix>(matrix(n, n)).householderQ();
    Vector scale(n);
    for (double& value : scale) value = std::pow(10, decades * (number() - 1) / 2);
    const Matrix P = std::pow(10, below(7) - 3) * B * scale.asDiagonal() * B.transpose();
    return 0.5 * (P + P.transpose());
  }
  /// Rows with repeated, redundant, nearly parallel and dependent ones.
  Matrix rows(Eigen::Index m, Eigen::Index n) {
    Matrix A = matrix(m, n);
    for (Eigen::Index i = 1; i < m; ++i) {
      const Eigen::Index other = below(static_cast<int>(i));
      switch (below(6)) {
        case 0:
          A.row(i) = A.row(other);
          break;
        case 1:
          A.row(i) = A.row(other) + std::pow(10, -2 - below(7)) * matrix(1, n);
          break;
        case 2:
          A.row(i) = 0.5 * A.row(other) + 0.25 * A.row(below(static_cast<int>(i)));
          break;
        default:
          break;
      }
    }
    return A;
  }

 private:
  std::mt19937 random_;
};

/// epsilon (|M| |v|): what rounding v, or the product, changes M v by.
inline Vector unsure(const Matrix& M, const Matrix& v) {
  return kEpsilon * (M.cwiseAbs() * v.cwiseAbs());
}

struct RandomSet {
  Matrix P, A, b, inside, x;
};

/// A polytope with `inside` in it, often at a vertex where many rows meet, and x anywhere.
inline RandomSet polytope(Draw& draw) {
  RandomSet set;
  const Eigen::Index n = 1 + draw.below(8), m = 1 + draw.below(3 * static_cast<int>(n) + 2);
  set.P = draw.definite(n);
  set.A = draw.rows(m, n);
  set.inside = draw.matrix(n, 1);
  set.x = set.inside + std::pow(10, draw.below(5) - 2) * draw.matrix(n, 1);
  if (draw.coin()) {
    // Whole numbers, among them many zeros: rows meet exactly, on axes and at the origin, and pairs
    // of them are equations.
    set.A = (1.4 * set.A).array().round();
    set.inside = (1.4 * set.inside).array().round();
    for (Eigen::Index i = 1; i < m; ++i)
      if (draw.below(4) == 0) set.A.row(i) = -set.A.row(i - 1);
    set.b = set.A * set.inside;
    for (double& value : set.b.reshaped()) value += draw.below(5) == 0;
    return set;
  }
  set.b = set.A * set.inside;
  for (double& value : set.b.reshaped())
    if (draw.coin()) value += std::abs(draw.number());
  // What rounding took away at a vertex.
  set.b.col(0) += 2 * static_cast<double>(n) * unsure(set.A, set.inside);
  return set;
}

struct RandomEllipsoid {
  Matrix P, x0, Q, r, x;
};

inline RandomEllipsoid ellipsoid(Draw& draw) {
  const Eigen::Index n = 1 + draw.below(8);
  RandomEllipsoid set{draw.definite(n), draw.matrix(n, 1), draw.definite(n), {}, {}};
  if (draw.below(3) == 0) {
    // On a grid, so that G'G is semidefinite in every arithmetic.
    const Matrix G =
        (draw.matrix(1 + draw.below(static_cast<int>(n)), n) * 1024).array().round() / 1024;
    set.Q = G.transpose() * G;
  }
  set.r = Matrix::Constant(1, 1, std::pow(10, draw.below(5) - 2) * set.Q.norm());
  set.x = set.x0 + std::pow(10, draw.below(5) - 2) * draw.matrix(n, 1);
  return set;
}

struct RandomFlat {
  Matrix P, A, b, x;
};

/// A z = b with a solution, also where rows are repeated, nearly parallel or combinations.
inline RandomFlat flat(Draw& draw) {
  const Eigen::Index n = 1 + draw.below(8), m = 1 + draw.below(static_cast<int>(n) + 2);
  RandomFlat set{draw.definite(n), draw.rows(m, n), {}, {}};
  // On grids, so that the planted solution is one exactly.
  set.A = (set.A * 0x1p20).array().round() * 0x1p-20;
  Matrix planted = (draw.matrix(n, 1) * 0x1p20).array().round() * 0x1p-20;
  if (draw.coin()) {
    set.A = (1.4 * set.A).array().round();
    planted = (1.4 * planted).array().round();
  }
  set.b = set.A * planted;
  set.x = planted + std::pow(10, draw.below(5) - 2) * draw.matrix(n, 1);
  return set;
}

}  // namespace gainsmith::numerics
