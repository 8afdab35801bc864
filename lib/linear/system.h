// A linear model as code over lanes, with bounds of all errors.
//
// Behind a jump x = B z. A flow of length s and the jump at its end give
//
//   z+ = M(s) z,   M(s) = D E(s) B
//   v just after the jump = z'F(s) z,   just before the next one = z'F_end(s) z
//   cost of both = z'C(s) z
//
// so all that a run needs are polynomials of s (length_table.h), 100 digits rounded once. The error
// e of z has e+ = M e + d with |d| <= K (|z| + r), r bounds of e, K constant. They are
//
//   r_i = root |row i of G| + b_i,   G+ = M G,   root^2 the number of errors that G holds
//
// (block.h). Every few flows, a block, `gather` makes one more error of b, scales
// all by a power of 2, and bounds for all flows of the next block at once (block.h)
//
//   b, which no flow of the block makes larger
//   the errors that forms have by their tables, their rounding and r
//
// What a lane carries from flow to flow: z, G by columns, b, and of each claim
//
//   nonincreasing   low, high    the least v - error and v + error so far; nothing where it falls
//                                in all runs
//                   open, rise   the largest (v + error) - low and (v - error) - high so far
//                   error        of v, in this block
//                   whole rise   of a claim with a tolerance, which open and rise leave out
//   cost            sum, error   with that of the whole block
//   below           low, high    the largest v - error and v + error just after a jump or the start
//                   error        of v, in this block
#pragma once

#include <memory>
#include <optional>

#include "lanes/machine.h"
#include "linear/length_table.h"
#include "linear/model.h"

namespace gainsmith::linear {

/// How many numbers a lane carries of a claim that is compared at jumps, of a cost, and of `below`.
constexpr std::size_t kComparedNumbers = 5, kCostNumbers = 2, kPeakNumbers = 3;
/// Which of the first is the error in this block, and the one more of a claim with a tolerance; which
/// of the last is the error in this block.
constexpr std::size_t kBlockError = 4, kWholeRise = 5, kPeakError = 2;

/// Of the numbers that a lane carries.
struct CarriedNumbers {
  std::size_t first = 0;  ///< of its numbers
  std::size_t count = 0;
};

struct LinearSystem {
  LinearModel model;
  std::size_t rank = 0;     ///< numbers z
  std::size_t carried = 0;  ///< numbers
  std::vector<CarriedNumbers> claims;
  std::int64_t flows_of_block = 1;  ///< fewer where |M| grows faster

  /// Inputs and results of the code. carried: as above. values: of each claim its value and error.
  ///
  ///   first    length, xi              -> carried, values at the start
  ///   step     length, carried         -> carried, which takes the place of what it was before
  ///   gather   scale, root, carried    -> carried; root is that after it
  ///   last     rest, length, left, root, carried -> carried, values at the end
  ///
  /// `last`: a flow of length `rest` that leaves `left` of `length`. The functions of a table in
  /// pieces are the last inputs of `first` and of `last`.
  std::optional<lanes::LaneCode> first, step, gather, last;
  PieceTable first_table, rest_table;

  std::size_t z(std::size_t i) const { return i; }
  std::size_t G(std::size_t i, std::size_t j) const { return rank + j * rank + i; }
  std::size_t b(std::size_t i) const { return rank + rank * rank + i; }
};

/// nullptr where a value may rise along a flow, or a function of lengths is no polynomial.
std::unique_ptr<const LinearSystem> make_linear_system(LinearModel model);

}  // namespace gainsmith::linear
