// Ranges of scalars on the command line: "T2=0.5:0.8", "T2=0.5:0.8:13", "delta=1e-3:10:20:log"; or one
// value, "T2=0.5".
#pragma once

#include <optional>
#include <string>

#include "model/problem.h"

namespace gainsmith::app {

struct RangeOption {
  model::ScalarRange range;
  bool is_value = false;            ///< both ends are the value
  std::optional<int> count;         ///< of the points of a grid; 1 of a value
  std::optional<bool> logarithmic;  ///< "log" or "lin"; none: by the range
};

/// Parses "NAME=LOW:HIGH[:COUNT[:log|lin]]" or "NAME=VALUE". LOW, HIGH and VALUE are expressions. InputError, with
/// `option` as its place, for anything else.
RangeOption parse_range(const std::string& text, const std::string& option);

/// InputError, with `option` as its place, unless the number is positive and finite.
void check_positive(const std::optional<double>& number, const std::string& option);

/// An expression given as an option's value.
expr::Expression parse_expression(const std::string& text, const std::string& option);

}  // namespace gainsmith::app
