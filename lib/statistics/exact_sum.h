// Sums of doubles without rounding: the same whatever the order and grouping of the terms.
//
// The sum is a fixed-point number in digits of 32 bits, from 2^-1074 to beyond 2^1023; a digit may
// be off its range until it is settled (Kulisch, Computer Arithmetic and Validity, 8).
#pragma once

#include <array>
#include <cstdint>

namespace gainsmith::statistics {

class ExactSum {
 public:
  /// A finite number.
  void add(double value);
  void add(const ExactSum& more);

  /// Rounded, to the last place or two; the same of equal sums.
  double value() const;

  static constexpr std::size_t kDigits = 70;
  using Digits = std::array<std::int64_t, kDigits>;

  /// All that a sum is, for files: the same of equal sums.
  Digits digits() const { return settled(digits_); }
  static ExactSum of(const Digits& digits);

  /// Settled sums of the same terms are equal.
  bool operator==(const ExactSum& other) const;

 private:
  /// The same sum with all digits but the last in [0, 2^32).
  static Digits settled(Digits digits);

  Digits digits_{};              ///< the sum is that of digits_[k] 2^(32 k - 1074)
  std::uint32_t unsettled_ = 0;  ///< additions since all but the last were in [0, 2^32)
};

}  // namespace gainsmith::statistics
