// A run whose draws are given: in a file, or by a search for the worst run.
#pragma once

#include <optional>
#include <vector>

#include "base/error.h"
#include "numbers/matrix.h"

namespace gainsmith::hybrid {

struct System;
struct Scenario;

/// What is given in place of draws. Vectors may be shorter than what they are about; what is left
/// out is drawn. A list is used in turn, again from its start.
struct GivenRun {
  std::vector<std::optional<numbers::Matrix>> starts;  ///< by variable
  std::vector<std::optional<double>> first;            ///< by event: the first time
  std::vector<std::vector<double>> lengths;            ///< by event, after the first time
  std::vector<std::vector<char>> losses;               ///< by event: whether a jump is lost
  std::vector<std::vector<numbers::Matrix>> noise;     ///< by noise
  Place place;

  /// Element `index` of one of the lists above, or its default.
  template <class List>
  static typename List::value_type of(const List& list, std::size_t index) {
    return index < list.size() ? list[index] : typename List::value_type{};
  }
};

/// InputError for what the dynamics do not draw, and for what lies outside the range of a clock or
/// has another shape. Where lengths and first times go up to, rounding is forgiven.
void check_given(const GivenRun& given, const System& system, const Scenario& scenario);

}  // namespace gainsmith::hybrid
