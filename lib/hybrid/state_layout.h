// The stacked state of a hybrid system and functions of it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "expr/program/program.h"
#include "model/dynamics.h"
#include "numbers/graph/stacked_functions.h"

namespace gainsmith::hybrid {

/// One named state inside the stacked vector: its elements column by column from `offset`.
struct Slot {
  std::string name;
  expr::Shape shape;
  Eigen::Index offset = 0;
};

/// How the named states are stacked to x in R^size.
struct StateLayout {
  std::vector<Slot> slots;
  Eigen::Index size = 0;
  std::string timer;

  /// Whether a name is that of a state or the timer, so that its value changes along a run.
  bool moves(const std::string& name) const { return name == timer || slot(name); }
  /// The slot of a name, or none.
  std::optional<std::size_t> slot(const std::string& name) const;
};

/// All variables, in the order of the dynamics, without a timer.
StateLayout layout_of(const model::Dynamics& dynamics);

/// Programs as one function of (x, tau). They and the constants must outlive it; every input must
/// be a state, the timer or a constant.
numbers::StackedFunctions stacked(std::vector<const expr::Program*> programs,
                                  const StateLayout& layout, const numbers::Values& constants);

/// A program as a function of (x, tau), one point at a time. The program and the constants must
/// outlive it; every input must be a state, the timer or a constant.
class PointFunction {
 public:
  PointFunction(const expr::Program& program, const StateLayout& layout,
                const numbers::Values& constants);

  /// The value, valid until the next call. InputError when an operation has no result.
  const numbers::Matrix& operator()(const Eigen::VectorXd& x, double tau) {
    return function_(x, tau);
  }
  /// Bounds of its elements over a box of states; false: none are known.
  bool enclose(const numbers::Box& x) { return function_.enclose(x); }
  const numbers::Range& range(std::size_t element) const { return function_.range(0, element); }

 private:
  numbers::StackedFunctions function_;
};

}  // namespace gainsmith::hybrid
