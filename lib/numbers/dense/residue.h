// Fractions modulo a prime: what is independent there is independent, since a minor that is not 0
// modulo p is not 0.
#pragma once

#include <cstdint>

#include "base/rational.h"

namespace gainsmith::numbers {

/// The prime 2^31 - 1: products of residues, and their sums with a residue, fit 64 bits.
constexpr std::uint64_t kPrime = 2147483647;

/// 1/x of x in [1, p): x^(p - 2), by Fermat's little theorem.
inline std::uint64_t inverse_modulo(std::uint64_t x) {
  std::uint64_t result = 1;
  for (std::uint64_t e = kPrime - 2; e > 0; e /= 2, x = x * x % kPrime)
    if (e % 2 == 1) result = result * x % kPrime;
  return result;
}

/// x modulo p, in [0, p).
inline std::uint64_t residue_of(const Integer& x) {
  const Integer prime(kPrime);
  return static_cast<std::uint64_t>(Integer((x % prime + prime) % prime));
}

/// None when the prime divides the denominator.
inline std::optional<std::uint64_t> residue_of(const Rational& x) {
  const std::uint64_t below = residue_of(Integer(denominator(x)));
  if (below == 0) return std::nullopt;
  const std::uint64_t above = residue_of(Integer(numerator(x)));
  return below == 1 ? above : above * inverse_modulo(below) % kPrime;
}

}  // namespace gainsmith::numbers
