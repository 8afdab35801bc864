// Which events commute whatever the state: neither writes what the other one reads or writes.
//
//   reads    what the conditions, the crossing, `if` and the maps of an event use
//   writes   the states of its maps, its counts and its clock, the noise that it draws
//
// An event that reads j is independent of none: every jump changes it.
#pragma once

#include <cstddef>
#include <vector>

#include "model/dynamics.h"

namespace gainsmith::claims {

/// By variable, whether the condition, the crossing or `if` of an event uses it.
std::vector<bool> read_by_guards(const model::Dynamics& dynamics, std::size_t event);

class Independence {
 public:
  explicit Independence(const model::Dynamics& dynamics);

  /// Whether the order of the two does not matter to either. One event is not independent of
  /// itself.
  bool operator()(std::size_t one, std::size_t other) const;

 private:
  /// By variable.
  struct Touched {
    std::vector<bool> reads;
    std::vector<bool> writes;
    bool counts_jumps = false;  ///< reads j
  };
  std::vector<Touched> events_;
};

}  // namespace gainsmith::claims
