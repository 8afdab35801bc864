// Internal to expr: operations at the place of one call, with the shapes that their rules give.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

/// Short names for instructions in the functions of the binder, all at the place of one node. All
/// methods take and return indices of instructions.
class Emitter {
 public:
  Emitter(Binder& binder, const Expression& expression, const Node& node)
      : binder_(binder), expression_(expression), node_(node) {}

  /// `text`: what a message says when the operation has no result.
  /// The instruction of an operation. Shapes that do not fit are an error of the caller
  /// (std::bad_optional_access).
  int operator()(Op op, std::vector<int> operands, const Attributes& attributes = {},
                 std::string text = "") const {
    const Shape of = binder_.shape_of(op, operands, attributes).value();
    return binder_.emit(expression_, node_, op, std::move(operands), of, attributes,
                        std::move(text));
  }

  Shape shape(int at) const { return binder_.shape(at); }
  int number(const std::string& text) const { return binder_.number(expression_, node_, text); }
  int zeros(Shape of) const { return binder_.emit(expression_, node_, Op::zeros, {}, of); }
  /// All elements are the 1 x 1 instruction `number`.
  int filled(int number, Shape of) const {
    return binder_.emit(expression_, node_, Op::fill, {number}, of);
  }
  /// number * I.
  int identity(int number, int size) const {
    return binder_.emit(expression_, node_, Op::identity, {number}, {size, size});
  }
  int identity(int size) const { return identity(number("1"), size); }

  int add(int a, int b) const { return (*this)(Op::add, {a, b}); }
  int subtract(int a, int b) const { return (*this)(Op::subtract, {a, b}); }
  int negate(int a) const { return (*this)(Op::negate, {a}); }
  int multiply(int a, int b) const { return (*this)(Op::multiply, {a, b}); }
  int scale(int number, int a) const { return (*this)(Op::scale, {number, a}); }
  int transpose(int a) const { return (*this)(Op::transpose, {a}); }
  /// Rows first .. last - 1, columns left .. right - 1.
  int part(int a, int first, int last, int left, int right) const {
    return (*this)(Op::index, {a}, {first, last, left, right});
  }
  int element(int a, int row, int column) const {
    return part(a, row, row + 1, column, column + 1);
  }
  /// The k-th element of a row or column.
  int element(int vector, int k) const {
    return shape(vector).rows == 1 ? element(vector, 0, k) : element(vector, k, 0);
  }
  /// Row by row, `columns` in each row.
  int blocks(std::vector<int> entries, int columns) const {
    return (*this)(Op::blocks, std::move(entries), {columns});
  }
  /// [first, 0; 0, second].
  int block_diagonal(int first, int second) const {
    const Shape a = shape(first), b = shape(second);
    return blocks({first, zeros({a.rows, b.cols}), zeros({b.rows, a.cols}), second}, 2);
  }
  /// expm(a t), t 1 x 1.
  int exponential(int a, int t) const { return (*this)(Op::matrix_exponential, {scale(t, a)}); }

 private:
  Binder& binder_;
  const Expression& expression_;
  const Node& node_;
};

}  // namespace gainsmith::expr
