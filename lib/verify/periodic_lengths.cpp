#include "verify/periodic_lengths.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/stop.h"
#include "numbers/dense/dense.h"
#include "numerics/matrix_products.h"
#include "search/nlopt.h"

namespace gainsmith::verify {

namespace {

using numerics::Matrix;

/// From just after a jump to just after the next one, a flow of length s between.
class Return {
 public:
  Return(Matrix flow, Matrix jump) : flow_(std::move(flow)), jump_(std::move(jump)) {}

  Matrix operator()(double length) const { return jump_ * numbers::exponential(length * flow_); }

  double growth(const std::vector<double>& lengths) const {
    Matrix product = Matrix::Identity(flow_.rows(), flow_.cols());
    for (const double length : lengths) product = (*this)(length)*product;
    return std::pow(numerics::spectral_radius(product),
                    1 / static_cast<double>(std::max<std::size_t>(1, lengths.size())));
  }

  /// The largest angular frequency.
  double fastest() const {
    return flow_.size() == 0 ? 0 : flow_.eigenvalues().imag().cwiseAbs().maxCoeff();
  }

 private:
  Matrix flow_, jump_;
};

/// Lengths that a search begins with, both ends among them: an eighth of a turn apart at most,
/// unless that are too many.
std::vector<double> grid(double low, double high, double frequency) {
  // Radians over the range, in turns; 8 points a turn, 9 to 33 in all.
  const double turns = (high - low) * frequency / (2 * std::numbers::pi);
  const auto count = static_cast<std::size_t>(std::clamp(1 + std::ceil(8 * turns), 9.0, 33.0));
  std::vector<double> lengths(count);
  for (std::size_t k = 0; k < count; ++k)
    lengths[k] = std::lerp(low, high, static_cast<double>(k) / static_cast<double>(count - 1));
  return lengths;
}

/// Moves the lengths within [low, high] to where the growth is largest.
void refine(const Return& step, double low, double high, PeriodicLengths& best) {
  search::LocalSearchOptions options;
  options.step = 0.05;
  options.tolerance = 1e-9;
  options.evaluations = 300 * static_cast<int>(best.lengths.size());
  const auto at = [&](const std::vector<double>& unit) {
    std::vector<double> lengths = unit;
    for (double& length : lengths) length = std::lerp(low, high, length);
    return lengths;
  };
  std::vector<double> start = best.lengths;
  for (double& length : start) length = std::clamp((length - low) / (high - low), 0.0, 1.0);
  search::nlopt_search()(
      [&](const std::vector<double>& unit) {
        check_stop();
        const double growth = step.growth(at(unit));
        if (growth > best.growth) best = {at(unit), growth};
        return -growth;
      },
      start, options, [] { return true; });
}

}  // namespace

std::optional<PeriodicLengths> fastest_lengths(const Setup& setup) {
  if (!setup.linear) return std::nullopt;
  const linear::Coordinates& coordinates = setup.linear->coordinates;
  const auto jump = linear::affine_jump(coordinates);
  const auto& clock = setup.events->system.clocks.front();
  if (!jump || !(clock->low < clock->high)) return std::nullopt;
  const Return step(coordinates.linear.cast<double>(), jump->linear.cast<double>());
  const std::vector<double> lengths = grid(clock->low, clock->high, step.fastest());
  std::vector<Matrix> factors;
  factors.reserve(lengths.size());
  for (const double length : lengths) factors.push_back(step(length));
  const numerics::MatrixProduct found = numerics::fastest_product(factors);
  PeriodicLengths best;
  for (const std::size_t factor : found.factors) best.lengths.push_back(lengths[factor]);
  best.growth = found.growth;
  if (!best.lengths.empty()) refine(step, clock->low, clock->high, best);
  return best;
}

}  // namespace gainsmith::verify
