// Every operation over balls holds the value in 100 digits of points drawn from its operands.
#include "bounded/ball.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bounded/ball_parts.h"
#include "bounded/bounded_system.h"
#include "bounded/wide_state.h"
#include "support/text_problem.h"

namespace gainsmith::bounded {
namespace {

template <class Scalar>
void hold_their_values(const std::string& text) {
  tests::TextProblem problem;
  problem.data("A", "n x n", "[0.2, -1.01; 1, 0]").state("x", "n").state("s", "scalar");
  problem.flow({{"x", "A*x"}, {"s", "s"}}).timer("0.5", "1", "0", "1");
  const expr::Program program = problem.program(text);
  const hybrid::StateLayout layout = layout_of({{"x", {2, 1}}, {"s", {1, 1}}});
  numbers::ValuesOf<Decimal100> constants;
  constants["A"] = wide(numbers::Matrix{{0.2, -1.01}, {1, 0}}) / Decimal100(3);
  const BallsOf<Scalar> balls = {{"A", ball_of<Scalar>(constants["A"])}};
  BallFunction<Scalar> over_balls(program, layout, balls);
  WideFunction exact(program, layout, constants);
  for (std::uint64_t run = 0; run < 200; ++run) {
    RandomStream random(0xBA11, run);
    const Eigen::VectorXd mid = drawn(random, 3, 1, 2).col(0);
    const double wideness = std::pow(10.0, -16 + 15 * random.uniform());
    const Eigen::VectorXd rad =
        random.uniform() < 0.2 ? Eigen::VectorXd(Eigen::VectorXd::Zero(3))
                               : Eigen::VectorXd(drawn(random, 3, 1, wideness).cwiseAbs().col(0));
    const ColumnOf<Scalar> centre = mid.cast<Scalar>();
    Ball<Scalar> ball;
    try {
      ball = over_balls(centre, rad, Scalar(0), 0);
    } catch (const expr::EvaluationError&) {
      continue;
    }
    for (int point = 0; point < 5; ++point) {
      Wide x = wide(mid);
      for (Eigen::Index i = 0; i < 3; ++i)
        x(i) += Decimal100(rad(i)) * Decimal100(point == 0 ? 1.0 : 2 * random.uniform() - 1);
      const Wide value = exact(x);
      for (Eigen::Index e = 0; e < value.size(); ++e)
        ASSERT_LE(abs(as<Decimal100>(ball.mid(e)) - value(e)),
                  Decimal100(ball.rad(e)) * Decimal100(kBoundSlack))
            << text << " run " << run;
    }
  }
}

TEST(Balls, HoldTheValueInHundredDigits) {
  for (const char* text : {"A*x + s*x - x",
                           "x'*A*x",
                           "s^3 - s*x(1)",
                           "exp(s)*x",
                           "log(3 + s)",
                           "sqrt(s^2 + x'*x)",
                           "x/(3 + s)",
                           "inv(A + 2*I)*x",
                           "expm(A*s)*x",
                           "abs(x)",
                           "max(x(1), s)",
                           "min(x(1), x(2))",
                           "where(x(1) > s, x(2), s)",
                           "norm(x)",
                           "sin(s) + cos(x(1)) - tanh(x(2))",
                           "sign(s)*x",
                           "trace(x*x')",
                           "diag(x)*A",
                           "[x, A; s, x']",
                           "sqrt(abs(s))",
                           "x.*A(:, 1) - s",
                           "x./(3 + x.^2)",
                           "(3 + x).^s",
                           "floor(3*x)",
                           "mod(x, 0.7)",
                           "mod(x(1), s)",
                           "atan2(x, s)",
                           "complement(x, 1)",
                           "sat(x, 0.5)",
                           "max(x) - min(x)",
                           "jacobian(sin(x)*s + max(x, s), x)",
                           "jacobian(abs(x).*x/norm(x), x)",
                           "jacobian(atan2(x, s) + mod(x, 0.7), s)"}) {
    SCOPED_TRACE(text);
    hold_their_values<double>(text);
    hold_their_values<DoubleDouble>(text);
  }
}

/// A sum of a million radii of 0.1 comes out 1e-11 of it too large or too small.
TEST(Balls, BoundsOfLongSumsHold) {
  const Eigen::Index count = 1000000;
  Ball<double> ones = exact_ball<double>(numbers::Matrix::Ones(1, count));
  Ball<double> zeros = exact_ball<double>(numbers::Matrix::Zero(count, 1));
  for (const double radius : {0.1, 0.3, 0.7}) {
    zeros.rad.setConstant(radius);
    Ball<double> sum;
    rules::multiply(ones, zeros, sum);
    EXPECT_GE(Decimal100(sum.rad(0)) * Decimal100(kBoundSlack),
              Decimal100(radius) * Decimal100(count));
  }
}

TEST(Balls, NothingIsAddedWhereNothingIsRounded) {
  const Ball<double> ball = ball_of<double>(wide(numbers::Matrix{{0.5, -3}, {0, 1024}}));
  EXPECT_EQ(ball.rad.maxCoeff(), 0);
  const Ball<double> third = ball_of<double>(Wide::Constant(1, 1, Decimal100(1) / Decimal100(3)));
  EXPECT_GT(third.rad(0), 0);
  EXPECT_LT(third.rad(0), 1e-16);
}

}  // namespace
}  // namespace gainsmith::bounded
