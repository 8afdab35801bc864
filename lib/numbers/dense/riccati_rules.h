// Internal to numbers: stabilising solutions of the equations of Riccati (spectrum.h), over the
// arithmetic W that they are computed in.
//
// With B R^-1 B' = G, A - B R^-1 S' for A and Q - S R^-1 S' for H the equations are
//   continuous   A'X + X A - X G X + H = 0
//   discrete     X = A'X (I + G X)^-1 A + H
// The first becomes one of the second form by a Cayley transform, with the same X. Doubling solves
// the second with quadratic convergence (Chu, Fan and Lin 2005).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/number.h"
#include "base/stop.h"
#include "numbers/dense/dense.h"
#include "numbers/dense/spectrum.h"
#include "numbers/dense/wide_dense.h"
#include "numerics/working.h"

namespace gainsmith::numbers {

/// An eigenvalue of a real matrix; both of a conjugate pair are listed.
template <class W>
struct Eigenvalue {
  W real{0};
  W imaginary{0};
};
template <class W>
std::vector<Eigenvalue<W>> balanced_eigenvalues(const MatrixOf<W>& M);

template <class W>
class RiccatiSolver {
 public:
  using M = MatrixOf<W>;

  RiccatiSolver(Riccati equation, const M& A, const M& B, const M& Q, const M& R, const M& S)
      : discrete_(equation == Riccati::discrete),
        A_(A),
        B_(B),
        Q_(numerics::symmetric_part<W>(Q)),
        R_(numerics::symmetric_part<W>(R)),
        S_(S) {
    auto inverse = inverted(R_);
    M cross = S_;
    M weight = Q_;
    if (!inverse && discrete_) {
      // X = Y + Z with Y = offset I, as in `found`, of which R + B'Y B may be invertible.
      offset_ = std::max(norm_1<W>(Q_), norm_1<W>(R_));
      if (offset_ == W(0)) offset_ = W(1);
      inverse = inverted(R_ + offset_ * times<W>(B_.transpose(), B_));
      cross += offset_ * times<W>(A_.transpose(), B_);
      weight += offset_ * (times<W>(A_.transpose(), A_) - identity(A_.rows()));
    }
    if (!inverse)
      throw NoSolution(discrete_ ? "R + B'*X*B is not invertible" : "R is not invertible");
    const M back = times<W>(*inverse, cross.transpose());
    start_ = {A_ - times<W>(B_, back), times<W>(times<W>(B_, *inverse), B_.transpose()),
              weight - times<W>(cross, back)};
  }

  /// X, n x n, symmetric. `rounding`: of what the solution is rounded to. NoSolution where nothing
  /// that is found passes is_solution().
  M solve(const W& rounding) const {
    const auto start = discrete_ ? std::optional(start_) : transformed();
    if (!start) explain();
    for (const W& size : {W(0), size_of_solution(*start)})
      if (auto X = found(*start, size)) {
        *X += offset_ * identity(A_.rows());
        if (is_solution(*X, rounding)) return std::move(*X);
      }
    explain();
  }

 private:
  /// X = A'X (I + G X)^-1 A + H.
  struct Doubling {
    M A, G, H;
  };
  /// K of X, A - B K, and the left side of the equation: what it differs from 0 by is checked
  /// against the size of its terms.
  struct Feedback {
    M gain, closed, residual;
    W terms;  ///< the size of what adds up to the residual
  };

  static W roundings(double count) { return W(count) * std::numeric_limits<W>::epsilon(); }
  /// The part of |A - B K|, or of 1, within which an eigenvalue counts as one on the stability
  /// boundary: two of them meet there, so that half of the digits are left.
  static W boundary_width() {
    using std::sqrt;
    constexpr double kRoundings = 4096;
    return sqrt(roundings(kRoundings));
  }
  static M identity(Eigen::Index n) { return M::Identity(n, n); }

  static std::optional<M> inverted(const M& matrix) {
    constexpr double kRoundings = 64;
    if (!matrix.allFinite()) return std::nullopt;
    auto found = wide_inverse<W>(matrix);
    if (!(found.condition > roundings(kRoundings)) || !found.matrix.allFinite())
      return std::nullopt;
    return std::move(found.matrix);
  }

