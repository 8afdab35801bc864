// Nesterov and Todd's scaling of a point: the metric in which X and S are the same diagonal matrix,
// so that a step treats both alike (Nesterov & Todd 1997; Todd, Toh & Tutuncu 1998).
#pragma once

#include "sdp/schur/linalg.h"

namespace gainsmith::sdp {

/// W = G G' with W S W = X, G^-1 X G^-T = G' S G = diag(d) block by block; in the linear part G is
/// sqrt(w), w = sqrt(x / s).
class Scaling {
 public:
  explicit Scaling(const Layout& layout);

  /// X = R R' with any square R, in the linear part X itself. False when S is not positive
  /// definite.
  bool prepare(const Blocks<double>& R, const Blocks<double>& S);

  const Blocks<double>& G() const { return G_; }
  /// W; w^2 in the linear part.
  const Blocks<double>& W() const { return W_; }
  const Vector<double>& d(int block) const { return d_[static_cast<std::size_t>(block)]; }
  const Vector<double>& linear_d() const { return linear_d_; }

  /// result = G M G', and G' M G.
  void outward(const Blocks<double>& M, Blocks<double>& result) const;
  void inward(const Blocks<double>& M, Blocks<double>& result) const;
  /// R of X + a dX with dX = G M G', from the factor of diag(d) + a M: so X stays positive definite
  /// although rounding hides its smallest eigenvalues. False when that is outside.
  bool factor(const Blocks<double>& M, double a, Blocks<double>& R) const;
  /// The longest a <= `longest`, or a little less, with diag(d) + a M >= 0.
  double step(const Blocks<double>& M, double longest) const;

 private:
  Blocks<double> G_, W_;
  std::vector<Vector<double>> d_;
  Vector<double> linear_d_;
};

/// Is S positive definite?
bool is_inside(const Blocks<double>& S);

/// X = R R', in the linear part R.
void square(const Blocks<double>& R, Blocks<double>& X);

}  // namespace gainsmith::sdp
