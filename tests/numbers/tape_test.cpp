// Programs as one tape: what they share, what is known, and where there is no value.
#include "numbers/graph/tape.h"

#include <gtest/gtest.h>

#include <deque>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/graph/scalar_trace.h"
#include "numbers/graph/stacked_functions.h"

namespace gainsmith::numbers {
namespace {

/// Texts over x of three elements, the time t and the constant A.
class TapeOf {
 public:
  explicit TapeOf(std::initializer_list<std::string> texts) {
    constants_["A"] = (Matrix(3, 3) << 0, 1, 0, -2, -1, 0, 0, 0, 3).finished();
    expr::Scope scope;
    scope.symbols["A"] = {{3, 3}, true};
    scope.symbols["x"] = {{3, 1}, false};
    scope.symbols["t"] = {{1, 1}, false};
    scope.time = "t";
    for (const std::string& text : texts)
      programs_.push_back(expr::compile(expr::parse({text, "test"}), scope));
  }

  StackedFunctions functions() const {
    std::vector<const expr::Program*> all;
    for (const expr::Program& program : programs_) all.push_back(&program);
    return {all, place, constants_, 3};
  }

  /// How many operations there are.
  std::size_t operations() const {
    ScalarGraph graph;
    std::vector<std::vector<int>> results;
    for (const expr::Program& program : programs_) {
      const auto input = [&](const expr::Input& one) {
        if (one.name == "A") return traced(constants_.at("A"), graph);
        return TracedMatrix{{3, 1}, {graph.input(0), graph.input(1), graph.input(2)}};
      };
      results.push_back(trace(program, input, graph).value);
    }
    return Tape(graph, results, 3).operations();
  }

 private:
  static std::optional<Eigen::Index> place(const std::string& name) {
    if (name == "t") return 3;  // beside x
    return name == "x" ? std::optional<Eigen::Index>(0) : std::nullopt;
  }