  /// With a shift c > 0 of the size of the closed loop's eigenvalues: F = A - c I,
  /// T = F' + H F^-1 G, A <- I + 2c T^-', G <- 2c F^-1 G T^-1, H <- 2c T^-1 H F^-1.
  std::optional<Doubling> transformed() const {
    using std::sqrt;
    const auto& [A, G, H] = start_;
    W shift = std::max(norm_1<W>(A), W(sqrt(norm_1<W>(G) * norm_1<W>(H))));
    if (shift == W(0)) shift = W(1);
    // An eigenvalue of A or of T may happen to be the shift.
    for (const double factor : {1.0, 1.6, 0.6, 2.7}) {
      const W c = shift * W(factor);
      const auto F = inverted(A - c * identity(A.rows()));
      if (!F) continue;
      const M T = (A - c * identity(A.rows())).transpose() + times<W>(times<W>(H, *F), G);
      const auto inverse = inverted(T);
      if (!inverse) continue;
      const W twice = W(2) * c;
      return Doubling{identity(A.rows()) + twice * inverse->transpose(),
                      symmetric(twice * times<W>(times<W>(*F, G), *inverse)),
                      symmetric(twice * times<W>(times<W>(*inverse, H), *F))};
    }
    return std::nullopt;
  }

  static M symmetric(const M& matrix) { return numerics::symmetric_part<W>(matrix); }

  /// Where H -> X has to come from above: of weights that do not see an unstable mode.
  static W size_of_solution(const Doubling& at) {
    const W G = norm_1<W>(at.G), H = norm_1<W>(at.H);
    if (G == W(0)) return H == W(0) ? W(1) : H;
    return std::max(H, W(W(1) / G));
  }

  /// X = Y + Z with Y = size I, of which Z solves an equation of the same form:
  /// V = I + G Y, A <- V^-1 A, G <- V^-1 G, H <- H + A'Y V^-1 A - Y.
  static std::optional<M> found(const Doubling& at, const W& size) {
    if (size == W(0)) return doubled(at);
    const M Y = size * identity(at.A.rows());
    const auto inverse = inverted(identity(at.A.rows()) + size * at.G);
    if (!inverse) return std::nullopt;
    const M back = times<W>(*inverse, at.A);
    const auto Z = doubled({back, symmetric(times<W>(*inverse, at.G)),
                            symmetric(at.H + size * times<W>(at.A.transpose(), back) - Y)});
    return Z ? std::optional<M>(Y + *Z) : std::nullopt;
  }

  /// The doubling of spectrum.h from (A, G, H), until H changes by no more than rounding. None
  /// where I + G H is singular, H or G overflows, or 200 steps do not suffice.
  static std::optional<M> doubled(Doubling at) {
    constexpr int kMostSteps = 200;
    const Eigen::Index n = at.A.rows();
    for (int step = 0; step < kMostSteps; ++step) {
      check_stop();
      const auto inverse = inverted(identity(n) + times<W>(at.G, at.H));
      if (!inverse) return std::nullopt;
      const M back = times<W>(*inverse, at.A);
      const M turned = times<W>(at.A, *inverse);
      const M change = symmetric(times<W>(times<W>(at.A.transpose(), at.H), back));
      at.G = symmetric(at.G + times<W>(times<W>(turned, at.G), at.A.transpose()));
      at.A = times<W>(at.A, back);
      at.H += change;
      if (!at.H.allFinite() || !at.G.allFinite()) return std::nullopt;
      if (norm_1<W>(change) <= roundings(1) * norm_1<W>(at.H)) return at.H;
    }
    return std::nullopt;
  }

  std::optional<Feedback> feedback(const M& X) const {
    const M XB = times<W>(X, B_);
    const M cross = (discrete_ ? times<W>(A_.transpose(), XB) : XB) + S_;
    const auto inverse = inverted(discrete_ ? M(R_ + times<W>(B_.transpose(), XB)) : R_);
    if (!inverse) return std::nullopt;
    Feedback result;
    result.gain = times<W>(*inverse, cross.transpose());
    result.closed = A_ - times<W>(B_, result.gain);
    const M XA = times<W>(X, A_);
    const M by_gain = times<W>(cross, result.gain);
    const M moved = discrete_ ? times<W>(A_.transpose(), XA) : M(XA + XA.transpose());
    result.residual = moved - by_gain + Q_;
    if (discrete_) result.residual -= X;
    const W a = norm_1<W>(A_), x = norm_1<W>(X);
    result.terms =
        (discrete_ ? W(a * a * x + x) : W(W(2) * a * x)) + norm_1<W>(by_gain) + norm_1<W>(Q_);
    return result;
  }

