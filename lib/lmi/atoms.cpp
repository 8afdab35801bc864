#include "lmi/atoms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/number.h"

namespace gainsmith::lmi {

double evaluate(const Atom& atom, double t) {
  const double wave = atom.sine ? std::sin(atom.frequency * t) : std::cos(atom.frequency * t);
  return std::pow(t, atom.power) * std::exp(atom.rate * t) * wave;
}

std::string to_string(const Atom& atom, const std::string& variable) {
  std::string text;
  const auto factor = [&](const std::string& part) { text += (text.empty() ? "" : "*") + part; };
  if (atom.power == 1) factor(variable);
  if (atom.power > 1) factor(variable + "^" + std::to_string(atom.power));
  if (atom.rate != 0) factor("exp(" + brief(atom.rate) + "*" + variable + ")");
  if (atom.frequency != 0)
    factor(std::string(atom.sine ? "sin(" : "cos(") + brief(atom.frequency) + "*" + variable + ")");
  return text.empty() ? "1" : text;
}

namespace {

double derivative(const Atom& atom, double t) {
  const double b = atom.frequency;
  const double wave = atom.sine ? std::sin(b * t) : std::cos(b * t);
  const double wave_slope = atom.sine ? b * std::cos(b * t) : -b * std::sin(b * t);
  const double power = std::pow(t, atom.power);
  const double power_slope = atom.power == 0 ? 0 : atom.power * std::pow(t, atom.power - 1);
  return std::exp(atom.rate * t) * ((power_slope + atom.rate * power) * wave + power * wave_slope);
}

/// A zero of the derivative between two points of different sign.
double stationary_point(const Atom& atom, double low, double high) {
  const bool rising = derivative(atom, low) > 0;
  for (int step = 0; step < 200 && low < high; ++step) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    ((derivative(atom, middle) > 0) == rising ? low : high) = middle;
  }
  return low;
}

}  // namespace

Range range(const Atom& atom, double begin, double end) {
  std::vector<double> candidates = {begin, end};
  if (begin < 0 && end > 0) candidates.push_back(0);
  // The derivative is exp(a t) times a function with at most k + 1 zeros per half wave.
  const double half_waves = atom.frequency * (end - begin) / std::numbers::pi;
  const int pieces = 8 * (atom.power + 2) * (1 + static_cast<int>(std::ceil(half_waves)));
  double left = begin;
  for (int i = 1; i <= pieces; ++i) {
    const double right = i == pieces ? end : begin + (end - begin) * i / pieces;
    if ((derivative(atom, left) > 0) != (derivative(atom, right) > 0))
      candidates.push_back(stationary_point(atom, left, right));
    left = right;
  }
  Range result{evaluate(atom, begin), evaluate(atom, begin)};
  for (const double t : candidates) {
    result.low = std::min(result.low, evaluate(atom, t));
    result.high = std::max(result.high, evaluate(atom, t));
  }
  return result;
}

int AtomTable::index(const Atom& atom) {
  const auto found = std::find(atoms_.begin(), atoms_.end(), atom);
  if (found != atoms_.end()) return static_cast<int>(found - atoms_.begin());
  atoms_.push_back(atom);
  return static_cast<int>(atoms_.size()) - 1;
}

Combination AtomTable::product(int a, int b) {
  if (a == 0) return {{1.0, b}};
  if (b == 0) return {{1.0, a}};
  const Atom first = (*this)[a];
  const Atom second = (*this)[b];
  Atom base{first.power + second.power, first.rate + second.rate, 0, false};
  const auto wave = [&](double frequency, bool sine) {
    Atom atom = base;
    atom.frequency = std::abs(frequency);
    atom.sine = sine;
    return index(atom);
  };
  if (first.frequency == 0 || second.frequency == 0) {
    const Atom& oscillating = first.frequency == 0 ? second : first;
    return {{1.0, wave(oscillating.frequency, oscillating.sine)}};
  }
  const double sum = first.frequency + second.frequency;
  const double difference = first.frequency - second.frequency;
  if (first.sine == second.sine) {
    // cos a cos b = (cos(a-b) + cos(a+b))/2, sin a sin b = (cos(a-b) - cos(a+b))/2
    return {{0.5, wave(difference, false)}, {first.sine ? -0.5 : 0.5, wave(sum, false)}};
  }
  // sin a cos b = (sin(a+b) + sin(a-b))/2; the difference vanishes when both frequencies are equal.
  const double signed_difference = first.sine ? difference : -difference;
  Combination result = {{0.5, wave(sum, true)}};
  if (signed_difference != 0)
    result.emplace_back(signed_difference > 0 ? 0.5 : -0.5, wave(difference, true));
  return result;
}

}  // namespace gainsmith::lmi
