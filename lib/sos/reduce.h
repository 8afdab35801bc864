// What the equations of a program say by themselves, without a solver.
//
// Where an equation says that a sum of positive multiples of diagonal elements of Gram matrices is
// 0, these are 0 in every solution, and so are their rows (facial reduction, Borwein & Wolkowicz
// 1981, by plain steps). Where the sum is to be negative, there is no solution. Without
// multipliers, full bases of monomials become those of half the Newton polytope by these steps.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sos/program.h"

namespace gainsmith::sos {

/// An equation that nothing satisfies.
struct Contradiction {
  Key key;
  std::string why;            ///< "is -3, and a sum of squares has none below 0 there"
  std::map<int, Key> told{};  ///< unknowns whose values other equations had told
};

/// Removes the rows that are 0 in every solution from the bases; a contradiction where there is no
/// solution, for a strict inequality also where a constant is no square of its basis.
std::optional<Contradiction> reduce(Program& program);

/// An equation that says what one of its unknowns is.
struct Pivot {
  int column = 0;
  Equation equation;

  /// Removes the column from another.
  void put_into(Equation& other) const;
};

/// The equations without u and t, each of which has been put into the others by one that has it.
struct Eliminated {
  std::vector<Equation> equations;  ///< of elements of Gram matrices alone, none empty
  /// Each has its column and elements, and columns that later pivots have.
  std::vector<Pivot> pivots;
  std::vector<int> left;  ///< columns that nothing determines: 0
  std::optional<Contradiction> contradiction;

  /// A sum over all columns, over elements alone; none where it has a column that is left.
  std::optional<Equation> without_free(Equation sum) const;
};

/// `equations`: of the program, and others over its columns.
Eliminated eliminate(const Program& program, std::vector<Equation> equations);

}  // namespace gainsmith::sos
