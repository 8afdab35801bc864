// Dynamics for tests, written as texts without a YAML file.
//
//   DynamicsText text;
//   text.state("x", 2, "[x(2); -9.81]", "[1; 0]")
//       .when("impact", "x(1) <= 0 and x(2) < 0")
//       .reacts("impact", {{"x", "[0; -0.8*x(2)]"}});
//   const model::Dynamics dynamics = text.dynamics();
//
// It begins with the component "plant"; states, modes, `frozen`, `flow_set` and reactions belong to
// the last component, what qualifies an event to the last event. Texts may use data, states, modes,
// noise, and of the run t, j, count(event), since(event), passes(event), event.left, of which those
// that are used become variables. What is named must be declared before it is named.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/dynamics.h"
#include "model/stated.h"
#include "support/text_problem.h"

namespace gainsmith::tests {

class DynamicsText {
 public:
  DynamicsText();

  DynamicsText& datum(const std::string& name, const numbers::Matrix& value);
  DynamicsText& observer(const std::string& name);

  /// `flow` empty: the state rests. `start` empty: a campaign gives it.
  DynamicsText& state(const std::string& name, expr::Shape shape, const std::string& flow,
                      const std::string& start = "");
  DynamicsText& state(const std::string& name, int rows, const std::string& flow,
                      const std::string& start = "");
  DynamicsText& symmetric(const std::string& name, int rows, const std::string& flow,
                          const std::string& start = "");
  DynamicsText& mode(const std::string& name, const std::string& start);
  DynamicsText& frozen(const std::string& condition);
  DynamicsText& flow_set(const std::string& condition, const std::string& say);

  DynamicsText& when(const std::string& name, const std::string& condition);
  DynamicsText& rises(const std::string& name, const std::string& value);
  DynamicsText& falls(const std::string& name, const std::string& value);
  DynamicsText& crosses(const std::string& name, const std::string& value);
  /// Of one length, or of lengths in [low, high].
  DynamicsText& every(const std::string& name, const std::string& length);
  DynamicsText& every(const std::string& name, const std::string& low, const std::string& high);
  DynamicsText& at(const std::string& name, const std::vector<std::string>& times);
  DynamicsText& first(const std::string& low, const std::string& high);
  DynamicsText& only_if(const std::string& condition);
  DynamicsText& lost(double probability, std::optional<int> in_a_row = std::nullopt);

  /// A pass of the reaction to an event: calls for the same event are passes one after the other.
  DynamicsText& reacts(const std::string& event, const Pairs& map);
  /// `until` empty: `at_most` times.
  DynamicsText& repeats(const std::string& event, const Pairs& map, const std::string& until,
                        const std::string& at_most, bool go_on = false);

  /// normal, lognormal: the center and the deviation; uniform: the ends. A column of `size`.
  DynamicsText& noise(const std::string& name, model::Dynamics::NoiseKind kind,
                      const std::vector<std::string>& values, int size = 1);
  /// Of the last noise: its deviation is a covariance.
  DynamicsText& covariance();
  /// Of the last noise: drawn anew at an event, or after each such time.
  DynamicsText& drawn_at(const std::string& event);
  DynamicsText& drawn_every(const std::string& length);

  /// Rows of (time, value); of lines the rate has the name with "_rate".
  DynamicsText& measured(const std::string& name, model::Between between,
                         const std::vector<std::pair<double, double>>& rows);

  /// `at`: the event at which alone it exists.
  DynamicsText& signal(const std::string& name, const std::string& value,
                       const std::string& at = "");

  /// InputError, as of the expressions, when a text does not fit.
  model::Dynamics dynamics() const;
  /// The data.
  model::Stated stated() const;

 private:
  DynamicsText& event(const std::string& name, model::Dynamics::EventKind kind);
  DynamicsText& border(const std::string& name, model::Dynamics::EventKind kind,
                       const std::string& value);
  DynamicsText& add(model::Dynamics::Variable variable, const std::string& flow,
                    const std::string& start);
  model::Dynamics::Reaction& reaction(const std::string& event);
  std::vector<model::Dynamics::Assignment> map(const Pairs& entries) const;
  std::size_t variable(const std::string& name) const;
  std::size_t event_of(const std::string& name) const;

  model::Dynamics unbound_;  ///< formulas and conditions with their texts, without programs
  numbers::Values data_;
};

}  // namespace gainsmith::tests
