// Shorthand of the tests of expr: texts become values, symbols are given by name.
#pragma once

#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "numbers/types/real.h"

namespace gainsmith::expr {

using numbers::evaluate;
using numbers::Matrix;
using numbers::RealAlgebra;
using numbers::Values;

/// A scope whose symbols have known values, and the values.
struct World {
  Scope scope;
  Values values;

  World() { scope.known = std::make_shared<numbers::KnownDoubles>(values); }
  World& set(const std::string& name, const Matrix& value) {
    scope.symbols[name] = {numbers::shape_of(value), true};
    values[name] = value;
    scope.known = std::make_shared<numbers::KnownDoubles>(values);
    return *this;
  }
  World& set(const std::string& name, double value) {
    return set(name, Matrix::Constant(1, 1, value));
  }
  /// "f(a, b)", "a*b".
  World& define(const std::string& signature, const std::string& body) {
    const Signature left = parse_signature({signature, "let"});
    scope.definitions[left.name] = {left.parameters, parse({body, "let"})};
    return *this;
  }
  Matrix operator()(const std::string& text, std::optional<Shape> expected = std::nullopt) const {
    return evaluate(compile(parse({text, "test"}), scope, expected), values);
  }
};

inline Matrix random_matrix(std::mt19937& random, int rows, int cols) {
  std::uniform_real_distribution<double> element(-1, 1);
  Matrix result(rows, cols);
  for (double& x : result.reshaped()) x = element(random);
  return result;
}

inline double relative_difference(const Matrix& a, const Matrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return 1e300;
  if (a.size() == 0) return 0;
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

}  // namespace gainsmith::expr
