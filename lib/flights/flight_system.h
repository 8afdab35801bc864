// A whole flight as code over lanes: from a start or a jump to the next event or the horizon, in
// closed form, where the values of a PackSystem are polynomials of time (flight_series.h) and what
// decides about events has degree 2 at most: balls, double integrators, tanks with constant flows.
//
//   x(s) = sum_j c_j s^j,   s* = the first root of a watch after which an event is due
//
// A run is made twice. The second is moved after each flight by up to kMoved of the size of all
// terms, at random, and at jumps (packs/moves.h). It has roots of its own. What both differ by,
// times kErrorOfFlights, and the rounding of terms is the error of a value. A flight is *ok* where
// all signs, the order of events and the comparisons of claims are certain by that. Otherwise the
// run is left to steps (packs/lane_set.h).
//
// Inputs, in this order: the values of the first run, then of the second; then as `Input` says; a
// move in [-1, 1) for each of the rows; of each claim its limit (ClaimLane) and its fields so far.
// Result 0: the fields of all claims; then as `Result` says.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "claims/claims.h"
#include "lanes/machine.h"
#include "packs/pack_system.h"

namespace gainsmith::flights {

using packs::PackClaim;
using packs::PackEvent;
using packs::PackSystem;
using packs::Watch;
using packs::Watched;
using packs::WatchedCondition;

/// The code of a flight and where its inputs and results are. It is made once and read by all
/// threads.
struct FlightSystem {
  enum Input : std::size_t {
    shift,   ///< how much later the root of the second run was, before the last jump
    rest,    ///< to the horizon
    fresh,   ///< 1 at the start of a run, otherwise 0
    jumped,  ///< the event that has jumped; -1: none
    inputs
  };
  enum Result : std::size_t {
    fields,
    ends,         ///< of the rows, in the first run, before a jump
    other_ends,   ///< in the second
    largest,      ///< along the flight, of all values
    flight,       ///< as Flight says
    sides_after,  ///< of the watches of crossings, at the end
    results
  };
  enum Flight : std::size_t { length, later, event, ok };
  /// Of a claim, with the sign that it is compared with: those that its kind asks for.
  enum Field : std::size_t {
    peak,  ///< the largest value so far
    violated,
    first,
    first_error,
    low,
    low_error,
    high,
    high_error,
    floor,  ///< ClaimLane::floor
    last,   ///< at the end of the flight; over jumps after the last
    last_error,
    seen,  ///< 1 once the claim is made
    fields_of_claim
  };
  /// Of each field its place among those of all claims; -1: the claim has none.
  using Places = std::array<int, fields_of_claim>;

  /// Values of the system, values that move, claims that are stated.
  std::size_t whole = 0, rows = 0, claims = 0;
  std::vector<std::size_t> crossings;  ///< the events with one
  std::vector<Places> places;          ///< by claim
  std::size_t fields_in_all = 0;
  std::optional<lanes::LaneCode> code;

  /// Positions of inputs: of `Input`, of the move of row k, of a limit, of a field of a claim, and
  /// of the side that a crossing had before.
  std::size_t at(Input input) const { return 2 * whole + input; }
  std::size_t move_of_row(std::size_t k) const { return 2 * whole + inputs + k; }
  std::size_t limit_of(std::size_t claim) const { return 2 * whole + inputs + rows + claim; }
  bool has(std::size_t claim, Field field) const { return places[claim][field] >= 0; }
  std::size_t field_of(std::size_t claim, Field field) const {
    return limit_of(claims) + static_cast<std::size_t>(places[claim][field]);
  }
  std::size_t side_before(std::size_t crossing) const {
    return limit_of(claims) + fields_in_all + crossing;
  }
  /// How many inputs the code has.
  std::size_t all_inputs() const { return side_before(crossings.size()); }
};

/// None where the system or a claim is of another kind. All arguments are those of the PackSystem.
std::optional<FlightSystem> make_flights(const PackSystem& pack,
                                         const std::vector<claims::Claim>& claims);

}  // namespace gainsmith::flights
