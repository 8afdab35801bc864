// Operations on numbers over lanes: each register holds one number of each of kLanes runs, and
// nothing crosses lanes.
//
// A step is decoded once for kLanes numbers. So an interpreter costs little beside the arithmetic,
// and no compiler is needed at run time.
//
// Three variants of the same source are compiled, for x86-64-v2, v3 and v4; the best that the
// machine has is chosen once. v3 and v4 have the same bits: a multiply_add is rounded once, nothing
// else is contracted, and elementary functions are computed here. v2 rounds a multiply_add twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace gainsmith::lanes {

/// Runs that are computed side by side; sets of lanes are bits of 32-bit numbers.
constexpr std::size_t kLanes = 32;

/// What a step does with registers a, b, c. The first operations are those of the table of scalar
/// operations.
enum class LaneOp : std::uint8_t {
#define LANE_OP(op, operands, ...) op,
#include "numbers/graph/scalar_ops.def"
  add_constant,       ///< constant a + b
  multiply_constant,  ///< constant a * b
  /// Constant a * b + c.
  multiply_constant_add,
  // Of the result of the step before, `last`, which stays where results are computed.
  add_last,                    ///< last + a
  multiply_add_last,           ///< a b + last
  multiply_constant_add_last,  ///< constant a * b + last
  multiply_last_add,           ///< last b + c
  copy,
  polynomial,  ///< of register a, with c + 1 constants from constant b on, the highest power first;
               ///< even and odd powers by Horner's rule of the square
  one_by_one   ///< the variants stop here: the caller computes it lane by lane
};

/// One instruction over all lanes. `a` of the operations with a constant is its number among
/// constants.
struct LaneStep {
  LaneOp op = LaneOp::one_by_one;
  bool is_partial = false;  ///< a result that is not finite is a fault of the lane
  bool stores = true;       ///< false: the next step alone reads the result
  std::uint32_t out = 0, a = 0, b = 0, c = 0;  ///< registers; of one_by_one `a` is its number
};

/// From `step` on, up to `end` or the next one_by_one, which is returned. Register k of lane l is
/// registers[k*kLanes + l], aligned to 64 bytes. faults[l] is not 0 after a result that is not
/// finite.
using RunSteps = const LaneStep* (*)(const LaneStep* step, const LaneStep* end,
                                     const double* constants, double* registers, double* faults);

/// low + width u of all lanes, u draw `draw` of the streams (key, runs[l]) of base/random.h,
/// uniform in [0, 1).
using Uniforms = void (*)(std::uint64_t key, const std::uint64_t* runs, std::uint64_t draw,
                          double low, double width, double* out);

/// The sine of base/sine.h of all lanes, in place.
using Sines = void (*)(double* x);

/// The lanes in which x < bound does not hold, as bits.
using Reached = std::uint32_t (*)(const double* x, double bound);

/// The functions of one instruction set. All variants have the same contract.
struct Variant {
  const char* name;
  RunSteps run;
  Uniforms uniforms;
  Sines sines;
  Reached reached;
};

/// The best that this machine has, or that GAINSMITH_ISA names: v2, v3 or v4. InputError for
/// another name, and for one that the machine has not.
const Variant& variant();
/// The variant of this name; nullptr: the machine has none.
const Variant* find_variant(const std::string& name);

}  // namespace gainsmith::lanes
