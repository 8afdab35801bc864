// Rows x columns.
#pragma once

#include <string>

namespace gainsmith::expr {

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
