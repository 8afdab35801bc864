// Dynamics (model/dynamics.h) with values: what the event-driven simulator runs. Its texts call
// nothing: functions were replaced before (model/run_texts.h).
//
// All variables are stacked in one vector, in the order of the dynamics, columns of each below each
// other; behind them are the branches that the flow takes (switches.h). Inside a flow each
// variable does one of three things:
//
//   rests    counts, modes, noise, branches, states without a flow
//   steady   its rate is made of what rests: t, since, left, and states such as s' = q; its value
//            is start + rate*(t - start time), never integrated
//   flows    everything else
//
// The whole flow is affine when x' = M x + b with M and b made of what rests: then it is exact.
//
// This room turns dynamics into a hybrid system in the sense of Goebel, Sanfelice & Teel (Hybrid
// Dynamical Systems, 2012), and holds what all runs of it share:
//
//   flow   x' = f(x)      where the conditions `while` hold and no event is due
//   jump   x+ = g_k(x)    at event k, alone; of several due events the first in their order
//
// A solution is a hybrid arc x(t, j): j counts jumps, several may lie at one t (trajectory.h).
//
//   system, state_layout     values of the constants, places of the variables
//   switches, breaks         branches of flows and of other texts, and where they change
//   event_functions          conditions and crossings as functions of all values
//   rounding_terms           sizes of terms, for rounding errors
//   scenario, initial, law   horizon, initial states, sampling intervals, noise, random streams
//   zeno, trajectory         accumulation of jumps, and the solution itself
//   idle, doubts             what has no effect, and what is unlikely to be meant
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/double_double.h"
#include "hybrid/state_layout.h"
#include "hybrid/switches.h"
#include "hybrid/tolerances.h"
#include "model/dynamics.h"
#include "model/run_texts.h"

namespace gainsmith::hybrid {

/// What a variable does inside a flow.
enum class Moves { rests, steady, flows };

/// Invariants: layout.slots and moves have one element a variable, then one a switch; free_flow has
/// one an assignment of dynamics.flow; clocks and times have one an event.
struct System {
  /// Of an event with `every`.
  struct Clock {
    double low = 0;
    double high = 0;
    std::optional<std::pair<double, double>> first;  ///< none: one length after the start
  };

  /// Of one noise: normal, lognormal: the center and the map of its spread (initial.h); uniform: low
  /// and high; vertices and corners: the list, of which run k takes element k/stride modulo their
  /// number. All but the map of its shape.
  struct NoiseValues {
    std::vector<numbers::Matrix> values;
    std::uint64_t stride = 1;
    std::optional<double> every;
  };

  model::Dynamics dynamics;  ///< flows with fixed branches
  numbers::Values constants;
  /// The constants in 31 digits, from the decimals of their texts; none: they are not known.
  std::function<numbers::ValuesOf<DoubleDouble>()> in_31_digits;
  StateLayout layout;      ///< the variables, then the branches of the switches
  Eigen::Index size = 0;   ///< of the variables
  Eigen::Index whole = 0;  ///< of variables and branches
  std::vector<Switch> switches;
  /// By flow: its text as it is, where branches of it are fixed.
  std::vector<std::optional<expr::Program>> free_flow;
  std::vector<Moves> moves;                            ///< of each slot of the layout
  bool affine = false;                                 ///< the whole flow
  bool pulses = false;                                 ///< of clocks, in the flow (pulses.h)
  std::vector<std::optional<Clock>> clocks;            ///< by event
  std::vector<std::vector<double>> times;              ///< by event: of `at`, rising
  std::vector<NoiseValues> noise;                      ///< by noise
  std::vector<std::vector<std::int64_t>> most_passes;  ///< by reaction, of each of its maps

  /// Of a run, as a part of its horizon.
  double longest_step() const { return pulses ? kLongestOfPulses : kLongestStep; }
  /// The slot of a name, or none.
  std::optional<std::size_t> slot(const std::string& name) const { return layout.slot(name); }
  /// Whether no flow changes an element of the values.
  bool rests(Eigen::Index element) const;
  /// Whether a name is that of what changes within a flow.
  bool is_moving(const std::string& name) const;
  /// Whether an event happens at given times, drawn or not.
  bool has_clock(std::size_t event) const {
    const auto kind = dynamics.events[event].kind;
    return kind == model::Dynamics::EventKind::every || kind == model::Dynamics::EventKind::at;
  }
  /// "x(2)", "P(1, 2)" or "s".
  std::string element_name(Eigen::Index element) const;
  /// The value of a formula of constants. InputError, at its place, when it uses anything else.
  numbers::Matrix value(const model::Formula& formula) const;
  double scalar(const model::Formula& formula) const { return value(formula)(0, 0); }
};

/// InputError, at its place, for a text that uses what has no value and for numbers of passes that
/// are not whole. The same for a clock that is not 0 <= low <= high and high > 0.
System make_system(const model::Dynamics& dynamics, numbers::Values constants);

}  // namespace gainsmith::hybrid
