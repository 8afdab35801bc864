// Norms, moduli, eigenvalues and their quotients as objectives and in requirements.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>

#include "design/semidefinite_program.h"
#include "design/solve.h"
#include "numbers/dense/dense.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"
#include "support/stop.h"

namespace gainsmith::design {
namespace {

using numbers::Matrix;
using tests::input_error;

Matrix random_matrix(RandomStream& random, int rows, int cols) {
  return Matrix::NullaryExpr(rows, cols,
                             [&] { return std::round(128 * random.uniform() - 64) / 64; });
}

double norm(const Matrix& matrix) { return tests::singular_values(matrix)(0); }

/// Parrott: with the best corner the norm is that of the known rows or columns.
TEST(ConvexFunctions, TheLeastNormOfACompletion) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(0xC0, seed);
    const Matrix M = random_matrix(random, 4, 5);
    const model::Gains gains = solve(
        "  data: {M: 4 x 5}\n  unknowns: {X: 2 x 2}\n"
        "  require: {finite: norm(X) <= 100}\n"
        "  minimize: \"norm([M(1:2, 1:3), M(1:2, 4:5); M(3:4, 1:3), X])\"\n",
        "data: {M: " + tests::matrix_yaml(M) + "}\n");
    const double least = std::max(norm(M.topRows(2)), norm(M.leftCols(3)));
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << seed;
    EXPECT_NEAR(*gains.objective, least, 1e-6 * least) << seed;
    EXPECT_LE(*gains.objective_lower_bound, *gains.objective) << seed;
  }
}

/// The best point in the sense of moduli is the median, in that of the largest modulus the middle.
TEST(ConvexFunctions, SumsAndLargestOfModuli) {
  const std::string head =
      "  data: {v: n}\n  unknowns: {x: scalar}\n  require: {any: abs(x) <= 9}\n";
  const std::string data = "data: {v: [1, 2, 7, -4, 3]}\n";
  const model::Gains median = solve(head + "  minimize: sum(abs(v - x*ones(n, 1)))\n", data);
  EXPECT_NEAR(*median.objective, 1 + 0 + 5 + 6 + 1, 1e-6);
  EXPECT_NEAR((*median.find("x"))(0, 0), 2, 1e-5);
  const model::Gains middle = solve(
      head + "  minimize: \"max(x - v(1), x - v(4), v(3) - x, v(5) - x) - min(x, 5)/2\"\n", data);
  EXPECT_NEAR(*middle.objective, 5.5 - 0.75, 1e-6) << "at 1.5";
  // One vector has one largest element, also where an unknown bounds it.
  for (const char* text :
       {"max([x - v; v - x])", "-min([x - v; v - x])/2 + max([x - v; v - x])/2"}) {
    const model::Gains alike = solve(head + "  minimize: \"" + text + "\"\n", data);
    EXPECT_NEAR(*alike.objective, 5.5, 1e-6) << text;
    EXPECT_NEAR((*alike.find("x"))(0, 0), 1.5, 1e-5) << text;
  }
}

