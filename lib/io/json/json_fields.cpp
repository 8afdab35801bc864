#include "io/json/json_fields.h"

#include <cmath>
#include <limits>

#include "base/number.h"

namespace gainsmith::io {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What JSON has no number for; infinities first.
constexpr std::array<std::pair<const char*, double>, 5> kTexts = {
    std::pair("inf", kInfinity), std::pair("-inf", -kInfinity), std::pair("-0", -0.0),
    std::pair("nan", kNan), std::pair("-nan", -kNan)};

}  // namespace

Json number_json(double value, JsonNumbers numbers) {
  if (numbers == JsonNumbers::or_null) return finite_or_null(value);
  const bool is_text =
      (std::isinf(value) && numbers != JsonNumbers::finite) ||
      (numbers == JsonNumbers::exact && (std::isnan(value) || (value == 0 && std::signbit(value))));
  return is_text ? Json(decimal17(value)) : Json(value);
}

double number_of(const JsonReader& reader, JsonNumbers numbers) {
  if (numbers == JsonNumbers::or_null) return reader.number_or_infinity();
  if (numbers == JsonNumbers::finite || !reader.is_text()) return reader.number();
  const std::size_t known = numbers == JsonNumbers::exact ? kTexts.size() : 2;
  for (std::size_t k = 0; k < known; ++k)
    if (reader.text() == kTexts[k].first) return kTexts[k].second;
  reader.fail("expected a number, \"inf\" or \"-inf\"");
}

}  // namespace gainsmith::io
