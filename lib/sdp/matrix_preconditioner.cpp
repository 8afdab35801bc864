#include "sdp/matrix_preconditioner.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/stop.h"
#include "sdp/work.h"

namespace gainsmith::sdp {
namespace {

using Dense = Matrix<double>;

/// Part of the mean diagonal element that keeps a Gram matrix from being singular.
constexpr double kFloor = 1e-13;

/// G'E and G'F' of the terms of one unknown in one block.
struct Scaled {
  std::vector<Dense> E, F;
};

std::vector<Scaled> scaled_terms(const MatrixOperator& of, std::size_t unknown,
                                 const Blocks<double>& G) {
  std::vector<Scaled> result;
  for (std::size_t k = 0; k < of.blocks().size(); ++k) {
    Scaled scaled;
    for (const MatrixOperator::Term& term : of.blocks()[k].terms) {
      if (term.unknown != unknown) continue;
      const Dense transposed = G.dense(static_cast<int>(k)).transpose();
      scaled.E.push_back(term.E.from_left(transposed));
      scaled.F.push_back(term.F.from_left(transposed));
    }
    if (!scaled.E.empty()) result.push_back(std::move(scaled));
  }
  return result;
}

/// T^-T of M = T T'.
Dense whitening(Dense M) {
  const auto n = static_cast<double>(std::max<Eigen::Index>(M.rows(), 1));
  M.diagonal().array() += kFloor * M.trace() / n;
  const Eigen::LLT<Dense> factor(M);
  Dense inverse = Dense::Identity(M.rows(), M.cols());
  factor.matrixU().solveInPlace(inverse);
  return inverse;
}

Dense eigenvectors(const Dense& M) {
  return Eigen::SelfAdjointEigenSolver<Dense>(M).eigenvectors();
}

/// D_ij += K_ii G_jj + G_ii K_jj + G_ij K_ij + G_ji K_ji.
void add_symmetric(const Dense& G, const Dense& K, Dense& D) {
  const Vector<double> g = G.diagonal(), k = K.diagonal();
  D.noalias() += k * g.transpose();
  D.noalias() += g * k.transpose();
  D.array() += G.array() * K.array();
  D += G.cwiseProduct(K).transpose();
}

/// 1 / D, of directions that M does not see 0.
Dense reciprocal(const Dense& D) {
  const double least = D.maxCoeff() * 1e-30;
  return D.unaryExpr([least](double d) { return d > least ? 1 / d : 0; });
}

}  // namespace

Preconditioner::Basis Preconditioner::symmetric_basis(std::size_t unknown, const SchurOperator& M,
                                                      const Blocks<double>& G) const {
  const Eigen::Index n = of_.program().unknowns[unknown].rows;
  std::vector<Scaled> blocks = scaled_terms(of_, unknown, G);
  Dense total = Dense::Zero(n, n);
  for (const Scaled& block : blocks)
    for (std::size_t t = 0; t < block.E.size(); ++t) {
      total.noalias() += block.E[t].transpose() * block.E[t];
      total.noalias() += block.F[t].transpose() * block.F[t];
    }
  const Dense Q0 = whitening(std::move(total));
  const Dense image = Q0.transpose() * M.apply_to(unknown, Q0 * Q0.transpose()) * Q0;
  Basis basis;
  basis.left = Q0 * eigenvectors(image);
  Dense D = Dense::Zero(n, n);
  for (Scaled& block : blocks) {
    for (Dense& E : block.E) E = (E * basis.left).eval();
    for (Dense& F : block.F) F = (F * basis.left).eval();
    for (std::size_t t = 0; t < block.E.size(); ++t)
      for (std::size_t s = 0; s < block.E.size(); ++s) {
        spend_on<double>(4 * static_cast<double>(n * block.E[t].size()));
        add_symmetric(block.E[s].transpose() * block.E[t], block.F[t].transpose() * block.F[s], D);
        add_symmetric(block.E[s].transpose() * block.F[t], block.E[t].transpose() * block.F[s], D);
      }
  }
  // Half of the quadratic form of e_i e_j' + e_j e_i' beside an element of the gradient.
  D.diagonal() *= 0.5;
  basis.weights = reciprocal(D);
  return basis;
}

Preconditioner::Basis Preconditioner::full_basis(std::size_t unknown,
                                                 const Blocks<double>& G) const {
  const MatrixProgram::Unknown& of = of_.program().unknowns[unknown];
  std::vector<Scaled> blocks = scaled_terms(of_, unknown, G);
  std::vector<Dense> lefts, rights;
  Dense left = Dense::Zero(of.rows, of.rows), right = Dense::Zero(of.columns, of.columns);
  for (const Scaled& block : blocks) {
    Dense& E = lefts.emplace_back(Dense::Zero(of.rows, of.rows));
    Dense& F = rights.emplace_back(Dense::Zero(of.columns, of.columns));
    for (std::size_t t = 0; t < block.E.size(); ++t) {
      E.noalias() += block.E[t].transpose() * block.E[t];
      F.noalias() += block.F[t].transpose() * block.F[t];
    }
    left += E;
    right += F;
  }
  const Dense P = whitening(std::move(left)), Q = whitening(std::move(right));
  Dense left_image = Dense::Zero(of.rows, of.rows), right_image = Dense::Zero(of.columns, of.columns);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    lefts[b] = (P.transpose() * lefts[b] * P).eval();
    rights[b] = (Q.transpose() * rights[b] * Q).eval();
    left_image += rights[b].trace() * lefts[b];
    right_image += lefts[b].trace() * rights[b];
  }
  Basis basis;
  basis.left = P * eigenvectors(left_image);
  basis.right = Q * eigenvectors(right_image);
  Dense D = Dense::Zero(of.rows, of.columns);
  for (Scaled& block : blocks) {
    for (Dense& E : block.E) E = (E * basis.left).eval();
    for (Dense& F : block.F) F = (F * basis.right).eval();
    for (std::size_t t = 0; t < block.E.size(); ++t)
      for (std::size_t s = 0; s < block.E.size(); ++s) {
        const Vector<double> e = block.E[s].cwiseProduct(block.E[t]).colwise().sum();
        const Vector<double> f = block.F[s].cwiseProduct(block.F[t]).colwise().sum();
        D.noalias() += 2 * e * f.transpose();
        const Dense across = block.E[s].transpose() * block.F[t];
        const Dense back = block.E[t].transpose() * block.F[s];
        D.array() += 2 * across.array() * back.array();
      }
  }
  basis.weights = reciprocal(D);
  return basis;
}

