#include "sdp/core/exposure.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace gainsmith::sdp {
namespace {

/// Eigenvalues of X that are this many times the next smaller one may be those of U; how many such
/// gaps are tried, from the largest eigenvalues on.
constexpr double kGap = 30;
constexpr int kGaps = 3;
/// Weights are multiples of 1 / kDenominator, so that arithmetic has them exactly; how far those of
/// a point may be from such numbers.
constexpr int kDenominator = 4;
constexpr double kNearby = 0.02;
/// Pivots from this part of the largest on are tried before the largest: data of combinatorial
/// problems have whole weights for most choices of rows.
constexpr double kPivot = 0.1;
/// What A*(d) and c'd may miss, in 31 digits, beside ||A*(d)|| = 1; the least eigenvalue of S.
constexpr double kExact = 1e-24, kThin = 1e-6;
/// The most corrections of d, each in double from residuals in 31 digits.
constexpr int kCorrections = 10;
/// The most steps of conjugate gradients; a gradient that counts as none beside the first.
constexpr int kSteps = 200;
constexpr double kFlat = 1e-7;

/// The multiple of 1 / kDenominator next to `value`; NaN where none is within kNearby.
double nearest_weight(double value) {
  const double nearest = std::round(value * kDenominator) / kDenominator;
  return std::abs(value - nearest) <= kNearby ? nearest : std::numeric_limits<double>::quiet_NaN();
}

/// By elimination, of the last row whose pivot is at least `least` of the largest (1: complete
/// pivoting); weights are rounded. Nothing when one is far from what it would become.
/// Column operations bring row k of the pivots of U to e_k'. Then U'y = 0 says that its y_k is
/// -sum_j u_jk y_j over the other rows j.
std::optional<Kernel> kernel_of(Matrix<double> u, double least) {
  const Eigen::Index r = u.cols(), n = u.rows();
  Kernel kernel;
  std::vector<char> eliminated(static_cast<std::size_t>(n), 0);
  for (Eigen::Index k = 0; k < r; ++k) {
    const Vector<double> pivots = u.rightCols(r - k).cwiseAbs().rowwise().maxCoeff();
    const double enough = least * pivots.maxCoeff();
    Eigen::Index row = n - 1, column = 0;
    while (pivots[row] < enough) --row;
    u.row(row).tail(r - k).cwiseAbs().maxCoeff(&column);
    u.col(k).swap(u.col(k + column));
    u.col(k) /= u(row, k);
    const Vector<double> pivot = u.col(k), others = u.row(row);
    u -= pivot * others.transpose();
    u.col(k) = pivot;
    kernel.eliminated.push_back(row);
    eliminated[static_cast<std::size_t>(row)] = 1;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    if (!eliminated[static_cast<std::size_t>(i)]) kernel.kept.push_back(i);
  kernel.weights.resize(r, n - r);
  for (Eigen::Index j = 0; j < n - r; ++j)
    for (Eigen::Index k = 0; k < r; ++k)
      kernel.weights(k, j) = nearest_weight(-u(kernel.kept[static_cast<std::size_t>(j)], k));
  if (!kernel.weights.allFinite()) return std::nullopt;
  return kernel;
}

/// An orthonormal basis of the columns (I; -weights').
Matrix<double> range_of(const Kernel& kernel) {
  const Eigen::Index r = kernel.weights.rows(), n = r + kernel.weights.cols();
  Matrix<double> u = Matrix<double>::Zero(n, r);
  for (Eigen::Index k = 0; k < r; ++k) u(kernel.eliminated[static_cast<std::size_t>(k)], k) = 1;
  for (Eigen::Index j = 0; j < n - r; ++j)
    u.row(kernel.kept[static_cast<std::size_t>(j)]) = -kernel.weights.col(j).transpose();
  return Eigen::HouseholderQR<Matrix<double>>(u).householderQ() * Matrix<double>::Identity(n, r);
}

}  // namespace

bool Exposure::find(const Iterate<double>& point) {
  std::vector<double> values(point.X.linear().begin(), point.X.linear().end());
  for (int b = 0; b < data_.layout.blocks(); ++b) {
    const auto& spectrum = spectra_.emplace_back(point.X.dense(b)).eigenvalues();
    values.insert(values.end(), spectrum.begin(), spectrum.end());
  }
  std::sort(values.begin(), values.end(), std::greater<>());
  // Wherever a gap of the spectrum suggests a rank of U, largest eigenvalues first.
  int gaps = 0;
  for (std::size_t k = 0; k + 1 < values.size() && gaps < kGaps; ++k) {
    if (!(values[k] > kGap * values[k + 1])) continue;
    ++gaps;
    if (guess(point, values[k]) && solve(point.x) && exposes()) return true;
  }
  return false;
}

/// U from the eigenvectors of X to eigenvalues from `threshold` on.
bool Exposure::guess(const Iterate<double>& point, double threshold) {
  kernels_.clear();
  range_.clear();
  for (const auto& spectrum : spectra_) {
    const Eigen::Index r = (spectrum.eigenvalues().array() >= threshold).count();
    const Matrix<double> u = spectrum.eigenvectors().rightCols(r);
    auto kernel = kernel_of(u, kPivot);
    if (!kernel) kernel = kernel_of(u, 1);
    if (!kernel) return false;
    range_.push_back(range_of(*kernel));
    kernels_.push_back(std::move(*kernel));
  }
  on_ = (point.X.linear().array() >= threshold).cast<double>();
  return true;
}

/// M loses U (U'M U) U'.
void Exposure::take_off_face(Blocks<double>& m) const {
  for (int b = 0; b < data_.layout.blocks(); ++b) {
    const Matrix<double>& u = range_[static_cast<std::size_t>(b)];
    if (u.cols() == 0) continue;
    auto block = m.dense(b);
    const Matrix<double> s = u.transpose() * block * u;
    block.noalias() -= u * s * u.transpose();
  }
  m.linear() = m.linear().cwiseProduct(Vector<double>::Ones(on_.size()) - on_);
}

/// step_ is the shortest d whose A*(d) is off_ off the face and whose c'd is `rest`: by conjugate
/// gradients on the normal equations (CGLS).
void Exposure::correct(double rest) {
  step_.setZero(data_.m());
  Vector<double> gradient(data_.m());
  const auto steepest = [&] {
    apply(data_, off_, gradient);
    gradient += rest * c_;
  };
  steepest();
  Vector<double> direction = gradient;
  double square = gradient.squaredNorm();
  const double flat = kFlat * kFlat * square;
  for (int step = 0; step < kSteps && square > flat; ++step) {
    adjoint(data_, direction, 0.0, moved_);
    take_off_face(moved_);
    const double moved = c_.dot(direction);
    const double curvature = moved_.flat().squaredNorm() + moved * moved;
    if (!(curvature > 0)) break;
    const double length = square / curvature;
    step_ += length * direction;
    off_.flat() -= length * moved_.flat();
    rest -= length * moved;
    steepest();
    const double next = gradient.squaredNorm();
    direction = gradient + (next / square) * direction;
    square = next;
  }
}

/// Is S positive definite?
bool Exposure::exposes() {
  Blocks<double> image(data_.layout);
  convert(image_.flat(), image.flat());
  for (Eigen::Index k = 0; k < on_.size(); ++k)
    if (on(k) && !(image.linear()[k] > kThin)) return false;
  for (int b = 0; b < data_.layout.blocks(); ++b) {
    const Matrix<double>& u = range_[static_cast<std::size_t>(b)];
    if (u.cols() == 0) continue;
    const Matrix<double> s = u.transpose() * image.dense(b) * u;
    const Eigen::SelfAdjointEigenSolver<Matrix<double>> solver(s, Eigen::EigenvaluesOnly);
    if (!(solver.eigenvalues()[0] > kThin)) return false;
  }
  return true;
}

/// From x: d with A*(d) on the face and c'd = 0, ||A*(d)|| = 1 at first. False when there is none
/// nearby.
bool Exposure::solve(const Vector<double>& x) {
  Blocks<double> image(data_.layout);
  adjoint(data_, x, 0.0, image);
  const double norm = image.flat().norm();
  if (!(norm > 0) || !std::isfinite(norm)) return false;
  d_.resize(data_.m());
  for (Eigen::Index i = 0; i < d_.size(); ++i) d_[i] = DoubleDouble(x[i] / norm);
  // Residuals in 31 digits, corrections in double; each has to halve what is left.
  double before = 1;
  for (int round = 0; round < kCorrections; ++round) {
    adjoint(data_, d_, DoubleDouble(0), image_);
    Blocks<DoubleDouble> off = image_;
    take_off_face(off);
    convert(off.flat(), off_.flat());
    take_off_face(off_);
    DoubleDouble cost(0);
    for (int i = 0; i < data_.m(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      cost += d_[i] * DoubleDouble(data_.c[at], data_.c_rest[at]);
    }
    const double miss = std::hypot(off_.flat().norm(), static_cast<double>(cost));
    if (miss <= kExact) return true;
    if (!(miss < before / 2)) return false;
    before = miss;
    correct(static_cast<double>(cost));
    for (int i = 0; i < data_.m(); ++i) d_[i] -= DoubleDouble(step_[i]);
  }
  return false;
}

/// M loses V M_PP V', P the eliminated rows: with y_P = weights y_kept, V = (I; -weights') spans
/// the range of U, so nothing is left of an M on the face.
void Exposure::take_off_face(Blocks<DoubleDouble>& m) const {
  for (int b = 0; b < data_.layout.blocks(); ++b) {
    const Kernel& kernel = kernels_[static_cast<std::size_t>(b)];
    if (kernel.eliminated.empty()) continue;
    auto block = m.dense(b);
    const Matrix<DoubleDouble> s = block(kernel.eliminated, kernel.eliminated);
    const Matrix<DoubleDouble> v = -kernel.weights.transpose().cast<DoubleDouble>();
    const Matrix<DoubleDouble> vs = v * s;
    block(kernel.kept, kernel.kept) -= vs * v.transpose();
    block(kernel.kept, kernel.eliminated) -= vs;
    block(kernel.eliminated, kernel.kept) -= vs.transpose();
    block(kernel.eliminated, kernel.eliminated).setZero();
  }
  for (Eigen::Index k = 0; k < on_.size(); ++k)
    if (on(k)) m.linear()[k] = DoubleDouble(0);
}

}  // namespace gainsmith::sdp
