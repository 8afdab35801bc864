// The suite that every number type passes (the contract is in expr/program/number_type.h).
//
//   INSTANTIATE_TEST_SUITE_P(Mine, Conformance, testing::Values(subject<Mine>("mine", 1e-12,
//   ...)));
//
// What is compared is computed in the number type itself: a residual is one program.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/compile.h"
#include "expr/binding/functions.h"
#include "expr/program/number_type.h"
#include "expr/text/parser.h"
#include "numbers/examples.h"
#include "numbers/types/degree.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {

/// A number type as the suite sees it: programs in, doubles out.
struct Subject {
  std::string name;
  double tolerance = 0;     ///< relative, of what takes a few operations
  double of_jacobians = 0;  ///< the same, where derivatives have fewer digits
  using Moves = std::function<bool(const std::string& input)>;
  /// Whether the type may have no value for a program some of whose inputs move.
  std::function<bool(const expr::Program&, const Moves&)> may_refuse =
      [](const expr::Program&, const Moves&) { return false; };
  /// Operations that the type has no value for, whatever moves.
  std::vector<expr::Op> lacks;
  /// The value of a program whose inputs are `fixed`, or move with this value at every point.
  std::function<Matrix(const expr::Program&, const Values& fixed, const Values& moving)> evaluate;
};

/// For types that are affine in what moves.
inline bool is_not_affine(const expr::Program& program, const Subject::Moves& moves) {
  return std::ranges::max(degrees(program, moves)) == kNotAffine;
}

inline void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.name; }

/// A subject from a number type and the ways from doubles to its values and back.
template <expr::NumberType Type>
Subject subject(std::string name, double tolerance,
                std::function<typename Type::Value(const Matrix&)> constant,
                std::function<typename Type::Value(const Matrix&)> moving,
                std::function<Matrix(const typename Type::Value&)> value, Type type = {}) {
  const auto evaluate = [=](const expr::Program& program, const Values& fixed_values,
                            const Values& moving_values) {
    std::deque<typename Type::Value> inputs;
    expr::Evaluator<Type> evaluator(program, type);
    for (const auto& [input, matrix] : fixed_values)
      evaluator.fix(input, inputs.emplace_back(constant(matrix)));
    for (const auto& [input, matrix] : moving_values)
      evaluator.set(input, inputs.emplace_back(moving(matrix)));
    const Matrix first = value(evaluator.run());
    EXPECT_EQ(value(evaluator.run()), first) << "another run gives other bits";
    EXPECT_EQ(shape_of(first), program.shape());
    return first;
  };
  Subject result;
  result.name = std::move(name);
  result.tolerance = tolerance;
  result.evaluate = evaluate;
  return result;
}

class Conformance : public testing::TestWithParam<Subject> {
 protected:
  using Texts = std::vector<std::pair<std::string, std::string>>;

  static expr::Program compile(const std::string& text, const Values& values) {
    expr::Scope scope;
    for (const auto& [name, matrix] : values) scope.symbols[name] = {shape_of(matrix), true};
    scope.known = std::make_shared<KnownDoubles>(values);
    return expr::compile(expr::parse({text, "test"}), scope);
  }

  static bool has_jacobian(const expr::Program& program) {
    return std::ranges::any_of(program.code,
                               [](const auto& i) { return i.op == expr::Op::jacobian; });
  }
  double tolerance(const expr::Program& program) const {
    return has_jacobian(program) ? std::max(GetParam().tolerance, GetParam().of_jacobians)
                                 : GetParam().tolerance;
  }

  static double largest(const Matrix& matrix) {
    return matrix.size() == 0 ? 0 : matrix.cwiseAbs().maxCoeff();
  }

  /// The example and the value that the table gives it, for all rows.
  static Texts examples() {
    Texts all;
    for (const expr::Operation& row : expr::operations())
      if (!row.example.empty()) all.emplace_back(row.example, row.value);
    for (const expr::Function& row : expr::functions()) all.emplace_back(row.example, row.value);
    for (const expr::Operator& row : expr::operators()) all.emplace_back(row.example, row.value);
    return all;
  }

