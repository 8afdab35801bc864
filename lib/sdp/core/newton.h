// The Newton system of the homogeneous model in the HKM direction.
#pragma once

#include "sdp/core/iterate.h"
#include "sdp/schur/factor.h"
#include "sdp/schur/mixed_schur.h"

namespace gainsmith::sdp {

/// The simplified homogeneous self-dual model (Xu, Hung, Ye 1996; for SDP de Klerk, Roos, Terlaky),
/// in the HKM direction (Helmberg, Rendl, Vanderbei, Wolkowicz 1996; Kojima, Shindoh, Hara 1997;
/// Monteiro 1997), whose B is symmetric and cheap to form:
///   R  = sum x_i F_i - tau F_0 - X      (primal)
///   r  = tau c - A(Y),  A(Y)_i = F_i.Y  (dual)
///   g  = F_0.Y - c'x - kappa            (gap)
/// A direction reduces R, r, g by the factor 1 - eta and aims at X Y = sigma mu I and
/// tau kappa = sigma mu:
///   dX = A*(dx) - dtau F_0 + eta R,
///   dY = K - H(X^-1 (A*(dx) - dtau F_0) Y),  H(M) = (M + M')/2,
///   K  = sigma mu X^-1 - Y - H(X^-1 (eta R Y + C)),   C = the second-order term dX_a dY_a,
/// with B dx = A(K) - eta r + dtau (g_0 - c), g_0 = A(X^-1 F_0 Y).
///
/// F_0 is eliminated through tau F_0 = A*(x) - X - R. With a = A(H(X^-1 R Y)), q = r - a,
/// B p = q, B z = c, B u = h = A(K) - eta r:
///   dx   = u + dtau (x/tau - 2 z + p/tau),
///   dtau = [(eta + sigma - 1)(n+1) mu - tr C - c_tk + R.K + p'h]
///          / ([(n+1) mu + 2 R.Y + R.X^-1 R Y - q'p]/tau + 2 c'p)     (both sides times tau),
/// from (n+1) mu = -(tau g + x'r + R.Y), an identity of the model. What is subtracted in the
/// textbook form (numbers of the size of 1/mu that leave one of the size of mu) never appears.
///
/// At a fixed tau (dtau = dkappa = 0) the same formulas give the infeasible primal-dual direction
/// of the problem itself, with eta = 1 and mu = X.Y / n.
enum class Model { homogeneous, fixed };

/// The longest steps for (x, X, tau) and for (Y, kappa).
template <typename T>
struct Steps {
  T primal{0}, dual{0};
};

template <typename T>
class Newton {
 public:
  Newton(const Data& data, unsigned threads);

  /// Factors X and Y. False when one is not positive definite.
  bool factorise(const Iterate<T>& point);

  /// Sets up the Schur complement at the point that was factored. False when it cannot be factored.
  /// In wide arithmetic, directions need not hold the dual equation to better than a part of its
  /// present defect, nor of `allowance` where that moves the objective by less than X.Y. In double,
  /// at a fixed tau, H(X^-1 R Y) is left out where it is nothing beside Y.
  bool prepare(const Iterate<T>& point, const Defect<T>& defect, Model model, double allowance);

  /// MixedSchur::stay_wide.
  void stay_wide() { schur_.stay_wide(); }

  /// sigma = 0, eta = 1, C = 0.
  void predict(const Iterate<T>& point, const Defect<T>& defect, Iterate<T>& direction);

  /// The direction with second-order terms of `predictor`.
  void correct(const Iterate<T>& point, const Defect<T>& defect, const Iterate<T>& predictor,
               const T& sigma, const T& eta, Iterate<T>& direction);

  /// Does the last direction, for all refinement, miss the dual equation by half of the present
  /// defect, and by so much that the objective may move by X.Y? Then this arithmetic has no more to
  /// give.
  bool exhausted() const { return exhausted_; }
  /// Does it miss the equation by a fiftieth of the present defect?
  bool imprecise() const { return imprecise_; }

  /// The largest steps <= `longest` that keep point + step direction in the cone, as sharp as
  /// ConeFactor::step; in the homogeneous model both are the shorter one.
  Steps<T> step(const Iterate<T>& point, const Iterate<T>& direction, const T& longest);

 private:
  void solve(const Iterate<T>& point, const Defect<T>& defect, const T& sigma, const T& eta,
             const T& trace_c, const T& c_tau_kappa, Iterate<T>& direction);
  /// dx, dtau and dkappa of the homogeneous model from u_ and h_.
  void move_tau(const Iterate<T>& point, const Defect<T>& defect, const T& sigma, const T& eta,
                const T& trace_c, const T& c_tau_kappa, Iterate<T>& direction) const;
  T refinement_goal(const Defect<T>& defect, double allowance) const;
  /// Lowers the residual of the dual equation that rounding left in `direction`.
  void refine(const Iterate<T>& point, const Defect<T>& defect, const T& eta,
              Iterate<T>& direction);
  /// out = H(X^-1 left right)
  void scaled_product(const Blocks<T>& left, const Blocks<T>& right, Blocks<T>& out);

  const Data& data_;
  Model model_ = Model::homogeneous;
  MixedSchur<T> schur_;
  ConeFactor<T> factor_X_, factor_Y_;
  Blocks<T> inverse_X_;
  Blocks<T> residual_term_;  ///< H(X^-1 R Y)
  Blocks<T> correction_;     ///< H(X^-1 C)
  Blocks<T> k_;              ///< K
  Blocks<T> half_, product_;
  Iterate<T> refinement_, trial_;
  Vector<T> a_, q_, p_, z_, u_, h_, c_;   ///< m each, of the formulas above
  T mu_{0}, order_{0}, r_y_{0}, r_r_{0};  ///< mu, n + 1, R.Y and R.H(X^-1 R Y)
  T goal_{0};                             ///< residual of the dual equation that refinement aims at
  T harmless_{0};                         ///< residual that moves the objective by X.Y
  bool exhausted_ = false, imprecise_ = false;
  bool missed_ = false;  ///< did refinement end above goal_?
};

}  // namespace gainsmith::sdp
