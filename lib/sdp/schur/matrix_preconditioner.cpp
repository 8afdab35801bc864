#include "sdp/schur/matrix_preconditioner.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

#include "base/stop.h"
#include "sdp/core/work.h"

namespace gainsmith::sdp {
namespace {

using Dense = Matrix<double>;

/// Part of the mean diagonal element that keeps a Gram matrix from being singular.
constexpr double kFloor = 1e-13;

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

/// Part of the quadratic form of M at e_i e_j' + e_j e_i', from two products G and K of the sides
/// of two terms: D_ij += K_ii G_jj + G_ii K_jj + G_ij K_ij + G_ji K_ji.
void add_symmetric(const Dense& G, const Dense& K, Dense& D) {
  const Vector<double> g = G.diagonal(), k = K.diagonal();
  D.noalias() += k * g.transpose();
  D.noalias() += g * k.transpose();
  D.array() += G.array() * K.array();
  D += G.cwiseProduct(K).transpose();
}

/// 1 / D; 0 in directions that M maps to 0.
Dense reciprocal(const Dense& D) {
  const double least = D.maxCoeff() * 1e-30;
  return D.unaryExpr([least](double d) { return d > least ? 1 / d : 0; });
}

}  // namespace

Preconditioner::Preconditioner(const MatrixOperator& of) : of_(of) { find_links(); }

/// Is a side of a term of Y (its E; of Y' its F) also a side of a term of P in the same block?
bool Preconditioner::shares_a_side(std::size_t P, std::size_t Y, bool transposed) const {
  for (const MatrixOperator::Block& block : of_.blocks())
    for (const MatrixOperator::Term& y : block.terms)
      for (const MatrixOperator::Term& p : block.terms) {
        if (y.unknown != Y || p.unknown != P) continue;
        const Side& common = transposed ? y.F : y.E;
        if (common == p.E || common == p.F) return true;
      }
  return false;
}

/// Has P two terms in a block of Y? Then Y + P K leaves one that is coupled with Y all the same.
bool Preconditioner::is_twice(std::size_t P, std::size_t Y) const {
  return std::ranges::any_of(of_.blocks(), [&](const MatrixOperator::Block& block) {
    return block.terms_of(Y) > 0 && block.terms_of(P) > 1;
  });
}

/// One P for each Y, the first.
void Preconditioner::find_links() {
  const auto& unknowns = of_.program().unknowns;
  for (std::size_t Y = 0; Y < unknowns.size(); ++Y) {
    bool found = unknowns[Y].symmetric;
    for (std::size_t P = 0; P < unknowns.size() && !found; ++P)
      for (const bool transposed : {false, true}) {
        if (found || !unknowns[P].symmetric || !shares_a_side(P, Y, transposed)) continue;
        if (is_twice(P, Y)) continue;
        links_.push_back({P, Y, transposed, {}});
        found = true;
      }
  }
}

/// With W = G G' products of these are E'W E and the like.
Preconditioner::Terms Preconditioner::scaled_terms(std::size_t unknown,
                                                   const Blocks<double>& G) const {
  Terms result(of_.blocks().size());
  for (std::size_t k = 0; k < result.size(); ++k)
    for (const MatrixOperator::Term& term : of_.blocks()[k].terms) {
      if (term.unknown != unknown) continue;
      const Dense transposed = G.dense(static_cast<int>(k)).transpose();
      result[k].push_back({term.E.from_left(transposed), term.F.from_left(transposed)});
    }
  return result;
}

/// K, and the terms of P with Y - P K for Y: E (P F + Y C) becomes E (P (F - K C) + Y C).
void Preconditioner::decouple(Link& link, std::vector<Terms>& terms) const {
  Terms& P = terms[link.P];
  const Eigen::Index n = of_.program().unknowns[link.P].rows;
  const MatrixProgram::Unknown& of = of_.program().unknowns[link.Y];
  const Eigen::Index free = link.transposed ? of.rows : of.columns;
  Dense across = Dense::Zero(n, free), own = Dense::Zero(free, free);
  // The terms of Y with the term of P that has a common side, or none.
  struct Beside {
    std::size_t block;
    Dense common, free;  ///< G'E, and G'C' on the side of C
    Dense* matched;
  };
  std::vector<Beside> beside;
  for (std::size_t k = 0; k < P.size(); ++k) {
    std::size_t y = 0;
    for (const MatrixOperator::Term& term : of_.blocks()[k].terms) {
      if (term.unknown != link.Y) continue;
      const Sides& sides = terms[link.Y][k][y++];
      beside.push_back(
          {k, link.transposed ? sides.F : sides.E, link.transposed ? sides.E : sides.F, nullptr});
      const Side& common = link.transposed ? term.F : term.E;
      std::size_t p = 0;
      for (const MatrixOperator::Term& other : of_.blocks()[k].terms) {
        if (other.unknown != link.P) continue;
        Sides& matched = P[k][p++];
        if (beside.back().matched) continue;
        if (common == other.E) beside.back().matched = &matched.F;
        if (common == other.F && !beside.back().matched) beside.back().matched = &matched.E;
      }
      const double weight = beside.back().common.squaredNorm();
      own.noalias() += weight * beside.back().free.transpose() * beside.back().free;
      if (beside.back().matched)
        across.noalias() += weight * beside.back().matched->transpose() * beside.back().free;
    }
  }
  own.diagonal().array() += kFloor * own.trace() / static_cast<double>(free);
  link.K = own.llt().solve(across.transpose()).transpose();
  std::vector<std::pair<std::size_t, Sides>> more;
  for (const Beside& term : beside) {
    // G'(K C)'
    const Dense part = term.free * link.K.transpose();
    if (term.matched)
      *term.matched -= part;
    else
      more.push_back({term.block, {term.common, -part}});
  }
  for (auto& [block, sides] : more) P[block].push_back(std::move(sides));
}

/// The basis Q of the header for a V of n x n, and the diagonal of M in it.
Preconditioner::Basis Preconditioner::symmetric_basis(const Terms& terms, Eigen::Index n) const {
  Dense total = Dense::Zero(n, n);
  for (const auto& block : terms)
    for (const Sides& term : block) {
      total.noalias() += term.E.transpose() * term.E;
      total.noalias() += term.F.transpose() * term.F;
    }
  const Dense Q0 = whitening(std::move(total));
  Terms inside = terms;
  Dense image = Dense::Zero(n, n);
  for (auto& block : inside) {
    if (block.empty()) continue;
    Dense half = Dense::Zero(block[0].E.rows(), block[0].E.rows());
    for (Sides& term : block) {
      term = {term.E * Q0, term.F * Q0};
      half.noalias() += term.E * term.F.transpose();
    }
    const Dense Q = half + half.transpose();
    for (const Sides& term : block) image.noalias() += term.E.transpose() * (Q * term.F);
  }
  const Dense U = eigenvectors(image + image.transpose());
  Basis basis;
  basis.left = Q0 * U;
  Dense D = Dense::Zero(n, n);
  for (auto& block : inside) {
    for (Sides& term : block) term = {term.E * U, term.F * U};
    for (const Sides& t : block)
      for (const Sides& s : block) {
        spend_on<double>(4 * static_cast<double>(n * t.E.size()));
        add_symmetric(s.E.transpose() * t.E, t.F.transpose() * s.F, D);
        add_symmetric(s.E.transpose() * t.F, t.E.transpose() * s.F, D);
      }
  }
  // Half of the quadratic form of e_i e_j' + e_j e_i' beside an element of the gradient.
  D.diagonal() *= 0.5;
  basis.weights = reciprocal(D);
  return basis;
}

/// V = P Z Q': each side's Gram matrix is whitened, and the eigenvectors are those of its sum over
/// blocks, weighted by the traces of the other side. D_ab is the element of M (matrix_schur.h) at
/// left_a right_b'.
Preconditioner::Basis Preconditioner::full_basis(Terms terms, Eigen::Index rows,
                                                 Eigen::Index columns) const {
  std::vector<Dense> lefts, rights;
  Dense left = Dense::Zero(rows, rows), right = Dense::Zero(columns, columns);
  for (const auto& block : terms) {
    Dense& E = lefts.emplace_back(Dense::Zero(rows, rows));
    Dense& F = rights.emplace_back(Dense::Zero(columns, columns));
    for (const Sides& term : block) {
      E.noalias() += term.E.transpose() * term.E;
      F.noalias() += term.F.transpose() * term.F;
    }
    left += E;
    right += F;
  }
  const Dense P = whitening(std::move(left)), Q = whitening(std::move(right));
  Dense left_image = Dense::Zero(rows, rows), right_image = Dense::Zero(columns, columns);
  for (std::size_t b = 0; b < terms.size(); ++b) {
    lefts[b] = (P.transpose() * lefts[b] * P).eval();
    rights[b] = (Q.transpose() * rights[b] * Q).eval();
    left_image += rights[b].trace() * lefts[b];
    right_image += lefts[b].trace() * rights[b];
  }
  Basis basis;
  basis.left = P * eigenvectors(left_image);
  basis.right = Q * eigenvectors(right_image);
  Dense D = Dense::Zero(rows, columns);
  for (auto& block : terms) {
    for (Sides& term : block) term = {term.E * basis.left, term.F * basis.right};
    for (const Sides& t : block)
      for (const Sides& s : block) {
        const Vector<double> e = s.E.cwiseProduct(t.E).colwise().sum();
        const Vector<double> f = s.F.cwiseProduct(t.F).colwise().sum();
        D.noalias() += 2 * e * f.transpose();
        const Dense across = s.E.transpose() * t.F, back = t.E.transpose() * s.F;
        D.array() += 2 * across.array() * back.array();
      }
  }
  basis.weights = reciprocal(D);
  return basis;
}

void Preconditioner::prepare(const SchurOperator& M, const Blocks<double>& G) {
  const auto& unknowns = of_.program().unknowns;
  std::vector<Terms> terms;
  for (std::size_t u = 0; u < unknowns.size(); ++u) terms.push_back(scaled_terms(u, G));
  for (Link& link : links_) decouple(link, terms);
  bases_.clear();
  scalars_.clear();
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    check_stop();
    bases_.push_back(unknowns[u].symmetric
                         ? symmetric_basis(terms[u], unknowns[u].rows)
                         : full_basis(std::move(terms[u]), unknowns[u].rows, unknowns[u].columns));
  }
  for (const int scalar : of_.scalars()) {
    const double d = M.diagonal(scalar);
    scalars_.push_back(d > 0 ? 1 / d : 0);
  }
}

