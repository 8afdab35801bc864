// Operations on Taylor series in time over lanes. Order k of a result follows from orders up to k of its
// operands (Griewank and Walther, Evaluating Derivatives, 2008, chapter 13).
//
// A register holds one order of a value, the one that is computed. A slot holds all of them, order by
// order. Only values have slots of which later orders need the orders before, so that most of a flow
// stays in the nearest cache. A value that rests is in its register at every order, and in its
// slot at order 0, with zeros behind it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gainsmith::lanes {

constexpr std::size_t kGroup = 8;   ///< runs that are computed together; numbers of a register
constexpr std::size_t kOrder = 16;  ///< the last one
constexpr std::size_t kSlot = (kOrder + 1) * kGroup;

enum class SeriesOp : std::uint8_t {
  integral,  ///< order k is order k - 1 of a, divided by k; order 0 is given
  add,
  subtract,
  negate,
  multiply,
  multiply_still,  ///< b does not move
  square,
  divide,
  divide_still,  ///< b does not move
  sqrt,
  exp,
  log,
  power,        ///< a^b, b does not move
  sine_cosine,  ///< sin a, and cos a beside
  tanh,         ///< tanh a, and 1 - tanh(a)^2 beside
  angle,        ///< atan2(a, b), with a^2 + b^2 beside
  // By the sign of a difference half of `length` after the start; in a flow, at the start.
  abs,
  sign,
  minimum,
  maximum,
  where_positive,     ///< a > 0 ? b : c
  where_nonnegative,  ///< a >= 0 ? b : c
};

constexpr std::uint32_t kNoSlot = 0xFFFFFFFF;

/// Where a value is.
struct SeriesPlace {
  std::uint32_t at = 0;  ///< its register
  std::uint32_t slot = kNoSlot;
  bool rests = false;  ///< it does not move
};

struct SeriesStep {
  SeriesOp op = SeriesOp::add;
  SeriesPlace out, beside, a, b, c;
};

/// A step by addresses. There is one for order 0 and one for all others, where what rests is 0.
struct FlowStep {
  SeriesOp op = SeriesOp::add;
  double* out = nullptr;                                     ///< register
  const double *ak = nullptr, *bk = nullptr, *ck = nullptr;  ///< registers, or zeros
  double* r = nullptr;                                       ///< slot of the result; nullptr: none
  const double *a = nullptr, *b = nullptr;                   ///< slots; registers of what has none
  double *beside = nullptr, *beside_out = nullptr;
};

/// Orders 0 to `last` of a flow, order by order; its branches by their signs at the start.
using RunFlow = void (*)(const FlowStep* first, const FlowStep* others, std::size_t count,
                         std::size_t last);

/// All orders of one value, of which all operands have slots.
using RunStep = void (*)(const SeriesStep& step, const double* length, double* slots);

/// The values of slots `length` after the start, by terms up to `order`: out[k*stride + l].
using SeriesValues = void (*)(const std::uint32_t* slot, std::size_t count, std::size_t order,
                              const double* length, const double* slots, double* out,
                              std::size_t stride);

/// By lane the largest |c_k| / scale over the slots, for k = kOrder and kOrder - 1, where scale is
/// floor + |c_0| + |c_1| length + |c_2| length^2.
using SeriesGrowth = void (*)(const std::uint32_t* slot, std::size_t count, const double* floor,
                              const double* length, const double* slots, double* last,
                              double* before);

}  // namespace gainsmith::lanes
