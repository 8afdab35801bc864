#include "statistics/exact_sum.h"

#include <cmath>
#include <stdexcept>

namespace gainsmith::statistics {

namespace {

constexpr int kBits = 32;
constexpr int kLeast = -1074;  ///< the exponent of the least positive double
constexpr std::int64_t kBase = std::int64_t{1} << kBits;

}  // namespace

ExactSum::Digits ExactSum::settled(Digits digits) {
  std::int64_t carry = 0;
  for (std::size_t k = 0; k + 1 < kDigits; ++k) {
    const std::int64_t sum = digits[k] + carry;
    carry = sum >> kBits;  // rounds down
    digits[k] = sum & (kBase - 1);
  }
  digits.back() += carry;
  return digits;
}

void ExactSum::add(double value) {
  if (!std::isfinite(value)) throw std::logic_error("an exact sum of what is not finite");
  if (value == 0) return;
  int exponent = 0;
  auto left = static_cast<std::int64_t>(std::ldexp(std::frexp(std::abs(value), &exponent), 53));
  int place = exponent - 53 - kLeast;
  if (place < 0) {  // a subnormal number: its last bits are 0
    left >>= -place;
    place = 0;
  }
  const std::int64_t sign = value < 0 ? -1 : 1;
  auto digit = static_cast<std::size_t>(place / kBits);
  for (int shift = place % kBits; left != 0; ++digit, shift = 0) {
    const std::int64_t part = left & ((std::int64_t{1} << (kBits - shift)) - 1);
    digits_[digit] += sign * (part << shift);
    left >>= kBits - shift;
  }
  constexpr std::uint32_t kMostUnsettled = 1U << 30;
  if (++unsettled_ < kMostUnsettled) return;
  digits_ = settled(digits_);
  unsettled_ = 0;
}

void ExactSum::add(const ExactSum& more) {
  digits_ = settled(digits_);
  const Digits others = settled(more.digits_);
  for (std::size_t k = 0; k < kDigits; ++k) digits_[k] += others[k];
  unsettled_ = 1;
}

ExactSum ExactSum::of(const Digits& digits) {
  ExactSum sum;
  sum.digits_ = digits;
  return sum;
}

double ExactSum::value() const {
  Digits digits = settled(digits_);
  const bool negative = digits.back() < 0;
  if (negative) {
    for (std::int64_t& digit : digits) digit = -digit;
    digits = settled(digits);
  }
  double sum = 0;
  for (std::size_t k = 0; k < kDigits; ++k)
    sum += std::ldexp(static_cast<double>(digits[k]), kBits * static_cast<int>(k) + kLeast);
  return negative ? -sum : sum;
}

bool ExactSum::operator==(const ExactSum& other) const {
  return settled(digits_) == settled(other.digits_);
}

}  // namespace gainsmith::statistics