/// z = T D^-1 T' r with T: (P, Y) -> (P, Y - P K) and D the diagonal of each unknown in its basis.
void Preconditioner::apply(const Vector<double>& r, Vector<double>& z) const {
  z.setZero(r.size());
  std::vector<Dense> gradients, steps;
  for (std::size_t u = 0; u < bases_.size(); ++u) gradients.push_back(of_.gradient(u, r));
  for (const Link& link : links_) {
    const Dense& Y = gradients[link.Y];
    const Dense part = (link.transposed ? Dense(Y.transpose()) : Y) * link.K.transpose();
    gradients[link.P] -= 0.5 * (part + part.transpose());
  }
  for (std::size_t u = 0; u < bases_.size(); ++u) {
    const Basis& basis = bases_[u];
    const Dense& right = basis.right.size() > 0 ? basis.right : basis.left;
    Dense inside = basis.left.transpose() * gradients[u] * right;
    inside = inside.cwiseProduct(basis.weights).eval();
    steps.push_back(basis.left * inside * right.transpose());
  }
  for (const Link& link : links_) {
    const Dense part = steps[link.P] * link.K;
    steps[link.Y] -= link.transposed ? Dense(part.transpose()) : part;
  }
  for (std::size_t u = 0; u < bases_.size(); ++u) of_.pack(u, steps[u], z);
  for (std::size_t i = 0; i < scalars_.size(); ++i)
    z[of_.scalars()[i]] = scalars_[i] * r[of_.scalars()[i]];
}

}  // namespace gainsmith::sdp
