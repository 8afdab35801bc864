#include "response/sweep.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace gainsmith::response {

namespace {

using Complex = std::complex<double>;

constexpr double kDegrees = 180 / std::numbers::pi;

/// Natural and damped frequencies |s| and |Im s| of poles and zeros, in rising order; of a sampled
/// system s = log(z)/T. Those at 0 are left out.
std::vector<double> features(const StateSpace& system) {
  std::vector<double> all;
  for (const Matrix& roots : {poles(system), zeros(system)})
    for (Eigen::Index k = 0; k < roots.rows(); ++k) {
      Complex s(roots(k, 0), roots(k, 1));
      if (system.is_sampled()) {
        if (std::abs(s) == 0) continue;
        s = std::log(s) / system.step;
      }
      for (const double w : {std::abs(s), std::abs(s.imag())})
        if (w > 0 && std::isfinite(w)) all.push_back(w);
    }
  // What rounding has made of roots at 0, some 1e-8 of a double one, is none.
  constexpr double kNothing = 1e-11, kGap = 1e-6;
  std::sort(all.begin(), all.end());
  std::size_t first = 0;
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (all[k] < kGap * all[k + 1] || all[k] < kNothing * all.back()) first = k + 1;
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first));
  return all;
}

/// How far H in the middle is from the line between its ends, as a logarithm.
double bend(const ComplexMatrix& a, const ComplexMatrix& middle, const ComplexMatrix& b) {
  double largest = 0;
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    const Complex x = a(k), y = middle(k), z = b(k);
    if (x == Complex(0) && y == Complex(0) && z == Complex(0)) continue;
    // log(y^2/(x z))/2; not finite where one of them is 0.
    const Complex ratio = (y / x) * (y / z);
    const double bent = std::abs(std::log(ratio)) / 2;
    largest = std::max(largest, std::isfinite(bent) ? bent : 1.0);
  }
  return largest;
}

class Refinement {
 public:
  Refinement(const StateSpace& system, Sweep& into) : response_(system), into_(into) {}

  ComplexMatrix at(double w) const { return response_.at(w); }
  /// Nothing at a pole.
  void add(double w, ComplexMatrix response) {
    if (!response.allFinite()) return;
    into_.frequency.push_back(w);
    into_.response.push_back(std::move(response));
  }
  /// Points between two neighbours a < b: the middle in log w, and where H bends there by more than
  /// kBend, both halves.
  void between(double a, const ComplexMatrix& at_a, double b, const ComplexMatrix& at_b) {
    constexpr double kBend = 0.01, kNearest = 1e-7;
    constexpr std::size_t kMost = 20'000;
    const double middle = std::sqrt(a) * std::sqrt(b);
    if (b / a < 1 + kNearest || into_.frequency.size() > kMost) return;
    ComplexMatrix here = at(middle);
    if (bend(at_a, here, at_b) <= kBend) return add(middle, std::move(here));
    between(a, at_a, middle, here);
    add(middle, here);
    between(middle, here, b, at_b);
  }

 private:
  FrequencyResponse response_;
  Sweep& into_;
};

}  // namespace

std::pair<double, double> range_of(const StateSpace& system) {
  constexpr double kBeside = 10, kWithout = 100;
  const std::vector<double> all = features(system);
  const double nyquist = system.is_sampled() ? std::numbers::pi / system.step
                                             : std::numeric_limits<double>::infinity();
  if (all.empty())
    return system.is_sampled() ? std::pair(nyquist / (kWithout * kWithout), nyquist)
                               : std::pair(1 / kWithout, kWithout);
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  const double low = std::min(*least, nyquist) / kBeside;
  return {low, system.is_sampled() ? nyquist : *most * kBeside};
}

Sweep sweep(const StateSpace& system, double low, double high) {
  constexpr double kPointsOfDecade = 20;
  Sweep result;
  Refinement refinement(system, result);
  std::vector<double> grid = features(system);
  std::erase_if(grid, [&](double w) { return !(w > low && w < high); });
  const auto count = static_cast<int>(std::ceil(std::log10(high / low) * kPointsOfDecade)) + 1;
  for (int k = 0; k <= count; ++k) grid.push_back(low * std::pow(high / low, double(k) / count));
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  grid.back() = high;
  ComplexMatrix last;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    ComplexMatrix here = refinement.at(grid[k]);
    if (k > 0) refinement.between(grid[k - 1], last, grid[k], here);
    last = here;
    refinement.add(grid[k], std::move(here));
  }
  return result;
}

namespace {

/// 90 k where a sweep begins along an asymptote c w^k: there the phase is 90 k but for half turns.
/// 0 elsewhere.
double phase_of_asymptote(const Sweep& sweep, Eigen::Index i, Eigen::Index j) {
  constexpr double kNearSlope = 0.1, kNearPhase = 15;
  if (sweep.frequency.size() < 2) return 0;
  const std::complex<double> first = sweep.response[0](i, j), second = sweep.response[1](i, j);
  const double slope = std::log(std::abs(second) / std::abs(first)) /
                       std::log(sweep.frequency[1] / sweep.frequency[0]);
  const double k = std::round(slope);
  const double beside = std::remainder(std::arg(first) * kDegrees - 90 * k, 180);
  return std::abs(slope - k) < kNearSlope && std::abs(beside) < kNearPhase ? 90 * k : 0;
}

}  // namespace

std::vector<double> phase(const Sweep& sweep, Eigen::Index i, Eigen::Index j) {
  constexpr double kRounding = 1e-6;  // degrees
  std::vector<double> degrees;
  double turns = 0;
  for (std::size_t k = 0; k < sweep.frequency.size(); ++k) {
    double now = std::arg(sweep.response[k](i, j)) * kDegrees;
    // Of a half turn the negative one, as of two integrators.
    if (k == 0) {
      const double least = phase_of_asymptote(sweep, i, j) - 180 + kRounding;
      now -= 360 * std::floor((now - least) / 360);
    }
    if (k > 0) {
      const double step = now + turns - degrees.back();
      turns -= 360 * std::round(step / 360);
    }
    degrees.push_back(now + turns);
  }
  return degrees;
}

}  // namespace gainsmith::response
