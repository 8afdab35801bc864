// Internal to the judge (judge.h): the texts of Dynamics with values, as functions of
// the stacked variables, and conditions that know what rounding leaves open.
//
// Rounding enters to first order, one variable after the other:
//
//   spread(x) = sum_i max(|f(x + r_i e_i) - f(x)|, |f(x - r_i e_i) - f(x)|)
//
// A comparison d > 0 is surely true where d > spread, surely false where d <= -spread.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hybrid/state_layout.h"
#include "judge/judge.h"
#include "model/dynamics.h"
#include "model/stated.h"

namespace gainsmith::judge {

/// A program of the variables.
class Text {
 public:
  /// InputError at the place when the program uses what is neither a variable nor has a value.
  Text(const expr::Program& program, const Place& place, const hybrid::StateLayout& layout,
       const model::Stated& stated);

  /// The value, valid until the next call. EvaluationError when it has no value.
  const numbers::Matrix& operator()(const Eigen::VectorXd& x) { return value_.at(0, x); }
  /// The same by the compiled program, as the judged run has it: faster, and no second opinion.
  const numbers::Matrix& compiled(const Eigen::VectorXd& x) { return value_(x); }
  /// How much each element moves, at most and to first order, when each x_i does by rounding_i.
  numbers::Matrix spread(const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);

 private:
  std::unique_ptr<const expr::Program> program_;  ///< on the heap: the evaluator points to it
  numbers::StackedFunctions value_;               ///< evaluated by Real, unlike what it judges
  std::vector<Eigen::Index> elements_;            ///< of x that it uses
};

/// A condition of the variables.
class Guard {
 public:
  Guard(const expr::Condition& condition, const hybrid::StateLayout& layout,
        const model::Stated& stated);
  /// The condition that the one given is false.
  static Guard negation(Guard guard);

  bool operator()(const Eigen::VectorXd& x);
  /// What is true for all values whose elements lie within `rounding` of x.
  Truth truth(const Eigen::VectorXd& x, const Eigen::VectorXd& rounding);
  /// A number that is > 0 where the condition is true, < 0 where it is false, up to where they meet:
  /// of a comparison the least difference, of `and` the least of its parts, of `or` the largest.
  double depth(const Eigen::VectorXd& x);

 private:
  explicit Guard(expr::Condition::Kind kind) : kind_(kind) {}

  expr::Condition::Kind kind_;
  std::optional<Text> difference_;
  std::vector<Guard> parts_;
};

/// One event: its condition or crossing or clock, and its `if`.
struct EventTexts {
  std::optional<Guard> condition;
  std::optional<Text> crossing;
  std::optional<Guard> only_if;
  double low = 0, high = 0;              ///< lengths of a clock
  double first_low = 0, first_high = 0;  ///< where its first occurrence lies
  std::vector<double> times;             ///< of `at`, in order, each once
};

/// The new value of one variable in a jump.
struct MapText {
  std::size_t variable;
  Text value;
  /// Sizes of the terms that the value is the sum of; none where nothing is computed.
  std::optional<Text> terms;
};

/// One map of a reaction, or a loop of it.
struct PassTexts {
  std::vector<MapText> map;  ///< variables with their new values
  bool repeats = false;
  std::optional<Guard> until;
  std::int64_t at_most = 1;
  bool go_on = false;
};

/// What one component does at one event.
struct ReactionTexts {
  std::size_t event = 0;
  std::size_t component = 0;
  std::vector<PassTexts> passes;
};

/// Where all values of a noise lie; infinite where it has no range.
struct NoiseRange {
  numbers::Matrix low, high;    ///< of its shape
  std::optional<double> every;  ///< drawn anew after each such time
};

struct FlowSetText {
  Guard left;  ///< true outside of where the component may flow
  std::string say;
};

/// All texts of the dynamics, and the sizes that count as right.
class Texts {
 public:
  /// All must outlive it. InputError for a text that uses what has no value, and for constants
  /// that do not fit.
  Texts(const model::Dynamics& dynamics, const model::Stated& stated, const Question& question);

  /// What counts as right of elements of these sizes.
  Eigen::VectorXd accuracy(const Eigen::VectorXd& sizes) const {
    if (question.absolute_of.size() > 0) return question.relative * sizes + question.absolute_of;
    return (question.relative * sizes.array() + question.absolute).matrix();
  }
  /// The rates of all elements at x: flows, clocks, 0 for what rests.
  void rate(const Eigen::VectorXd& x, Eigen::VectorXd& out);
  /// The same by compiled programs (Text::compiled).
  void compiled_rate(const Eigen::VectorXd& x, Eigen::VectorXd& out);
  /// Whether the states of each variable flow with the modes of x.
  std::vector<bool> flowing(const Eigen::VectorXd& x);
  /// Gives what rests in a flow from `start` the bits that it has there: a sum of polynomials has
  /// rounded them, and `==` would detect it. Not so noise that may change within a flow.
  void settle(const Eigen::VectorXd& start, Eigen::VectorXd& x);
  /// Whether noise may be drawn anew within a flow: after a time, or where `if` spends its event.
  bool changes_inside(std::size_t variable) const;
  /// The largest element of each variable's part of `sizes`, for each of its elements.
  Eigen::VectorXd by_variable(const Eigen::VectorXd& sizes) const;
  auto part(Eigen::VectorXd& x, std::size_t variable) const {
    const hybrid::Slot& slot = layout.slots[variable];
    return x.segment(slot.offset, slot.shape.size());
  }
  auto part(const Eigen::VectorXd& x, std::size_t variable) const {
    const hybrid::Slot& slot = layout.slots[variable];
    return x.segment(slot.offset, slot.shape.size());
  }
  bool is(std::size_t variable, model::Dynamics::VariableKind kind) const {
    return dynamics.variables[variable].kind == kind;
  }
  bool is_measured(std::size_t variable) const {
    return is(variable, model::Dynamics::VariableKind::measured) ||
           is(variable, model::Dynamics::VariableKind::measured_rate);
  }
  /// Whether a file has a row of what is measured at t, where it may change.
  bool has_row(std::size_t variable, double t) const;
  /// The variable of a kind that belongs to an event or a noise, if there is one.
  std::optional<std::size_t> find(model::Dynamics::VariableKind kind, std::size_t of) const;
  /// The value of a formula of constants. InputError where it has none.
  numbers::Matrix constant(const model::Formula& formula) const;
  /// The value of a start; none without one.
  std::optional<numbers::Matrix> start(std::size_t variable, const Eigen::VectorXd& x) const;

  const model::Dynamics& dynamics;
  const model::Stated& stated;
  const Question& question;
  hybrid::StateLayout layout;  ///< one slot a variable
  std::vector<EventTexts> events;
  std::vector<ReactionTexts> reactions;
  std::vector<NoiseRange> noise;
  std::vector<FlowSetText> flow_sets;

 private:
  template <class Value>
  void set_rate(const Eigen::VectorXd& x, Eigen::VectorXd& out, const Value& value_of);
  double scalar(const model::Formula& formula) const;
  EventTexts event_texts(const model::Dynamics::Event& event) const;
  MapText map_text(const model::Dynamics::Assignment& entry) const;
  ReactionTexts reaction_texts(const model::Dynamics::Reaction& reaction) const;
  NoiseRange noise_range(const model::Dynamics::Noise& noise) const;

  std::vector<std::pair<std::size_t, Text>> flow_;
  std::vector<std::optional<Guard>> frozen_;  ///< by component
};

/// (M + M')/2.
void make_symmetric(numbers::Matrix& value);

}  // namespace gainsmith::judge