  Values constants_;
  std::deque<expr::Program> programs_;
};

Vector point(double a, double b, double c) { return (Vector(3) << a, b, c).finished(); }

TEST(Tape, WhatSeveralResultsShareIsComputedOnce) {
  const std::size_t one = TapeOf({"exp(x(1))*sin(x(2))"}).operations();
  EXPECT_EQ(TapeOf({"exp(x(1))*sin(x(2))", "sin(x(2))*exp(x(1))"}).operations(), one);
  EXPECT_EQ(TapeOf({"exp(x(1))*sin(x(2))", "exp(x(1))*sin(x(2)) + x(3)"}).operations(), one + 1);
}

TEST(Tape, ZerosAndOnesOfAMatrixCostNothing) {
  // x(2); -2 x(1) - x(2); 3 x(3)
  EXPECT_LE(TapeOf({"A*x"}).operations(), 3U);
  EXPECT_EQ(TapeOf({"eye(3)*x + zeros(3, 1)"}).operations(), 0U);
}

TEST(Tape, AnOperationOnConstantMatricesIsMadeOnce) {
  EXPECT_EQ(TapeOf({"svd(A'*inv(A + A'))(2)*x(1)"}).operations(), 1U);
}

TEST(Tape, AConstantWithoutAValueKeepsItsFault) {
  const TapeOf texts({"x(1) + inv(0*A)(1, 1)"});
  StackedFunctions functions = texts.functions();
  EXPECT_FALSE(functions.run(point(1, 2, 3)));
}

TEST(Tape, ADerivativeIsAFormula) {
  const TapeOf texts({"jacobian([x(1)*x(2); x(3)^2; sin(x(1))], x)"});
  StackedFunctions functions = texts.functions();
  ASSERT_TRUE(functions.run(point(2, 3, 5)));
  Matrix expected(3, 3);
  expected << 3, 2, 0, 0, 0, 10, std::cos(2.0), 0, 0;
  EXPECT_EQ(functions.value(0), expected);
  EXPECT_LE(texts.operations(), 2U);  // cos and 2 x(3)
}

TEST(Tape, TheDerivativeOfAnExponentialIsOneOfALargerMatrix) {
  const TapeOf texts(
      {"jacobian(expm([0, x(1); -x(2), x(3)])*[1; 2], x)", "jacobian(expm(x(1)), x)"});
  StackedFunctions functions = texts.functions();
  for (const Vector& x : {point(0.3, 2, -1), point(0, 0, 0)}) {
    ASSERT_TRUE(functions.run(x));
    for (std::size_t k = 0; k < functions.count(); ++k)
      EXPECT_LT((functions.value(k) - functions.at(k, x)).cwiseAbs().maxCoeff(), 1e-14) << k;
  }
}

TEST(Tape, AnExponentialOfAKnownMatrixIsAFormula) {
  const TapeOf texts({"expm(A*x(1))", "expm(-A*(x(1) - t))*x",
                      "jacobian(expm(A*x(1))*[1; 2; 3], x)",
                      "jacobian(expm(2*A*(x(1) + t))(2, :)', x)"});
  StackedFunctions functions = texts.functions();
  for (const Vector& x : {point(0.3, 2, -1), point(0, 0, 0), point(-1.5, 1, 1)}) {
    ASSERT_TRUE(functions.run(x, 0.2));
    for (std::size_t k = 0; k < functions.count(); ++k) {
      const Matrix truth = functions.at(k, x, 0.2);
      EXPECT_LT((functions.value(k) - truth).cwiseAbs().maxCoeff(), 1e-13 * (1 + truth.norm()))
          << k;
    }
  }
  // An exponential, a sine, a cosine and another exponential, not a matrix.
  EXPECT_LT(TapeOf({"expm(A*x(1))"}).operations(), 25U);
}

TEST(Tape, TheDerivativeOfANormAtZeroHasNoValue) {
  const TapeOf texts({"jacobian(norm(x), x)", "jacobian(sqrt(x(1)), x)"});
  StackedFunctions functions = texts.functions();
  EXPECT_TRUE(functions.run(point(1, 0, 0)));
  EXPECT_FALSE(functions.run(point(0, 0, 0)));
}

/// At two points, the first of them twice, and two times.
void expect_values_of_real(const TapeOf& texts, double within) {
  StackedFunctions functions = texts.functions();
  for (const Vector& x : {point(1, -0.2, 3), point(-2, 4, 0.5), point(1, -0.2, 3)})
    for (const double t : {0.4, -1.0}) {
      ASSERT_TRUE(functions.run(x, t));
      for (std::size_t k = 0; k < functions.count(); ++k) {
        const Matrix truth = functions.at(k, x, t);
        EXPECT_LT((functions.value(k) - truth).cwiseAbs().maxCoeff(), within * (1 + truth.norm()))
            << k;
      }
    }
}

TEST(Tape, AFlowMapIsThatOfReal) {
  const TapeOf texts({"flow_map([x(2); -sin(x(1)); 0.1*x(1)], x, 0.8)",
                      "flow_map([x(2); -9.8 - abs(x(2))*x(2); t], x, -x(3)/10)",
                      "flow_map([sign(x(2)); 0.3 - x(2); max(x(1), t)], x, 2)",
                      "flow_map(A*x, x, 0)", "flow_map(ones(3, 1), x, t)"});
  expect_values_of_real(texts, 1e-11);
}

/// By the state, by what is constant along the flow, by its length and by the time; also across
/// jumps whose instant does not change.
TEST(Tape, TheDerivativeOfAFlowMapIsThatOfReal) {
  const TapeOf texts(
      {"jacobian(flow_map([x(2); -sin(x(1)); 0.1*x(1)], x, 0.8), x)",
       "jacobian(flow_map([x(2); -9.8 - abs(x(2))*x(2); t], x, -x(3)/10), x)",
       "jacobian(flow_map([x(2)^2; -sin(x(1)); t*x(3)], x, t)(1:2), t)",
       "jacobian(flow_map([x(2)*x(3); -sin(x(1)); sign(x(3) - 20) + sign(t)], x, 2), x)",
       "jacobian(flow_map(x(1)*sin(x(2)*t), t, x(3)), x)"});
  expect_values_of_real(texts, 1e-9);
}

TEST(Tape, AFlowMapHasNoDerivativeAcrossAJumpThatMoves) {
  const TapeOf texts({"jacobian(flow_map([1; sign(x(1)); 0], x, 2), x)"});
  StackedFunctions functions = texts.functions();
  EXPECT_TRUE(functions.run(point(1, 0, 0)));
  EXPECT_FALSE(functions.run(point(-1, 0, 0)));
  EXPECT_THROW(functions.at(0, point(-1, 0, 0)), expr::EvaluationError);
}

/// Of an integration, of its derivative, and with what stands still along the flow.
TEST(Tape, AFlowMapAlongAnAffineRateIsAnExponential) {
  const TapeOf texts({"flow_map(A*x, x, 0.7)", "flow_map([x(2); -9.8 - 0.1*x(2); 0], x, x(3)/4)",
                      "jacobian(flow_map([x(2); -9.8 - 0.1*x(2); 1], x, -t), x)",
                      "flow_map(x(3)*t + x(1), t, 0.3)", "flow_map(ones(3, 1), x, t)"});
  StackedFunctions functions = texts.functions();
  for (const Vector& x : {point(1, -0.2, 3), point(-2, 4, 0.5)})
    for (const double t : {0.4, -1.0}) {
      ASSERT_TRUE(functions.run(x, t));
      for (std::size_t k = 0; k < functions.count(); ++k) {
        const Matrix truth = functions.at(k, x, t);
        EXPECT_LT((functions.value(k) - truth).cwiseAbs().maxCoeff(), 1e-12 * (1 + truth.norm()))
            << k;
      }
    }
  const auto is_block = [](const std::string& text) { return TapeOf({text}).operations() < 2; };
  EXPECT_FALSE(is_block("flow_map([x(2); -9.8 - 0.1*x(2); 0], x, x(3)/4)"));
  EXPECT_TRUE(is_block("flow_map([x(2); -sin(x(1)); 0.1*x(1)], x, 0.8)"));
}

TEST(Tape, AFlowMapThatEscapesNamesItsPlace) {
  const TapeOf texts({"flow_map([x(1)^2; 0; 0], x, 3)"});
  StackedFunctions functions = texts.functions();
  EXPECT_TRUE(functions.run(point(0.3, 0, 0)));
  EXPECT_FALSE(functions.run(point(1, 0, 0)));
  EXPECT_THROW(functions.at(0, point(1, 0, 0)), expr::EvaluationError);
}

TEST(Tape, WhereSomethingHasNoValueItsPlaceIsNamed) {
  const TapeOf texts({"x(1)", "log(x(2))", "1/x(3)"});
  StackedFunctions functions = texts.functions();
  EXPECT_FALSE(functions.run(point(1, -1, 1)));
  EXPECT_EQ(functions.at(0, point(1, -1, 1))(0), 1);
  EXPECT_THROW(functions.at(1, point(1, -1, 1)), expr::EvaluationError);
  EXPECT_FALSE(functions.run(point(1, 1, 0)));
  EXPECT_TRUE(functions.run(point(1, 1, 1)));
}

TEST(Tape, AZeroHidesNoFault) {
  const TapeOf texts({"0*log(x(1)) + 0*inv([x(2), 1; 1, x(2)])(1, 1)"});
  StackedFunctions functions = texts.functions();
  EXPECT_TRUE(functions.run(point(1, 2, 0)));
  EXPECT_FALSE(functions.run(point(-1, 2, 0)));
  EXPECT_FALSE(functions.run(point(1, 1, 0)));
}

TEST(Tape, TheInverseOfASmallMatrixIsThatOfReal) {
  const TapeOf texts({"inv([x(1), 1, 0; 1e6, x(2), 1; 0, 1, 1e-6*x(3)])"});
  StackedFunctions functions = texts.functions();
  for (const Vector& x : {point(2, 3, 5), point(0, 1, -2), point(-1e3, 7, 1e4)}) {
    ASSERT_TRUE(functions.run(x));
    const Matrix value = functions.value(0);
    const Matrix expected = functions.at(0, x);
    EXPECT_LE((value - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.cwiseAbs().maxCoeff());
  }
}

/// The rate of a text over x as x moves by dx, and its central difference.
std::pair<Matrix, Matrix> rates(const std::string& text, const Vector& x, const Vector& dx) {
  expr::Scope scope;
  scope.symbols["x"] = {{3, 1}, false};
  const expr::Program program = expr::compile(expr::parse({text, "test"}), scope);
  ScalarGraph graph;
  TracedMatrix moving{{3, 1}, {graph.input(0), graph.input(1), graph.input(2)}};
  moving.slopes = {{graph.input(3), graph.input(4), graph.input(5)}};
  const TracedMatrix traced = trace(
      program, [&](const expr::Input&) { return moving; }, graph);
  Tape tape(graph, {traced.value, traced.slopes[0]}, 6);
  const auto result = [&](const Vector& at, std::size_t which) {
    std::copy_n(at.data(), 3, tape.inputs());
    std::copy_n(dx.data(), 3, tape.inputs() + 3);
    EXPECT_TRUE(tape.run());
    Matrix value(traced.shape.rows, traced.shape.cols);
    tape.copy(which, value.data());
    return value;
  };
  const double h = 1e-6;
  const Matrix difference = (result(x + h * dx, 0) - result(x - h * dx, 0)) / (2 * h);
  return {result(x, 1), difference};
}

TEST(Tape, OperationsOnMatricesHaveRates) {
  const std::string wide = "[x(1), x(2), 1; x(2), x(3)^2, x(1)]";
  const std::string large = "kron([x(1), x(2); x(2), x(3)], eye(5) + x(1)*ones(5, 5))";
  const std::string texts[] = {"svd(" + wide + ")",
                               "svd(" + wide + "')",
                               "norm(" + wide + ")",
                               "pinv(" + wide + ")",
                               "det([x(1), 2; x(2), x(3)])",
                               "lambda_min([x(1), x(2); x(2), x(3)])",
                               "lambda_max([x(1), x(2), 0; x(2), x(3), 1; 0, 1, 4])",
                               "norm(" + large + ")"};
  for (const std::string& text : texts)
    for (const Vector& x : {point(0.3, 2, -1), point(-1.5, 0.25, 2)}) {
      const auto [rate, difference] = rates(text, x, point(0.7, -0.2, 1.1));
      EXPECT_LE((rate - difference).cwiseAbs().maxCoeff(), 1e-7 * (1 + difference.norm())) << text;
    }
}

TEST(Tape, ARateOfEqualSingularValuesIsBetweenThoseOfBothSides) {
  const auto [rate, difference] =
      rates("svd([1 + x(1), 0; 0, 1 - x(1)])", point(0, 0, 0), point(1, 0, 0));
  EXPECT_LE(rate.cwiseAbs().maxCoeff(), 1);
  EXPECT_EQ(rates("norm([x(1), 0; 0, x(2)])", point(0, 0, 0), point(1, 1, 0)).first(0), 0);
}

}  // namespace
}  // namespace gainsmith::numbers
