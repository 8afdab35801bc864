#include "sdp/schur/matrix_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stop.h"
#include "sdp/core/variant.h"
#include "sdp/schur/matrix_operator.h"
#include "sdp/schur/matrix_preconditioner.h"
#include "sdp/schur/matrix_scaling.h"
#include "sdp/schur/matrix_schur.h"

namespace gainsmith::sdp {
namespace {

/// One solve: x and S = C + L(x), the multipliers X = R R' and the equations of matrix_solver.h.
/// Steps are computed in the coordinates of Scaling, in which X and S are diag(d).
class MatrixIpm {
 public:
  MatrixIpm(const MatrixProgram& program, const MatrixOptions& options)
      : options_(options),
        operator_(program),
        schur_(operator_),
        preconditioner_(operator_),
        factored_(operator_),
        scaling_(operator_.layout()),
        c_(ConstVectorMap<double>(program.c.data(), static_cast<Eigen::Index>(program.c.size()))),
        X_(operator_.layout()),
        root_(operator_.layout()),
        S_(operator_.layout()),
        defect_(operator_.layout()),
        dX_(operator_.layout()),
        dS_(operator_.layout()),
        image_(operator_.layout()),
        target_(operator_.layout()),
        work_(operator_.layout()) {}

  Solution solve() {
    Solution result;
    result.cause = start() ? iterate(result.iterations) : Cause::stalled;
    conclude(result);
    return result;
  }

 private:
  /// Of the right-hand side: what conjugate gradients may leave, at most and for each unit of the
  /// gap, after how many steps they give up, and what a direction is of no use with: where a point
  /// is wanted, of the right-hand side, where a minimum is, of what they may leave. There L*(X) = c
  /// would be lost, and with it the bound and the start of another solver.
  static constexpr double kResidual = 1e-3, kResidualOfGap = 0.003, kLeastResidual = 1e-11;
  static constexpr int kSteps = 150;
  /// Steps with the factor: what these leave is rounding.
  static constexpr int kFactoredSteps = 20;
  static constexpr double kUseless = 0.03, kUselessToMinimum = 10;
  /// Of the distance to the boundary.
  static constexpr double kShortest = 0.9, kLongest = 0.99;
  /// Corrections of a direction beyond the first, with the factor.
  static constexpr int kCorrections = 2;
  /// A step below this gets nowhere.
  static constexpr double kNoStep = 1e-4;
  /// Part of a step taken back when it leaves the cone, and how often.
  static constexpr double kRetreat = 0.2;
  static constexpr int kRetreats = 6;

  /// From S(x) at the point given and X = I/n, n the order of the cone; or from x = 0 and
  /// S = X = 10 max(1, |C|, |c|) I. False where S(x) is not positive definite.
  bool start() {
    const Layout& layout = operator_.layout();
    x_.setZero(operator_.variables());
    double size = 1;
    if (!options_.start.empty()) {
      x_ = ConstVectorMap<double>(options_.start.data(), x_.size());
      update_S();
      start_X(1.0 / layout.order());
      return is_inside(S_);
    }
    const double constants = operator_.constant().flat().cwiseAbs().maxCoeff();
    size = std::max({1.0, constants, c_.cwiseAbs().maxCoeff()}) * 10;
    S_.set_identity(size);
    start_X(size);
    update_defect();
    return true;
  }

  void start_X(double size) {
    root_.set_identity(std::sqrt(size));
    root_.linear().setConstant(size);
    square(root_, X_);
  }

  /// S = C + L(x).
  void update_S() {
    operator_.apply(x_, S_);
    S_.flat() += operator_.constant().flat();
    exact_ = true;
    defect_.flat().setZero();
  }
  /// C + L(x) - S.
  void update_defect() {
    operator_.apply(x_, defect_);
    defect_.flat() += operator_.constant().flat() - S_.flat();
  }

  double mu() const { return inner(X_, S_) / operator_.layout().order(); }

  /// Changes to the factor from the iteration on whose conjugate gradients would have cost more.
  Cause iterate(int& iterations) {
    for (iterations = 0; iterations < options_.iteration_limit; ++iterations) {
      if (exact_ && options_.enough && options_.enough({x_.data(), x_.data() + x_.size()}))
        return Cause::enough;
      if (exact_ && gap() <= options_.tolerance) return Cause::converged;
      check_stop();
      if (!scaling_.prepare(root_, S_)) return Cause::stalled;
      schur_.set_scaling(scaling_.W());
      if (!prepare()) return Cause::stalled;
      steps_ = 0;
      if (!move()) return Cause::stalled;
      direct_ |= may_factor_ && steps_ * schur_.cost() > factored_.cost();
    }
    return Cause::stalled;
  }