  /// What holds for all values of the inputs.
  static Texts identities() {
    return {{"(A*B)*D", "A*(B*D)"},
            {"A*(B + I) - B", "A*B + (A - B)"},
            {"-(A - B)", "B - A"},
            {"A/x", "(1/x)*A"},
            {"x*I + A", "A + x*eye(3)"},
            {"x*ones(2, 3)", "[x, x, x; x, x, x]"},
            {"[A, D; C, eye(2)]*[v; x; y]", "[A*v + D*[x; y]; C*v + [x; y]]"},
            {"[A, D](:, 4:5)", "D"},
            {"[A; C](2:4, 1)", "[A(2:3, 1); C(1, 1)]"},
            {"(A*D)'", "D'*A'"},
            {"He(A)", "A + A'"},
            {"trace(A*B)", "trace(B*A)"},
            {"trace(A)", "ones(1, 3)*diag(A)"},
            {"diag(diag(v))", "v"},
            {"blkdiag(A, x)", "[A, 0; 0, x]"},
            {"A^3", "A*A*A"},
            {"A^0", "eye(3)"},
            {"A*inv(A)", "eye(3)"},
            {"A^-2", "inv(A)*inv(A)"},
            {"C*pinv(C)*C", "C"},
            {"pinv(C)", "C'*inv(C*C')"},
            {"expm(A)*expm(-A)", "eye(3)"},
            {"expm(2*A)", "expm(A)^2"},
            {"expm(diag(v))", "diag(exp(v))"},
            {"expm([0, x; -x, 0])", "[cos(x), sin(x); -sin(x), cos(x)]"},
            {"exp(log(w))", "w"},
            {"log(exp(A))", "A"},
            {"diag(sqrt(w))^2", "diag(w)"},
            {"diag(sin(v))^2 + diag(cos(v))^2", "eye(3)"},
            {"diag(exp(v) + exp(-v))*tanh(v)", "exp(v) - exp(-v)"},
            {"x^0.5*x^0.5", "x"},
            {"A.*B", "B.*A"},
            {"(A.*B)./B", "A"},
            {"A.^3", "A.*A.*A"},
            {"w.^-2", "1./(w.*w)"},
            {"w.^0.5", "sqrt(w)"},
            {"w.^v", "exp(v.*log(w))"},
            {"v - x", "v - x*ones(3, 1)"},
            {"floor(v - floor(v) + [5; -2; 3])", "[5; -2; 3]"},
            {"v + 0.3", "mod(v + 0.3, 9) - 9*where(v + 0.3 < 0, 1, 0)"},
            {"tan(v)", "sin(v)./cos(v)"},
            {"asin(sin(v))", "v"},
            {"acos(cos(w))", "w"},
            {"atan(tan(v))", "v"},
            {"cosh(v).^2 - sinh(v).^2", "ones(3, 1)"},
            {"log10(10.^v)", "v"},
            {"ceil(v + 5.2) - 1", "floor(v + 5.2)"},
            {"round(v) + round(-v)", "zeros(3, 1)"},
            {"[cos(atan2(w, v)); sin(atan2(w, v))]", "[v; w]./sqrt([v.^2 + w.^2; v.^2 + w.^2])"},
            {"skew(v)*w", "-skew(w)*v"},
            {"max(v) - min(v)", "max([v - v(1); v - v(2); v - v(3)])"},
            {"norm(sat(v, x))", "min(norm(v), x)"},
            {"complement(D, 1)'*D", "zeros(1, 2)"},
            {"complement(v, 2)'*complement(v, 2)", "eye(2)"},
            {"jacobian(A*v, v)", "A"},
            {"jacobian(sin(v).*w, v)", "diag(cos(v).*w)"},
            {"jacobian(inv(A), A)", "-kron(inv(A)', inv(A))"},
            {"jacobian(norm(v), v)", "v'/norm(v)"},
            {"x^y", "exp(y*log(x))"},
            {"diag(sign(v))*v", "abs(v)"},
            {"max(v, -v)", "abs(v)"},
            {"min(A, B) + max(A, B)", "A + B"},
            {"clip(A, -x, x)", "min(max(A, -x), x)"},
            {"where(A > B, A, B)", "max(A, B)"},
            {"where(A < B, A, B)", "min(A, B)"},
            {"norm(v)", "(v'*v)^0.5"},
            {"norm(C)", "svd(C)(1)"},
            {"cond(A)", "norm(A)*norm(inv(A))"},
            {"det(A*B)", "det(A)*det(B)"},
            {"det([A, D; C, eye(2)])", "det(A - D*C)"},
            {"jacobian(det(A), A)", "det(A)*[inv(A)(1, :), inv(A)(2, :), inv(A)(3, :)]"},
            {"A*lyap(A, B) + lyap(A, B)*A'", "-B"},
            {"A*dlyap(A, B)*A' + B", "dlyap(A, B)"},
            {"c2d(A, D, x)(:, 1:3)", "expm(x*A)"},
            {"A*c2d(A, D, x)(:, 4:end)", "(expm(x*A) - I)*D"},
            {"ctrb(A, D)", "obsv(A', D')'"},
            {"interp1([-1; 0; 1], [0; x; y], v)",
             "(1 + v).*where(v < 0, x, 0) + where(v < 0, 0, x + (y - x)*v)"},
            {"svd(A)'*svd(A)", "trace(A'*A)"},
            {"orth(D)*orth(D)'*D", "D"},
            {"orth(D)'*orth(D)", "eye(2)"},
            {"C*null(C)", "zeros(2, 1)"},
            {"null(C)'*null(C)", "eye(1)"},
            {"M'*backward_gramian(A, C, B, C, [0.1, 0.2])*M", "gramian(A, C, B, C, [0.1, 0.2])"}};
  }

