#include "forall/atoms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/number.h"

namespace gainsmith::forall {

/// std::pow makes t^0 = 1 at t = 0 too.
double evaluate(const Atom& atom, double t) {
  const double wave = atom.sine ? std::sin(atom.frequency * t) : std::cos(atom.frequency * t);
  return std::pow(t, atom.power) * std::exp(atom.rate * t) * wave;
}

int compose(expr::Composer& composer, const Atom& atom, const std::string& variable) {
  using expr::Op;
  const int t = composer.input(variable);
  int product = -1;
  const auto factor = [&](int part) {
    product = product < 0 ? part : composer.apply(Op::multiply, {product, part});
  };
  const auto scaled = [&](double rate) {
    return composer.apply(Op::multiply, {composer.number(decimal17(rate)), t});
  };
  if (atom.power == 1) factor(t);
  if (atom.power > 1) factor(composer.apply(Op::power, {t}, {}, {atom.power}));
  if (atom.rate != 0) factor(composer.apply(Op::exp, {scaled(atom.rate)}));
  if (atom.frequency != 0)
    factor(composer.apply(atom.sine ? Op::sin : Op::cos, {scaled(atom.frequency)}));
  return product < 0 ? composer.number("1") : product;
}

std::string to_string(const Atom& atom, const std::string& variable, int digits) {
  std::string text;
  const auto factor = [&](const std::string& part) { text += (text.empty() ? "" : "*") + part; };
  if (atom.power == 1) factor(variable);
  if (atom.power > 1) factor(variable + "^" + std::to_string(atom.power));
  if (atom.rate != 0) factor("exp(" + brief(atom.rate, digits) + "*" + variable + ")");
  if (atom.frequency != 0)
    factor(std::string(atom.sine ? "sin(" : "cos(") + brief(atom.frequency, digits) + "*" +
           variable + ")");
  return text.empty() ? "1" : text;
}

namespace {

void meet(Range& range, double value) {
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

/// t^k exp(a t): stationary at 0 and at -k/a.
Range envelope_range(const Atom& atom, double begin, double end) {
  const Atom envelope{atom.power, atom.rate, 0, false};
  Range result{evaluate(envelope, begin), evaluate(envelope, begin)};
  meet(result, evaluate(envelope, end));
  if (begin < 0 && end > 0) meet(result, evaluate(envelope, 0));
  const double peak = atom.rate == 0 ? 0 : -atom.power / atom.rate;
  if (begin < peak && peak < end) meet(result, evaluate(envelope, peak));
  return result;
}

/// exp(a t) cos(b t) or sin: stationary where tan(b t) = a/b or tan(b t) = -b/a, half a wave apart;
/// the envelope is monotone, so the two stationary points next to either end hold the extremes.
Range wave_range(const Atom& atom, double begin, double end) {
  const double b = atom.frequency;
  const double first = (atom.sine ? std::atan2(-b, atom.rate) : std::atan2(atom.rate, b)) / b;
  const double half_wave = std::numbers::pi / b;
  Range result{evaluate(atom, begin), evaluate(atom, begin)};
  meet(result, evaluate(atom, end));
  const double from = std::ceil((begin - first) / half_wave);
  const double to = std::floor((end - first) / half_wave);
  for (const double m : {from, from + 1, to - 1, to})
    if (m >= from && m <= to)
      meet(result, evaluate(atom, std::clamp(first + m * half_wave, begin, end)));
  return result;
}

/// t^k exp(a t) cos(b t), k > 0: interval products on pieces, a bound from outside that tightens
/// with their number.
Range product_range(const Atom& atom, double begin, double end) {
  // The interval is cut into pieces of 1/64 half wave, but into no more than 1e5.
  constexpr double kPiecesPerHalfWave = 64;
  constexpr double kMostPieces = 1e5;
  const double half_waves = atom.frequency * (end - begin) / std::numbers::pi;
  const int pieces = static_cast<int>(std::min(kMostPieces, kPiecesPerHalfWave * (2 + half_waves)));
  Range result{evaluate(atom, begin), evaluate(atom, begin)};
  for (int i = 0; i < pieces; ++i) {
    const double left = begin + (end - begin) * i / pieces;
    const double right = i + 1 == pieces ? end : begin + (end - begin) * (i + 1) / pieces;
    const Range envelope = envelope_range(atom, left, right);
    const Range wave = wave_range({0, 0, atom.frequency, atom.sine}, left, right);
    for (const double x : {envelope.low, envelope.high})
      for (const double y : {wave.low, wave.high}) meet(result, x * y);
  }
  return result;
}

}  // namespace

Range range(const Atom& atom, double begin, double end) {
  if (atom.frequency == 0) return envelope_range(atom, begin, end);
  return atom.power == 0 ? wave_range(atom, begin, end) : product_range(atom, begin, end);
}

std::optional<double> place_of(const Atom& atom, double value, double begin, double end) {
  // Of a wave; later ones are not tried.
  constexpr int kMostExtrema = 1000;
  constexpr double kSame = 1e-9;
  std::vector<double> places = {begin, end};
  if (atom.frequency == 0) {
    if (atom.rate != 0) places.push_back(-atom.power / atom.rate);
  } else if (atom.power == 0) {
    // a cos(bt) - b sin(bt) = 0, or a sin(bt) + b cos(bt) = 0.
    const double phase =
        atom.sine ? std::atan2(-atom.frequency, atom.rate) : std::atan2(atom.rate, atom.frequency);
    const double half = std::acos(-1.0) / atom.frequency;
    const double first = std::ceil((begin - phase / atom.frequency) / half);
    for (int k = 0; k < kMostExtrema; ++k) {
      const double t = phase / atom.frequency + (first + k) * half;
      if (!(t < end)) break;
      places.push_back(t);
    }
  }
  double best = begin;
  double size = 0;
  for (const double t : places) {
    if (!(t >= begin && t <= end)) continue;
    size = std::max(size, std::abs(evaluate(atom, t)));
    if (std::abs(evaluate(atom, t) - value) < std::abs(evaluate(atom, best) - value)) best = t;
  }
  if (!(std::abs(evaluate(atom, best) - value) <= kSame * size)) return std::nullopt;
  return best;
}

std::vector<std::pair<double, Atom>> derivative(const Atom& atom) {
  std::vector<std::pair<double, Atom>> terms;
  if (atom.power > 0) {
    Atom lower = atom;
    --lower.power;
    terms.emplace_back(atom.power, lower);
  }
  if (atom.rate != 0) terms.emplace_back(atom.rate, atom);
  if (atom.frequency != 0) {
    Atom turned = atom;
    turned.sine = !atom.sine;
    terms.emplace_back(atom.sine ? atom.frequency : -atom.frequency, turned);
  }
  return terms;
}

std::vector<std::pair<double, Atom>> product(const Atom& a, const Atom& b) {
  const auto wave = [&](double frequency, bool sine) {
    return Atom{a.power + b.power, a.rate + b.rate, std::abs(frequency), sine};
  };
  if (a.frequency == 0 || b.frequency == 0) {
    const Atom& oscillating = a.frequency == 0 ? b : a;
    return {{1.0, wave(oscillating.frequency, oscillating.sine)}};
  }
  const double sum = a.frequency + b.frequency;
  const double difference = a.frequency - b.frequency;
  if (a.sine == b.sine) {
    // cos a cos b = (cos(a-b) + cos(a+b))/2, sin a sin b = (cos(a-b) - cos(a+b))/2
    return {{0.5, wave(difference, false)}, {a.sine ? -0.5 : 0.5, wave(sum, false)}};
  }
  // sin a cos b = (sin(a+b) + sin(a-b))/2; the difference vanishes when both frequencies are equal.
  const double signed_difference = a.sine ? difference : -difference;
  std::vector<std::pair<double, Atom>> result = {{0.5, wave(sum, true)}};
  if (signed_difference != 0)
    result.emplace_back(signed_difference > 0 ? 0.5 : -0.5, wave(difference, true));
  return result;
}

}  // namespace gainsmith::forall
