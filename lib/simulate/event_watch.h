// The texts of a System that decide when something happens, and their zero crossings on a step.
//
// Each text is an EventFunction whose sign decides. A condition that no flow can change from these
// values on is left out (at_rest), and so is a function that an interval holds away from 0.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/event_functions.h"
#include "simulate/step_values.h"
#include "simulate/vector_field.h"

namespace gainsmith::simulate {

class EventWatch {
 public:
  /// A condition under `while`, and what a run says that ends there.
  struct FlowSet {
    hybrid::EventCondition where;
    std::string say;
    Place place;
  };

  explicit EventWatch(const hybrid::System& system);

  // By event: `when`, `if`, and e of rises, falls and crosses.
  std::vector<std::optional<hybrid::EventCondition>> when, only_if;
  std::vector<std::optional<hybrid::EventFunction>> crossing;
  std::vector<FlowSet> flow_sets;
  std::vector<hybrid::EventFunction> switches;

  /// The times just after all zero crossings on a step, in order, the last of each instant: those
  /// of events and of `while` that may decide something from `values` on, the values at the start of
  /// the step. `turn` is given the turning points within `near` of their terms, and those that come
  /// nearest. `left`: the last at which something just leaves 0, clearly. `hidden`, at the start of a
  /// flow: the first CrossingsOnStep::hidden_turn, if any.
  std::vector<double> crossings(
      const StepValues& inside, const Eigen::VectorXd& values, double near,
      const std::function<void(const hybrid::NearTurn&, bool reached)>& turn, double& left,
      std::optional<double>* hidden = nullptr);

  /// Whether e of an event is 0 but for rounding: that of its terms, and of the values on the step
  /// that `crossings` has searched last.
  bool is_noise(std::size_t event, const Eigen::VectorXd& values);
  /// Whether it may be 0 but for the rounding of the time of an instant besides.
  bool may_be_noise(std::size_t event, const Eigen::VectorXd& values);
  /// A jump leads to values that have no rounding of a step.
  void forget_step(std::size_t event) { rounding_[event] = time_rounding_[event] = 0; }

  /// The function that a turning point is of.
  hybrid::EventFunction& function_of(const hybrid::NearTurn& turn);

  /// The first instant in (t, last] at which a function that is affine in what is steady crosses
  /// zero; `last` when there is none.
  double next_line(const VectorField& field, double t, double last, const Eigen::VectorXd& values);

 private:
  struct Sides {
    bool above = false;     ///< > 0
    bool at_least = false;  ///< >= 0
  };
  /// What a function decides about; the condition is none of a crossing.
  struct Role {
    hybrid::NearTurn::Of of;
    std::size_t index;
    hybrid::EventCondition* condition;
    std::size_t comparison;
  };
  using Visit = std::function<void(hybrid::EventFunction&, Sides, const Role&)>;

  /// Visits all functions that may decide something in a flow from these values.
  void active_functions(const Eigen::VectorXd& values, const Visit& visit);
  /// The moving comparisons of a condition that is not decided by what rests.
  static void comparisons_of(const Role& role, const Eigen::VectorXd& values, const Visit& visit);
  static bool decides(const Role& role, const Eigen::VectorXd& values);

  const hybrid::System* system_;
  std::vector<double> rounding_;       ///< by event: of e on a step
  std::vector<double> time_rounding_;  ///< by event: what that of the time makes of e
};

}  // namespace gainsmith::simulate
