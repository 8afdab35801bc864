#include "sdp/face.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/scalars.h"
#include "sdp/report.h"

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
/// An entry that counts as none, beside the largest.
constexpr double kNoise = 1e-11;
/// Rounding of I in Y, and the factor from one t to the next.
constexpr double kRidge = 1e-26;
constexpr double kLiftFactor = 16;
constexpr int kLiftTries = 14;

double nearest_weight(double value) {
  const double nearest = std::round(value * kDenominator) / kDenominator;
  return std::abs(value - nearest) <= kNearby ? nearest : std::numeric_limits<double>::quiet_NaN();
}

/// y_eliminated = weights y_kept says that U'y = 0.
struct Kernel {
  std::vector<Eigen::Index> eliminated, kept;
  Matrix<double> weights;
};

/// By elimination, of the last row whose pivot is at least `least` of the largest (1: complete
/// pivoting); weights are rounded. Nothing when one is far from what it would become.
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

/// The search for d and U in the working problem.
class Exposure {
 public:
  explicit Exposure(const Data& data)
      : data_(data), image_(data.layout), off_(data.layout), moved_(data.layout) {
    c_ = Vector<double>::Map(data.c.data(), data.m());
  }

  /// From X and x of a point; true when d and U were found.
  bool find(const Iterate<double>& point);

  const Vector<DoubleDouble>& direction() const { return d_; }
  const Kernel& kernel(std::size_t b) const { return kernels_[b]; }
  bool on(Eigen::Index k) const { return on_[k] != 0; }

 private:
  bool guess(const Iterate<double>& point, double threshold);
  bool solve(const Vector<double>& x);
  void correct(double rest);
  bool exposes();
  void take_off_face(Blocks<DoubleDouble>& m) const;
  void take_off_face(Blocks<double>& m) const;

  const Data& data_;
  Vector<double> c_, step_;
  Vector<DoubleDouble> d_;
  Blocks<DoubleDouble> image_;  ///< A*(d)
  Blocks<double> off_, moved_;  ///< its part off the face, and that of a direction
  std::vector<Eigen::SelfAdjointEigenSolver<Matrix<double>>> spectra_;  ///< of X
  std::vector<Kernel> kernels_;                                         ///< by dense block
  std::vector<Matrix<double>> range_;                                   ///< U
  Vector<double> on_;  ///< 1 where a linear entry is in U
};

bool Exposure::find(const Iterate<double>& point) {
  std::vector<double> values(point.X.linear().begin(), point.X.linear().end());
  for (int b = 0; b < data_.layout.blocks(); ++b) {
    const auto& spectrum = spectra_.emplace_back(point.X.dense(b)).eigenvalues();
    values.insert(values.end(), spectrum.begin(), spectrum.end());
  }
  std::sort(values.begin(), values.end(), std::greater<>());
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

/// The numbers of N' F N in one block, both triangles, of which few are not zero.
class Accumulator {
 public:
  void resize(int n) {
    n_ = static_cast<std::size_t>(n);
    values_.assign(n_ * n_, DoubleDouble(0));
  }
  void add(int i, int j, const DoubleDouble& value) {
    const std::size_t at = static_cast<std::size_t>(i) + n_ * static_cast<std::size_t>(j);
    if (values_[at].hi() == 0) touched_.push_back(at);
    values_[at] += value;
  }
  /// Appends what is not below `least` to `list`, and forgets it.
  void take(double least, int block, std::vector<Entry>& list) {
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const std::size_t at : touched_) {
      const DoubleDouble value = values_[at];
      values_[at] = DoubleDouble(0);
      const auto row = static_cast<int>(at % n_), column = static_cast<int>(at / n_);
      if (row > column || std::abs(value.hi()) < least) continue;
      list.push_back({block, row, column, value.hi(), value.lo(), 0});
    }
    touched_.clear();
  }

 private:
  std::size_t n_ = 0;
  std::vector<DoubleDouble> values_;
  std::vector<std::size_t> touched_;
};

template <typename Packed>
DoubleDouble both(const Packed& value, const Packed& rest, std::size_t at) {
  return rest.empty() ? DoubleDouble(value[at]) : DoubleDouble(value[at], rest[at]);
}

}  // namespace

