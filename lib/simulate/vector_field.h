// What the variables of a System do within one flow.
//
// The elements that flow are y: those of states that are neither resting nor steady, of symmetric
// ones the lower triangle. Everything that is steady is a line
//
//   value(t) = max(base + rate*(t - time), least)
//
// whose base is kept over events that leave it alone, so that no rounding adds up.
//
// A symmetric n x n state has n (n + 1)/2 elements of y; its rate enters as (M + M')/2. A frozen
// component has the rate 0.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "hybrid/event_functions.h"
#include "hybrid/system.h"
#include "hybrid/trajectory.h"
#include "ode/exponential_tables.h"

namespace gainsmith::simulate {

class VectorField {
 public:
  explicit VectorField(const hybrid::System& system);

  /// At the start of a run: the times since events are 0.
  void reset();
  /// since(event) runs from `time` on; event.left runs down to 0 then.
  void set_clock(model::Dynamics::VariableKind kind, std::size_t event, double time);

  /// Begins a flow: reads which components are frozen and the steady rates. InputError for a
  /// symmetric state whose flow is not.
  void begin(double t, const Eigen::VectorXd& values);
  /// Gives everything steady its value at t, in the flow that has begun.
  void fill(double t, Eigen::VectorXd& values) const;
  /// Gives t and the clocks of events their values.
  void fill_clocks(double t, Eigen::VectorXd& values) const;

  /// Of y.
  Eigen::Index size() const { return static_cast<Eigen::Index>(elements_.size()); }
  /// y of all values, and below the values with y in place.
  Eigen::VectorXd gathered(const Eigen::VectorXd& values) const;
  void spread(const Eigen::VectorXd& y, Eigen::VectorXd& values) const;
  /// y' at (t, y). EvaluationError where it has no value.
  void rate(double t, const Eigen::VectorXd& y, Eigen::VectorXd& rate);
  /// What y' may depend on beside y. Of an affine flow it is affine in y and these: they are lines,
  /// and values that rest, such as noise that is held.
  struct LinearInput {
    Eigen::Index element = 0;
    /// Of a line of the time: 1 or -1. None: the rate of a flow, or 0.
    std::optional<double> clock_rate;
    bool rests = false;
  };
  const std::vector<LinearInput>& linear_inputs() const { return linear_inputs_; }
  /// In the flow that has begun.
  double rate_of(const LinearInput& input) const;
  /// y' where these have the values given, whatever the time.
  void rate_at(const Eigen::VectorXd& y, const Eigen::VectorXd& inputs, Eigen::VectorXd& rate);
  /// The other resting values that y' uses, and which components are frozen.
  Eigen::VectorXd parameters(const Eigen::VectorXd& values) const;

  /// All variables over [from, to] from a series for y.
  hybrid::DenseStep step(double from, double to, const numbers::Matrix& series) const;
  /// The part of a step up to t: what is steady is the same line, and what rests keeps its bits.
  hybrid::DenseStep until(const hybrid::DenseStep& step, double t) const;
  const hybrid::System& system() const { return *system_; }
  /// Whether the component of a state is, in the flow that has begun.
  bool is_frozen(std::size_t variable) const;
  /// Of exact flows.
  ode::ExponentialTables& tables() { return tables_; }

 private:
  struct Line {
    Eigen::Index element = 0;
    double base = 0, time = 0, rate = 0;
    bool not_below_zero = false;

    double at(double t) const {
      const double value = base + rate * (t - time);
      return not_below_zero && value < 0 ? 0 : value;
    }
  };
  struct Entry {
    std::size_t variable = 0;
    hybrid::SystemFunction value;
    Eigen::Index first = 0;  ///< of its elements in y, or of its lines
    /// With branches as they are: where a fixed one has no value, such as sqrt(max(x, 0)) below 0.
    std::optional<hybrid::SystemFunction> free;
  };

  void add_flow(std::size_t flow);
  void note_inputs(const std::vector<const expr::Program*>& programs);
  /// Whether all rates are affine in the flowing and steady variables together with this one.
  bool is_affine_in(std::size_t variable, const std::vector<const expr::Program*>& programs) const;
  void add_linear_inputs(std::size_t variable);
  Line& clock(std::size_t variable);
  /// The rate with fixed branches; where it has no value, with free ones.
  static const numbers::Matrix& text_of(Entry& entry, const Eigen::VectorXd& values);
  const numbers::Matrix& value_of(Entry& entry, const Eigen::VectorXd& values);
  /// Starts a new line at t where its rate or its value has changed.
  void set_steady(Entry& entry, double t);
  /// InputError where the asymmetry is above kMeantEqual of the largest rate so far.
  void require_symmetric(Entry& entry, const numbers::Matrix& rate);
  /// y' at values_.
  void rates(Eigen::VectorXd& rate);
  void set_lines(hybrid::DenseStep& step) const;

  const hybrid::System* system_;
  std::vector<Line> lines_;
  std::vector<std::size_t> clocks_;     ///< their variables: the first lines
  std::vector<Eigen::Index> elements_;  ///< of y among the values
  std::vector<Eigen::Index> mirrors_;   ///< the transposed ones
  std::vector<Entry> flows_, steady_;
  numbers::StackedFunctions together_;  ///< of flows_
  struct Element {
    std::size_t flow = 0, at = 0, mirror = 0;  ///< of the value of together_
  };
  std::vector<Element> rate_of_;  ///< of each element of y
  std::vector<LinearInput> linear_inputs_;
  std::vector<Eigen::Index> resting_inputs_;
  std::vector<std::size_t> linear_;                            ///< variables of linear_inputs_
  std::vector<std::optional<hybrid::EventCondition>> frozen_;  ///< by component
  std::vector<bool> is_frozen_;
  std::vector<double> largest_rate_;  ///< by variable, in this run
  numbers::Matrix symmetric_;
  Eigen::VectorXd values_;
  ode::ExponentialTables tables_;
};

}  // namespace gainsmith::simulate
