// Dynamics with one clock, and nothing else that makes a jump, whose flow is affine.
//
//   flow, while the timer tau runs down to 0:   x' = M x + b,  tau' = -1
//   jump, when tau = 0:                          x+ = g(x),     tau+ a length of the clock
//
// x stacks the states, in the order of the dynamics; tau is what is left of the clock; M and b are
// constant. Jump maps may be any expression that has a value in 100 digits.
#pragma once

#include <memory>
#include <vector>

#include "hybrid/state_layout.h"
#include "hybrid/system.h"

namespace gainsmith::linear {

/// One state's derivative, or its value after a jump, as a function of the whole state.
struct MapEntry {
  std::size_t slot = 0;
  expr::Program program;
};

struct SampledSystem {
  const hybrid::System* dynamics = nullptr;
  hybrid::StateLayout layout;         ///< the states, and the name of the timer
  std::vector<std::size_t> variable;  ///< of the dynamics, of each slot
  std::vector<MapEntry> flow;
  std::vector<MapEntry> jump;  ///< states that change; the others keep their value

  const numbers::Values& constants() const { return dynamics->constants; }
};

/// Whether what a program computes from the states can be followed in 100 digits: projections,
/// eigenvalues, solutions of Riccati equations and of flows, extrema, pseudo-inverses, bases and
/// determinants cannot.
bool has_wide_value(const expr::Program& program, const hybrid::StateLayout& layout);

/// The same dynamics in this form; none when they are of another kind. Of another kind are other
/// events, conditions, noise, measured data, modes, losses, and texts that ask for the time, branch
/// or have no value in 100 digits. The dynamics must outlive it.
std::unique_ptr<const SampledSystem> make_sampled_system(const hybrid::System& dynamics);

}  // namespace gainsmith::linear