/// The derivative of a text at a datum is data, enclosed like the rest; elements of unknowns are
/// affine in them.
TEST(ConvexFunctions, DerivativesAndElementsInRequirements) {
  const model::Gains gains = solve(
      "  data: {x0: 2}\n  unknowns: {P: symmetric 2, g: scalar}\n"
      "  let: {f(x): \"[x(2); -9.81*sin(x(1)) - 0.1*x(2)]\"}\n"
      "  require: {flow: \"He(P*jacobian(f(x0), x0)) < -eye(2)\", floor: P > 0.1*I, "
      "weighted: \"[1, 2; 2, 1].*P < g*I\"}\n  minimize: g\n  gains: {K: P}\n",
      "data: {x0: [0.1, 0]}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  const Matrix A{{0, 1}, {-9.81 * std::cos(0.1), -0.1}};
  const Matrix& P = *gains.find("K");
  EXPECT_LT(numbers::symmetric_eigenvalues(P * A + A.transpose() * P + Matrix::Identity(2, 2))(1),
            0);
  const Matrix weighted = Matrix{{1, 2}, {2, 1}}.cwiseProduct(P);
  EXPECT_NEAR(*gains.objective, numbers::symmetric_eigenvalues(weighted)(1), 1e-5);
}

/// What stands in a sum over an index is bounded term by term.
TEST(ConvexFunctions, SumsOverIndices) {
  const model::Gains gains = solve(
      "  unknowns: {x: scalar, P: {shape: symmetric 2, for: i in 1..2}}\n"
      "  require: {c: x <= 100, d: {forall: i in 1..2, that: \"P(i)(1, 2) == i\"}}\n"
      "  minimize: \"sum(i in 1..3, abs(x - i^2)) + sum(i in 1..2, j in 1..2, i < j, "
      "norm(P(i)) + 2*norm(P(j)))\"\n");
  EXPECT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(*gains.objective, 8 + 1 + 2 * 2, 1e-5);
}

TEST(ConvexFunctions, NumbersAreComparedWithEachElement) {
  const model::Gains gains = solve(
      "  unknowns: {x: 3}\n  require: {a: \"max(x, 0, [-1; 2; 1]) <= 3\", b: sum(x) >= -4}\n"
      "  minimize: \"sum(max(x, 0)) + 2*max(x(1), -1)\"\n");
  EXPECT_NEAR(*gains.objective, 0 - 2, 1e-6);
}

/// An objective with functions of its own needs no other inequality.
/// The point of a box that is nearest to one outside of it, in each norm.
TEST(ConvexFunctions, ElementsOfColumnsAndRowsAreCompared) {
  for (const char* text :
       {"0 <= x <= 1", "zeros(1, n) <= x' <= ones(1, n)", "zeros(n, 1) <= x <= ones(n, 1)"}) {
    const model::Gains gains =
        solve(std::string("  data: {b: n}\n  unknowns: {x: n}\n  require: {box: \"") + text +
                  "\"}\n  minimize: norm(x - b)\n",
              "data: {b: [2, 0.5, -1]}\n");
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << text;
    EXPECT_NEAR(*gains.objective, std::sqrt(2.0), 1e-6) << text;
  }
}

/// Halfway between two points; and sums of largest moduli.
TEST(ConvexFunctions, LargestValuesOfOthers) {
  const std::string head =
      "  data: {a: n, b: n}\n  unknowns: {x: n}\n  require: {near: norm(x) <= 99}\n";
  const std::string data = "data: {a: [1, 2], b: [4, 6]}\n";
  EXPECT_NEAR(*solve(head + "  minimize: \"max(norm(x - a), norm(x - b))\"\n", data).objective, 2.5,
              1e-6);
  EXPECT_NEAR(*solve(head + "  minimize: \"max(abs(x - a)) + max(abs(x - b))\"\n", data).objective,
              4, 1e-6);
  const model::Gains gains = solve(
      "  data: {a: n, b: n}\n  unknowns: {x: n, t: scalar}\n  require: {both: \"max(norm(x - a), "
      "norm(x - b)) <= t\"}\n  minimize: t\n",
      data);
  EXPECT_NEAR(*gains.objective, 2.5, 1e-6);
  EXPECT_NE(input_error([&] { solve(head + "  minimize: \"max(min(x), 0)\"\n", data); })
                .message()
                .find("is concave"),
            std::string::npos);
}

/// Least squares in a box, by their closed forms where no bound is active.
TEST(ConvexFunctions, QuadraticForms) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(0xC1, seed);
    const Matrix A = random_matrix(random, 5, 3);
    const Matrix b = random_matrix(random, 5, 1);
    const Matrix x = A.colPivHouseholderQr().solve(b);
    const double least = (A * x - b).squaredNorm();
    const std::string data =
        "data: {A: " + tests::matrix_yaml(A) + ", b: " + tests::matrix_yaml(b) + "}\n";
    for (const char* text :
         {"(A*x - b)'*(A*x - b)", "norm(A*x - b)^2", "2*(A*x - b)'*0.5*(A*x - b)",
          "sum((A*x - b).^2)", "x'*(A'*A)*x - 2*b'*A*x + b'*b"}) {
      const model::Gains gains = solve(
          std::string("  data: {A: m x n, b: m}\n  unknowns: {x: n}\n  require: {box: -99 <= x <= "
                      "99}\n  minimize: \"") +
              text + "\"\n",
          data);
      ASSERT_EQ(gains.verdict, model::Verdict::yes) << text;
      EXPECT_NEAR(*gains.objective, least, 1e-6 * (1 + b.squaredNorm())) << text;
    }
  }
}

