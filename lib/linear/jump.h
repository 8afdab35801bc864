// The jump of sampled dynamics that are linear but for clocks, in 100 digits.
//
//   x+ = J x + j   with coefficients that may depend on clocks
//
// A clock has a constant rate, and the jump sets it to a constant: so what it is at a jump is a
// function of the length of the flow before, and J is too. x are the elements that are no clocks.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "linear/coordinates.h"
#include "linear/flow.h"

namespace gainsmith::linear {

class LinearJump {
 public:
  /// `start`: all coordinates where runs start, of those that start the same in all runs. None when
  /// the jump or the flow is of another kind. The coordinates must outlive it.
  static std::optional<LinearJump> make(const Coordinates& coordinates, const Wide& start,
                                        const std::vector<bool>& same);

  LinearJump(LinearJump&&) noexcept;
  LinearJump& operator=(LinearJump&&) noexcept;
  ~LinearJump();

  /// The elements of the coordinates that are x.
  const std::vector<Eigen::Index>& elements() const { return elements_; }
  /// Whether J depends on the length.
  bool varies() const { return clocks_ != nullptr; }
  /// [J, j] after a flow of a length; `first`: the one from the start.
  Wide operator()(const Decimal100& length, bool first) const;

 private:
  struct Clocks;
  LinearJump();

  std::vector<Eigen::Index> elements_;
  Wide constant_;  ///< when it does not vary
  std::unique_ptr<Clocks> clocks_;
};

}  // namespace gainsmith::linear
