#include "numbers/types/degree.h"

#include <gtest/gtest.h>

#include <string>

#include "expr/binding/compile.h"
#include "expr/binding/functions.h"
#include "expr/text/parser.h"
#include "numbers/examples.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {
namespace {

/// x (2 x 1), X (2 x 2) and s move; A (2 x 2) and t do not.
expr::Scope scope() {
  expr::Scope result;
  for (const char* name : {"x", "X", "s", "A", "t"})
    result.symbols[name] = {name == std::string("x")                            ? expr::Shape{2, 1}
                            : std::string("XA").find(name) != std::string::npos ? expr::Shape{2, 2}
                                                                                : expr::Shape{}};
  result.functions["F"] = {2, 2};
  return result;
}

bool moves(const std::string& name) { return name == "x" || name == "X" || name == "s"; }

Degree degree(const std::string& text) {
  return degrees(expr::compile(expr::parse({text, "test"}), scope()), moves).back();
}

TEST(Degree, OfEachKindOfText) {
  for (const char* text : {"A", "t^2*A", "inv(A)*expm(A)", "where(t > 0, A, 2)", "A.^2",
                           "jacobian(A*x + t*x, x)", "norm(A)", "F(t)"})
    EXPECT_EQ(degree(text), 0) << text;
  for (const char* text : {"x",
                           "A*x + t*x",
                           "s*A",
                           "x/t",
                           "-X'",
                           "He(X)",
                           "[X, x; x', s]",
                           "X(1, :)",
                           "trace(X)",
                           "diag(x)",
                           "diag(X)",
                           "s*I + X",
                           "s*ones(2, 2)",
                           "A.*X",
                           "X./A",
                           "X - s*I",
                           "X^1",
                           "where(t > 0, x, 2*x)",
                           "F(t)*x",
                           "inv(A)*x"})
    EXPECT_EQ(degree(text), 1) << text;
  for (const char* text : {"X*x",
                           "s*x",
                           "x'*x",
                           "t/s",
                           "X^2",
                           "inv(X)",
                           "exp(s)",
                           "abs(x)",
                           "max(s, 1)",
                           "norm(x)",
                           "where(s > 0, x, 2*x)",
                           "expm(X)",
                           "F(s)",
                           "s^t",
                           "X.*X",
                           "A./X",
                           "X.^2",
                           "floor(s)",
                           "jacobian(X*x, x)",
                           "x*x' - x*x'"})
    EXPECT_EQ(degree(text), kNotAffine) << text;
}

TEST(Degree, WhatIsCalledAffineHasNoSecondDifference) {
  int affine = 0;
  const auto try_example = [&](const std::string& text) {
    expr::Scope known;
    known.known = std::make_shared<KnownDoubles>(example_inputs());
    known.symbols["x"] = {{2, 1}, true};
    expr::Program program = expr::compile(expr::parse({text, "test"}), known);
    for (std::size_t at = 0; at < program.code.size(); ++at) {
      if (program.code[at].op != expr::Op::constant) continue;
      expr::Program moved = program;
      Matrix start;
      RealAlgebra{}.apply(moved.code[at], {}, start);
      moved.code[at].op = expr::Op::input;
      moved.code[at].attributes[0] = static_cast<int>(moved.inputs.size());
      moved.inputs.push_back({"m", {}});
      const auto all = degrees(moved, [](const std::string& name) { return name == "m"; });
      if (all[static_cast<std::size_t>(moved.result)] == kNotAffine) continue;
      ++affine;
      const auto at_step = [&](double step) {
        Values values = example_inputs();
        values["m"] = start + Matrix::Constant(1, 1, step);
        return evaluate(moved, values);
      };
      const Matrix bend = at_step(2) - 2 * at_step(1) + at_step(0);
      EXPECT_LT(bend.norm(), 1e-12) << text << ", number " << at;
    }
  };
  for (const expr::Operation& row : expr::operations())
    if (!row.example.empty()) try_example(std::string(row.example));
  EXPECT_GT(affine, 20);
}

}  // namespace
}  // namespace gainsmith::numbers