std::optional<Face> find_face(const Problem& problem, const Presolved& presolved,
                              const Iterate<double>& point) {
  const Recovery& recovery = presolved.recovery;
  Exposure exposure(presolved.data);
  if (!exposure.find(point)) return std::nullopt;
  Face face;
  face.direction.assign(problem.c.size(), DoubleDouble(0));
  for (std::size_t i = 0; i < recovery.constraint.size(); ++i)
    face.direction[static_cast<std::size_t>(recovery.constraint[i])] =
        exposure.direction()[static_cast<Eigen::Index>(i)] * recovery.s[i];

  // Rows of N by row of Y: what is not eliminated is a unit vector.
  std::vector<std::vector<char>> eliminated;
  for (const Block& block : problem.blocks)
    eliminated.emplace_back(static_cast<std::size_t>(block.size), 0);
  const auto eliminate = [&](const Recovery::Row& row) {
    eliminated[static_cast<std::size_t>(row.block)][static_cast<std::size_t>(row.row)] = 1;
  };
  for (std::size_t b = 0; b < recovery.dense.size(); ++b)
    for (const Eigen::Index i : exposure.kernel(b).eliminated)
      eliminate(recovery.dense[b][static_cast<std::size_t>(i)]);
  for (std::size_t k = 0; k < recovery.linear.size(); ++k)
    if (exposure.on(static_cast<Eigen::Index>(k))) eliminate(recovery.linear[k]);
  int number = 0;
  for (const auto& rows : eliminated) {
    Face::Rows& block = face.blocks.emplace_back();
    block.parts.resize(rows.size());
    block.kept.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) block.kept[i] = !rows[i];
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (block.kept[i]) block.parts[i].push_back({block.size++, 1});
    if (block.size > 0) block.number = number++;
  }
  for (std::size_t b = 0; b < recovery.dense.size(); ++b) {
    const Kernel& kernel = exposure.kernel(b);
    const auto& rows = recovery.dense[b];
    auto& parts = face.blocks[static_cast<std::size_t>(rows.front().block)].parts;
    const auto at = [&](const std::vector<Eigen::Index>& list, Eigen::Index k) {
      const auto place = static_cast<std::size_t>(list[static_cast<std::size_t>(k)]);
      return static_cast<std::size_t>(rows[place].row);
    };
    for (Eigen::Index k = 0; k < kernel.weights.rows(); ++k)
      for (Eigen::Index j = 0; j < kernel.weights.cols(); ++j)
        if (kernel.weights(k, j) != 0)
          parts[at(kernel.eliminated, k)].push_back(
              {parts[at(kernel.kept, j)].front().row, kernel.weights(k, j)});
  }
  return face;
}

Problem restrict_to(const Face& face, const Problem& problem) {
  Problem restricted;
  std::vector<Accumulator> sums(problem.blocks.size());
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Face::Rows& rows = face.blocks[b];
    if (rows.number < 0) continue;
    restricted.blocks.push_back({rows.size, problem.blocks[b].diagonal});
    sums[b].resize(rows.size);
  }
  restricted.c = problem.c;
  restricted.c_rest = problem.c_rest;
  for (std::size_t i = 0; i < problem.f.size(); ++i) {
    double largest = 0;
    for (const Entry& e : problem.f[i]) {
      largest = std::max(largest, std::abs(e.value));
      const auto b = static_cast<std::size_t>(e.block);
      const DoubleDouble value(e.value, e.rest);
      for (const Face::Part& p : face.blocks[b].parts[static_cast<std::size_t>(e.row)])
        for (const Face::Part& q : face.blocks[b].parts[static_cast<std::size_t>(e.column)]) {
          const DoubleDouble product = value * p.weight * q.weight;
          sums[b].add(p.row, q.row, product);
          if (e.row != e.column) sums[b].add(q.row, p.row, product);
        }
    }
    auto& list = restricted.f.emplace_back();
    for (std::size_t b = 0; b < sums.size(); ++b)
      if (face.blocks[b].number >= 0) sums[b].take(kNoise * largest, face.blocks[b].number, list);
    if (i == 0 || !list.empty()) continue;
    restricted.c[i - 1] = 0;
    if (!restricted.c_rest.empty()) restricted.c_rest[i - 1] = 0;
  }
  return restricted;
}

