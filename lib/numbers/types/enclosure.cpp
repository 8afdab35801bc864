#include "numbers/types/enclosure.h"

#include <cctype>
#include <cstdint>
#include <cstdlib>

#include "numbers/dense/foundation.h"
#include "numbers/types/enclosure_rules.h"

namespace gainsmith::numbers {

/// The decimal is n 10^e with whole n. For e >= 0 n 10^e must be below 2^53. For e < 0 5^-e must
/// divide n: what is left is divided by a power of two.
bool is_exact_decimal(const std::string& decimal) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
  std::uint64_t digits = 0;
  long exponent = 0;
  bool behind_point = false;
  for (std::size_t i = 0; i < decimal.size(); ++i) {
    const char c = decimal[i];
    if (c == 'e' || c == 'E') {
      const long stated = std::strtol(decimal.c_str() + i + 1, nullptr, 10);
      if (stated < -1000 || stated > 1000) return false;
      exponent += stated;
      break;
    }
    if (c == '.') behind_point = true;
    if (c == '.' || c == '+' || c == '-') continue;
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return false;
    digits = digits * 10 + static_cast<std::uint64_t>(c - '0');
    if (digits >= kMost) return false;
    if (behind_point) --exponent;
  }
  for (; exponent > 0 && digits != 0 && digits < kMost; --exponent) digits *= 10;
  if (digits == 0) return true;
  // n / 10^k is n / 5^k by a power of two.
  for (; exponent < 0; ++exponent) {
    if (digits % 5 != 0) return false;
    digits /= 5;
  }
  return digits < kMost;
}

template struct Enclosure<double>;
template Enclosed<double> enclose<double>(const expr::Program&, const EnclosedValues<double>&);

}  // namespace gainsmith::numbers
