// The quintic of a function over a step, as a lane computes it.
#pragma once

#include "packs/quintics.h"

namespace gainsmith::packs {

template <class Value, class Rate>
pieces::StepPolynomial polynomial_through(const Value& value, const Rate& rate, double from,
                                          double length) {
  static const lanes::LaneCode code = StepPolynomials::code(1);
  lanes::LaneMachine machine(code);
  const double middle = from + length / 2, end = from + length;
  const double inputs[] = {length,
                           value(from),
                           rate(from),
                           value(middle),
                           rate(middle),
                           value(end),
                           rate(end),
                           value(from + length / 4),
                           value(from + 3 * length / 4)};
  constexpr std::size_t lane = 3;
  std::size_t next = 0;
  for (const double one : inputs) machine.input(next++)[lane] = one;
  machine.run();
  return quintic(machine, 0, lane);
}

}  // namespace gainsmith::packs
