#include "numerics/output_gain.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace gainsmith::numerics {

namespace {

constexpr int kStarts = 100;
constexpr int kSteps = 100;       // of a search
constexpr int kHalvings = 40;     // of a step
constexpr double kMargin = 0.05;  // of the size of A: enough
constexpr double kLargest = 100;  // in units in which B and C have columns and rows of length 1
constexpr double kFlat = 1e-3;    // relative gain of a step that ends a search

/// What is minimised, with its gradient.
struct Peak {
  double value = std::numeric_limits<double>::infinity();  ///< < 0: stable
  Vector gradient;
};

/// The largest of the eigenvalues of A + B F C, with F in units in which the columns of B and the
/// rows of C have the length 1 and A has the size 1.
class ClosedLoop {
 public:
  ClosedLoop(const Matrix& A, const Matrix& B, const Matrix& C, Time time)
      : discrete_(time == Time::discrete), A_(A), B_(B), C_(C) {
    size_ = discrete_ ? std::max(1.0, A.norm()) : A.norm();
    if (size_ == 0) size_ = 1;
    const auto or_one = [](double length) { return length > 0 ? length : 1.0; };
    units_ = Matrix::Constant(B.cols(), C.rows(), size_);
    for (Eigen::Index i = 0; i < B.cols(); ++i) units_.row(i) /= or_one(B.col(i).norm());
    for (Eigen::Index j = 0; j < C.rows(); ++j) units_.col(j) /= or_one(C.row(j).norm());
  }

  double enough() const { return -kMargin * (discrete_ ? 1 : size_); }
  Eigen::Index count() const { return units_.size(); }
  Matrix gain(const Vector& g) const {
    return units_.cwiseProduct(g.reshaped(units_.rows(), units_.cols()));
  }

  /// With M = A + B F C, M r = lambda r, l'M = lambda l' and l'r = 1 (no conjugates), the gradient
  /// of the real part is Re(B'l (C r)'), m x p. That of the modulus has the factor
  /// conj(lambda)/|lambda| before the real part is taken.
  Peak at(const Vector& g) const {
    const Matrix closed = A_ + B_ * gain(g) * C_;
    Peak peak{.gradient = Vector::Zero(g.size())};
    if (!closed.allFinite()) return peak;
    const Eigen::EigenSolver<Matrix> solver(closed);
    if (solver.info() != Eigen::Success) return peak;
    const auto& values = solver.eigenvalues();
    Eigen::Index k = 0;
    const double largest = discrete_ ? values.cwiseAbs().maxCoeff(&k) : values.real().maxCoeff(&k);
    peak.value = largest - (discrete_ ? 1 : 0);
    const Eigen::MatrixXcd right = solver.eigenvectors();
    const Eigen::VectorXcd left =
        right.transpose().partialPivLu().solve(Eigen::VectorXcd::Unit(values.size(), k));
    std::complex<double> phase = 1;
    if (discrete_ && largest > 0) phase = std::conj(values(k)) / largest;
    const Matrix slope = (phase * (B_.transpose() * left) * (C_ * right.col(k)).transpose()).real();
    if (slope.allFinite()) peak.gradient = slope.cwiseProduct(units_).reshaped();
    return peak;
  }

