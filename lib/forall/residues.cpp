#include "forall/residues.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "expr/program/evaluate.h"
#include "numbers/dense/dense.h"

namespace gainsmith::forall {

namespace {

using Complex = std::complex<double>;
using numbers::ComplexMatrix;

/// Relative to ||F||: a defective eigenvalue of multiplicity m is split by about eps^(1/m).
constexpr double kSameEigenvalue = 1e-4;
constexpr double kRounding = 1e-14;

struct Cluster {
  Complex mean;
  int size = 0;
  double distance = 0;  ///< to the nearest other eigenvalue; 0 when there is none
};

/// Groups of eigenvalues that are chained by small distances.
std::vector<Cluster> clusters_of(const Eigen::VectorXcd& eigenvalues, double norm) {
  const auto n = static_cast<std::size_t>(eigenvalues.size());
  std::vector<std::size_t> group(n);
  for (std::size_t i = 0; i < n; ++i) group[i] = i;
  const auto at = [&](std::size_t i) { return eigenvalues(static_cast<Eigen::Index>(i)); };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (group[i] != group[j] && std::abs(at(i) - at(j)) <= kSameEigenvalue * norm)
        std::replace(group.begin(), group.end(), group[i], group[j]);
  std::vector<Cluster> clusters;
  for (std::size_t g = 0; g < n; ++g) {
    Cluster cluster;
    for (std::size_t i = 0; i < n; ++i) {
      if (group[i] != g) continue;
      cluster.mean += at(i);
      ++cluster.size;
    }
    if (cluster.size == 0) continue;
    cluster.mean /= cluster.size;
    for (std::size_t i = 0; i < n; ++i) {
      if (group[i] == g) continue;
      const double distance = std::abs(at(i) - cluster.mean);
      if (cluster.distance == 0 || distance < cluster.distance) cluster.distance = distance;
    }
    const double noise = 10 * kRounding * norm;
    if (std::abs(cluster.mean.real()) <= noise) cluster.mean.real(0);
    if (std::abs(cluster.mean.imag()) <= noise) cluster.mean.imag(0);
    clusters.push_back(cluster);
  }
  return clusters;
}

/// (1/2 pi i) times the integral of inv(sI - F) on a circle around the cluster, by the trapezoid
/// rule, whose error falls like 2^-points.
ComplexMatrix projector(const numbers::Matrix& F, const Cluster& cluster, double norm) {
  constexpr int kPoints = 64;
  // Halfway to the nearest other eigenvalue, or around all of them.
  const double radius = cluster.distance > 0 ? 0.5 * cluster.distance : norm + 1;
  const Eigen::Index n = F.rows();
  ComplexMatrix sum = ComplexMatrix::Zero(n, n);
  for (int k = 0; k < kPoints; ++k) {
    const Complex step = std::polar(radius, 2 * std::numbers::pi * (k + 0.5) / kPoints);
    const ComplexMatrix shifted =
        (cluster.mean + step) * ComplexMatrix::Identity(n, n) - F.cast<Complex>();
    sum += step * numbers::complex_inverse(shifted);
  }
  return sum / kPoints;
}

/// Adds a term without the elements that are rounding, and none where nothing is left.
void add(std::vector<std::pair<Atom, numbers::Matrix>>& terms, const Atom& atom,
         numbers::Matrix matrix, double size) {
  const double noise = kRounding * std::max(size, 1.0) * static_cast<double>(matrix.rows());
  matrix = (matrix.array().abs() <= noise).select(0, matrix);
  if (!matrix.isZero(0)) terms.emplace_back(atom, std::move(matrix));
}

/// The terms of one eigenvalue l with Im l >= 0: R_j = (F - l I)^j R_0, j! below, until R_j
/// longest^j / j! is rounding.
void add_terms(std::vector<std::pair<Atom, numbers::Matrix>>& terms, const numbers::Matrix& F,
               const Cluster& cluster, double norm, double longest) {
  const Complex l = cluster.mean;
  const double size = norm + 1;
  ComplexMatrix residue = projector(F, cluster, norm);
  // Of R_0: without a Jordan block the further terms are rounding.
  const double noise = 1e-11 * residue.cwiseAbs().maxCoeff();
  double factor = 1;  // 1 / j!
  for (int j = 0; j < cluster.size; ++j) {
    if (j > 0) {
      residue = F.cast<Complex>() * residue - l * residue;
      factor /= j;
      if (residue.cwiseAbs().maxCoeff() * factor * std::pow(longest, j) <= noise) return;
    }
    if (l.imag() == 0) {
      add(terms, {j, l.real(), 0, false}, factor * residue.real(), size);
    } else {
      add(terms, {j, l.real(), l.imag(), false}, 2 * factor * residue.real(), size);
      add(terms, {j, l.real(), l.imag(), true}, -2 * factor * residue.imag(), size);
    }
  }
}

/// The least state that each hangs together with, by elements of F other than 0.
std::vector<Eigen::Index> parts_of(const numbers::Matrix& F) {
  std::vector<Eigen::Index> part(static_cast<std::size_t>(F.rows()));
  std::iota(part.begin(), part.end(), 0);
  for (Eigen::Index i = 0; i < F.rows(); ++i)
    for (Eigen::Index j = 0; j < F.cols(); ++j) {
      const Eigen::Index a = part[static_cast<std::size_t>(i)];
      const Eigen::Index b = part[static_cast<std::size_t>(j)];
      if (F(i, j) != 0) std::replace(part.begin(), part.end(), std::max(a, b), std::min(a, b));
    }
  return part;
}

/// log2 of units d for the states, 0 for the first of each part: by least squares the elements
/// F_ij 2^(d_j - d_i) longest are as near to 1 as they can be. Other units of the states and of the
/// time, by powers of two, give the same matrix.
std::vector<int> units_of(const numbers::Matrix& F, double longest) {
  constexpr double kHalf = 0.5137;  // exact halves must not fall to either side by rounding
  const Eigen::Index n = F.rows();
  const double wanted = longest > 0 ? -std::ilogb(longest) : 0;
  numbers::Matrix normal = numbers::Matrix::Zero(n, n);
  numbers::Vector right = numbers::Vector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i == j || F(i, j) == 0) continue;
      const double difference = std::ilogb(F(i, j)) - wanted;  // d_i - d_j
      normal(i, i) += 1;
      normal(j, j) += 1;
      normal(i, j) -= 1;
      normal(j, i) -= 1;
      right[i] += difference;
      right[j] -= difference;
    }
  const auto part = parts_of(F);
  for (Eigen::Index i = 0; i < n; ++i)
    if (part[static_cast<std::size_t>(i)] == i) normal(i, i) += 1;
  const numbers::Matrix d = numbers::Cholesky(normal).solve(right);
  std::vector<int> units;
  for (Eigen::Index i = 0; i < n; ++i) units.push_back(static_cast<int>(std::floor(d(i) + kHalf)));
  return units;
}

