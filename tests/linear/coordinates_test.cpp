// Flows and jumps in the coordinates of a judgement are those of the system, in 100 digits.
#include "linear/coordinates.h"

#include <gtest/gtest.h>

#include "linear/sampled_problem.h"
#include "linear/wide_state.h"

namespace gainsmith::linear {
namespace {

using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

class CoordinatesTest : public testing::Test {
 protected:
  void make(const TextProblem& problem, const std::vector<std::string>& functions) {
    problem_ = std::make_unique<SampledProblem>(problem);
    system_ = &problem_->system();
    constants_ = problem_->values;
    std::vector<expr::Program> programs;
    for (const std::string& text : functions) programs.push_back(problem.program(text));
    made_ = make_coordinates(*system_, constants_, programs);
    programs_ = programs;
  }
  Wide in(const expr::Program& program, const hybrid::StateLayout& layout, const Wide& x) const {
    return WideFunction(program, layout, made_.constants)(x);
  }
  /// The coordinates of a state of the system.
  Wide turned(const Wide& state) const {
    Wide x = Wide::Zero(made_.layout.size, 1);
    for (std::size_t i = 0; i < made_.list.size(); ++i) {
      const hybrid::Slot& slot = made_.layout.slots[i];
      x.middleRows(slot.offset, slot.shape.size()) =
          in(made_.list[i].start, system_->layout, state).reshaped();
    }
    return x;
  }
  /// The system's derivative, or its state after a jump.
  Wide moved(const Wide& state, const std::vector<MapEntry>& entries, bool keeps) const {
    Wide result = keeps ? state : Wide(Wide::Zero(state.rows(), 1));
    for (const MapEntry& entry : entries) {
      const hybrid::Slot& slot = system_->layout.slots[entry.slot];
      result.middleRows(slot.offset, slot.shape.size()) =
          in(entry.program, system_->layout, state).reshaped();
    }
    return result;
  }

  std::unique_ptr<SampledProblem> problem_;
  const SampledSystem* system_ = nullptr;
  numbers::ValuesOf<Decimal100> constants_;
  std::vector<expr::Program> programs_;
  Coordinates made_;
};

TEST_F(CoordinatesTest, CommuteWithFlowJumpAndFunctions) {
  make(sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93)),
       {"(z - zh)'*(z - zh) + th^2", "norm(z - zh)"});
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(0xC00, seed);
    const Wide state = wide(drawn(random, system_->layout.size, 1, 10));
    const Wide x = turned(state);
    // The coordinates are linear in the state: their derivative is that of the state, turned.
    const Wide flow = turned(moved(state, system_->flow, false));
    EXPECT_LT(largest_of(made_.linear * x + made_.constant - flow), Decimal100(1e-75));
    const Wide after = turned(moved(state, system_->jump, true));
    for (std::size_t i = 0; i < made_.list.size(); ++i) {
      const hybrid::Slot& slot = made_.layout.slots[i];
      const Eigen::Index rows = slot.shape.size();
      const Wide jump = made_.list[i].jump
                            ? Wide(in(*made_.list[i].jump, made_.layout, x).reshaped())
                            : Wide(x.middleRows(slot.offset, rows));
      EXPECT_LT(largest_of(jump - after.middleRows(slot.offset, rows)), Decimal100(1e-85));
    }
    for (std::size_t i = 0; i < programs_.size(); ++i)
      EXPECT_LT(largest_of(in(made_.functions[i], made_.layout, x) -
                           in(programs_[i], system_->layout, state)),
                Decimal100(1e-85));
  }
}

TEST_F(CoordinatesTest, LeaveOutWhatNoClaimDependsOn) {
  make(sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93)),
       {"(z - zh)'*(z - zh)"});
  EXPECT_EQ(made_.layout.size, 3);  // z - zh and th; z itself may diverge
  make(sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93)),
       {"z'*z"});
  EXPECT_EQ(made_.layout.size, 2);
}

}  // namespace
}  // namespace gainsmith::linear