  static Values random_inputs(unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> element(-1, 1);
    const auto random = [&](int rows, int cols) {
      Matrix matrix(rows, cols);
      for (double& x : matrix.reshaped()) x = element(generator);
      return matrix;
    };
    Values values;
    for (const char* name : {"A", "B"}) values[name] = random(3, 3) + 2 * Matrix::Identity(3, 3);
    values["C"] = random(2, 3);
    values["D"] = random(3, 2);
    values["v"] = random(3, 1);
    values["w"] = random(3, 1).cwiseAbs() + Matrix::Constant(3, 1, 0.1);
    values["x"] = random(1, 1).cwiseAbs() + Matrix::Constant(1, 1, 0.1);
    values["y"] = random(1, 1);
    return values;
  }

  /// In the text of an identity M stands for the flow over the window of the Gramians.
  static std::string written_out(const std::string& text) {
    const std::string flow = "(expm(0.2*A)*B*expm(0.1*A))";
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i)
      result += text[i] == 'M' ? flow : std::string(1, text[i]);
    return result;
  }

  static std::string residual(const std::string& left, const std::string& right) {
    return "(" + written_out(left) + ") - (" + written_out(right) + ")";
  }

  /// The program with its decimals as inputs, and their values.
  static std::pair<expr::Program, Values> with_inputs(expr::Program program) {
    Values values;
    for (const auto& [name, value] : example_inputs())
      if (program.uses(name)) values[name] = value;
    for (expr::Instruction& instruction : program.code) {
      if (instruction.op != expr::Op::constant) continue;
      Matrix value;
      RealAlgebra{}.apply(instruction, {}, value);
      const std::string name = "number " + instruction.text;
      values[name] = value;
      instruction.op = expr::Op::input;
      instruction.attributes[0] = static_cast<int>(program.inputs.size());
      program.inputs.push_back({name, {}});
    }
    return {std::move(program), std::move(values)};
  }

  /// The residual is small when the inputs for which `moves` holds move and the others do not; or
  /// it is refused, where it may be.
  void expect_small(const expr::Program& program, const Values& values, double tolerance,
                    const Subject::Moves& moves) const {
    Values fixed;
    Values moving;
    for (const auto& [name, matrix] : values) (moves(name) ? moving : fixed)[name] = matrix;
    try {
      EXPECT_LE(largest(GetParam().evaluate(program, fixed, moving)), tolerance);
    } catch (const expr::EvaluationError& error) {
      EXPECT_TRUE(GetParam().may_refuse(program, moves)) << error.what();
    }
  }

  /// Whether a program holds an operation that the type lacks, which then names it.
  bool is_lacking(const expr::Program& program) const {
    for (const expr::Instruction& instruction : program.code)
      if (std::ranges::count(GetParam().lacks, instruction.op) > 0) {
        try {
          GetParam().evaluate(program, example_inputs(), {});
          ADD_FAILURE() << "has a value";
        } catch (const expr::EvaluationError& error) {
          EXPECT_EQ(error.message().find("the " + to_string(instruction.op) + " has no"), 0U)
              << error.message();
        }
        return true;
      }
    return false;
  }

  /// As above with no input moving, with each alone and with all.
  void expect_small_however(const expr::Program& program, const Values& values,
                            double tolerance) const {
    expect_small(program, values, tolerance, [](const std::string&) { return false; });
    for (const auto& [moved, matrix] : values)
      expect_small(program, values, tolerance,
                   [&, name = moved](const std::string& input) { return input == name; });
    expect_small(program, values, tolerance, [](const std::string&) { return true; });
  }
};