  bool prepare() {
    if (direct_) return factored_.prepare(schur_, scaling_.W());
    preconditioner_.prepare(schur_, scaling_.G());
    return true;
  }

  /// A predictor and a corrector (Mehrotra 1992).
  bool move() {
    const double now = mu();
    dx_.setZero(x_.size());
    aim(0, false);
    bool good = direction();
    const double primal = scaling_.step(image_, 1), dual = scaling_.step(dX_, 1);
    const double reached = (now * operator_.layout().order() + primal * scaled_inner(image_) +
                            dual * scaled_inner(dX_) + primal * dual * inner(image_, dX_)) /
                           operator_.layout().order();
    // sigma = (mu that the predictor reaches / mu)^max(1, 3 a^2), a the shorter step.
    const double ratio = std::clamp(reached / now, 0.0, 1.0);
    const double shorter = std::min(primal, dual);
    const double sigma = std::max(1e-6, std::pow(ratio, std::max(1.0, 3 * shorter * shorter)));
    aim(sigma * now, true);
    good = direction() || good;
    if (direct_) correct_further(sigma * now);
    if (!good && ++failures_ > 1) return false;
    return advance(shorter);
  }

  /// The second-order term of the last direction, again, while that lengthens the steps.
  void correct_further(double mu) {
    const auto reach = [&] { return scaling_.step(image_, 1) * scaling_.step(dX_, 1); };
    double longest = reach();
    for (int k = 0; k < kCorrections; ++k) {
      const Vector<double> dx = dx_;
      const Blocks<double> dX = dX_, dS = dS_, image = image_;
      aim(mu, true);
      direction();
      if (const double next = reach(); next > longest) {
        longest = next;
        continue;
      }
      dx_ = dx;
      dX_ = dX;
      dS_ = dS;
      image_ = image;
      return;
    }
  }

  /// diag(d) . M
  double scaled_inner(const Blocks<double>& M) const {
    double sum = scaling_.linear_d().dot(M.linear());
    for (int b = 0; b < M.layout().blocks(); ++b) sum += scaling_.d(b).dot(M.dense(b).diagonal());
    return sum;
  }

  /// target = G^-1 (X + R) G^-T = mu D^-1 - corr, with the second-order term of the last direction.
  void aim(double mu, bool second_order) {
    for (int b = 0; b < target_.layout().blocks(); ++b) {
      const Vector<double>& d = scaling_.d(b);
      auto target = target_.dense(b);
      if (second_order) {
        const Matrix<double> product = dX_.dense(b) * image_.dense(b);
        for (Eigen::Index j = 0; j < d.size(); ++j)
          for (Eigen::Index i = 0; i < d.size(); ++i)
            target(i, j) = -(product(i, j) + product(j, i)) / (d[i] + d[j]);
      } else {
        target.setZero();
      }
      target.diagonal().array() += mu / d.array();
    }
    const auto& d = scaling_.linear_d();
    target_.linear() = (mu / d.array()).matrix();
    if (second_order)
      target_.linear().array() -= dX_.linear().array() * image_.linear().array() / d.array();
  }

  /// dx, image = G' dS G and dX = G^-1 dX G^-T for the target.
  bool direction() {
    // L*(X + R) - c, without the part of the defect of S.
    scaling_.outward(target_, work_);
    if (!exact_) {
      scaling_.inward(defect_, image_);
      scaling_.outward(image_, dS_);
      work_.flat() -= dS_.flat();
    }
    operator_.adjoint(work_, right_);
    right_ -= c_;
    const bool good = solve_for_dx();
    operator_.apply(dx_, dS_);
    dS_.flat() += defect_.flat();
    scaling_.inward(dS_, image_);
    dX_.flat() = target_.flat() - image_.flat();
    for (int b = 0; b < dX_.layout().blocks(); ++b) dX_.dense(b).diagonal() -= scaling_.d(b);
    dX_.linear() -= scaling_.linear_d();
    return good;
  }

  /// Where one preconditioner fails, by the other. Rounding ends the factor's use first where M has
  /// small eigenvalues that the products still have digits of.
  bool solve_for_dx() {
    if (conjugate_gradients()) return true;
    if (!may_factor_) return false;
    const Vector<double> dx = dx_;
    const double missed = residual_.norm();
    may_factor_ = !direct_;
    direct_ = !direct_;
    if (prepare() && conjugate_gradients()) return true;
    if (!(residual_.norm() < missed)) dx_ = dx;
    return false;
  }

