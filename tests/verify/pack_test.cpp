#include "numbers/pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "hybrid/text_problem.h"
#include "numbers/real.h"

namespace gainsmith::verify {
namespace {

using numbers::constant_pack;
using numbers::Matrix;
using numbers::Pack;
using numbers::PackAlgebra;

/// Inputs x (3 x 1), X (2 x 2) and s (1 x 1) that move, and M (3 x 3) that does not.
class PackTest : public testing::Test {
 protected:
  PackTest() {
    problem_.data("M", "3 x 3", "zeros(3, 3)");
    problem_.state("x", "3").state("X", "2 x 2").state("s", "scalar");
  }

  Matrix random(Eigen::Index rows, Eigen::Index cols) {
    Matrix result(rows, cols);
    for (double& element : result.reshaped()) element = draws_.uniform() + 0.1;
    return result;
  }

  static void store(Pack& pack, Eigen::Index lane, const Matrix& value) {
    pack.lanes.row(lane) = value.reshaped().transpose();
  }

  /// Evaluates at kLanes random points by packs and point by point; the largest relative
  /// difference.
  double difference(const std::string& text) {
    const expr::Program program = problem_.program(text);
    expr::Evaluator<PackAlgebra> packs(program);
    const Matrix M = random(3, 3);
    const Pack constant = constant_pack(M);
    packs.fix("M", constant);
    std::map<std::string, Pack> inputs;
    std::vector<numbers::Values> points(Pack::kLanes);
    const std::vector<std::pair<std::string, expr::Shape>> moving = {
        {"x", {3, 1}}, {"X", {2, 2}}, {"s", {1, 1}}};
    for (const auto& [name, shape] : moving) {
      Pack& pack = inputs[name];
      pack = {false, shape.rows, shape.cols, {}, Eigen::ArrayXXd(Pack::kLanes, shape.size())};
      for (Eigen::Index lane = 0; lane < Pack::kLanes; ++lane) {
        Matrix& value = points[static_cast<std::size_t>(lane)][name];
        value = random(shape.rows, shape.cols);
        store(pack, lane, value);
      }
      packs.set(name, pack);
    }
    const Pack& found = packs.run();
    double worst = 0;
    for (Eigen::Index lane = 0; lane < Pack::kLanes; ++lane) {
      numbers::Values& values = points[static_cast<std::size_t>(lane)];
      values["M"] = M;
      const Matrix expected = numbers::evaluate(program, values);
      const Eigen::VectorXd row = found.same ? Eigen::VectorXd(found.matrix.reshaped())
                                             : Eigen::VectorXd(found.lanes.row(lane).transpose());
      worst = std::max(worst, (row - expected.reshaped()).norm() / (1e-300 + expected.norm()));
    }
    return worst;
  }

 private:
  tests::TextProblem problem_;
  RandomStream draws_{1, 2};
};

TEST_F(PackTest, EveryOperationIsThatOfDoubles) {
  for (const char* text : {"x + M*x",
                           "x - s*x",
                           "-x",
                           "x'*M*x",
                           "x*x'",
                           "X*X",
                           "X'*X",
                           "M*M",
                           "s*M",
                           "x*s",
                           "x/s",
                           "M/s",
                           "X^3",
                           "s^0.5",
                           "[X, X; X', X]",
                           "x(2)",
                           "X(2, :)",
                           "exp(-s)*x",
                           "log(x)",
                           "sqrt(x)",
                           "sin(x)",
                           "cos(X)",
                           "tanh(x)",
                           "abs(-x)",
                           "sign(x - 0.5*ones(3, 1))",
                           "min(s, 0.5)",
                           "max(x(1), s)",
                           "where(s > 0.5, x, M*x)",
                           "trace(X)",
                           "norm(x)",
                           "norm(X)",
                           "inv(X)",
                           "expm(X)",
                           "diag(x)",
                           "diag(X)",
                           "s*I + X",
                           "s*ones(2, 2)",
                           "pinv(x)",
                           "trace(M)"})
    EXPECT_LT(difference(text), 1e-14) << text;
}

TEST(Pack, LaneWithoutAResultIsNoNumberAndTheOthersGoOn) {
  tests::TextProblem problem;
  const expr::Program program = problem.state("s", "scalar").program("log(s) + 1/s");
  expr::Evaluator<PackAlgebra> evaluator(program);
  Pack s{false, 1, 1, {}, Eigen::ArrayXXd::Constant(Pack::kLanes, 1, 1.0)};
  s.lanes(3) = -1;
  s.lanes(4) = 0;
  evaluator.set("s", s);
  const Pack& result = evaluator.run();
  EXPECT_EQ(result.lanes(0), 1);
  EXPECT_TRUE(std::isnan(result.lanes(3)));
  EXPECT_FALSE(std::isfinite(result.lanes(4)));
  EXPECT_EQ(result.lanes(5), 1);
}

TEST(Pack, ConstantPartThatFailsIsAnErrorWithItsPlace) {
  tests::TextProblem problem;
  problem.data("Z", "2 x 2", "zeros(2, 2)").state("s", "scalar");
  const expr::Program program = problem.program("s*trace(inv(Z))");
  expr::Evaluator<PackAlgebra> evaluator(program);
  const Pack zero = constant_pack(Matrix::Zero(2, 2));
  const Pack s{false, 1, 1, {}, Eigen::ArrayXXd::Zero(Pack::kLanes, 1)};
  evaluator.fix("Z", zero);
  evaluator.set("s", s);
  try {
    evaluator.run();
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().column, 9) << error.what();
  }
}

}  // namespace
}  // namespace gainsmith::verify