TEST(ConvexFunctions, QuadraticFormsInRequirements) {
  const std::string head = "  data: {Q: symmetric 2}\n  unknowns: {x: 2, t: scalar}\n";
  const std::string singular = "data: {Q: [[1, 2], [2, 4]]}\n";
  // The width of a strip and of a disc; the first is what is left of Q > 0.
  EXPECT_NEAR(
      *solve(head + "  require: {a: x'*Q*x < 9, b: -9 <= x(2) <= 9}\n  minimize: -x(1) - 2*x(2)\n",
             singular)
           .objective,
      -3, 1e-5);
  EXPECT_NEAR(
      *solve(head + "  require: {a: x'*x + t^2 <= 9, b: 3*t >= 6}\n  minimize: -x(1)\n", singular)
           .objective,
      -std::sqrt(5.0), 1e-5);
  EXPECT_NEAR(*solve(head + "  require: {a: \"sum(i in 1..2, (x(i) - i)^2) <= t\", b: x <= 0}\n  "
                            "minimize: t\n",
                     singular)
                   .objective,
              5, 1e-5);
  const auto message = [&](const std::string& text, const std::string& data) {
    return input_error([&] { solve(head + text, data); }).message();
  };
  EXPECT_NE(
      message("  require: {a: norm(x) <= 1}\n  minimize: x'*Q*x\n", "data: {Q: [[1, 2], [2, 1]]}\n")
          .find("is not convex"),
      std::string::npos);
  EXPECT_NE(
      message("  require: {a: norm(x) <= 1}\n  minimize: -1*x'*x\n", singular).find("is convex"),
      std::string::npos);
  EXPECT_NE(message("  require: {a: norm(x) <= 1}\n  minimize: x(1) - x'*x\n", singular)
                .find("is convex: it can only be asked to be small"),
            std::string::npos);
}

/// v*v' in 16 digits is indefinite by rounding: its matrix inequality has no solution, and the
/// requirement has.
TEST(ConvexFunctions, SquaresThatRoundingMakesIndefiniteAreRefused) {
  const std::string text =
      "  data: {Q: 2 x 2}\n  unknowns: {x: 2}\n  require: {c: x'*Q*x <= 1, b: x(1) >= 0.1}\n";
  const std::string message =
      input_error([&] {
        solve(text,
              "data: {Q: [[1.2121384559130066, 0.22338505798737301], [0.22338505798737301, "
              "0.04116764375273918]]}\n");
      }).message();
  EXPECT_NE(message.find("norm(R*e)^2 with Q = R'*R"), std::string::npos) << message;
  EXPECT_EQ(solve(text, "data: {Q: [[0.1, 0.3], [0.3, 0.9]]}\n").verdict, model::Verdict::yes);
  // Only the symmetric part counts.
  EXPECT_EQ(solve(text, "data: {Q: [[1, 5], [-5, 1]]}\n").verdict, model::Verdict::yes);
}

TEST(ConvexFunctions, SquaresAsTheyAreWritten) {
  for (const char* text :
       {"-x'*x >= -4", "4 - x'*x >= 0", "(2*x)'*(2*x) <= 16", "x'*x/2 <= 2", "sum(x.^2) <= 4"}) {
    const model::Gains gains = solve(std::string("  unknowns: {x: 2}\n  require: {c: \"") + text +
                                     "\"}\n  minimize: -3*x(1) - 4*x(2)\n");
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << text;
    EXPECT_NEAR(*gains.objective, -10, 1e-5) << text;
  }
}

/// The constant part is 0 at the ends and in the middle of the interval.
TEST(ConvexFunctions, WhatIsZeroAtSomePointsIsNoZero) {
  const model::Gains gains = solve(
      "  unknowns: {h: scalar}\n  require: {d: {forall: \"s in [0, 3]\", that: \"h >= s*(3 - "
      "s)*(1.5 "
      "- s)\"}}\n  minimize: h\n");
  EXPECT_NEAR(*gains.objective, 1.29903810568, 1e-5);
}

TEST(ConvexFunctions, MayStandAlone) {
  const model::Gains gains =
      solve("  data: {b: n}\n  unknowns: {x: scalar}\n  minimize: norm(b - x*ones(n, 1))\n",
            "data: {b: [1, 3]}\n");
  EXPECT_NEAR(*gains.objective, std::sqrt(2), 1e-6);
}

