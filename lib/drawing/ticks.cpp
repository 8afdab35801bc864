#include "drawing/ticks.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"

namespace gainsmith::drawing {

namespace {

constexpr const char* minus = "\xE2\x88\x92";

/// The double nearest to mantissa 10^exponent: a product would round twice.
double decimal(std::int64_t mantissa, int exponent) {
  const auto value = parse_decimal(std::to_string(mantissa) + "e" + std::to_string(exponent));
  return value.value_or(mantissa > 0 ? HUGE_VAL : -HUGE_VAL);
}

/// The multiples within [low, high], a ten-thousandth of a step outside included.
Ticks within(double low, double high, int multiplier, int exponent) {
  constexpr double nearly = 1e-4;
  const double step = decimal(multiplier, exponent);
  Ticks found{0, 0, multiplier, exponent};
  found.first = static_cast<std::int64_t>(std::ceil(low / step - nearly));
  found.last = static_cast<std::int64_t>(std::floor(high / step + nearly));
  return found;
}

}  // namespace

double Ticks::value(std::int64_t k) const { return decimal(k * multiplier, exponent); }

std::string Ticks::label(std::int64_t k, int factor) const {
  const std::int64_t mantissa = k * multiplier;
  if (mantissa == 0) return "0";
  std::string digits = std::to_string(std::abs(mantissa));
  const int places = factor - exponent;
  if (places <= 0) {
    digits.append(static_cast<std::size_t>(-places), '0');
  } else {
    const auto behind = static_cast<std::size_t>(places);
    if (digits.size() <= behind) digits.insert(0, behind + 1 - digits.size(), '0');
    digits.insert(digits.size() - behind, ".");
  }
  return (mantissa < 0 ? minus : "") + digits;
}

Ticks ticks(double low, double high, int most, int smallest_exponent) {
  // Halves, since the difference of large ends has no double.
  const double half = high / 2 - low / 2;
  const int start = static_cast<int>(std::floor(std::log10(half / most)));
  for (int exponent = std::max(start, smallest_exponent);; ++exponent)
    for (const int multiplier : {1, 2, 5}) {
      const Ticks found = within(low, high, multiplier, exponent);
      if (found.count() <= most) return found;
    }
}

Ticks ticks_of_degrees(double low, double high, int most) {
  constexpr int kSteps[] = {15, 30, 45, 90, 180, 360, 720, 1800, 3600, 7200, 18000, 36000};
  const Ticks decimal = ticks(low, high, most);
  if (decimal.value(1) <= 10 || decimal.value(1) > kSteps[std::size(kSteps) - 1]) return decimal;
  for (const int step : kSteps)
    if (const Ticks found = within(low, high, step, 0); found.count() <= most) return found;
  return decimal;
}

}  // namespace gainsmith::drawing
