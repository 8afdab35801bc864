// All digits asked for are printed where half a unit of the last one is at least the error: its
// place is ceil(log10(2 error)) or higher. Fewer end at the first digit of the error, which
// follows.
#include "base/known_digits.h"

#include <cmath>
#include <cstdlib>

#include "base/number.h"

namespace gainsmith {

std::string brief(double value, int digits, double error) {
  if (!(error > 0) || !std::isfinite(value)) return brief(value, digits);
  const double last = std::ceil(std::log10(2 * error));  // the place of the last digit
  const double first = value == 0 ? last - 2 : std::floor(std::log10(std::abs(value)));
  if (first - last >= digits - 1) return brief(value, digits);
  const double place = std::floor(std::log10(error));
  const std::string known = first < place ? "0" : brief(value, static_cast<int>(first - place) + 1);
  constexpr double kUp = 1.05;  // what two digits round
  return known + " +- " + brief(kUp * (error + std::abs(value - std::atof(known.c_str()))), 2);
}

}  // namespace gainsmith