/// Of a symmetric pencil without further unknowns.
TEST(ConvexFunctions, TheSpreadOfEigenvalues) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(0xC1, seed);
    const int n = 2 + static_cast<int>(seed % 3);
    const Matrix C = random_symmetric(random, n);
    const model::Gains gains = solve(
        "  data: {C: n x n}\n  unknowns: {d: scalar}\n  require: {any: abs(d) <= 1}\n"
        "  minimize: lambda_max(C + d*I) - 2*lambda_min(C + d*I)\n",
        "data: {C: " + tests::matrix_yaml(C) + "}\n");
    const auto values = numbers::SymmetricEigen(C).values();
    // d = 1 is best: max + d - 2 (min + d).
    EXPECT_NEAR(*gains.objective, values.maxCoeff() - 2 * values.minCoeff() - 1, 1e-6) << seed;
  }
}

TEST(ConvexFunctions, AnEigenvalueIsAFunctionOfData) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(0xC2, seed);
    const Matrix C = random_symmetric(random, 4);
    const model::Gains gains = solve(
        "  data: {C: n x n}\n  unknowns: {x: scalar}\n  require: {any: x > 0}\n"
        "  gains: {e: \"[lambda_max(C), lambda_min(C)]\"}\n",
        "data: {C: " + tests::matrix_yaml(C) + "}\n");
    const auto values = numbers::SymmetricEigen(C).values();
    EXPECT_NEAR(gains.gains[0].second(0), values.maxCoeff(), 1e-13);
    EXPECT_NEAR(gains.gains[0].second(1), values.minCoeff(), 1e-13);
  }
}

/// The least norm of D M inv(D) of a matrix without negative elements is its Perron eigenvalue.
TEST(Quotient, ScalingsReachThePerronEigenvalue) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(0xC3, seed);
    const int n = 2 + static_cast<int>(seed % 4);
    const Matrix M = random_matrix(random, n, n).cwiseAbs().array() + 1.0 / 64;
    const model::Gains gains = solve(
        "  data: {M: n x n}\n  unknowns: {P: diagonal n}\n  require: {positive: P > 0}\n"
        "  minimize: lambda_max(M'*P*M, P)\n",
        "data: {M: " + tests::matrix_yaml(M) + "}\n");
    const double perron = tests::eigenvalues(M).cwiseAbs().maxCoeff();
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << seed;
    EXPECT_NEAR(*gains.objective, perron * perron, 1e-6 * perron * perron) << seed;
    ASSERT_TRUE(gains.objective_lower_bound) << seed;
    EXPECT_LE(*gains.objective_lower_bound, perron * perron * (1 + 1e-12)) << seed;
    EXPECT_GE(*gains.objective_lower_bound, perron * perron * (1 - 1e-6)) << seed;
  }
}

/// A Lyapunov matrix shows every decay rate below that of the slowest mode, in all units of time.
TEST(Quotient, TheDecayRateIsThatOfTheSlowestMode) {
  for (const double unit : {1e-3, 1.0, 1e3})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      RandomStream random(0xC4, seed);
      const Matrix A = unit * random_matrix(random, 3, 3);
      const model::Gains gains = solve(
          "  data: {A: n x n}\n  unknowns: {P: symmetric n}\n  require: {positive: P > 0}\n"
          "  minimize: lambda_max(He(P*A), 2*P)\n",
          "data: {A: " + tests::matrix_yaml(A) + "}\n");
      const double slowest = tests::spectral_abscissa(A);
      ASSERT_EQ(gains.verdict, model::Verdict::yes) << seed;
      EXPECT_NEAR(*gains.objective, slowest, 1e-6 * unit) << seed;
      EXPECT_LE(*gains.objective_lower_bound, slowest + 1e-12 * unit) << seed;
    }
}

TEST(Quotient, WithoutASolutionTheInequalitiesSayNo) {
  const model::Gains gains =
      solve("  unknowns: {x: scalar}\n  require: {a: x < -1}\n  minimize: lambda_max(1, x)\n");
  EXPECT_EQ(gains.verdict, model::Verdict::no);
  EXPECT_FALSE(gains.objective);
}

TEST(Quotient, WhatHasNoMinimumIsSaid) {
  const model::Gains gains = solve(
      "  unknowns: {x: scalar, y: scalar}\n  require: {a: x < 1, c: y < 2}\n"
      "  minimize: lambda_max(x, y)\n");
  EXPECT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_FALSE(gains.objective_lower_bound);
  EXPECT_EQ(gains.solver.status, "feasible");
  EXPECT_NE(gains.solver.message.find("a smaller one may be possible"), std::string::npos);
}

