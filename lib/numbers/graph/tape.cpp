#include "numbers/graph/tape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "numbers/graph/scalar_operations.h"

namespace gainsmith::numbers {

/// Registers: `inputs` of them, the constants, whose values stay, and one for each step.
Tape::Tape(const ScalarGraph& graph, const std::vector<std::vector<int>>& results, int inputs) {
  TapeCode code = tape_code(graph, results, inputs);
  registers_.assign(code.registers, 0);
  std::copy(code.constants.begin(), code.constants.end(), registers_.begin() + inputs);
  constants_ = code.inputs;
  first_ = code.inputs + code.constants.size();
  for (const TapeCode::Block& block : code.blocks) blocks_.emplace_back(block);
  steps_ = std::move(code.steps);
  results_ = std::move(code.results);
  reads_ = std::move(code.reads);
}

/// Without a branch for each register: infinities and NaN are what has all bits of the exponent.
bool Tape::is_finite() const {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000U;
  std::uint64_t found = 0;
  for (std::size_t k = first_; k < registers_.size(); ++k)
    found |= (std::bit_cast<std::uint64_t>(registers_[k]) & kExponent) == kExponent ? 1U : 0U;
  return found == 0;
}

/// The steps of run() over intervals. Constants that are no whole numbers are widened by `part` of
/// their size: a decimal is not a double.
bool Tape::enclose(const Box& inputs, double part) {
  if (!blocks_.empty()) return false;
  ranges_.resize(registers_.size());
  for (std::size_t k = constants_; k < first_; ++k) {
    const double value = registers_[k];
    const double error = std::rint(value) == value ? 0 : part * std::abs(value);
    ranges_[k] = {value - error, value + error};
  }
  for (const std::uint32_t k : reads_) {
    if (k >= inputs.size()) return false;
    ranges_[k] = inputs[k];
  }
  return std::all_of(steps_.begin(), steps_.end(), [&](const TapeCode::Step& step) {
    return numbers::enclose(step.op, ranges_[step.a], ranges_[step.b], ranges_[step.c],
                            step.a == step.b, ranges_[step.out]);
  });
}

/// Infinities and NaN are found once at the end, not in each step.
bool Tape::run() {
  double* const r = registers_.data();
  for (const TapeCode::Step& step : steps_) {
    double* const out = &r[step.out];
    if (step.op != ScalarOp::block) {
      *out = ScalarOperations<double>::apply(step.op, r[step.a], r[step.b], r[step.c]);
      continue;
    }
    const Matrix* const value = blocks_[step.a](r);
    if (value == nullptr) return false;
    std::copy_n(value->data(), value->size(), out);
  }
  return is_finite();
}

}  // namespace gainsmith::numbers
