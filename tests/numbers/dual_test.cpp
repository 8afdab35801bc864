// Derivatives by dual numbers against closed forms, differences and other number types.
#include "numbers/types/dual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "base/eigen_scalars.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/types/enclosure.h"
#include "numbers/types/real.h"

namespace gainsmith::numbers {
namespace {

Matrix random_matrix(std::mt19937& random, int rows, int cols) {
  std::uniform_real_distribution<double> element(-1, 1);
  Matrix result(rows, cols);
  for (double& x : result.reshaped()) x = element(random);
  return result;
}

Values random_values(unsigned seed) {
  std::mt19937 random(seed);
  Values values;
  values["x"] = random_matrix(random, 3, 1);
  values["y"] = random_matrix(random, 3, 1);
  values["w"] = random_matrix(random, 3, 1).cwiseAbs() + Matrix::Constant(3, 1, 0.2);
  values["A"] = random_matrix(random, 3, 3) + 2 * Matrix::Identity(3, 3);
  values["B"] = random_matrix(random, 2, 3);
  values["C"] = random_matrix(random, 4, 2);
  values["s"] = random_matrix(random, 1, 1).cwiseAbs() + Matrix::Constant(1, 1, 0.5);
  return values;
}

expr::Program compiled(const std::string& text, const Values& values) {
  expr::Scope scope;
  for (const auto& [name, value] : values) scope.symbols[name] = {shape_of(value), true};
  scope.known = std::make_shared<KnownDoubles>(values);
  return expr::compile(expr::parse({text, "test"}), scope);
}

Matrix value_of(const std::string& text, const Values& values) {
  return evaluate(compiled(text, values), values);
}

double relative_difference(const Matrix& a, const Matrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return 1e300;
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

TEST(Dual, HasTheDerivativesOfClosedForms) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Values values = random_values(seed);
    for (const auto& [of, derivative] : std::map<std::string, std::string>{
             {"jacobian(A*x - y, x)", "A"},
             {"jacobian(x'*A*x, x)", "x'*(A + A')"},
             {"jacobian(A(2, :)', A)", "kron(eye(3), [0, 1, 0])"},
             {"jacobian(A', A)*jacobian(A', A)", "eye(9)"},
             {"jacobian([x, 2*y]', x)", "kron(eye(3), [1; 0])"},
             {"jacobian(s*A, s)", "[A(:, 1); A(:, 2); A(:, 3)]"},
             {"jacobian(x/s, s)", "-x/s^2"},
             {"jacobian(x.*y, x)", "diag(y)"},
             {"jacobian(x./w, w)", "-diag(x./w.^2)"},
             {"jacobian(2./w, w)", "-diag(2./w.^2)"},
             {"jacobian(x.^3, x)", "3*diag(x.^2)"},
             {"jacobian(A^3, A)", "kron(eye(3), A^2) + kron(A', A) + kron((A^2)', eye(3))"},
             {"jacobian(A^-1, A)", "-kron(inv(A)', inv(A))"},
             {"jacobian(w.^1.5, w)", "1.5*diag(sqrt(w))"},
             {"jacobian(w.^x, x)", "diag(w.^x.*log(w))"},
             {"jacobian(s^s, s)", "s^s*(log(s) + 1)"},
             {"jacobian(expm(s*A)*y, s)", "A*expm(s*A)*y"},
             {"jacobian(exp(x) + log(w).*sin(x) + cos(x), x)",
              "diag(exp(x) + log(w).*cos(x) - sin(x))"},
             {"jacobian(tanh(x), x)", "diag(1 - tanh(x).^2)"},
             {"jacobian(sqrt(w), w)", "diag(0.5./sqrt(w))"},
             {"jacobian(abs(x), x)", "diag(sign(x))"},
             {"jacobian(floor(5*x) + sign(x), x)", "zeros(3)"},
             {"jacobian(mod(5*x, s), s)", "-floor(5*x/s)"},
             {"jacobian(atan2(x, w), x)", "diag(w./(x.^2 + w.^2))"},
             {"jacobian(atan2(w, x), x)", "-diag(w./(x.^2 + w.^2))"},
             {"jacobian(max(x, y), x)", "diag(where(x > y, ones(3, 1), 0))"},
             {"jacobian(min(x), x)", "where(x' > min(x)*ones(1, 3), zeros(1, 3), 1)"},
             {"jacobian(where(x > 0, x.^2, y), x)", "diag(where(x > 0, 2*x, 0))"},
             {"jacobian(trace(A*A), A)", "2*[A(1, :), A(2, :), A(3, :)]"},
             {"jacobian(sum(diag(x)*A), x)", "(A*ones(3, 1))'"},
             {"jacobian(norm(x), x)", "x'/norm(x)"},
             {"jacobian(norm(diag(w)), w)", "where(w' < max(w)*ones(1, 3), zeros(1, 3), 1)"},
             {"jacobian(svd(diag([3; 2; 1].*w/max(w) + [9; 4; 0])), w)*w", "zeros(3, 1)"},
             {"jacobian(pinv(B)*B*x, x)", "pinv(B)*B"},
             {"jacobian(B*pinv(B), B)", "zeros(4, 6)"},
             {"jacobian(pinv(C)*C, C)", "zeros(4, 8)"},
             {"jacobian(skew(x)*y, x)", "-skew(y)"},
             {"jacobian(kron(x, [1; 2]), x)", "kron(eye(3), [1; 2])"},
             {"jacobian(complement(C, 2)'*C, C)", "zeros(4, 8)"},
             {"jacobian(He(A)/2*x, x)", "He(A)/2"},
             {"jacobian(clip(x, -2, 2), x)", "eye(3)"},
             {"jacobian(y, x)", "zeros(3)"},
             {"jacobian(x, x)", "eye(3)"}}) {
      EXPECT_LT(relative_difference(value_of(of, values), value_of(derivative, values)), 1e-14)
          << of << ", seed " << seed;
    }
  }
}

TEST(Dual, TakesTheBranchOfTheValueAtATie) {
  const Values values = {{"x", Matrix::Zero(2, 1)}, {"y", Matrix::Zero(2, 1)}};
  for (const auto& [of, derivative] : std::map<std::string, std::string>{
           {"jacobian(abs(x), x)", "eye(2)"},
           {"jacobian(max(x, y), x)", "eye(2)"},
           {"jacobian(max(y, x), x)", "zeros(2)"},
           {"jacobian(min(x, y), x)", "eye(2)"},
           {"jacobian(max(x), x)", "[1, 0]"},
           {"jacobian(where(x >= 0, 2*x, x), x)", "2*eye(2)"},
           {"jacobian(where(x > 0, 2*x, x), x)", "eye(2)"},
           {"jacobian(sat(x, 3), x)", "eye(2)"},
           {"jacobian(where(x > 0, sqrt(x), 0), x)", "zeros(2)"},
           {"jacobian(norm(0*x), x)", "zeros(1, 2)"},
           {"jacobian(sqrt(0*x'*x), x)", "zeros(1, 2)"},
           {"jacobian(lambda_max([x(1), 1; 1, x(2)]), x)", "[0.5, 0.5]"}})
    EXPECT_LT(relative_difference(value_of(of, values), value_of(derivative, values)), 1e-14) << of;
}

TEST(Dual, NamesWhatHasNoDerivative) {
  const Values values = {{"x", Matrix::Zero(2, 1)}, {"A", Matrix::Ones(2, 2)}};
  const auto refused = [&](const std::string& text, const std::string& part) {
    try {
      value_of(text, values);
      ADD_FAILURE() << text << " has a value";
    } catch (const expr::EvaluationError& error) {
      EXPECT_NE(error.message().find(part), std::string::npos) << text << ": " << error.message();
      EXPECT_EQ(to_string(error.place()), "test:1:5") << text;
    }
  };
  refused("0 - jacobian(norm(x), x)", "jacobian: the norm has no derivative at this point");
  refused("0 + jacobian(sqrt(x), x)", "the sqrt has no derivative");
  refused("0 + jacobian(sqrt(x'*x), x)", "the sqrt has no derivative");
  refused("0 + jacobian(hypot(x(1), 0), x)", "the sqrt has no derivative");
  refused("0 + jacobian(norm(x.^2), x)", "the norm has no derivative");
  refused("0 + jacobian(x.^0.25, x)", "the power has no derivative");
  refused("0 + jacobian(atan2(x, x), x)", "the atan2 has no derivative");
  refused("0 + jacobian(pinv(A), A)", "the pinv has no derivative");
  refused("0 + jacobian(svd(eye(2) + diag(x)), x)", "the svd has no derivative");
  refused("0 + jacobian(orth(A), A)", "the orth has no derivative");
  refused("0 + jacobian(null(A), A)", "the null has no derivative");
  refused("0 + jacobian(1./x, x)", "division by zero");
}

/// Random columns of three elements, made of what has a derivative nearly everywhere.
class Sampler {
 public:
  explicit Sampler(unsigned seed) : random_(seed) {}