void Preconditioner::prepare(const SchurOperator& M, const Blocks<double>& G) {
  bases_.clear();
  scalars_.clear();
  for (std::size_t u = 0; u < of_.program().unknowns.size(); ++u) {
    check_stop();
    bases_.push_back(of_.program().unknowns[u].symmetric ? symmetric_basis(u, M, G)
                                                         : full_basis(u, G));
  }
  for (const int scalar : of_.scalars()) {
    const double d = M.diagonal(scalar);
    scalars_.push_back(d > 0 ? 1 / d : 0);
  }
}

void Preconditioner::apply(const Vector<double>& r, Vector<double>& z) const {
  z.setZero(r.size());
  for (std::size_t u = 0; u < bases_.size(); ++u) {
    const Basis& basis = bases_[u];
    const Dense& right = basis.right.size() > 0 ? basis.right : basis.left;
    Dense inside = basis.left.transpose() * of_.gradient(u, r) * right;
    inside = inside.cwiseProduct(basis.weights).eval();
    of_.pack(u, basis.left * inside * right.transpose(), z);
  }
  for (std::size_t i = 0; i < scalars_.size(); ++i)
    z[of_.scalars()[i]] = scalars_[i] * r[of_.scalars()[i]];
}

}  // namespace gainsmith::sdp
