#include "gainsmith/exact_number.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/number.h"

namespace gainsmith::app {

io::Json bits(double value) {
  const bool plain = std::isfinite(value) && !(value == 0 && std::signbit(value));
  return plain ? io::Json(value) : io::Json(decimal17(value));
}

double from_bits(const io::JsonReader& reader) {
  if (!reader.is_text()) return reader.number();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::array<std::pair<const char*, double>, 5> known = {
      std::pair("inf", kInfinity), std::pair("-inf", -kInfinity), std::pair("-0", -0.0),
      std::pair("nan", std::numeric_limits<double>::quiet_NaN()),
      std::pair("-nan", -std::numeric_limits<double>::quiet_NaN())};
  for (const auto& [text, value] : known)
    if (reader.text() == text) return value;
  reader.fail("expected a number");
}

}  // namespace gainsmith::app
