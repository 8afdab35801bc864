// Internal to bind: plant, observers and events bound to Dynamics.
//
// A hybrid system (Goebel, Sanfelice and Teel 2012): every component has states with x' = f(x)
// while its flow set holds, and x+ = g(x) at events. Events are due by a clock, at given times or
// rows of measured data, by a condition, or by a crossing of 0. Observers read outputs of the
// plant, never its states.
//
// The variables of Dynamics are states, modes, noise, measured quantities, and numbers that texts
// may ask for: the time, counts of jumps, times since and until events.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bind/dynamics_names.h"
#include "expr/binding/scope.h"
#include "model/dynamics.h"
#include "model/problem.h"

namespace gainsmith::bind {

/// It is used once: run() or varied().
class DynamicsBinding {
 public:
  /// `scope` has data, parameters, definitions, unknowns and gains; the names of plant, observers
  /// and events are added to it.
  DynamicsBinding(const model::Method& method, const model::Dimensions& dimensions,
                  const DynamicsNames& names, const std::vector<model::UncertainText>& uncertain,
                  const std::map<std::string, expr::Expression>& data_texts, expr::Scope& scope);

  /// All names first, then the formulas over them. InputError for the first text that does not fit.
  model::Dynamics run();
  /// The uncertain data alone, with their names "plant.k" and those of what uses them.
  model::Dynamics varied() {
    add_varied();
    return result_;
  }
  /// The event at which alone an output exists, by its full name.
  std::optional<std::size_t> event_of_output(const std::string& output) const;

 private:
  // dynamics.cpp: components, states, flows.
  void add_component(const model::Component& component);
  void add_states(const model::Component& component, std::size_t at);
  void add_definitions(const model::Component& component);
  /// Inputs are functions of the time. The time t and the number of jumps j are variables unless a
  /// method has other things of these names.
  void add_inputs();
  void add_measured(const model::MeasuredText& text);
  void bind_measured_events();
  /// Uncertain data as noise that is drawn once a run, with what depends on it.
  void add_varied();
  std::string no_datum(const std::string& name) const;
  model::Dynamics::Noise varied_noise(const model::UncertainText& text, expr::Shape shape) const;
  std::vector<expr::Expression> values_of(const model::UncertainText& text,
                                          expr::Shape shape) const;
  /// The start that a state has by its declaration; a campaign may give another one.
  void bind_starts();
  void bind_flow(const model::Component& component, std::size_t at);
  /// The variable that an entry of flow or of a jump sets. InputError where it is no state of the
  /// component.
  std::size_t state(const model::Component& component, std::size_t at, const model::Named& entry,
                    const char* what) const;
  expr::Shape shape_of(const model::Declaration& state) const;
  /// Whether nothing has this name yet.
  bool is_free(const std::string& name) const;

  // events.cpp: what is due, and what happens then.
  void add_events();
  void sort_events();
  /// count(e), since(e), passes(e) of each event, and what is left to one with a clock.
  void add_moments();
  void bind_event(const model::EventText& text, const model::Component* component, std::size_t at);
  void bind_reaction(const model::ReactionText& text, const model::Component& component,
                     std::size_t at);
  model::Dynamics::Pass pass(const model::PassText& text, const model::Component& component,
                             std::size_t at, std::size_t event) const;
  /// Conditions under which a component flows, and the modes in which its states are frozen.
  void bind_flow_sets(const model::Component& component, std::size_t at);
  void bind_noise(const model::NoiseText& text);
  void bind_sinusoid(const model::NoiseText& text);
  std::string time_of(const std::string& noise);
  void add_noise(model::Dynamics::Noise noise);
  /// The index of an event as a component names it; InputError where there is none.
  std::size_t event(const model::Component* component, const std::string& name,
                    const Place& place) const;
  void check_ends(const std::string& event, const model::Formula& low,
                  const model::Formula& high) const;
  /// InputError for what changes along a run.
  model::Formula constant(const expr::Expression& text, std::optional<expr::Shape> shape) const;
  expr::Condition condition(const expr::Expression& text, const model::Component* reader,
                            std::optional<std::size_t> event, const expr::Scope& scope) const;

  // dynamics_reads.cpp: who may read what.
  struct Reader {
    const model::Component* component = nullptr;  ///< none: outside
    std::optional<std::size_t> event;             ///< at which it reads
  };
  /// `text` has full names. InputError for an observer that reads states of the plant or another
  /// observer, and for an output where it does not exist.
  void check_reads(const Reader& reader, const expr::Expression& text,
                   const expr::Scope& scope) const;
  /// What no flow_map in the texts of a component, or outside (nullptr), may have in its rate.
  void set_reader(const model::Component* component);
  void check_name(const Reader& reader, const expr::Expression& top, const expr::Node& node,
                  const std::string& name, bool states, const expr::Scope& scope,
                  std::set<std::string>& seen) const;

  model::Formula formula(const expr::Expression& text, const expr::Scope& scope,
                         std::optional<expr::Shape> shape) const;
  /// Whether it is a variable of the dynamics.
  bool is_moving(const std::string& name) const;

  const model::Method* method_;
  const model::Dimensions* dimensions_;
  const DynamicsNames* names_;
  const std::vector<model::UncertainText>* uncertain_;
  const std::map<std::string, expr::Expression>* data_texts_;
  expr::Scope* scope_;
  model::Dynamics result_;
  std::map<std::string, std::size_t> events_;         ///< by full name
  std::map<std::string, std::string> output_events_;  ///< the event's name as written, by output
  /// Full names; observers read these, whatever they are made of.
  std::set<std::string> outputs_of_plant_;
  std::vector<const model::EventText*> event_texts_;  ///< of result_.events, in order
};

/// Drops the numbers of events, t and j, where no program reads them.
void drop_unread(model::Dynamics& dynamics, const std::set<std::string>& read);

}  // namespace gainsmith::bind
