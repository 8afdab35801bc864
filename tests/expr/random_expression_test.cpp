// Random expressions as text, against the same computation done with Eigen while the text is made.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <string>

#include "expr/text/lexer.h"
#include "expr/world.h"

namespace gainsmith::expr {
namespace {

/// A text and the value that it must have. `binds` is the strength of its loosest operator: 1 sum,
/// 2 product, 3 sign, 4 postfix.
struct Sample {
  std::string text;
  Matrix value;
  int binds = 4;
};

class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {
    for (const auto& [rows, cols] : {std::pair{2, 2}, {3, 3}, {2, 3}, {3, 2}, {1, 1}, {3, 1}}) {
      const std::string name = "M" + std::to_string(rows) + std::to_string(cols);
      world.set(name, random_matrix(random_, rows, cols));
    }
  }

  Sample make(int rows, int cols, int depth) {
    if (depth == 0) return leaf(rows, cols);
    switch (pick(11)) {
      case 0:
      case 1:
        return sum(rows, cols, depth - 1);
      case 2:
      case 3:
        return product(rows, cols, depth - 1);
      case 4: {
        const Sample inner = make(rows, cols, depth - 1);
        return {"-" + guarded(inner, 3), -inner.value, 3};
      }
      case 5: {
        const Sample inner = make(cols, rows, depth - 1);
        return {guarded(inner, 4) + "'", inner.value.transpose(), 4};
      }
      case 6: {
        const Sample number = make(1, 1, 0);
        const Sample inner = make(rows, cols, depth - 1);
        return {guarded(number, 2) + "*" + guarded(inner, 3), number.value(0, 0) * inner.value, 2};
      }
      case 7: {
        const Sample inner = make(rows, cols, depth - 1);
        return {guarded(inner, 2) + "/(3 + 1)", inner.value / 4, 2};
      }
      case 8: {
        const Sample a = make(rows, cols, depth - 1);
        const Sample b = make(rows, cols, depth - 1);
        return {guarded(a, 2) + ".*" + guarded(b, 3), a.value.cwiseProduct(b.value), 2};
      }
      case 9: {
        const Sample a = make(rows, cols, depth - 1);
        const Sample b = make(rows, cols, 0);
        const Matrix divisor = (b.value.cwiseProduct(b.value).array() + 1).matrix();
        return {guarded(a, 2) + "./(" + guarded(b, 4) + ".^2 + ones(" + std::to_string(rows) +
                    ", " + std::to_string(cols) + "))",
                a.value.cwiseQuotient(divisor), 2};
      }
      default:
        return rows == cols ? square(rows, depth - 1) : blocks(rows, cols, depth - 1);
    }
  }

  World world;

 private:
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

  static std::string guarded(const Sample& sample, int binds) {
    return sample.binds < binds ? "(" + sample.text + ")" : sample.text;
  }

  Sample leaf(int rows, int cols) {
    if (rows == 1 && cols == 1 && pick(2) == 0) {
      const double value = pick(100) / 8.0;
      return {std::to_string(value), Matrix::Constant(1, 1, value)};
    }
    const std::string name = "M" + std::to_string(rows) + std::to_string(cols);
    const auto found = world.values.find(name);
    if (found != world.values.end()) return {name, found->second};
    // A part of a larger one.
    const std::string part = "M33(1:" + std::to_string(rows) + ", 1:" + std::to_string(cols) + ")";
    return {part, world.values["M33"].topLeftCorner(rows, cols)};
  }

  Sample sum(int rows, int cols, int depth) {
    const Sample a = make(rows, cols, depth);
    const Sample b = make(rows, cols, depth);
    if (pick(2) == 0) return {a.text + " + " + b.text, a.value + b.value, 1};
    return {a.text + " - " + guarded(b, 2), a.value - b.value, 1};
  }

  Sample product(int rows, int cols, int depth) {
    const int inner = 2 + pick(2);
    const Sample a = make(rows, inner, depth);
    const Sample b = make(inner, cols, depth);
    return {guarded(a, 2) + "*" + guarded(b, 3), a.value * b.value, 2};
  }

  Sample square(int size, int depth) {
    const Sample a = make(size, size, depth);
    switch (pick(3)) {
      case 0:
        return {"He(" + a.text + ")", a.value + a.value.transpose()};
      case 1:
        return {guarded(a, 4) + "^2", a.value * a.value};
      default:
        return {a.text + " + 2*I", a.value + 2 * Matrix::Identity(size, size), 1};
    }
  }

  Sample blocks(int rows, int cols, int depth) {
    if (cols < 2) {
      const Sample top = make(1, cols, depth);
      const Sample rest = make(rows - 1, cols, depth);
      Matrix value(rows, cols);
      value << top.value, rest.value;
      return {"[" + top.text + "; " + rest.text + "]", value};
    }
    const Sample left = make(rows, 1, depth);
    const Sample rest = make(rows, cols - 1, depth);
    Matrix value(rows, cols);
    value << left.value, rest.value;
    return {"[" + left.text + ", " + rest.text + "]", value};
  }

  std::mt19937 random_;
};

TEST(RandomExpressions, GiveWhatEigenGives) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    Generator generator(seed);
    const Sample sample =
        generator.make(1 + static_cast<int>(seed % 3), 1 + static_cast<int>(seed / 3 % 3), 5);
    const Matrix value = generator.world(sample.text);
    ASSERT_LT(relative_difference(value, sample.value), 1e-11)
        << "seed " << seed << ": " << sample.text;
  }
}

TEST(RandomExpressions, ReadTheSameAcrossLinesAndSpaces) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Generator generator(seed);
    const Sample sample = generator.make(3, 3, 4);
    std::string spread;
    for (const Token& token : tokenize({sample.text, "t"})) spread += token.text + "\n  ";
    ASSERT_EQ(generator.world(spread), generator.world(sample.text)) << spread;
  }
}

}  // namespace
}  // namespace gainsmith::expr