/// Whenever it comes, an interrupt makes no verdict and no bound wrong.
TEST(Quotient, MayBeInterrupted) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0}\n  minimize: lambda_max(He(P*A), 2*P)\n"
      "data: {A: [[-1, 4], [0, -2]]}\n");
  int undecided = 0;
  for (int after = 0; after < 400; after += 13) {
    sdp::Options options;
    int calls = 0;
    const tests::StopInTest stop;
    options.progress = [&](const sdp::Progress&) {
      if (++calls > after) request_stop();
    };
    const model::Gains gains = synthesize(yaml.instance, options);
    EXPECT_NE(gains.verdict, model::Verdict::no) << after;
    if (gains.verdict == model::Verdict::undecided) {
      ++undecided;
      EXPECT_FALSE(gains.objective) << after;
      continue;
    }
    EXPECT_GE(*gains.objective, -1) << after;
    if (gains.objective_lower_bound) {
      EXPECT_LE(*gains.objective_lower_bound, -1 + 1e-12) << after;
    }
  }
  EXPECT_GT(undecided, 0);
}

TEST(Quotient, IsNoSemidefiniteProgram) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod: {method: m, unknowns: {x: scalar}, require: {a: x > 1}, minimize: "
      "\"lambda_max(1, x)\"}\n");
  EXPECT_NE(input_error([&] { semidefinite_program(yaml.instance); })
                .message()
                .find("is solved by several semidefinite programs"),
            std::string::npos);
}

TEST(ConvexFunctions, MistakesAreNamed) {
  const std::string head = "  data: {A: 2 x 2}\n  unknowns: {X: 2 x 2, v: 2, s: scalar}\n";
  const std::string data = "data: {A: I}\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"norm(X) >= 1", "'norm(X)' is convex: it can only be asked to be small"},
      {"min(s, 1) <= 0", "'min(s, 1)' is concave: it can only be asked to be large"},
      {"s*norm(X) <= 1", "times a number that is written out, not inside of 's*norm(X)'"},
      {"norm(X)^2 <= 1", "not inside of 'norm(X)^2'"},
      {"norm(norm(X)*A) <= 1", "'norm(X)*A' is inside of another such function"},
      {"abs(X) <= 1", "abs of unknowns is taken of numbers and vectors; found 2 x 2"},
      {"norm(X) <= v", "is compared with a number; found 2 x 1"},
      {"abs(v) <= A(1:1, :)*[1; 1; 1]", "cannot multiply"},
      {"lambda_max(v) <= 1", "lambda_max takes a symmetric matrix; found 2 x 1"},
      {"norm(X) == 1", "'==' takes affine sides"},
      {"norm(X, 1) <= 1", "'norm' is written norm(M); found 2 arguments"},
      {"lambda_max(X, A) <= 1", "lambda_max(M, N) of two matrices is alone in minimize"},
      {"lambda_min(-X, A) >= 1", "'lambda_min' is written lambda_min(M); found 2 arguments"},
      {"max(v, [1, 2, 3]) <= 1", "'v' is 2 x 1, another one 1 x 3"},
      {"norm(X) != 1", "'!=' takes affine sides"},
      {"sum(i in 1..1001, abs(s - i)) <= 1", "eigenvalues has at most 1000 terms"},
      {"0 <= [X, v]", "elements are compared by min(x) >= a"}};
  for (const auto& [text, expected] : cases) {
    const std::string found =
        input_error([&] { solve(head + "  require: {a: \"" + text + "\"}\n", data); }).message();
    EXPECT_NE(found.find(expected), std::string::npos) << text << ": " << found;
  }
  EXPECT_NE(input_error([] { solve("  unknowns: {g: scalar}\n  minimize: g\n"); })
                .message()
                .find("has no inequality under 'require'"),
            std::string::npos);
  const std::string quantified =
      input_error([&] {
        solve(head + "  require: {a: {forall: \"t in [0, 1]\", that: norm(X) + s <= t}}\n", data);
      }).message();
  EXPECT_NE(quantified.find("must be alone on its side"), std::string::npos) << quantified;
}

}  // namespace
}  // namespace gainsmith::design
