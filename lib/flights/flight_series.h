// Values of a System as polynomials of time along a flow, where they are.
//
//   x_k(s) = sum_j c_kj s^j from s = 0 on,  by Picard's iteration x <- x(0) + int f(x) ds
//
// It ends where the flow is nilpotent: bodies in free fall, double integrators, clocks, constant
// rates. Beside each coefficient is the size of the terms that it is the sum of.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "packs/pack_graph.h"

namespace gainsmith::flights {

using packs::index;
using packs::Nodes;
using packs::PackGraph;

/// A polynomial in the time s since the start of a flight, as nodes. `size` of a coefficient is the
/// sum of the absolute values of its terms, by which rounding is measured.
struct Series {
  Nodes value;  ///< coefficients of 1, s, s^2, ...
  Nodes size;   ///< of their terms; none where sizes are not asked for

  std::size_t degree() const { return value.size() - 1; }
  bool operator==(const Series&) const = default;
};

/// The values of one run along a flight, as polynomials whose coefficients are nodes over the
/// inputs.
class FlightSeries {
 public:
  static constexpr std::size_t most_degree = 5;

  /// `x`: nodes of all values at s = 0, all of them inputs or constants; the texts must outlive it.
  /// NoFormula (numbers/graph/scalar_rules.h) where a value is no polynomial of this degree.
  FlightSeries(PackGraph& texts, const Nodes& x, bool sizes);

  /// Of value k.
  const Series& of_value(std::size_t k) const { return values_[k]; }
  /// Of an element of a program.
  Series of(const expr::Program& program, std::size_t element = 0) {
    return of_node(texts_.value(program, x_).value[element]);
  }

  /// Of a node that is made of the values.
  /// It is computed once for each node.
  Series of_node(int node);
  /// Its value, and the size of its terms, at s.
  int at(const Nodes& coefficients, int s);

 private:
  void begin();
  Series constant(int node);
  Series made_of(int node);
  Series combined(const Series& a, const Series& b, bool negated);
  Series product(const Series& a, const Series& b);
  Series scaled(const Series& a, int factor, int size);
  Series chosen(const numbers::ScalarGraph::Node& one);
  Series integral(int start, const Series& rate);
  void trim(Series& series);

  PackGraph& texts_;
  numbers::ScalarGraph& graph_;
  Nodes x_;
  bool sizes_;
  std::vector<Series> values_;
  std::map<int, Series> known_;
};

}  // namespace gainsmith::flights
