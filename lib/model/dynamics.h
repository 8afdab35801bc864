// What a plant and its observers do: flows, events, jumps. Part of a Design (design.h).
//
// Everything that moves is a variable: the states of all components, modes, and what the texts ask
// of the run itself (the time, counts of events, noise). The programs use variables by their names,
// and data, parameters and gains as the other programs of a design do. A state of an observer that
// is one of several has its name with that of the observer, "nominal.xh"; all others have their
// own.
//
//   flow   variable' = program, for the states that have one; a clock (time, since) runs at rate 1,
//          `left` at rate -1; everything else rests
//   jump   at an instant the events are checked in order; the first that is due jumps, alone, and
//          all are checked again. A jump runs the reactions to its event, each on the values
//          before the jump; a component without one keeps its states, bit by bit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "expr/binding/condition.h"
#include "model/formula.h"
#include "model/measured.h"
#include "model/words.h"

namespace gainsmith::model {

struct Dynamics {
  /// The plant, or an observer.
  struct Component {
    std::string name;  ///< "plant", "observer" or that of one of several
    bool observer = false;
    /// Where true its states do not flow; of modes alone.
    std::optional<expr::Condition> frozen;
    /// `while`: a run that leaves it ends with `say`.
    struct FlowSet {
      expr::Condition where;
      std::string say;
      Place place;
    };
    std::vector<FlowSet> flow_sets;
    Place place;
  };

  enum class VariableKind {
    state,
    mode,    ///< a whole number that never flows
    time,    ///< t
    jumps,   ///< j
    count,   ///< count(event): its jumps so far
    since,   ///< since(event): the time since its last jump; since the start before the first
    left,    ///< event.left: what is left of the clock of an event with `every`
    passes,  ///< passes(event): of the loop of its last jump
    noise,
    measured,      ///< what a file says; `of` a Measured
    measured_rate  ///< its rate, where it runs along lines
  };

  struct Variable {
    VariableKind kind = VariableKind::state;
    std::string name;           ///< under which programs know it
    std::size_t component = 0;  ///< of a state or mode
    std::size_t of = 0;  ///< the event of count, since, left, passes; the noise, the measured
    expr::Shape shape;
    Structure structure = Structure::full;  ///< symmetric: kept equal to its transpose
    std::optional<Formula> start;           ///< of a state or mode: when the campaign gives none
    Place place;
  };

  enum class EventKind {
    when,     ///< while the condition is true
    rises,    ///< once, when e comes to be > 0 from below, or from exactly 0 after a start or jump
    falls,    ///< once, when it comes to be < 0 from above
    crosses,  ///< either
    every,    ///< when its clock has run down
    at        ///< at given times
  };

  struct Event {
    std::string name;  ///< "sample"; of a component, when it is one of several: "toggled.leave"
    std::string own;   ///< without that of its component
    EventKind kind = EventKind::when;
    std::optional<std::size_t> component;      ///< of which it is; none: of the whole
    std::optional<expr::Condition> condition;  ///< of `when`
    std::optional<Formula> crossing;           ///< e of rises, falls, crosses: 1 x 1
    /// Of `every`: the lengths [low, high] and where its first occurrence lies; of constants. With
    /// low = high occurrence k is at first + k low.
    std::optional<Formula> low, high, first_low, first_high;
    std::vector<Formula> times;              ///< of `at`: columns or numbers, of constants
    std::vector<double> rows;                ///< of `at`: times that a file says
    std::optional<expr::Condition> only_if;  ///< `if`: false spends the occurrence
    double lost = 0;                         ///< the probability that no observer sees it
    std::optional<int> lost_in_a_row;        ///< at most
    Place place;

    /// Whether it is of a method of the program and not of the user's text.
    bool is_built_in() const { return is_method_file(place.file); }
  };

  /// The new value of a variable.
  struct Assignment {
    std::size_t variable = 0;
    Formula value;
    Place place;
  };

  /// One map of a jump. It reads the states of its own component as the map before it left them and
  /// everything else as before the jump.
  struct Pass {
    std::vector<Assignment> map;
    bool repeats = false;
    std::optional<expr::Condition> until;  ///< checked before each pass; none: all of them
    std::optional<Formula> at_most;        ///< passes, a whole number of constants
    bool go_on = false;  ///< whether the run goes on when `until` does not become true
    Place place;
  };

  struct Reaction {
    std::size_t event = 0;
    std::size_t component = 0;
    std::vector<Pass> passes;
    Place place;
  };

  enum class NoiseKind {
    normal,     ///< center + z, z with the deviation or the covariance that is given
    lognormal,  ///< center .* exp(z)
    uniform,
    vertices,  ///< nothing is drawn: with all noises of this kind and the next, run k takes element
               ///< k, modulo their number, of the product of their lists; the first turns fastest
    corners  ///< the same of the corners of a box: elements of low or high, the first turns fastest
  };
  struct Noise {
    std::string name;
    NoiseKind kind = NoiseKind::normal;
    expr::Shape shape;
    /// normal, lognormal: the center and the deviation or covariance; uniform, corners: low, high;
    /// vertices: the list. Scalars or of its shape, of constants; a covariance is of a column.
    std::vector<Formula> values;
    bool covariance = false;
    std::optional<std::size_t> event;  ///< drawn anew at it, before its maps; none: see `every`
    std::optional<Formula> every;      ///< drawn anew after each such time; none: once a run
    Place place;

    bool has_center() const { return kind == NoiseKind::normal || kind == NoiseKind::lognormal; }
  };

  /// A quantity of which a file says the values. It and, of lines, its rate change at the rows,
  /// without a jump: a switch of the flow.
  struct Measured {
    std::string name;
    Between between = Between::hold;
    std::shared_ptr<const Series> series;
    bool output = false;               ///< shown by an output of the plant
    std::optional<std::size_t> event;  ///< at which alone it is sampled
    Place place;
  };

  /// A name for a value along a run, to be written, drawn or compared.
  struct Signal {
    std::string name;  ///< "y", "e", "nominal.e"
    Formula value;
    std::optional<std::size_t> at;  ///< the event at which alone it exists
    bool output = false;            ///< of the plant or of an observer
  };

  /// Of a method with a timer: where nothing says so, states start in the box [-1, 1], and a run
  /// lasts 40 of its longest lengths.
  bool has_timer = false;
  std::vector<Component> components;  ///< the plant first
  std::vector<Variable> variables;
  std::vector<Assignment> flow;
  std::vector<Event> events;  ///< in the order in which they are checked
  std::vector<Reaction> reactions;
  std::vector<Noise> noise;
  std::vector<Measured> measured;
  std::vector<Signal> signals;  ///< sinusoids, inputs, outputs of the components, then signals
};

}  // namespace gainsmith::model
