#include "expr/program/evaluate.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

/// Doubles, with every operation counted.
struct CountingAlgebra {
  using Value = Matrix;
  std::shared_ptr<int> count = std::make_shared<int>(0);

  void apply(const Instruction& instruction, std::span<const Matrix* const> operands,
             Matrix& out) const {
    ++*count;
    RealAlgebra().apply(instruction, operands, out);
  }
};

class Evaluation : public testing::Test {
 protected:
  Evaluation() {
    std::mt19937 random(1);
    A = random_matrix(random, 3, 3);
    x = random_matrix(random, 3, 1);
    world.set("A", A).set("x", x);
    program = compile(parse({"expm(A)*A*x + A^2*x", "test"}), world.scope);
  }
  World world;
  Matrix A, x;
  Program program;
};

TEST_F(Evaluation, FixedPartsAreComputedOnceAndGiveTheSame) {
  CountingAlgebra algebra;
  Evaluator<CountingAlgebra> evaluator(program, algebra);
  evaluator.fix("A", A);
  evaluator.set("x", x);
  const Matrix first = evaluator.run();
  EXPECT_EQ(first, evaluate(program, world.values));
  const int before = *algebra.count;
  EXPECT_EQ(evaluator.run(), first);
  EXPECT_EQ(*algebra.count - before, 3) << "two products with x and their sum";
}

TEST_F(Evaluation, VaryingInputsTakeTheirNewValue) {
  Evaluator<RealAlgebra> evaluator(program);
  evaluator.fix("A", A);
  evaluator.set("x", x);
  evaluator.run();
  const Matrix other = 2 * x;
  evaluator.set("x", other);
  World changed = world;
  changed.set("x", other);
  EXPECT_EQ(evaluator.run(), evaluate(program, changed.values));
}

TEST_F(Evaluation, AnInputFixedAgainTakesItsNewValue) {
  Evaluator<RealAlgebra> evaluator(program);
  evaluator.fix("A", A);
  evaluator.set("x", x);
  evaluator.run();
  const Matrix other = A + Matrix::Identity(3, 3);
  evaluator.fix("A", other);
  World changed = world;
  changed.set("A", other);
  EXPECT_EQ(evaluator.run(), evaluate(program, changed.values));
}

TEST_F(Evaluation, NamesThatTheProgramDoesNotUseAreIgnored) {
  Evaluator<RealAlgebra> evaluator(program);
  evaluator.fix("unused", A);
  evaluator.set("unused", A);
  evaluator.fix("A", A);
  evaluator.set(static_cast<std::size_t>(program.input("x")), x);
  EXPECT_EQ(evaluator.run(), evaluate(program, world.values));
}

TEST_F(Evaluation, AnInputWithoutAValueIsAFaultOfTheProgram) {
  Evaluator<RealAlgebra> evaluator(program);
  evaluator.set("x", x);
  EXPECT_THROW(evaluator.run(), std::logic_error);
}

TEST_F(Evaluation, AnImpossibleOperationIsAnInputErrorAtItsPlace) {
  const Program inverse = compile(parse({"x' +\n x'*inv(A)", "test"}), world.scope);
  Evaluator<RealAlgebra> evaluator(inverse);
  const Matrix singular = Matrix::Ones(3, 3);
  evaluator.fix("A", singular);
  evaluator.set("x", x);
  EXPECT_EQ(input_error([&] { evaluator.run(); }).place(), (Place{"test", 2, 5}));
  evaluator.fix("A", A);
  EXPECT_EQ(evaluator.run(), evaluate(inverse, world.values)) << "usable after an error";
}

TEST_F(Evaluation, AProgramThatIsAnInputIsItsValue) {
  const Program itself = compile(parse({"x", "test"}), world.scope);
  EXPECT_EQ(evaluate(itself, world.values), x);
}

TEST_F(Evaluation, LargeAndSmallProductsAgree) {
  std::mt19937 random(2);
  for (const int size : {15, 16, 17, 40}) {
    const Matrix a = random_matrix(random, size, size);
    const Matrix b = random_matrix(random, size, 3);
    World products;
    products.set("a", a).set("b", b);
    Matrix expected = Matrix::Zero(size, 3);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < size; ++k) expected(i, j) += a(i, k) * b(k, j);
    EXPECT_LT(relative_difference(products("a*b"), expected), 1e-14);
  }
}

}  // namespace
}  // namespace gainsmith::expr