  std::string make(int depth) {
    if (depth == 0) return pick({"x", "x", "y", "A*x", "w"});
    const std::string e = make(depth - 1);
    switch (std::uniform_int_distribution<int>(0, 22)(random_)) {
      case 0:
        return "(" + e + " + " + make(depth - 1) + ")";
      case 1:
        return "(" + e + " - 0.7*" + make(depth - 1) + ")";
      case 2:
        return "(" + e + ").*(" + make(depth - 1) + ")";
      case 3:
        return "(" + e + ")./(2 + (" + make(depth - 1) + ").^2)";
      case 4:
        return "A*(" + e + ")";
      case 5:
        return pick({"sin", "cos", "tanh"}) + "(" + e + ")";
      case 6:
        return "exp(tanh(" + e + "))";
      case 7:
        return "log(1 + (" + e + ").^2)";
      case 8:
        return "(1 + (" + e + ").^2).^" + pick({"0.5", "-1.3", "-2", "s"});
      case 9:
        return "sqrt(1 + (" + e + ").^2)";
      case 10:
        return "atan2(" + e + ", 2 + tanh(" + make(depth - 1) + "))";
      case 11:
        return pick({"max", "min"}) + "(" + e + ", " + make(depth - 1) + ")";
      case 12:
        return "where(" + e + " > 0.1, " + make(depth - 1) + ", y)";
      case 13:
        return "norm(" + e + " + [4; 0; 0])*" + make(depth - 1);
      case 14:
        return "sat(" + e + ", 0.5)";
      case 15:
        return "expm(skew(tanh(" + e + ")))*y";
      case 16:
        return "inv(4*I + diag(tanh(" + e + ")))*" + make(depth - 1);
      case 17:
        return "[max(" + e + "); B*(" + make(depth - 1) + ")]";
      case 18:
        return "norm([tanh(" + e + "), y, A])*y";
      case 19:
        return "svd([tanh(" + e + "), y, A])";
      case 20:
        return "pinv([tanh(" + e + "), y + [0; 3; 0]])'*[1; s]";
      case 21:
        return "complement([tanh(" + e + ") + [2; 0; 0], y + [0; 2; 0]], 1)";
      default:
        return "(mod(" + e + ", 3) + abs(y))";
    }
  }