 private:
  bool discrete_;
  const Matrix& A_;
  const Matrix& B_;
  const Matrix& C_;
  double size_ = 1;
  Matrix units_;
};

struct Found {
  Vector gain;
  Peak peak;
};

/// A point along the direction d that satisfies the weak Wolfe conditions, by bisection and
/// doubling (Lewis & Overton 2013):
///   f(g + s d) <= f(g) + 1e-4 s f'd,   f'(g + s d) d >= 0.9 f'd.
/// The last point that was tried where 40 do not suffice.
Found along(const ClosedLoop& loop, const Found& from, const Vector& direction, double step) {
  constexpr double kDecrease = 1e-4, kCurvature = 0.9;
  const double slope = from.peak.gradient.dot(direction);
  double low = 0, high = std::numeric_limits<double>::infinity();
  Found to = from;
  for (int k = 0; k < kHalvings; ++k) {
    to.gain = from.gain + step * direction;
    to.peak = loop.at(to.gain);
    if (!(to.peak.value <= from.peak.value + kDecrease * step * slope))
      high = step;
    else if (to.peak.gradient.dot(direction) < kCurvature * slope && to.gain.norm() < kLargest)
      low = step;
    else
      break;
    step = std::isfinite(high) ? (low + high) / 2 : 2 * low;
  }
  return to;
}

/// A local search by BFGS. With a step s and a change y of the gradient the inverse curvature is
///   H <- (I - s y'/y's) H (I - y s'/y's) + s s'/y's,   where y's > 0;   H = I y's/y'y at first.
Found descend(const ClosedLoop& loop, const Vector& start) {
  Found found{start, loop.at(start)};
  const Matrix eye = Matrix::Identity(start.size(), start.size());
  Matrix inverse = eye;  // of the curvature
  for (int k = 0; k < kSteps; ++k) {
    Vector direction = -inverse * found.peak.gradient;
    if (!(direction.dot(found.peak.gradient) < 0)) {
      inverse = eye;
      direction = -found.peak.gradient;
    }
    const double length = found.peak.gradient.norm();
    if (length == 0) break;
    const Found next = along(loop, found, direction, k == 0 ? 1 / length : 1);
    if (!(next.peak.value < found.peak.value)) break;
    const double won = found.peak.value - next.peak.value;
    const Vector step = next.gain - found.gain;
    const Vector change = next.peak.gradient - found.peak.gradient;
    const double curvature = step.dot(change);
    if (curvature > 0) {
      if (k == 0) inverse *= curvature / change.squaredNorm();
      const Matrix shear = eye - step * change.transpose() / curvature;
      inverse = shear * inverse * shear.transpose() + step * step.transpose() / curvature;
    }
    found = next;
    if (found.gain.norm() > kLargest) break;
    if (found.peak.value < 0 && won < kFlat * -found.peak.value) break;
  }
  return found;
}

/// The k-th of evenly spread directions, in sizes from 0.3 to 300.
Vector start(Eigen::Index count, int k) {
  constexpr double kGolden = 0.6180339887498949, kPlastic = 0.7548776662466927;
  const auto part = [](double x) { return x - std::floor(x); };
  Vector g(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto at = static_cast<double>(i);
    g(i) = 2 * part(k * (kGolden + kPlastic * at + kPlastic * kPlastic * at * at)) - 1;
  }
  const double largest = g.cwiseAbs().maxCoeff();
  return g * (std::pow(10, 3 * part(k * kPlastic) - 0.5) / std::max(largest, 1e-9));
}

}  // namespace

Matrix output_gain(const Matrix& A, const Matrix& B, const Matrix& C, Time time) {
  const Matrix none = Matrix::Zero(B.cols(), C.rows());
  if (A.size() == 0 || none.size() == 0) return none;
  if (!A.allFinite() || !B.allFinite() || !C.allFinite()) return none;
  const ClosedLoop loop(A, B, C, time);
  // A search of a plant of 20 states takes what 50 searches of one of 5 states take.
  constexpr double kWork = 1e5;
  const auto n = static_cast<double>(A.rows());
  const int starts = std::clamp(static_cast<int>(kWork / (n * n * n)), 3, kStarts);
  Found best = descend(loop, Vector::Zero(loop.count()));
  for (int k = 1; k < starts && !(best.peak.value <= loop.enough()); ++k) {
    Found found = descend(loop, start(loop.count(), k));
    if (found.peak.value < best.peak.value) best = std::move(found);
  }
  const Matrix F = loop.gain(best.gain);
  return F.allFinite() ? F : none;
}

}  // namespace gainsmith::numerics
