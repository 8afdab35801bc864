// Rows x columns.
#pragma once

#include <string>

namespace gainsmith::expr {

/// The size of a matrix, 1 x 1 by default. Empty matrices, such as 0 x n, are allowed.
struct Shape {
  int rows = 1;
  int cols = 1;

  bool operator==(const Shape&) const = default;
  bool is_scalar() const { return rows == 1 && cols == 1; }
  bool is_square() const { return rows == cols; }
  int size() const { return rows * cols; }
};

/// "2 x 3".
std::string to_string(Shape shape);

}  // namespace gainsmith::expr