  /// Where a point is all that is wanted, L*(X) = c need not hold.
  double residual_goal() const {
    if (options_.enough) return kResidual;
    return std::clamp(kResidualOfGap * gap(), kLeastResidual, kResidual);
  }

  /// From the dx there is. False when they lead nowhere.
  bool conjugate_gradients() {
    const double size = right_.norm(), goal = residual_goal() * size;
    schur_.apply(dx_, product_);
    residual_ = right_ - product_;
    double rho = 0;
    const int most = direct_ ? kFactoredSteps : kSteps;
    for (int step = 0; step < most; ++step) {
      if (residual_.norm() <= goal) return true;
      check_stop();
      ++steps_;
      if (direct_)
        factored_.apply(residual_, half_);
      else
        preconditioner_.apply(residual_, half_);
      const double next = residual_.dot(half_);
      if (!(next > 0)) return false;
      search_ = step == 0 ? half_ : Vector<double>(half_ + (next / rho) * search_);
      rho = next;
      schur_.apply(search_, product_);
      const double curvature = search_.dot(product_);
      if (!(curvature > 0)) return false;
      dx_ += (rho / curvature) * search_;
      residual_ -= (rho / curvature) * product_;
    }
    return residual_.norm() <= (options_.enough ? kUseless * size : kUselessToMinimum * goal);
  }

  /// A share of the longest steps, larger where the predictor reached farther. X moves by its
  /// factor (Scaling::factor), S with x. False where no step of use stays in the cone.
  bool advance(double reach) {
    const double part = kShortest + (kLongest - kShortest) * reach;
    double primal = std::min(1.0, part * scaling_.step(image_, 2));
    double dual = std::min(1.0, part * scaling_.step(dX_, 2));
    const Vector<double> from = x_;
    const Blocks<double> S = S_;
    for (int retreat = 0; retreat < kRetreats; ++retreat) {
      if (std::max(primal, dual) < kNoStep) return false;
      x_ = from + primal * dx_;
      const bool inside = scaling_.factor(dX_, dual, root_);
      if (exact_ || primal == 1) {
        update_S();
      } else {
        S_.flat() = S.flat() + primal * dS_.flat();
        update_defect();
      }
      if (inside && is_inside(S_)) {
        square(root_, X_);
        return true;
      }
      primal *= kRetreat;
      dual *= kRetreat;
    }
    return false;
  }

  double objective() const { return c_.dot(x_); }
  double gap() const { return inner(X_, S_) / (1 + std::abs(objective())); }

  /// The dual objective is c'x - X.S: a bound as far as L*(X) = c holds.
  void conclude(Solution& result) const {
    result.x.assign(x_.data(), x_.data() + x_.size());
    result.primal_objective = objective();
    result.relative_gap = gap();
    result.dual_objective = result.primal_objective - inner(X_, S_);
    for (const auto& [from, to] : {std::pair(&S_, &result.X), std::pair(&X_, &result.Y)}) {
      for (int b = 0; b < from->layout().blocks(); ++b) {
        const auto block = from->dense(b);
        to->values.emplace_back(block.data(), block.data() + block.size());
      }
      for (const double element : from->linear()) to->values.push_back({element});
    }
  }

  const MatrixOptions& options_;
  const MatrixOperator operator_;
  SchurOperator schur_;
  Preconditioner preconditioner_;
  MatrixSchur factored_;
  Scaling scaling_;
  const Vector<double> c_;
  Vector<double> x_, dx_, right_, residual_, half_, search_, product_;
  Blocks<double> X_, root_;  ///< X = root root'
  Blocks<double> S_;
  Blocks<double> defect_;   ///< C + L(x) - S
  Blocks<double> dX_, dS_;  ///< dX scaled, G^-1 dX G^-T
  Blocks<double> image_;    ///< G' dS G
  Blocks<double> target_, work_;
  bool exact_ = false;  ///< S = C + L(x)
  int failures_ = 0;
  int steps_ = 0;        ///< of conjugate gradients in this iteration
  bool direct_ = false;  ///< by the factor of the Schur operator
  /// Not where a point is wanted: a few iterations of few steps bring it.
  bool may_factor_ = !options_.enough;
};

}  // namespace

Solution solve_here(const MatrixProgram& program, const MatrixOptions& options) {
  return MatrixIpm(program, options).solve();
}

}  // namespace gainsmith::sdp
