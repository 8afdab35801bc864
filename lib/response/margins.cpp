#include "response/margins.h"

#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace gainsmith::response {

namespace {

using Complex = std::complex<double>;

/// The w in [a, b] where f, of another sign at both ends, is 0: by bisection in log w, until a and
/// b are neighbours.
double root(const std::function<double(double)>& f, double a, double b) {
  const bool rises = f(b) > 0;
  for (int k = 0; k < 100; ++k) {
    const double middle = std::sqrt(a) * std::sqrt(b);
    if (middle <= a || middle >= b) break;
    ((f(middle) > 0) == rises ? b : a) = middle;
  }
  return std::sqrt(a) * std::sqrt(b);
}

/// The frequencies at which f changes its sign.
std::vector<double> crossings(const Sweep& sweep, const std::function<double(const Complex&)>& f,
                              const FrequencyResponse& response) {
  std::vector<double> found;
  // Of a loop that stays at 0 rounding is no crossing, as the gain of an all-pass.
  constexpr double kRounding = 1e-12;
  const auto at = [&](double w) { return f(response.at(w)(0, 0)); };
  for (std::size_t k = 0; k + 1 < sweep.frequency.size(); ++k) {
    const double a = f(sweep.response[k](0, 0)), b = f(sweep.response[k + 1](0, 0));
    if (std::abs(a) <= kRounding && std::abs(b) <= kRounding) continue;
    if (a == 0)
      found.push_back(sweep.frequency[k]);
    else if (b != 0 && (a > 0) != (b > 0))
      found.push_back(root(at, sweep.frequency[k], sweep.frequency[k + 1]));
  }
  return found;
}

}  // namespace

std::pair<double, double> range_with_crossover(const StateSpace& loop) {
  constexpr int kDecades = 15;
  // A gain that moves towards 1 by less than kMoves a decade is taken as constant.
  constexpr double kDecade = 10, kMoves = 1.5;
  const FrequencyResponse response(loop);
  auto [low, high] = range_of(loop);
  // Outside of all poles and zeros |L| is a power of the frequency, or stays.
  const auto extend = [&](double& end, double factor) {
    for (int k = 0; k < kDecades; ++k) {
      const double here = response.largest_gain(end), next = response.largest_gain(end * factor);
      const bool nearer_to_1 = here < 1 ? next > kMoves * here : next * kMoves < here;
      if (here == 0 || !std::isfinite(here) || !nearer_to_1) return;
      end *= factor;
      if ((here < 1) != (next < 1)) return;
    }
  };
  extend(low, 1 / kDecade);
  if (!loop.is_sampled()) extend(high, kDecade);
  return {low, high};
}

Margins margins(const StateSpace& loop) {
  Margins result;
  const auto [low, high] = range_with_crossover(loop);
  const Sweep sweep = response::sweep(loop, low, high);
  const FrequencyResponse response(loop);
  const auto at = [&](double w) { return response.at(w)(0, 0); };
  const auto nearer = [](std::optional<Margin>& best, double value, double w, auto&& size) {
    if (!best || size(value) < size(best->value)) best = {value, w};
  };
  const auto decibels = [](double factor) { return std::abs(std::log(factor)); };
  const auto plain = [](double value) { return std::abs(value); };
  const auto imaginary = [](const Complex& l) { return l.imag(); };
  const auto size = [](const Complex& l) { return std::log(std::abs(l)); };
  for (const double w : crossings(sweep, imaginary, response)) {
    const Complex l = at(w);
    // A pole on the axis changes the sign too, at infinity.
    constexpr double kReal = 1e-3;
    if (l.real() < 0 && std::isfinite(l.real()) && std::abs(l.imag()) < kReal * std::abs(l.real()))
      nearer(result.gain, -1 / l.real(), w, decibels);
  }
  // Where L is real by symmetry: at rest, at half of the sampling frequency, at infinity.
  // Beyond kInfinite it has a pole there, but for rounding.
  constexpr double kInfinite = 1e13;
  const auto meet_real = [&](double l, double w) {
    if (l < 0 && -l < kInfinite) nearer(result.gain, -1 / l, w, decibels);
  };
  meet_real(at(0).real(), 0);
  if (loop.is_sampled())
    meet_real(at(std::numbers::pi / loop.step).real(), std::numbers::pi / loop.step);
  else
    meet_real(loop.D(0, 0), std::numeric_limits<double>::infinity());
  for (const double w : crossings(sweep, size, response)) {
    constexpr double kNoAngle = 1e-12;
    double angle = std::arg(-at(w));  // 0 at -1
    if (std::abs(angle) <= kNoAngle) {
      angle = 0;
      nearer(result.gain, 1, w, decibels);
    }
    nearer(result.phase, angle * 180 / std::numbers::pi, w, plain);
    const double lag = angle >= 0 ? angle : angle + 2 * std::numbers::pi;
    nearer(result.delay, lag / w, w, plain);
  }
  result.stable = loop.D(0, 0) != -1 && is_stable(with_unit_feedback(loop));
  return result;
}

}  // namespace gainsmith::response
