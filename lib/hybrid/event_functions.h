// Texts of a System as functions of the stacked values, one point at a time. The system must
// outlive them; names are resolved when they are made.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "expr/binding/condition.h"
#include "hybrid/breaks.h"
#include "hybrid/system.h"
#include "numbers/graph/stacked_functions.h"

namespace gainsmith::hybrid {

/// Programs over the variables of a system as one function of all its values.
numbers::StackedFunctions stacked(std::vector<const expr::Program*> programs, const System& system);

/// One program over all values of a system, variables and branches. Inputs that are no variables
/// are constants, fixed when it is made.
class SystemFunction {
 public:
  SystemFunction(const expr::Program& program, const System& system);

  /// The value, valid until the next call. EvaluationError when an operation has no result.
  const numbers::Matrix& operator()(const Eigen::VectorXd& values) { return function_(values); }

  /// Whether it is the same all along a flow.
  bool rests() const { return rests_; }
  /// Whether it is affine in t and other variables of steady rate, and uses no other that move.
  bool is_line() const { return is_line_; }
  /// The elements of the values that it uses.
  std::vector<Eigen::Index> elements() const { return function_.elements(); }
  /// Bounds of its elements over a box of values; false: none are known.
  bool enclose(const numbers::Box& values) { return function_.enclose(values); }
  const numbers::Range& range(std::size_t element) const { return function_.range(0, element); }

 private:
  bool rests_ = true;
  bool is_line_ = false;
  numbers::StackedFunctions function_;
};

/// A function whose sign matters, with the sizes of the terms that it is the sum of: its rounding
/// is that of its terms.
class EventFunction {
 public:
  EventFunction(const expr::Program& program, const System& system);

  const numbers::Matrix& operator()(const Eigen::VectorXd& values) { return value_(values); }
  /// The sums of the terms' absolute values, element by element.
  const numbers::Matrix& terms(const Eigen::VectorXd& values) { return terms_(values); }
  /// Of each element, on which side of 0 it is all over a box: 1 or -1; 0: it may come to 0, or
  /// next to it, which is within `near` of its terms or where a turning point is reported. Empty:
  /// no bounds are known.
  const std::vector<int>& sides(const numbers::Box& values, double near = 0);
  /// Whether an element is 0 but for the rounding of its terms.
  bool is_noise(const Eigen::VectorXd& values, Eigen::Index element = 0);
  /// Between them it is smooth along a flow.
  Breaks& breaks() { return breaks_; }
  bool rests() const { return value_.rests(); }
  bool is_line() const { return value_.is_line(); }
  /// may_wave (breaks.h) of it.
  bool waves() const { return waves_; }
  Eigen::Index size() const { return size_; }
  /// The elements of the values that it uses; its terms and breaks use no others.
  const std::vector<Eigen::Index>& elements() const { return elements_; }

 private:
  Eigen::Index size_;
  bool waves_;
  SystemFunction value_;
  std::vector<Eigen::Index> elements_;
  std::unique_ptr<const expr::Program> terms_program_;
  SystemFunction terms_;
  Breaks breaks_;
  std::vector<int> sides_;
};

/// A tree of comparisons (expr/binding/condition.h) with `and`, `or`, `not`. A comparison of
/// matrices is true where it is true of all elements.
class EventCondition {
 public:
  struct Comparison {
    EventFunction function;
    expr::Condition::Kind kind;
    std::string text;

    /// Which difference is on the side of the truth, alone: > 0, or >= 0.
    bool strict() const { return kind == expr::Condition::Kind::positive; }
  };

  EventCondition(const expr::Condition& condition, const System& system);

  /// Whether it is true at these values.
  bool operator()(const Eigen::VectorXd& values);
  /// What a flow from these values on cannot change.
  Truth at_rest(const Eigen::VectorXd& values);
  /// Whether it were true if that comparison were as it is not.
  bool if_changed(const Eigen::VectorXd& values, std::size_t comparison);

  /// All leaves of the tree, left to right. Their zero crossings are where it may change.
  std::vector<Comparison>& comparisons() { return comparisons_; }
  const std::string& text() const { return text_; }
  const Place& place() const { return place_; }
  /// "x(1) = 0.25, q = 1": the differences, for messages.
  std::string differences(const Eigen::VectorXd& values);

 private:
  /// A node of the tree: all, any or none of `parts`, or one comparison.
  struct Part {
    expr::Condition::Kind kind = expr::Condition::Kind::all;
    std::size_t comparison = 0;
    std::vector<Part> parts;
  };
  Part make(const expr::Condition& condition, const System& system);
  /// Kleene logic with yes, no and unknown: an unknown leaf leaves the whole unknown unless the
  /// others decide it.
  template <class Compare>
  static Truth truth(const Part& part, const Compare& compare);
  bool is_true(std::size_t comparison, const Eigen::VectorXd& values);

  std::vector<Comparison> comparisons_;
  Part whole_;
  std::string text_;
  Place place_;
};

}  // namespace gainsmith::hybrid