Iterate<double> restrict_to(const Face& face, const Problem& problem, const Point<double>& point,
                            const Problem& program, const Presolved& presolved) {
  Point<double> on_face;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Face::Rows& rows = face.blocks[b];
    if (rows.number < 0) continue;
    const bool diagonal = problem.blocks[b].diagonal;
    const std::size_t n = rows.parts.size(), size = static_cast<std::size_t>(rows.size);
    auto& x = on_face.X.emplace_back(diagonal ? size : size * size, 0);
    auto& y = on_face.Y.emplace_back(diagonal ? size : size * size, 0);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = diagonal ? j : 0; i < (diagonal ? j + 1 : n); ++i)
        for (const Face::Part& p : rows.parts[i])
          for (const Face::Part& q : rows.parts[j]) {
            const std::size_t to = static_cast<std::size_t>(p.row) +
                                   (diagonal ? 0 : size * static_cast<std::size_t>(q.row));
            const std::size_t from = diagonal ? i : i + n * j;
            x[to] += p.weight * q.weight * point.X[b][from];
            if (rows.kept[i] && rows.kept[j]) y[to] = point.Y[b][from];
          }
  }
  double along = 0, square = 0;
  for (std::size_t i = 0; i < point.x.size(); ++i) {
    const double d = face.direction[i].hi();
    along += d * point.x[i];
    square += d * d;
  }
  for (std::size_t i = 0; i < point.x.size(); ++i)
    on_face.x.push_back(point.x[i] - along / square * face.direction[i].hi());
  Iterate<double> result(presolved.data);
  reduce(program, presolved, on_face, result.x, result.X, result.Y);
  return result;
}

std::optional<Point<DoubleDouble>> lift(const Face& face, const Problem& problem,
                                        const Solution& solution, double tolerance) {
  Point<DoubleDouble> point;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const Face::Rows& rows = face.blocks[b];
    const auto n = static_cast<std::size_t>(block.size), size = static_cast<std::size_t>(rows.size);
    auto& y = point.Y.emplace_back(block.diagonal ? n : n * n, DoubleDouble(0));
    if (rows.number < 0) continue;
    const auto number = static_cast<std::size_t>(rows.number);
    const std::vector<double>& z = solution.Y.values[number];
    const std::vector<double> none;
    const auto& rest = solution.rest.Y.values.empty() ? none : solution.rest.Y.values[number];
    DoubleDouble largest(0);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = block.diagonal ? j : 0; i <= j; ++i) {
        DoubleDouble sum(0);
        for (const Face::Part& p : rows.parts[i])
          for (const Face::Part& q : rows.parts[j])
            sum += both(z, rest,
                        static_cast<std::size_t>(p.row) +
                            (block.diagonal ? 0 : size * static_cast<std::size_t>(q.row))) *
                   (p.weight * q.weight);
        if (i == j) largest = std::max(largest, sum);
        if (block.diagonal)
          y[i] = sum;
        else
          y[i + n * j] = y[j + n * i] = sum;
      }
    if (size < n && !block.diagonal)
      for (std::size_t i = 0; i < n; ++i) y[i * (n + 1)] += kRidge * largest;
  }
  double largest = 0, rows = 0;
  for (const Entry& e : problem.f[0]) largest = std::max(largest, std::abs(e.value));
  for (const Block& block : problem.blocks) rows += block.size;
  const double shift = tolerance * (1 + largest) / std::sqrt(rows);
  const std::vector<DoubleDouble> start = [&] {
    std::vector<DoubleDouble> x;
    for (std::size_t i = 0; i < solution.x.size(); ++i)
      x.push_back(both(solution.x, solution.rest.x, i));
    return x;
  }();
  double t = 0;
  for (int step = 0; step < kLiftTries; ++step) {
    point.x = start;
    for (std::size_t i = 0; i < start.size(); ++i) point.x[i] += face.direction[i] * t;
    point.X = slack(problem, point.x);
    for (std::size_t b = 0; b < point.X.size(); ++b) {
      const Block& block = problem.blocks[b];
      const auto n = static_cast<std::size_t>(block.size);
      for (std::size_t i = 0; i < n; ++i) point.X[b][block.diagonal ? i : i * (n + 1)] += shift;
    }
    if (in_cone(problem, point.X)) return point;
    if (t > 0) {
      t *= kLiftFactor;
      continue;
    }
    for (const auto& block : point.X)
      for (const DoubleDouble& v : block) t = std::max(t, std::abs(v.hi()));
  }
  return std::nullopt;
}

}  // namespace gainsmith::sdp
