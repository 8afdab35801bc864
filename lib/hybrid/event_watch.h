// Internal to hybrid: the texts of an EventSystem that decide when something happens, and their
// borders on a step.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/event_function.h"
#include "hybrid/movement.h"
#include "hybrid/step_values.h"

namespace gainsmith::hybrid {

class EventWatch {
 public:
  struct Stay {
    EventCondition where;
    std::string say;
    Place place;
  };

  explicit EventWatch(const EventSystem& system);

  // By event: `when`, `if`, and e of rises, falls and crosses.
  std::vector<std::optional<EventCondition>> when, only_if;
  std::vector<std::optional<EventBorder>> crossing;
  std::vector<Stay> stays;
  std::vector<EventBorder> switches;

  /// The times just after all crossings on a step, in order, of borders of events and of `while`
  /// that may decide about something from `values` on, those at the start of the step. `turn` is
  /// told of turning points within `near` of their terms, and of those that come nearest.
  /// `hidden`, at the start of a flow: the first BorderOnStep::hidden_turn, if any.
  std::vector<double> crossings(const StepValues& inside, const Eigen::VectorXd& values,
                                double near,
                                const std::function<void(const NearTurn&, bool reached)>& turn,
                                std::optional<double>* hidden = nullptr);

  /// The border that a turning point is of.
  EventBorder& border_of(const NearTurn& turn);

  /// The first time in (t, last] at which a border that is affine in what is steady is crossed;
  /// `last` when there is none.
  double next_line(const Movement& movement, double t, double last, const Eigen::VectorXd& values);

 private:
  struct Sides {
    bool above = false;     ///< > 0
    bool at_least = false;  ///< >= 0
  };
  /// What a border decides about; the condition is none of a crossing.
  struct Role {
    NearTurn::Of of;
    std::size_t index;
    EventCondition* condition;
    std::size_t comparison;
  };
  using Visit = std::function<void(EventBorder&, Sides, const Role&)>;

  void active_borders(const Eigen::VectorXd& values, const Visit& visit);
  static void comparisons_of(const Role& role, const Eigen::VectorXd& values, const Visit& visit);
  static bool decides(const Role& role, const Eigen::VectorXd& values);

  const EventSystem* system_;
};

}  // namespace gainsmith::hybrid
