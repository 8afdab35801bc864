// Programs over doubles as one list of operations on single numbers, which all of them share:
//
//   registers   the inputs, the constants, one for each operation
//   operation   register <- op(register, register, register); what has no formula on numbers is a
//               block, an operation on matrices
//
// What several results need is computed once, and so is what `let` shares between states. The
// values are those of Real up to rounding, the same on every machine but for elementary functions.
// A run allocates nothing, blocks apart.
#pragma once

#include <cstdint>
#include <vector>

#include "numbers/graph/range.h"
#include "numbers/graph/tape_block.h"
#include "numbers/graph/tape_code.h"

namespace gainsmith::numbers {

class Tape {
 public:
  /// Computes the nodes of `results` and what may have no value, from `inputs` numbers.
  Tape(const ScalarGraph& graph, const std::vector<std::vector<int>>& results, int inputs);
  Tape(Tape&&) noexcept = default;
  Tape& operator=(Tape&&) noexcept = default;

  /// Where the inputs are written before a run, and which of them are read.
  double* inputs() { return registers_.data(); }
  const std::vector<std::uint32_t>& reads() const { return reads_; }
  /// False: something has no value, or is not finite. Then the results say nothing.
  bool run();
  /// Element `k` of a result.
  double operator()(std::size_t result, std::size_t k) const {
    return registers_[results_[result][k]];
  }
  /// All elements, to `out`.
  void copy(std::size_t result, double* out) const {
    for (const std::uint32_t at : results_[result]) *out++ = registers_[at];
  }
  std::size_t operations() const { return steps_.size(); }

  /// Bounds of the results when the inputs lie anywhere in the box, in which those that are read
  /// have a place; constants that are no whole numbers may be off by `part` of them. Interval
  /// arithmetic operation by operation (range.h). False: something may have no value there, or no
  /// bounds are known, as of blocks.
  bool enclose(const Box& inputs, double part = 0);
  /// Of element `k` of a result, after enclose().
  const Range& range(std::size_t result, std::size_t k) const {
    return ranges_[results_[result][k]];
  }

 private:
  bool is_finite() const;

  std::vector<double> registers_;
  std::vector<TapeCode::Step> steps_;
  std::vector<TapeBlock> blocks_;
  std::vector<std::vector<std::uint32_t>> results_;
  std::vector<std::uint32_t> reads_;
  std::size_t constants_ = 0;  ///< the first register of a constant
  std::size_t first_ = 0;      ///< register that is computed
  Box ranges_;                 ///< of the registers
};

}  // namespace gainsmith::numbers
