// What the parts of the code of a flight (flight_system.h) have in common: the graph, the values of
// both runs as polynomials, and what has to be so.
#pragma once

#include "flights/flight_series.h"
#include "flights/flight_system.h"
#include "flights/lane_terms.h"

namespace gainsmith::flights {

/// A polynomial in both runs, of the time since the start of a flight of the first.
struct FlightPair {
  Series first;
  Nodes second;
};

/// One graph for the whole flight: the texts, both runs, and one truth value `ok` that collects all
/// that has to be certain.
class FlightGraph {
 public:
  /// All must outlive it. NoFormula (numbers/graph/scalar_rules.h) where values are no polynomials.
  FlightGraph(const PackSystem& pack, FlightSystem& made);

  const PackSystem& pack() const { return pack_; }
  FlightSystem& made() { return made_; }
  numbers::ScalarGraph& nodes() { return texts_.graph(); }
  LaneTerms& terms() { return is_; }
  /// Of the first run, with the sizes of terms; of the second.
  FlightSeries& first() { return first_; }
  FlightSeries& second() { return second_; }

  int input(std::size_t position) { return texts_.graph().input(static_cast<int>(position)); }
  int input(FlightSystem::Input which) { return input(made_.at(which)); }
  /// The flight is ok where all of it is so. What is positive is required; what is true.
  void require(int node) { require_true(is_.is_positive(node)); }
  void require_true(int truth) { ok_ = is_.both(truth, ok_); }
  int ok() const { return ok_; }

  /// The second run is moved back to the time of the first, to first order.
  FlightPair pair(const Series& first, const Series& second);
  /// How far coefficient j may be from the true one.
  int error_of(const FlightPair& pair, std::size_t j);

 private:
  Nodes second_inputs();

  const PackSystem& pack_;
  FlightSystem& made_;
  PackGraph texts_;
  LaneTerms is_;
  FlightSeries first_, second_;
  int ok_ = 0;
};

}  // namespace gainsmith::flights
