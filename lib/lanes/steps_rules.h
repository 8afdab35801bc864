// The operations of steps.h, included by one source a variant, which names it in GAINSMITH_VARIANT.
// Nothing here may be shared with other sources: it is compiled for other machines than they are.
//
// The elementary functions reduce their argument in two or three parts (Cody and Waite 1980) and
// take a Taylor polynomial there, without tables. They are right to four units in the last place.
#include <immintrin.h>

#include "base/sine.h"
#include "lanes/steps.h"

namespace gainsmith::lanes {

namespace {

// Vectors of the width that the machine has: wider ones would live in memory.
#if defined(__AVX512F__)
/// Numbers in a vector register.
constexpr std::size_t kWidth = 8;
#elif defined(__AVX2__)
constexpr std::size_t kWidth = 4;
#else
constexpr std::size_t kWidth = 2;
#endif
/// Vectors in a register of the interpreter.
constexpr std::size_t kVectors = kLanes / kWidth;
using V = double __attribute__((vector_size(8 * kWidth)));
using I = long long __attribute__((vector_size(8 * kWidth)));
using U = unsigned long long __attribute__((vector_size(8 * kWidth)));

#if defined(__AVX512F__)
inline V all(double x) { return _mm512_set1_pd(x); }
inline I all(long long x) { return (I)_mm512_set1_epi64(x); }
#elif defined(__AVX2__)
inline V all(double x) { return _mm256_set1_pd(x); }
inline I all(long long x) { return (I)_mm256_set1_epi64x(x); }
#else
inline V all(double x) { return _mm_set1_pd(x); }
inline I all(long long x) { return (I)_mm_set1_epi64x(x); }
#endif
inline U all_bits(unsigned long long x) { return (U)all(static_cast<long long>(x)); }
inline V bits_to_number(I x) { return __builtin_bit_cast(V, x); }
inline I number_to_bits(V x) { return __builtin_bit_cast(I, x); }
inline V abs_of(V x) { return bits_to_number(number_to_bits(x) & all(0x7fffffffffffffffLL)); }
/// x >= 0 with the sign of another number.
inline V with_sign(V x, V sign) {
  return bits_to_number(number_to_bits(x) |
                        (number_to_bits(sign) & all(-0x7fffffffffffffffLL - 1)));
}

/// a b + c, rounded once where the machine has the instruction.
inline V multiply_add(V a, V b, V c) {
#if defined(__AVX512F__)
  return _mm512_fmadd_pd(a, b, c);
#elif defined(__FMA__)
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}

inline V sqrt_of(V x) {
#if defined(__AVX512F__)
  return _mm512_maskz_sqrt_pd(0xFF, x);
#elif defined(__AVX2__)
  return _mm256_sqrt_pd(x);
#else
  return _mm_sqrt_pd(x);
#endif
}

inline V floor_of(V x) {
#if defined(__AVX512F__)
  return _mm512_floor_pd(x);
#elif defined(__AVX2__)
  return _mm256_floor_pd(x);
#else
  return _mm_floor_pd(x);
#endif
}

/// Adding it rounds to a whole number, which is then in the last bits.
constexpr double kRound = 0x1.8p52;

struct Rounded {
  V value;
  I bits;  ///< the whole number, in the low half
};
inline Rounded rounded(V x) {
  const V shifted = x + all(kRound);
  return {shifted - all(kRound), number_to_bits(shifted) - number_to_bits(all(kRound))};
}

/// (e^r - 1 - r) / r^2 for |r| <= log(2)/2: Taylor's series up to r^13.
inline V exp_rest(V r) {
  constexpr double terms[] = {1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800,
                              1.0 / 362880,     1.0 / 40320,     1.0 / 5040,     1.0 / 720,
                              1.0 / 120,        1.0 / 24,        1.0 / 6,        1.0 / 2};
  V sum = all(terms[0]);
  for (std::size_t k = 1; k < sizeof terms / sizeof *terms; ++k)
    sum = multiply_add(sum, r, all(terms[k]));
  return sum;
}

/// x = k log(2) + r, log(2) in two parts of which the first has 32 bits (fdlibm).
inline V exp_reduced(V x, Rounded& k) {
  k = rounded(x * all(1.44269504088896338700e+00));
  return (x - k.value * all(6.93147180369123816490e-01)) -
         k.value * all(1.90821492927058770002e-10);
}

/// 2^k by its exponent bits, -1022 <= k <= 1023.
inline V power_of_two(I k) { return bits_to_number((k + all(1023LL)) << 52); }

/// e^x = 2^k (1 + r + r^2 q(r)); infinite above log of the largest double, 0 far below. What is not
/// a number stays so.
inline V exp_of(V x) {
  constexpr double largest = 709.782712893384;
  constexpr double least = -745.2;
  const V inside = x > all(largest) ? all(largest) : x < all(least) ? all(least) : x;
  Rounded k;
  const V r = exp_reduced(inside, k);
  const V value = all(1.0) + (r + r * r * exp_rest(r));
  // In two factors, since 2^k may be less than any number while e^x is not.
  const Rounded half = rounded(k.value * all(0.5) - all(0.25));
  V out = value * power_of_two(half.bits) * power_of_two(k.bits - half.bits);
  out = x > all(largest) ? all(__builtin_inf()) : out;
  return x == x ? out : x;
}

/// (e^y - 1)/(e^y + 1) with y = 2|x|: e^y - 1 = 2^k (e^r - 1) + 2^k - 1 loses no digits near 0.
/// Beyond |x| = 22 it is 1 to double.
inline V tanh_of(V x) {
  const V size = abs_of(x);
  const V y = all(2.0) * (size > all(22.0) ? all(22.0) : size);
  Rounded k;
  const V r = exp_reduced(y, k);
  const V scale = power_of_two(k.bits);
  const V minus_one = multiply_add(scale, r + r * r * exp_rest(r), scale - all(1.0));
  const V out = minus_one / (minus_one + all(2.0));
  return x == x ? with_sign(out, x) : x;
}

/// Whether a lane of a mask is set; those of comparisons are all ones or all zeros.
inline bool any(I mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask) != 0;
#elif defined(__AVX2__)
  return _mm256_movemask_pd((__m256d)mask) != 0;
#else
  return _mm_movemask_pd((__m128d)mask) != 0;
#endif
}

/// sin(r) for |r| <= pi/2: Taylor's series up to r^21.
inline V sin_kernel(V r) {
  constexpr double terms[] = {1.0 / 51090942171709440000.0,
                              -1.0 / 121645100408832000.0,
                              1.0 / 355687428096000.0,
                              -1.0 / 1307674368000.0,
                              1.0 / 6227020800,
                              -1.0 / 39916800,
                              1.0 / 362880,
                              -1.0 / 5040,
                              1.0 / 120,
                              -1.0 / 6};
  const V z = r * r;
  V sum = all(terms[0]);
  for (std::size_t k = 1; k < sizeof terms / sizeof *terms; ++k)
    sum = multiply_add(sum, z, all(terms[k]));
  return multiply_add(r * z, sum, r);
}

/// Beyond these angles the half turns are not exact.
constexpr double kLargestAngle = 1e6;

/// x = k pi + r, with k + 1/2 for the cosine, pi in three parts (fdlibm) of which the first two
/// have 33 bits: then sin(x) = (-1)^k sin(r) and cos(x) = -(-1)^k sin(r).
template <bool cosine>
inline V sine(V x) {
  const V shift = all(cosine ? 0.5 : 0.0);
  const Rounded turns = rounded(x * all(3.18309886183790691216e-01) - shift);
  const V k = turns.value + shift;
  V r = x - k * all(0x1.921fb544p+1);
  r = r - k * all(0x1.0b4611a6p-33);
  r = multiply_add(k, all(-0x1.3198a2e037073p-68), r);
  const I sign = (turns.bits + all(cosine ? 1LL : 0LL)) << 63;
  V out = bits_to_number(number_to_bits(sin_kernel(r)) ^ sign);
  const I far = ~(abs_of(x) <= all(kLargestAngle));
  if (any(far)) [[unlikely]]
    for (std::size_t l = 0; l < kWidth; ++l)
      if (far[l] != 0) out[l] = cosine ? __builtin_cos(x[l]) : __builtin_sin(x[l]);
  return out;
}

/// The result of a step, in vector registers.
struct Last {
  V part[kVectors];
};

inline void store(const LaneStep& step, double* registers, const Last& last) {
  if (!step.stores) return;
  V* const out = reinterpret_cast<V*>(registers + step.out * kLanes);
#pragma GCC unroll 16
  for (std::size_t k = 0; k < kVectors; ++k) out[k] = last.part[k];
}

/// `operation` of the operands and the last result.
template <class Operation>
inline void each(const LaneStep& step, double* registers, Last& last, const Operation& operation) {
  const V* const a = reinterpret_cast<const V*>(registers + step.a * kLanes);
  const V* const b = reinterpret_cast<const V*>(registers + step.b * kLanes);
  const V* const c = reinterpret_cast<const V*>(registers + step.c * kLanes);
#pragma GCC unroll 16
  for (std::size_t k = 0; k < kVectors; ++k)
    last.part[k] = operation(a[k], b[k], c[k], last.part[k]);
  store(step, registers, last);
}

inline V sine_of(V x) { return sine<false>(x); }
inline V cosine_of(V x) { return sine<true>(x); }

/// sum_i c_i a^i as E(a^2) + a O(a^2), even and odd powers apart by Horner's rule. Two sums are in
/// progress at once, of `chunk` vectors, which hides the latency of multiply_add.
inline void polynomial(const LaneStep& step, const double* constants, double* registers,
                       Last& last) {
  constexpr std::size_t chunk = kVectors < 4 ? kVectors : 4;
  const V* const a = reinterpret_cast<const V*>(registers + step.a * kLanes);
#pragma GCC unroll 4
  for (std::size_t first = 0; first < kVectors; first += chunk) {
    const double* k = constants + step.b;
    const double* const end = k + step.c;
    V square[chunk], one[chunk], other[chunk];
    const V highest = all(*k), next = all(*++k);
#pragma GCC unroll 4
    for (std::size_t v = 0; v < chunk; ++v) {
      square[v] = a[first + v] * a[first + v];
      one[v] = highest;
      other[v] = next;
    }
    for (; end - k >= 2; k += 2) {
      const V even = all(k[1]), odd = all(k[2]);
#pragma GCC unroll 4
      for (std::size_t v = 0; v < chunk; ++v) {
        one[v] = multiply_add(one[v], square[v], even);
        other[v] = multiply_add(other[v], square[v], odd);
      }
    }
    if (k == end) {
#pragma GCC unroll 4
      for (std::size_t v = 0; v < chunk; ++v)
        last.part[first + v] = multiply_add(one[v], a[first + v], other[v]);
    } else {
      const V constant = all(k[1]);
#pragma GCC unroll 4
      for (std::size_t v = 0; v < chunk; ++v)
        last.part[first + v] =
            multiply_add(other[v], a[first + v], multiply_add(one[v], square[v], constant));
    }
  }
  store(step, registers, last);
}

/// The 64-bit products of the low halves.
inline U multiply_low(U a, U b) {
#if defined(__AVX512F__)
  return (U)_mm512_maskz_mul_epu32(0xFF, (__m512i)a, (__m512i)b);
#elif defined(__AVX2__)
  return (U)_mm256_mul_epu32((__m256i)a, (__m256i)b);
#else
  return (U)_mm_mul_epu32((__m128i)a, (__m128i)b);
#endif
}

/// Philox4x32-10 (Salmon et al. 2011; base/random.h) of a vector of counters (draw, run), each word
/// in the low half of 64 bits. The first two words give 53 bits, u = bits 2^-53.
void uniforms(std::uint64_t key, const std::uint64_t* runs, std::uint64_t draw, double low,
              double width, double* out) {
  const U half = all_bits(0xFFFFFFFFULL);
  for (std::size_t v = 0; v < kVectors; ++v) {
    U run;
    __builtin_memcpy(&run, runs + v * kWidth, sizeof run);
    U w0 = all_bits(draw & 0xFFFFFFFFULL), w1 = all_bits(draw >> 32U);
    U w2 = run & half, w3 = run >> 32;
    std::uint32_t k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32U);
    for (int round = 0; round < 10; ++round) {
      const U p0 = multiply_low(w0, all_bits(0xD2511F53ULL));
      const U p1 = multiply_low(w2, all_bits(0xCD9E8D57ULL));
      w0 = (p1 >> 32) ^ w1 ^ all_bits(k0);
      w1 = p1 & half;
      w2 = (p0 >> 32) ^ w3 ^ all_bits(k1);
      w3 = p0 & half;
      k0 += 0x9E3779B9U;
      k1 += 0xBB67AE85U;
    }
    // 53 bits as two whole numbers behind the exponents of 2^52 and 2^84.
    const U bits = ((w0 << 32) | w1) >> 11;
    const V high = __builtin_bit_cast(V, (bits >> 32) | all_bits(0x4530000000000000ULL));
    const V rest = __builtin_bit_cast(V, (bits & half) | all_bits(0x4330000000000000ULL));
    const V number = (high - all(0x1p84)) + (rest - all(0x1p52));
    const V value = all(low) + all(width) * (number * all(0x1p-53));
    __builtin_memcpy(out + v * kWidth, &value, sizeof value);
  }
}

