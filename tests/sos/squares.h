// What tests ask of polynomials without unknowns: whether they are sums of squares.
#pragma once

#include <algorithm>

#include "sos/decide.h"

namespace gainsmith::tests {

enum class Answer { yes, no, open };

/// Every equation of the program, with the values of the identity, has to hold; and Q >= 0.
inline bool holds(const sos::Program& program, const sos::Identity& identity) {
  const sos::Columns columns(program);
  for (const sos::Equation& equation : equations_of(program)) {
    Rational sum = 0;
    for (const auto& [column, c] : equation.terms) {
      if (!columns.is_element(column)) {
        sum += c * identity.free[static_cast<std::size_t>(column)];
        continue;
      }
      const sos::Columns::Place place = columns.place(column);
      sum += c * identity.grams[place.gram](place.row, place.column);
    }
    if (sum != equation.value) return false;
  }
  return std::all_of(identity.grams.begin(), identity.grams.end(), sos::is_shown_definite);
}

inline Answer ask(const sos::Statement& statement) {
  sos::Program program = sos::pose({statement}, 0);
  if (sos::reduce(program)) return Answer::no;
  const sos::Decision decision = sos::decide(program, {});
  if (decision.excluded) return Answer::no;
  if (!decision.u) return Answer::open;
  return holds(decision.program, decision.identity) ? Answer::yes : Answer::open;
}

}  // namespace gainsmith::tests
