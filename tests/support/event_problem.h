// Dynamics for the tests of the event-driven simulator, written as text without a YAML file.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/scope.h"
#include "numbers/types/real.h"
#include "simulate/simulator.h"

namespace gainsmith::tests {

class EventProblem {
 public:
  using Map = std::vector<std::pair<std::string, std::string>>;
  using VariableKind = model::Dynamics::VariableKind;
  using EventKind = model::Dynamics::EventKind;

  EventProblem& data(const std::string& name, const numbers::Matrix& value);
  EventProblem& data(const std::string& name, double value);
  /// "f(x)", a text.
  EventProblem& let(const std::string& signature, const std::string& text);
  /// An observer; what follows belongs to it. The plant is there from the start.
  EventProblem& observer(const std::string& name);
  EventProblem& frozen(const std::string& condition);
  EventProblem& flow_set(const std::string& condition, const std::string& say);

  EventProblem& state(const std::string& name, expr::Shape shape, const std::string& start);
  EventProblem& symmetric(const std::string& name, int size, const std::string& start);
  EventProblem& mode(const std::string& name, const std::string& start);
  EventProblem& flow(const std::string& name, const std::string& text);
  /// "since(sample)", "count(sample)", "passes(sample)", "sample.left".
  EventProblem& number(VariableKind kind, const std::string& name, const std::string& event);
  EventProblem& noise(const std::string& name, model::Dynamics::NoiseKind kind,
                      const std::vector<std::string>& values, const std::string& event = "",
                      const std::string& every = "");

  EventProblem& when(const std::string& name, const std::string& condition);
  EventProblem& crossing(EventKind kind, const std::string& name, const std::string& e);
  EventProblem& every(const std::string& name, const std::string& low, const std::string& high,
                      const std::string& first = "");
  EventProblem& at(const std::string& name, const std::vector<std::string>& times);
  EventProblem& only_if(const std::string& condition);  ///< of the last event
  EventProblem& lost(double probability, std::optional<int> in_a_row = std::nullopt);

  /// A map of the jump at an event, of the component that is open; several follow each other.
  EventProblem& jump(const std::string& event, const Map& map);
  EventProblem& repeat(const std::string& event, const Map& map, const std::string& until,
                       const std::string& at_most, bool go_on = false);

  hybrid::System system() const;

 private:
  struct Text {
    std::string condition, say;
  };
  struct Jump {
    std::string event;
    std::size_t component = 0;
    Map map;
    bool repeats = false;
    std::string until, at_most;
    bool go_on = false;
  };
  struct Happening {
    std::string name;
    EventKind kind;
    std::vector<std::string> texts;
    std::string first, only_if;
    double lost = 0;
    std::optional<int> in_a_row;
  };
  struct State {
    model::Dynamics::Variable variable;
    std::string of, start;
  };
  struct NoiseText {
    std::string name;
    model::Dynamics::NoiseKind kind;
    std::vector<std::string> values;
    std::string event, every;
  };
  struct Part {
    std::string name;
    std::string frozen;
    std::vector<Text> flow_sets;
  };
  friend class EventCompiler;

  numbers::Values values_;
  std::map<std::string, std::string> definitions_;
  std::vector<Part> components_{{"plant", "", {}}};
  std::vector<State> states_;
  Map flows_;
  std::vector<Happening> events_;
  std::vector<Jump> jumps_;
  std::vector<NoiseText> noise_;
};

/// The values of a variable at a time, of the first part that reaches it.
numbers::Matrix value_at(const hybrid::System& system, const hybrid::Trajectory& trajectory,
                         const std::string& variable, double t);
/// The same in a vector of all variables.
numbers::Matrix part_of(const hybrid::System& system, const Eigen::VectorXd& values,
                        const std::string& variable);
std::vector<hybrid::JumpPoint> jumps_of(const hybrid::Trajectory& trajectory);

}  // namespace gainsmith::tests
