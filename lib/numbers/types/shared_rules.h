// Internal to numbers: what number types of matrices do alike.
#pragma once

#include <cstddef>

#include "expr/program/evaluate.h"
#include "expr/program/number_type.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// place(row, column, operand) for each operand of Op::blocks, at its first element.
template <class Value, class Place>
void for_each_block(const expr::Step<Value>& at, const Place& place) {
  const auto columns = static_cast<std::size_t>(at.attribute(0));
  std::ptrdiff_t row = 0;
  for (std::size_t first = 0; first < at.operands.size(); first += columns) {
    std::ptrdiff_t column = 0;
    for (std::size_t j = first; j < first + columns; ++j) {
      place(row, column, at[j]);
      column += at[j].cols();
    }
    row += at[first].rows();
  }
}

/// base^exponent, exponent >= 0, by squaring: some 2 log2 k products at most. `one`: base^0.
template <class Value, class Times>
Value whole_power(Value one, Value base, int exponent, const Times& times) {
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) one = times(one, base);
    if (exponent > 1) base = times(base, base);
  }
  return one;
}

template <class Scalar>
MatrixOf<Scalar> elementwise_product(const MatrixOf<Scalar>& a, const MatrixOf<Scalar>& b) {
  return a.cwiseProduct(b);
}

/// The value of a program at named values. std::logic_error when an input has none.
template <class Type, class NamedValues>
typename Type::Value evaluate_once(const expr::Program& program, const NamedValues& values) {
  expr::Evaluator<Type> evaluator(program);
  for (const expr::Input& input : program.inputs) {
    const auto found = values.find(input.name);
    if (found != values.end()) evaluator.set(input.name, found->second);
  }
  return evaluator.run();
}

}  // namespace gainsmith::numbers
