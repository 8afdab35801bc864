// Scalar graphs (numbers/graph/scalar_graph.h) over lanes.
//
// A LaneCode is made once and read by all threads; a LaneMachine has the registers of one of them.
// A lane in which something has no value is marked (faults) and its results say nothing; the other
// lanes are what they are without it.
//
// What has a vector form runs over all lanes (steps.h). Operations on matrices, powers, logarithms
// and the like are computed lane by lane, in the lanes that are active.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lanes/steps.h"
#include "numbers/graph/scalar_graph.h"
#include "numbers/graph/tape_block.h"
#include "numbers/graph/tape_code.h"

namespace gainsmith::lanes {

/// A list of steps over registers, with few of them: a register is free again after the last use of
/// its value. Immutable.
class LaneCode {
 public:
  /// Computes the nodes of `results` and what may have no value, from `inputs` numbers a lane.
  /// `feed_back`: then writes the first result to the inputs from this one on.
  LaneCode(const numbers::ScalarGraph& graph, const std::vector<std::vector<int>>& results,
           std::size_t inputs, std::optional<std::uint32_t> feed_back = {},
           numbers::Computed computed = numbers::Computed::partial);

 private:
  friend class LaneMachine;
  /// What is computed lane by lane: one of these.
  struct OneByOne {
    numbers::ScalarOp op = numbers::ScalarOp::block;
    std::size_t block = 0;  ///< its number
    std::uint32_t out = 0, a = 0, b = 0, c = 0;
    std::vector<std::uint32_t> results;  ///< of a block
  };
  class Maker;

  std::vector<LaneStep> steps_;
  std::vector<OneByOne> one_by_one_;
  std::vector<numbers::TapeCode::Block> blocks_;
  std::vector<double> constants_;
  std::vector<std::pair<std::uint32_t, double>> filled_;  ///< registers of constants
  std::vector<std::vector<std::uint32_t>> results_;
  std::size_t registers_ = 0;
  bool may_fault_ = false;  ///< beside what is done lane by lane
};

class LaneMachine {
 public:
  /// The code must outlive it. `variant`: for tests.
  explicit LaneMachine(const LaneCode& code, const Variant& variant = lanes::variant());
  LaneMachine(LaneMachine&&) noexcept;
  LaneMachine& operator=(LaneMachine&&) noexcept;
  ~LaneMachine();

  /// The kLanes numbers of input k; they stay.
  double* input(std::size_t k) { return registers_.get() + k * kLanes; }
  /// Computes all lanes; what is done lane by lane only where `active`.
  void run(std::uint32_t active = ~0U);
  /// How many elements a result has.
  std::size_t size(std::size_t result) const { return code_->results_[result].size(); }
  /// The kLanes numbers of an element of a result.
  const double* result(std::size_t result, std::size_t element) const {
    return registers_.get() + code_->results_[result][element] * kLanes;
  }
  /// The lanes in which the last run met what has no value, as bits.
  std::uint32_t faults() const { return faults_; }

 private:
  void run_one_by_one(const LaneCode::OneByOne& operation, std::uint32_t active);

  struct Free {
    void operator()(double* registers) const;
  };
  const LaneCode* code_;
  RunSteps run_;
  std::unique_ptr<double[], Free> registers_;
  std::vector<std::vector<numbers::TapeBlock>> blocks_;  ///< by block, by lane
  std::uint32_t faults_ = 0;
};

}  // namespace gainsmith::lanes
