// Ends of axes: the extent of the values and a margin, taken by halves, since the difference of two
// large doubles may be infinite.
#include "drawing/axis.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "drawing/ticks.h"

namespace gainsmith::drawing {

namespace {

/// The greatest d with 10^d <= value.
int decade_below(double value) {
  const auto power = [](int d) {
    return parse_decimal("1e" + std::to_string(d)).value_or(HUGE_VAL);
  };
  int decade = static_cast<int>(std::floor(std::log10(value)));
  if (power(decade) > value) --decade;
  if (power(decade + 1) <= value) ++decade;
  return decade;
}

/// low, high = middle -+ half (1 + margin), half at least 5e-11 of the greatest size and 1e-300.
void set_ends(const Extent& values, double margin, Axis& axis) {
  if (values.empty()) return;
  constexpr double smallest = 1e-300, largest = std::numeric_limits<double>::max();
  const double size = std::max(std::abs(values.low), std::abs(values.high));
  const double middle = values.low / 2 + values.high / 2;
  double half = values.high / 2 - values.low / 2;
  if (half == 0)
    half = values.whole ? std::max(1.0, size / 10) : size > 10 * smallest ? size / 10 : 1;
  else
    half = std::max({half, size * 5e-11, smallest});
  half *= 1 + margin;
  axis.low = std::max(middle - half, -largest);
  axis.high = std::min(middle + half, largest);
}

/// The power of 1000 that keeps the labels short, 0 for numbers that are short themselves.
int shared_factor(const Ticks& shown) {
  const double size =
      std::max(std::abs(shown.value(shown.first)), std::abs(shown.value(shown.last)));
  if (size >= 1e-3 && size < 1e5) return 0;
  return 3 * static_cast<int>(std::floor(decade_below(size) / 3.0));
}

/// "200" or "2x10" with its power.
Tick multiple_of_power(double share, int digit, int decade) {
  const Ticks number{digit, digit, 1, decade};
  if (decade >= -3 && decade < 5) return {share, number.label(digit), {}};
  const std::string times = digit == 1 ? "10" : std::to_string(digit) + "\xC3\x97" + "10";
  return {share, times, Ticks().label(decade)};
}

/// Of a logarithmic axis that holds hardly a decade.
Axis with_linear_ticks(Axis axis, int most) {
  const Ticks shown = ticks(std::pow(10, axis.low), std::pow(10, axis.high), most);
  axis.ticks.clear();
  for (auto k = shown.first; k <= shown.last; ++k)
    axis.ticks.push_back({axis.share(shown.value(k)), shown.label(k), {}});
  return axis;
}

}  // namespace

void Extent::add(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
  whole = whole && value == std::floor(value);
}

bool Axis::shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }

double Axis::share(double value) const {
  const double at = logarithmic ? std::log10(value) : value;
  return (at / 2 - low / 2) / (high / 2 - low / 2);
}

Axis linear_axis(const Extent& values, double margin, int most) {
  Axis axis;
  set_ends(values, margin, axis);
  const Ticks shown =
      values.degrees ? ticks_of_degrees(axis.low, axis.high, most)
                     : ticks(axis.low, axis.high, most, values.whole && !values.empty() ? 0 : -310);
  axis.factor = shared_factor(shown);
  for (auto k = shown.first; k <= shown.last; ++k)
    axis.ticks.push_back({axis.share(shown.value(k)), shown.label(k, axis.factor), {}});
  return axis;
}

/// On a logarithmic axis the margin is a share of half its decades.
Axis close_axis(const Extent& values, bool logarithmic, double margin, int most) {
  if (!logarithmic || values.empty()) return linear_axis(values, margin, most);
  constexpr double least_width = 1e-9;  // decades
  Axis axis;
  axis.logarithmic = true;
  const double low = std::log10(values.low), high = std::log10(values.high);
  double half = (high - low) / 2 * (1 + margin);
  if (half < least_width) half = 0.1;
  axis.low = (low + high) / 2 - half;
  axis.high = (low + high) / 2 + half;
  const Ticks decades = ticks(axis.low, axis.high, most, 0);
  // Fewer powers of ten say too little: then 1, 2 and 5 times them are labelled.
  constexpr std::int64_t few = 3;
  if (decades.count() >= few) {
    for (auto k = decades.first; k <= decades.last; ++k)
      axis.ticks.push_back(
          {(decades.value(k) - axis.low) / (axis.high - axis.low), "10", decades.label(k)});
    return axis;
  }
  for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade)
    for (const int digit : {1, 2, 5}) {
      const double value = Ticks{digit, digit, 1, decade}.value(digit);
      const double share = axis.share(value);
      if (share >= 0 && share <= 1) axis.ticks.push_back(multiple_of_power(share, digit, decade));
    }
  return axis.ticks.size() < 2 ? with_linear_ticks(axis, most) : axis;
}

Axis logarithmic_axis(const Extent& values, int most) {
  Axis axis;
  axis.logarithmic = true;
  if (!values.empty()) {
    axis.low = decade_below(values.low);
    axis.high = decade_below(values.high);
    if (values.high > *parse_decimal("1e" + brief(axis.high))) ++axis.high;
    if (axis.low == axis.high) --axis.low, ++axis.high;
  }
  const double decades = axis.high - axis.low;
  const Ticks shown = ticks(axis.low, axis.high, most, 0);
  for (auto k = shown.first; k <= shown.last; ++k)
    axis.ticks.push_back({(shown.value(k) - axis.low) / decades, "10", shown.label(k)});
  // Lines of so many decades would fill the panel.
  if (decades > 50) return axis;
  const int digits = decades <= 4 ? 9 : 1;
  for (int decade = 0; decade < decades; ++decade)
    for (int digit = 1; digit <= digits; ++digit)
      axis.between.push_back((decade + std::log10(digit)) / decades);
  return axis;
}

}  // namespace gainsmith::drawing