/// M_ij 2^(sign (d_j - d_i)).
numbers::Matrix in_units(numbers::Matrix M, const std::vector<int>& units, int sign) {
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index j = 0; j < M.cols(); ++j)
      M(i, j) = std::ldexp(M(i, j), sign * (units[static_cast<std::size_t>(j)] -
                                            units[static_cast<std::size_t>(i)]));
  return M;
}

/// EvaluationError unless the sum is expm(F t) to 1e-10 at seven points.
void verify(const std::vector<std::pair<Atom, numbers::Matrix>>& terms, const numbers::Matrix& F,
            double low, double high) {
  constexpr int kPieces = 6;
  constexpr double kTolerance = 1e-10;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = low + (high - low) * i / kPieces;
    const numbers::Matrix exact = numbers::exponential(F * t);
    numbers::Matrix sum = numbers::Matrix::Zero(F.rows(), F.cols());
    for (const auto& [atom, matrix] : terms) sum += evaluate(atom, t) * matrix;
    if (!((sum - exact).norm() <= kTolerance * exact.norm()))
      throw expr::EvaluationError(
          "expm cannot be written as a sum of scalar functions to 10 digits: its matrix has "
          "eigenvalues that are close but not equal; use synthesis: {forall: exchange}");
  }
}

}  // namespace

std::vector<std::pair<Atom, numbers::Matrix>> residue_expansion(const numbers::Matrix& given,
                                                                double low, double high) {
  const double longest = std::max(std::abs(low), std::abs(high));
  const std::vector<int> units = units_of(given, longest);
  const numbers::Matrix F = in_units(given, units, 1);
  const double norm = F.norm();
  std::vector<std::pair<Atom, numbers::Matrix>> terms;
  const Eigen::VectorXcd eigenvalues = numbers::eigenvalues(F);
  for (const Cluster& cluster : clusters_of(eigenvalues, norm))
    if (cluster.mean.imag() >= 0) add_terms(terms, F, cluster, norm, longest);
  verify(terms, F, low, high);
  for (auto& [atom, matrix] : terms) matrix = in_units(std::move(matrix), units, -1);
  return terms;
}

}  // namespace gainsmith::forall