 private:
  std::string pick(std::initializer_list<const char*> list) {
    return *(list.begin() +
             std::uniform_int_distribution<int>(0, static_cast<int>(list.size()) - 1)(random_));
  }
  std::mt19937 random_;
};

TEST(Dual, AgreesWithDifferencesOnRandomPrograms) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const std::string text = Sampler(seed).make(1 + static_cast<int>(seed % 3));
    const Values values = random_values(seed);
    const Matrix found = value_of("jacobian(" + text + ", x)", values);
    ASSERT_EQ(shape_of(found), (expr::Shape{3, 3})) << text;
    const expr::Program program = compiled(text, values);
    Matrix expected(3, 3);
    for (Eigen::Index j = 0; j < 3; ++j) {
      constexpr double kStep = 1e-5;
      const auto at = [&](double step) {
        Values moved = values;
        moved["x"](j) += step;
        return evaluate(program, moved);
      };
      expected.col(j) =
          (8 * (at(kStep) - at(-kStep)) - (at(2 * kStep) - at(-2 * kStep))) / (12 * kStep);
    }
    EXPECT_LT(relative_difference(found, expected), 1e-8) << "seed " << seed << ": " << text;
  }
}

/// Of the derivative in 100 digits at points of the operands' balls.
TEST(Dual, LiesInTheEnclosure) {
  int known = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const std::string text = "jacobian(" + Sampler(seed).make(2) + ", x)";
    const Values values = random_values(seed);
    const expr::Program program = compiled(text, values);
    std::mt19937 random(seed);
    for (const double radius : {0.0, 1e-9, 1e-3}) {
      EnclosedValues<double> enclosed;
      ValuesOf<Decimal100> points;
      for (const auto& [name, value] : values) {
        enclosed[name] = {value, Matrix::Constant(value.rows(), value.cols(), radius)};
        points[name] = value.cast<Decimal100>() +
                       (radius * random_matrix(random, static_cast<int>(value.rows()),
                                               static_cast<int>(value.cols())))
                           .cast<Decimal100>();
      }
      const MatrixOf<Decimal100> truth = evaluate<Decimal100>(program, points);
      const Enclosed<double> found = enclose<double>(program, enclosed);
      if (radius < 1e-3 && found.is_known()) ++known;
      for (Eigen::Index i = 0; i < truth.size(); ++i)
        EXPECT_LE(abs(Decimal100(truth(i) - found.mid(i))), found.rad(i))
            << "seed " << seed << ": " << text;
    }
  }
  EXPECT_GT(known, 60);
}

TEST(Dual, OfConstantsHasNoSlope) {
  DualNumbers<double> numbers;
  const Dual<double> a = constant_dual<double>(Matrix::Ones(2, 2));
  const Dual<double>* operands[] = {&a};
  expr::Instruction inverse{expr::Op::transpose, {0}, {2, 2}, {}, {}, {}, 0};
  Dual<double> out;
  numbers.apply(inverse, operands, out);
  EXPECT_FALSE(out.moves());
  EXPECT_EQ(out.slope.rows(), 4);
}

}  // namespace
}  // namespace gainsmith::numbers
