// What the problems of the catalogue are put together from.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "support/linear_algebra.h"
#include "support/sdp_catalogue.h"

namespace gainsmith::sdp::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Answer = CatalogueProblem::Answer;

/// Uniform numbers in [-1, 1), the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : stream_(seed, 0) {}
  double number() { return 2 * stream_.uniform() - 1; }
  MatrixXd matrix(int rows, int columns) {
    MatrixXd result(rows, columns);
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i) result(i, j) = number();
    return result;
  }
  MatrixXd symmetric(int n) {
    const MatrixXd a = matrix(n, n);
    return a + a.transpose();
  }
  MatrixXd orthogonal(int n) { return tests::orthogonal_factor(matrix(n, n)); }

 private:
  RandomStream stream_;
};

/// Appends the upper triangle of `matrix`, nonzeros only, as entries of one block from its row
/// `first` on.
void put(std::vector<Entry>& list, int block, const MatrixXd& matrix, int first = 0);

/// m costs of zero and m + 1 matrices without entries.
Problem empty(std::vector<Block> blocks, int m);

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

inline double trace_product(const MatrixXd& a, const MatrixXd& b) {
  return a.cwiseProduct(b).sum();
}

/// How a planted optimum looks: in each block X = Q diag(lambda, 0) Q' with `rank` eigenvalues from
/// 0.5 to 2.5, Y = Q diag(0, omega) Q' (Q = I in a diagonal block). `gap` eigenvectors belong to
/// neither: no strict complementarity when it is positive. The F_i are scaled by 10^-spread to
/// 10^spread.
struct Planted {
  std::string name;
  std::vector<Block> blocks;
  int m = 0;
  std::vector<int> rank;  ///< by block
  std::uint64_t seed = 0;
  int gap = 0;  ///< in the first block
  double spread = 0;
  int skip = 0;  ///< where positive, F_i, i > 1, is empty in block b when skip divides i + b
  int rows = 0;  ///< where positive, F_i, i > 1, has entries in so many rows and columns only
};

/// Optimal at X, Y and a random x by F_0 = sum x_i F_i - X, c_i = F_i.Y. F_1 > 0, and some s I has
/// the products with the F_i that Y has: so both sides have interior points, and what rounding does
/// to F_0 and c cannot make them infeasible.
CatalogueProblem planted(const Planted& plan);

/// The problems side by side, each with blocks and variables of its own. The sum of the optima; the
/// answer of the one that has none.
CatalogueProblem direct_sum(const std::string& name, const std::vector<CatalogueProblem>& parts);

// By theme; sdp_catalogue() has them all.
std::vector<CatalogueProblem> control_problems();
std::vector<CatalogueProblem> closed_forms();
std::vector<CatalogueProblem> planted_problems();
std::vector<CatalogueProblem> infeasible_problems();
std::vector<CatalogueProblem> delicate_problems();

}  // namespace gainsmith::sdp::testing
