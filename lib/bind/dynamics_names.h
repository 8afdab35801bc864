// Internal to bind: what the names in the texts of plant and observers refer to.
//
// Programs know the states of the plant by their own names and those of an observer with its name,
// "nominal.xh". Within an observer its own names need none. Outside, a bare name that only
// observers have refers to each that has it, in turn; one that plant and method share is the
// method's.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "expr/text/rename.h"
#include "model/method.h"

namespace gainsmith::bind {

/// "nominal.outside"; of the plant the name alone. So events are called.
std::string full_name(const model::Component& component, const std::string& name);

/// The names of states, modes, definitions and outputs.
std::set<std::string> names_of(const model::Component& component);

/// Texts with full names, as they are for one observer; `observer` is empty where none of them has
/// a bare name of one.
struct Reading {
  std::string observer;
  std::vector<expr::Expression> texts;
};

/// It renames texts and binds nothing. The method must outlive it.
class DynamicsNames {
 public:
  /// `varied`: data of which the plant has a value of its own, plant.cf, and definitions that use
  /// them.
  DynamicsNames(const model::Method& method, std::set<std::string> varied);

  /// "nominal.xh"; of the plant the name alone, with "plant." where data, definitions, unknowns or
  /// gains of the method have it too.
  std::string full(const model::Component& component, const std::string& name) const;
  /// The text of a component with full names. `parameters`: names that it binds itself.
  expr::Expression within(const model::Component& component, const expr::Expression& text,
                          const std::vector<std::string>& parameters = {}) const;
  /// The text of a definition, of those that are varied, as the plant has it.
  expr::Expression of_plant(const expr::Expression& text,
                            const std::vector<std::string>& parameters) const;
  const std::set<std::string>& varied() const { return varied_; }
  /// Texts outside of components, that belong together: one reading, or one for each observer that
  /// has all the bare names in them. InputError when no observer has all of them.
  std::vector<Reading> outside(const std::vector<expr::Expression>& texts) const;
  /// The texts of a certain observer, whose names need no prefix. InputError at `place` when there
  /// is none of this name.
  Reading of_observer(const std::string& observer, const std::vector<expr::Expression>& texts,
                      const Place& place) const;
  /// A text that no observer by itself is meant in. InputError when there are several readings.
  expr::Expression outside(const expr::Expression& text) const;
  /// The states that a name of `initial` refers to.
  std::vector<std::string> states(const std::string& name) const;
  /// The full name of the event that a component, or a text outside (nullptr), means; none when
  /// there is none.
  std::optional<std::string> event(const model::Component* component,
                                   const std::string& name) const;
  /// All of them as they may be written there, for messages.
  std::vector<std::string> event_names(const model::Component* component) const;
  /// "nominal.e" of several observers; the name alone of the only one.
  std::string title(const std::string& name, const std::string& observer) const;
  /// Adds a signal: later texts may name it. Its readings.
  std::vector<Reading> add_signal(const model::Named& signal);

 private:
  std::optional<std::string> of_part(const std::string& name) const;
  bool is_output_of_plant(const std::string& name) const;
  std::set<std::string> bare_names(const std::vector<expr::Expression>& texts) const;
  bool has(const std::string& observer, const std::string& name) const;
  void refuse_captured(const std::set<std::string>& bare, const Place& place) const;
  Reading reading(const std::string& observer, const std::set<std::string>& bare,
                  const std::vector<expr::Expression>& texts) const;

  const model::Method* method_;
  std::set<std::string> varied_;
  std::set<std::string> of_method_;                        ///< data, unknowns, gains and the like
  std::set<std::string> shared_;                           ///< by plant and method
  std::map<std::string, std::set<std::string>> own_;       ///< by observer
  std::map<std::string, std::set<std::string>> readings_;  ///< signals, by observer
  std::set<std::string> anywhere_;                         ///< names that the observers do not own
};

}  // namespace gainsmith::bind