TEST_P(Conformance, EveryExampleOfTheTableHasItsValue) {
  for (const auto& [example, value] : examples()) {
    SCOPED_TRACE(example);
    const Values inputs = example_inputs();
    const expr::Program program = compile(residual(example, value), inputs);
    if (is_lacking(program)) continue;
    const double scale = 1 + largest(evaluate(compile(example, inputs), inputs));
    EXPECT_LE(largest(GetParam().evaluate(program, inputs, {})), scale * tolerance(program));
  }
}

TEST_P(Conformance, EveryOperationStandsInItsExample) {
  for (const expr::Operation& row : expr::operations()) {
    if (row.example.empty()) continue;
    const expr::Program program = compile(std::string(row.example), example_inputs());
    EXPECT_TRUE(std::ranges::any_of(program.code, [&](const auto& i) { return i.op == row.op; }))
        << row.identifier;
  }
}

TEST_P(Conformance, ExamplesHoldForMovingNumbers) {
  for (const auto& [example, value] : examples()) {
    SCOPED_TRACE(example);
    const expr::Program written = compile(residual(example, value), example_inputs());
    if (is_lacking(written)) continue;
    const auto [program, values] = with_inputs(written);
    // Decimals as doubles.
    expect_small_however(program, values, std::max(1e-12, 20 * GetParam().tolerance));
  }
}

TEST_P(Conformance, IdentitiesHold) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Values values = random_inputs(seed);
    for (const auto& [left, right] : identities()) {
      SCOPED_TRACE(left + " = " + right);
      const expr::Program whole = compile(written_out(left), values);
      const expr::Program program = compile(residual(left, right), values);
      Values used;
      for (const auto& [name, matrix] : values)
        if (program.uses(name)) used[name] = matrix;
      const double scale = 1 + largest(evaluate(whole, values));
      expect_small_however(program, used, 20 * scale * tolerance(program));
    }
  }
}

TEST_P(Conformance, AgreesWithDouble) {
  const Values values = random_inputs(4);
  for (const auto& [left, right] : identities()) {
    const expr::Program program = compile(written_out(left), values);
    const Matrix expected = evaluate(program, values);
    const Matrix found = GetParam().evaluate(program, values, {});
    EXPECT_LE(largest(found - expected), 1e-11 * (1 + largest(expected))) << left;
  }
}

