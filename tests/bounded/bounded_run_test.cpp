// Runs with error bounds against the same runs in 100 digits, step by step from the decimals.
#include "bounded/bounded_run.h"

#include <gtest/gtest.h>

#include "bounded/sampled_problem.h"
#include "bounded/wide_state.h"

namespace gainsmith::bounded {
namespace {

using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

/// expm(s G) [x; 1] by its series in 100 digits.
Wide flown(const Coordinates& all, const Wide& x, const Decimal100& s) {
  const Eigen::Index n = x.rows();
  Wide G = Wide::Zero(n + 1, n + 1);
  G.topLeftCorner(n, n) = all.linear;
  G.topRightCorner(n, 1) = all.constant;
  Wide term(n + 1, 1);
  term.topRows(n) = x;
  term(n) = Decimal100(1);
  Wide sum = term;
  for (int k = 1; k < 400; ++k) {
    term = (G * term * (s / Decimal100(k))).eval();
    sum += term;
    if (largest_of(term) < Decimal100(1e-95) * largest_of(sum)) break;
  }
  return sum.topRows(n);
}

Wide jumped(const Coordinates& all, const Wide& x) {
  Wide after = x;
  for (std::size_t i = 0; i < all.list.size(); ++i)
    if (all.list[i].jump)
      after.middleRows(all.layout.slots[i].offset, all.layout.slots[i].shape.size()) =
          WideFunction(*all.list[i].jump, all.layout, all.constants)(x).reshaped();
  return after;
}

template <class Scalar>
void follow(const TextProblem& problem, const std::string& claim, double most) {
  const SampledProblem made(problem);
  const Coordinates all = make_coordinates(made.system(), made.values, {problem.program(claim)});
  const BoundedSystem<Scalar> bounded(all, exact_steps(all, *made.steps, {}));
  BoundedSimulator<Scalar> simulator(made.system(), made.scenario, *made.steps, bounded);
  for (std::uint64_t run = 0; run < 6; ++run) {
    const Track<Scalar>& track = simulator.run(7, run);
    ASSERT_EQ(track.termination, Termination::horizon);
    Wide x = track.state(0).unaryExpr([](const Scalar& v) { return as<Decimal100>(v); });
    ASSERT_EQ(track.bound(0).maxCoeff(), 0);  // the start is that of the draws, exactly
    double widest = 0;
    for (std::size_t k = 0; k < track.samples(); ++k) {
      if (k > 0 && track.moves[k - 1].jump) {
        x = jumped(all, x);
      } else if (k > 0) {
        x = flown(all, x, Decimal100(track.moves[k - 1].step.length));
      }
      for (Eigen::Index i = 0; i < track.size; ++i) {
        const Decimal100 error = abs(as<Decimal100>(track.state(k)(i)) - x(i));
        ASSERT_LE(error, Decimal100(track.bound(k)(i))) << "run " << run << " sample " << k;
      }
      const double size = static_cast<double>(largest_of(x));
      widest = std::max(widest, track.bound(k).maxCoeff() / size);
    }
    EXPECT_LT(widest, most) << run;
  }
}

TextProblem observer() {
  TextProblem problem =
      sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
  problem.horizon("12").start("zh", model::StartKind::expression, {"0*z"});
  problem.start("th", model::StartKind::expression, {"0"});
  return problem;
}

TEST(BoundedRun, ItsBoundsHoldTheErrorAgainstHundredDigits) {
  follow<double>(observer(), "(z - zh)'*(z - zh)", 1e-8);
  follow<DoubleDouble>(observer(), "(z - zh)'*(z - zh)", 1e-22);
}

TEST(BoundedRun, StiffFlowsAndConstantsToo) {
  for (const char* A : {"[-1, 100; 0, -300]", "[0, 40; -40, -0.1]", "[0.3, 1; 0, 0]"}) {
    TextProblem problem;
    problem.data("A", "n x n", A).data("b", "n x 1", "[0.3; -0.7]").state("x", "n");
    problem.flow({{"x", "A*x + b"}}).jump({{"x", "0.9*x - b"}}).timer("0.4", "1.3", "0", "1.3");
    problem.horizon("9");
    SCOPED_TRACE(A);
    follow<double>(problem, "x'*x", 1e-8);
    follow<DoubleDouble>(problem, "x'*x", 1e-22);
  }
}

}  // namespace
}  // namespace gainsmith::bounded
