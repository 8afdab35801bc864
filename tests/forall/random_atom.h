// Random functions of the kind that atoms are.
#pragma once

#include <cmath>
#include <random>

#include "forall/atoms.h"

namespace gainsmith::forall::testing {

/// t^k exp(a t) cos(b t) or sin(b t) with k below 3 and |a|, |b| below 2, each absent half the
/// time.
inline Atom random_atom(std::mt19937& generator) {
  std::uniform_real_distribution<double> number(-2, 2);
  Atom atom;
  atom.power = static_cast<int>(generator() % 3);
  atom.rate = generator() % 2 == 0 ? 0 : number(generator);
  atom.frequency = generator() % 2 == 0 ? 0 : std::abs(number(generator));
  atom.sine = atom.frequency != 0 && generator() % 2 == 0;
  return atom;
}

}  // namespace gainsmith::forall::testing