  /// Whether the residual is at most n roundings of its terms, and all eigenvalues of A - B K lie
  /// on the stable side by more than boundary_width().
  bool is_solution(const M& X, const W& rounding) const {
    const auto found = feedback(X);
    if (!found || !found->closed.allFinite()) return false;
    const W size = W(static_cast<double>(X.rows()));
    if (norm_1<W>(found->residual) > size * rounding * found->terms) return false;
    const W slack = boundary_width() * (discrete_ ? W(1) : norm_1<W>(found->closed));
    return std::ranges::all_of(balanced_eigenvalues<W>(found->closed),
                               [&](const auto& one) { return excess(one) < -slack; });
  }

  /// How far an eigenvalue lies beyond the stability boundary.
  W excess(const Eigenvalue<W>& one) const {
    using std::sqrt;
    if (!discrete_) return one.real;
    return sqrt(W(one.real * one.real + one.imaginary * one.imaginary)) - W(1);
  }

  /// Hautus: whether [A - l I, B] has full rank n, in double. Of a complex l over real and
  /// imaginary parts, 2n x 2(n + m).
  static bool reaches(const M& A, const M& B, const Eigenvalue<W>& l) {
    constexpr double kNothing = 1e-12;
    const auto rounded = [](const M& m) {
      return Matrix(m.unaryExpr([](const W& x) { return static_cast<double>(x); }));
    };
    const Eigen::Index n = A.rows(), m = B.cols();
    Matrix both = Matrix::Zero(2 * n, 2 * (n + m));
    both.topLeftCorner(n, n) = rounded(A - l.real * identity(n));
    both.block(n, n, n, n) = both.topLeftCorner(n, n);
    both.block(0, n, n, n).diagonal().setConstant(static_cast<double>(l.imaginary));
    both.block(n, 0, n, n).diagonal().setConstant(-static_cast<double>(l.imaginary));
    both.block(0, 2 * n, n, m) = rounded(B);
    both.block(n, 2 * n + m, n, m) = rounded(B);
    const Vector values = singular_values(both);
    return values.minCoeff() > kNothing * values.maxCoeff();
  }

  static std::string text(const Eigenvalue<W>& l) {
    const double imaginary = std::abs(static_cast<double>(l.imaginary));
    return brief(static_cast<double>(l.real)) +
           (imaginary > 0 ? " +- " + brief(imaginary) + "i" : "");
  }

  /// Throws the reason: a mode that B does not reach, one that the weights do not see, or neither.
  [[noreturn]] void explain() const {
    const std::string none = "there is no stabilising solution: ";
    const auto& [A, G, H] = start_;
    const W slack = boundary_width() * (discrete_ ? W(1) : norm_1<W>(A));
    const auto modes = balanced_eigenvalues<W>(A);
    for (const Eigenvalue<W>& mode : modes)
      if (excess(mode) >= -slack && !reaches(A, B_, mode))
        throw NoSolution(none + "B does not reach the mode of A at " + text(mode) +
                         ", which is not stable");
    for (const Eigenvalue<W>& mode : modes)
      if (excess(mode) >= -slack && excess(mode) <= slack && !reaches(A.transpose(), H, mode))
        throw NoSolution(none + "the weights do not see the mode at " + text(mode) + ", on the " +
                         (discrete_ ? "unit circle" : "imaginary axis"));
    throw NoSolution(
        none + "no X leaves A - B*K with all eigenvalues " +
        (discrete_ ? "inside of the unit circle" : "on the left of the imaginary axis"));
  }

  bool discrete_;
  M A_, B_, Q_, R_, S_;
  W offset_ = W(0);
  Doubling start_;
};

}  // namespace gainsmith::numbers