/// Those of base/sine.h, which have the same bits on every machine.
void sines(double* x) {
  V* const all_of = reinterpret_cast<V*>(x);
#pragma GCC unroll 4
  for (std::size_t v = 0; v < kVectors; ++v) all_of[v] = gainsmith::sine(all_of[v]);
}

/// Comparisons that are ordered: a lane with what is not a number has reached its bound.
std::uint32_t reached(const double* x, double bound) {
  const V* const all_of = reinterpret_cast<const V*>(x);
  std::uint32_t bits = 0;
#pragma GCC unroll 16
  for (std::size_t v = 0; v < kVectors; ++v) {
#if defined(__AVX512F__)
    const unsigned before = _mm512_cmp_pd_mask(all_of[v], all(bound), _CMP_LT_OQ);
#elif defined(__AVX2__)
    const auto before =
        static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(all_of[v], all(bound), _CMP_LT_OQ)));
#else
    const auto before = static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd(all_of[v], all(bound))));
#endif
    bits |= before << (v * kWidth);
  }
  return ~bits;
}

/// The interpreter: one case an operation, each a loop over the vectors of a register.
const LaneStep* run(const LaneStep* step, const LaneStep* end, const double* constants,
                    double* registers, double* faults) {
  Last last{};
  for (; step != end; ++step) {
    const auto over = [&](const auto& operation) { each(*step, registers, last, operation); };
    const auto over_constant = [&](const auto& operation) {
      const V k = all(constants[step->a]);
      each({step->op, false, step->stores, step->out, 0, step->b, step->c}, registers, last,
           [&](V, V b, V c, V before) { return operation(k, b, c, before); });
    };
    switch (step->op) {
#define LANE_OP(op, operands, ...)                                                 \
  case LaneOp::op:                                                                 \
    over([]([[maybe_unused]] V a, [[maybe_unused]] V b, [[maybe_unused]] V c, V) { \
      return __VA_ARGS__;                                                          \
    });                                                                            \
    break;
#include "numbers/graph/scalar_ops.def"
      case LaneOp::add_constant:
        over_constant([](V k, V b, V, V) { return k + b; });
        break;
      case LaneOp::multiply_constant:
        over_constant([](V k, V b, V, V) { return k * b; });
        break;
      case LaneOp::multiply_constant_add:
        over_constant([](V k, V b, V c, V) { return multiply_add(k, b, c); });
        break;
      case LaneOp::add_last:
        over([](V a, V, V, V before) { return before + a; });
        break;
      case LaneOp::multiply_add_last:
        over([](V a, V b, V, V before) { return multiply_add(a, b, before); });
        break;
      case LaneOp::multiply_constant_add_last:
        over_constant([](V k, V b, V, V before) { return multiply_add(k, b, before); });
        break;
      case LaneOp::multiply_last_add:
        over([](V, V b, V c, V before) { return multiply_add(before, b, c); });
        break;
      case LaneOp::copy:
        over([](V a, V, V, V) { return a; });
        break;
      case LaneOp::polynomial:
        polynomial(*step, constants, registers, last);
        break;
      case LaneOp::one_by_one:
        return step;
    }
    if (!step->is_partial) continue;
    const V* const value = reinterpret_cast<const V*>(registers + step->out * kLanes);
    V* const fault = reinterpret_cast<V*>(faults);
    // 0 times what is not finite is not a number.
    for (std::size_t k = 0; k < kVectors; ++k) fault[k] += value[k] * all(0.0);
  }
  return step;
}

}  // namespace

extern const Variant GAINSMITH_VARIANT;
const Variant GAINSMITH_VARIANT{GAINSMITH_VARIANT_NAME, run, uniforms, sines, reached};

}  // namespace gainsmith::lanes
