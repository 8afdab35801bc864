#include "flights/flight_graph.h"

#include "flights/tolerances.h"
#include "hybrid/tolerances.h"
#include "packs/pack_system.h"

namespace gainsmith::flights {

FlightGraph::FlightGraph(const PackSystem& pack, FlightSystem& made)
    : pack_(pack),
      made_(made),
      texts_(*pack.system, pack.costs),
      is_(texts_.graph()),
      first_(texts_, texts_.inputs(), true),
      second_(texts_, second_inputs(), false),
      ok_(is_.number(1)) {}

/// The values of the second run are the inputs behind those of the first.
Nodes FlightGraph::second_inputs() {
  Nodes x;
  for (std::size_t k = 0; k < pack_.whole; ++k)
    x.push_back(input(pack_.whole + index(texts_.kept(static_cast<int>(k)))));
  return x;
}

/// q(s - shift) to first order: the coefficients q_j - (j + 1) shift q_{j+1}. The second run began
/// its flight `shift` later, as its root was later.
FlightPair FlightGraph::pair(const Series& first, const Series& second) {
  FlightPair made{first, second.value};
  const int shift = input(FlightSystem::shift);
  for (std::size_t j = 0; j + 1 < made.second.size(); ++j)
    made.second[j] =
        is_.minus(second.value[j],
                  is_.times(is_.part(static_cast<double>(j + 1), shift), second.value[j + 1]));
  made.second.resize(made.first.value.size(), is_.number(0));
  return made;
}

/// kErrorOfFlights |p_j - q_j| + kTermRounding size_j.
int FlightGraph::error_of(const FlightPair& flight_pair, std::size_t j) {
  const int apart = is_.abs(is_.minus(flight_pair.first.value[j], flight_pair.second[j]));
  return is_.add(is_.part(kErrorOfFlights, apart),
                 is_.part(hybrid::kTermRounding, flight_pair.first.size[j]));
}

}  // namespace gainsmith::flights