TEST_P(Conformance, FaultsAreTheSameAtTheSamePlace) {
  const Values values = {{"A", Matrix::Identity(2, 2)},
                         {"S", Matrix::Ones(2, 2)},
                         {"delta", Matrix::Constant(1, 1, 0.1)},
                         {"zero", Matrix::Zero(1, 1)}};
  struct Case {
    const char* text;
    int column;
    const char* message;
  };
  for (const Case& c : {
           Case{"1 + 1/zero", 5, "division by zero"},
           {"A + inv(S)", 5, "inv: the matrix is singular to working precision"},
           {"A + S^-1", 5, "inv: the matrix is singular to working precision"},
           {"inv(diag([2, zero]))", 1, "inv: the matrix is singular to working precision"},
           {"2*asin(1 + delta)", 3, "asin of a number outside of [-1, 1]"},
           {"log10(-delta)", 1, "log10 of a number that is not positive"},
           {"lyap(diag([1, -1]), A)", 1,
            "lyap: two eigenvalues of A have the sum 0, as A*X + X*A' is singular to working "
            "precision"},
           {"1 + log(-delta)", 5, "log of -0.1"},
           {"log(zero)", 1, "log of 0"},
           {"2*sqrt(-delta)", 3, "sqrt of -0.1"},
           {"(-delta)^0.5", 1, "the power is not a finite number"},
           {"2*[-1; 2].^0.5", 3, "the power is not a finite number"},
           {"zero./[1; 0]", 1, "division by zero"},
           {"1 + mod(delta, zero)", 5, "division by zero"},
           {"2*exp(exp(exp(4)))", 3, "the exp is not a finite number"},
           {"1 + 1e400", 5, "the number 1e400 is beyond the range of double"},
           {"backward_gramian(A, A, S, A, [1, 1])", 1,
            "backward_gramian: the jump matrix J, which must be invertible, is singular to working "
            "precision"},
       }) {
    try {
      GetParam().evaluate(compile(c.text, values), values, {});
      ADD_FAILURE() << c.text << " has a value";
    } catch (const expr::EvaluationError& error) {
      EXPECT_EQ(error.message(), c.message) << c.text;
      EXPECT_EQ(to_string(error.place()), "test:1:" + std::to_string(c.column)) << c.text;
    }
  }
}

TEST_P(Conformance, EmptyMatricesAreValues) {
  for (const auto& [text, value] : Texts{{"norm(zeros(0, 3))", "0"},
                                         {"trace(zeros(0))", "0"},
                                         {"zeros(2, 0)*zeros(0, 3)", "zeros(2, 3)"},
                                         {"[eye(2), zeros(2, 0)]", "eye(2)"},
                                         {"inv(zeros(0))", "zeros(0)"},
                                         {"expm(zeros(0))", "zeros(0)"},
                                         {"pinv(zeros(0, 3))", "zeros(3, 0)"},
                                         {"svd(zeros(0, 3))", "zeros(0, 1)"},
                                         {"orth(zeros(2, 0))", "zeros(2, 0)"},
                                         {"null(zeros(0, 2))", "eye(2)"},
                                         {"diag(zeros(0, 1))", "zeros(0)"},
                                         {"zeros(0, 2).*zeros(0, 2)", "zeros(0, 2)"},
                                         {"2./zeros(2, 0).^2", "zeros(2, 0)"},
                                         {"complement(zeros(2, 0), 2)", "eye(2)"},
                                         {"max(zeros(0, 2), 1)", "log(zeros(0, 2))"}}) {
    const Matrix found = GetParam().evaluate(compile(residual(text, value), {}), {}, {});
    EXPECT_EQ(largest(found), 0) << text;
  }
}

}  // namespace gainsmith::numbers
