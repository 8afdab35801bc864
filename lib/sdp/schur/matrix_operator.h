// The inequalities of a MatrixProgram as linear maps, applied by products of matrices. For unknowns
// and blocks of n rows the Schur operator costs O(n^3) an application; as a matrix it has O(n^4)
// elements.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "sdp/schur/linalg.h"
#include "sdp/schur/matrix_program.h"

namespace gainsmith::sdp {

/// A matrix of `size` rows beside an unknown: E, or F'. One with at most one element a
/// column costs no product.
class Side {
 public:
  explicit Side(Matrix<double> values);

  Eigen::Index rows() const { return rows_; }
  Eigen::Index columns() const { return columns_; }
  /// M * this, M with rows() columns.
  Matrix<double> from_left(const Matrix<double>& M) const;
  /// this' * M, M with rows() rows.
  Matrix<double> transposed_times(const Matrix<double>& M) const;
  /// this * M, M with columns() rows.
  Matrix<double> times(const Matrix<double>& M) const;
  /// sum += this * M.
  void add_product(const Matrix<double>& M, Matrix<double>& sum) const;
  bool operator==(const Side& other) const = default;

 private:
  Eigen::Index rows_, columns_;
  bool sparse_ = true;
  std::vector<Eigen::Index> row_;  ///< of the element of each column, where sparse
  std::vector<double> value_;
  Matrix<double> dense_;
};

/// x -> L(x) = (sum_t He(E_t V_t F_t) + sum_i x_i G_i, a_r'x), its adjoint, and the Schur operator.
class MatrixOperator {
 public:
  explicit MatrixOperator(const MatrixProgram& program);

  /// Sides with few elements are in E where V is symmetric, the largest element of one is 1, and
  /// no two terms of one V in one block have the same E: so equal sides compare as equal.
  struct Term {
    std::size_t unknown;
    Side E, F;  ///< F transposed
  };
  struct Scalar {
    int variable;
    std::vector<MatrixProgram::Element> elements;  ///< of G_i, upper triangle
  };
  struct Block {
    std::vector<Term> terms;
    std::vector<Scalar> scalars;
    /// How many terms an unknown has.
    auto terms_of(std::size_t unknown) const {
      return std::ranges::count(terms, unknown, &Term::unknown);
    }
  };
  struct Row {
    Vector<double> coefficients;  ///< m
  };

  const MatrixProgram& program() const { return program_; }
  const Layout& layout() const { return layout_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<Row>& rows() const { return rows_; }
  Eigen::Index variables() const { return static_cast<Eigen::Index>(program_.c.size()); }
  /// The scalars that are in no matrix.
  const std::vector<int>& scalars() const { return scalars_; }

  /// The constant parts C_k, a_r0.
  const Blocks<double>& constant() const { return constant_; }
  /// S = L(x).
  void apply(const Vector<double>& x, Blocks<double>& S) const;
  /// g = L*(Q), Q symmetric: g_i = <F_i, Q> with L(x) = sum x_i F_i.
  void adjoint(const Blocks<double>& Q, Vector<double>& g) const;

  /// V of x.
  Matrix<double> unpack(std::size_t unknown, const Vector<double>& x) const;
  /// x := V.
  void pack(std::size_t unknown, const Matrix<double>& V, Vector<double>& x) const;
  /// g += what <R, dV> is in the scalars of V.
  void add_gradient(std::size_t unknown, const Matrix<double>& R, Vector<double>& g) const;
  /// R with <R, dV> = g'dx.
  Matrix<double> gradient(std::size_t unknown, const Vector<double>& g) const;

 private:
  void add_terms(const MatrixProgram::Block& from, Block& to) const;

  const MatrixProgram& program_;
  Layout layout_;
  std::vector<Block> blocks_;
  std::vector<Row> rows_;
  std::vector<int> scalars_;
  Blocks<double> constant_;
};

/// M(v) = L*(W L(v) W) at one scaling W (blocks; the linear part holds x_r / s_r = w_r^2).
class SchurOperator {
 public:
  explicit SchurOperator(const MatrixOperator& of);

  /// Keeps a pointer to W, and W E, W F' and W G W of all terms for apply().
  void set_scaling(const Blocks<double>& W);
  void apply(const Vector<double>& v, Vector<double>& Mv) const;
  /// <G_i, W G_i W> of a scalar.
  double diagonal(int scalar) const;
  /// Multiplications of apply(), about.
  double cost() const;

 private:
  struct Scaled {
    std::vector<Matrix<double>> E, F;     ///< W E, W F' of each term
    std::vector<Matrix<double>> scalars;  ///< W G W
  };
  const MatrixOperator& of_;
  const Blocks<double>* W_ = nullptr;
  std::vector<Scaled> scaled_;
  mutable std::vector<Matrix<double>> unknowns_;
};

}  // namespace gainsmith::sdp
