#include "flights/flight_system.h"

#include <algorithm>

#include "flights/flight_claims.h"
#include "flights/flight_event.h"
#include "hybrid/tolerances.h"
#include "numbers/graph/scalar_rules.h"
#include "packs/pack_system.h"
#include "packs/tolerances.h"

namespace gainsmith::flights {

using model::ClaimKind;

namespace {

/// Where all rows end, the second run moved.
void add_ends(FlightGraph& graph, const FlightEnd& end, std::vector<Nodes>& results) {
  LaneTerms& is = graph.terms();
  FlightSeries& first = graph.first();
  const std::vector<int>& rows = graph.pack().rows;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t row = index(rows[k]);
    const FlightPair flight_pair = graph.pair(first.of_value(row), graph.second().of_value(row));
    const int size = first.at(flight_pair.first.size, end.length);
    const int move = graph.input(graph.made().move_of_row(k));
    results[FlightSystem::ends].push_back(first.at(flight_pair.first.value, end.length));
    results[FlightSystem::other_ends].push_back(
        is.add(first.at(flight_pair.second, end.other_length),
               is.part(packs::kMoved, is.times(size, move))));
  }
  for (std::size_t k = 0; k < graph.pack().whole; ++k) {
    const int size = first.at(first.of_value(k).size, end.length);
    results[FlightSystem::largest].push_back(size);
    graph.require(is.minus(is.number(hybrid::kLargestState), size));
  }
}

/// The order matters: the end of the flight is found first, since claims are compared up to it. The
/// fields of claims are fed back to their inputs, so that they carry over from flight to flight.
void make_code(const PackSystem& pack, const std::vector<claims::Claim>& claims,
               FlightSystem& made) {
  made.whole = pack.whole;
  made.rows = pack.rows.size();
  made.claims = pack.claims.size();
  for (std::size_t e = 0; e < pack.events.size(); ++e)
    if (pack.events[e].crossing) made.crossings.push_back(e);
  for (const PackClaim& claim : pack.claims)
    made.places.push_back(places_of(claim, made.fields_in_all));
  FlightGraph graph(pack, made);
  const FlightEnd end = find_end(graph);
  std::vector<Nodes> results(FlightSystem::results);
  std::size_t number = 0;
  for (const claims::Claim& claim : claims)
    if (claim.stated())
      add_claim(graph, claim, number++, end.length, results[FlightSystem::fields]);
  add_ends(graph, end, results);
  const int later = graph.terms().minus(end.other_length, end.length);
  results[FlightSystem::flight] = {end.length, later, end.event, graph.ok()};
  for (const std::size_t e : made.crossings)
    results[FlightSystem::sides_after].push_back(end.sides[pack.events[e].crossing->watch]);
  std::optional<std::uint32_t> fed_back;
  if (made.claims > 0) fed_back = static_cast<std::uint32_t>(made.limit_of(made.claims));
  made.code.emplace(graph.nodes(), results, made.all_inputs(), fed_back);
}

/// What flights leave to steps whatever the texts are.
/// Plain are systems with events by conditions or crossings alone, without clocks, noise, costs,
/// kinks, branches and lost events. Claims with `after`, a tolerance or a cost are left to steps
/// too.
bool may_fly(const PackSystem& pack, const std::vector<claims::Claim>& claims) {
  const model::Dynamics& dynamics = pack.system->dynamics;
  const bool has_branches = std::any_of(pack.watches.begin(), pack.watches.end(),
                                        [](const Watch& watch) { return !watch.branches.empty(); });
  const bool is_plain =
      std::all_of(pack.events.begin(), pack.events.end(), [](const PackEvent& event) {
        return (event.when || event.crossing) && !event.only_if && !event.lost;
      });
  constexpr std::size_t most_events = 64;
  return is_plain && !pack.events.empty() && pack.events.size() <= most_events && !has_branches &&
         pack.kinks.empty() && pack.flats.empty() && pack.costs.empty() && dynamics.noise.empty() &&
         !pack.system->pulses &&
         std::none_of(claims.begin(), claims.end(), [](const claims::Claim& claim) {
           return claim.stated() &&
                  (claim.after > 0 || claim.tolerance > 0 || claim.kind == ClaimKind::cost ||
                   (claim.kind == ClaimKind::shrinks && claim.over));
         });
}

}  // namespace

std::optional<FlightSystem> make_flights(const PackSystem& pack,
                                         const std::vector<claims::Claim>& claims) {
  if (!may_fly(pack, claims)) return std::nullopt;
  FlightSystem made;
  try {
    make_code(pack, claims, made);
  } catch (const numbers::NoFormula&) {
    return std::nullopt;
  }
  return made;
}

}  // namespace gainsmith::flights
