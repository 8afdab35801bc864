#include "flights/flight_event.h"

#include <algorithm>

#include "flights/tolerances.h"
#include "hybrid/tolerances.h"
#include "numbers/graph/scalar_rules.h"
#include "packs/pack_system.h"

namespace gainsmith::flights {

using model::Dynamics;

namespace {

/// Later than any event; the end of the flight is then the horizon.
constexpr double kNoTime = 1e300;
/// The most roots of all watches together, as the conditions of all events are evaluated at each.
constexpr std::size_t kMostRoots = 8;

/// Whether something is certainly so, and whether it may be.
struct Certainty {
  int certain = 0, possible = 0;
};

/// On which side of 0 a watch is just after a moment, and whether that is certain.
struct Side {
  int sign = 0, known = 0;
};

/// Finds the end of one flight, as nodes: all candidates are computed in all lanes, and the
/// earliest one at which an event may be due is picked.
class EventFinder {
 public:
  explicit EventFinder(FlightGraph& graph)
      : graph_(graph),
        pack_(graph.pack()),
        made_(graph.made()),
        is_(graph.terms()),
        first_(graph.first()) {
    for (const Watch& watch : pack_.watches)
      watches_.push_back(graph.pair(first_.of(*watch.of, watch.element_of),
                                    graph.second().of(*watch.of, watch.element_of)));
  }

  FlightEnd find() {
    find_sides();
    return find_event();
  }

 private:
  // --- Sides and roots. ---

  /// Just after the start. What is 0 within its error is on the side to which it moves.
  void find_sides() {
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      const FlightPair& watch = watches_[w];
      const int value = watch.first.value[0];
      if (!pack_.watches[w].moves) {
        const int other = watch.second[0];
        const int same = is_.is_positive(is_.times(value, other));
        graph_.require_true(
            is_.either(same, is_.both(is_.is_equal(value, 0), is_.is_equal(other, 0))));
        rests_.push_back(value);
        sides_.push_back({is_.sign(value), is_.number(1)});
        near_0_.push_back(is_.number(0));
        continue;
      }
      rests_.push_back(-1);
      const int error = graph_.error_of(watch, 0);
      const int clear = is_.is_positive(is_.minus(is_.abs(value), error));
      near_0_.push_back(is_.no(clear));
      int side = is_.sign(value);
      if (watch.first.degree() > 0) {
        const int rate = watch.first.value[1];
        const int leaves = is_.is_positive(is_.minus(is_.abs(rate), graph_.error_of(watch, 1)));
        side = is_.pick(clear, side, is_.sign(rate));
        graph_.require_true(is_.either(clear, leaves));
      } else {
        graph_.require_true(clear);
      }
      sides_.push_back({side, is_.number(1)});
    }
  }

  /// A root of a watch; a time below 0: none.
  struct Candidate {
    int time = 0;
    int rate = 0;   ///< of the watch there
    int other = 0;  ///< the watch there in the second run
    std::size_t watch = 0;
  };

  /// The rate c_1 + 2 c_2 s at the root, and what the second run has there: its own root is
  /// other/rate earlier, to first order.
  Candidate candidate(int time, std::size_t w) {
    const Nodes& c = watches_[w].first.value;
    int rate = is_.number(0);
    if (c.size() > 1) rate = c[1];
    if (c.size() > 2) rate = is_.add(rate, is_.part(2, is_.times(c[2], time)));
    return {time, rate, first_.at(watches_[w].second, time), w};
  }

  /// A discriminant within its error of 0 may be a touch, which is left open. The error is the
  /// first-order effect of the errors of c_0, c_1 and c_2, and kTouches of its terms.
  void add_candidates(std::size_t w, std::vector<Candidate>& candidates) {
    const FlightPair& watch = watches_[w];
    const std::size_t degree = watch.first.degree();
    if (!pack_.watches[w].moves || degree == 0) return;
    if (degree > 2) throw numbers::NoFormula();
    const int none = is_.number(-1);
    if (degree == 1) {
      const int root = is_.quotient(is_.minus(watch.first.value[0]), watch.first.value[1], -1);
      candidates.push_back(candidate(is_.pick(near_0_[w], none, root), w));
      return;
    }
    const Nodes& c = watch.first.value;
    const int discriminant = is_.minus(is_.times(c[1], c[1]), is_.part(4, is_.times(c[0], c[2])));
    const int size = is_.add(is_.times(c[1], c[1]), is_.part(4, is_.abs(is_.times(c[0], c[2]))));
    const int error =
        is_.add(is_.part(2, is_.times(is_.abs(c[1]), graph_.error_of(watch, 1))),
                is_.part(4, is_.add(is_.times(is_.abs(c[0]), graph_.error_of(watch, 2)),
                                    is_.times(is_.abs(c[2]), graph_.error_of(watch, 0)))));
    const int margin = is_.add(error, is_.part(kTouches, size));
    const int has_roots = is_.is_positive(is_.minus(discriminant, margin));
    // What may touch 0 is left open. What starts at 0 has its other root far from that.
    graph_.require_true(is_.either(is_.either(has_roots, near_0_[w]),
                                   is_.is_positive(is_.minus(is_.minus(discriminant), margin))));
    const int q = is_.part(-0.5, is_.add(c[1], is_.times(is_.sign(c[1]), is_.root(discriminant))));
    const int has_any = is_.either(has_roots, near_0_[w]);
    candidates.push_back(candidate(is_.pick(has_any, is_.quotient(q, c[2], -1), none), w));
    // Of what starts at 0 the other root is the start.
    const int has_both = is_.both(has_roots, is_.no(near_0_[w]));
    candidates.push_back(candidate(is_.pick(has_both, is_.quotient(c[0], q, -1), none), w));
  }

  /// The sides just after a root.
  std::vector<Side> sides_after(const Candidate& one) {
    std::vector<Side> sides;
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      const FlightPair& watch = watches_[w];
      if (!pack_.watches[w].moves) {
        sides.push_back(sides_[w]);
        continue;
      }
      if (w == one.watch) {
        sides.push_back({is_.sign(one.rate), is_.number(1)});
        continue;
      }
      // Its error there, and what it changes by between the roots of both runs; times the rate.
      const Candidate at = candidate(one.time, w);
      const int value = first_.at(watch.first.value, one.time);
      const int error =
          is_.add(is_.part(kErrorOfFlights, is_.abs(is_.minus(value, at.other))),
                  is_.part(hybrid::kTermRounding, first_.at(watch.first.size, one.time)));
      const int later = is_.part(kErrorOfFlights, is_.abs(is_.times(at.rate, one.other)));
      const int clear = is_.minus(is_.abs(value), error);
      sides.push_back({is_.sign(value),
                       is_.is_positive(is_.minus(is_.times(clear, is_.abs(one.rate)), later))});
    }
    return sides;
  }

  /// Certain: true for all sides that are not known. Possible: true for some of them, part by part.
  Certainty truth(const WatchedCondition& condition, const std::vector<Side>& sides) {
    using Kind = expr::Condition::Kind;
    const int one = is_.number(1);
    const int zero = is_.number(0);
    if (condition.kind == Kind::none) {
      const Certainty inner = truth(condition.parts.front(), sides);
      return {is_.no(inner.possible), is_.no(inner.certain)};
    }
    if (condition.kind == Kind::any) {
      Certainty made{zero, zero};
      for (const WatchedCondition& part : condition.parts) {
        const Certainty inner = truth(part, sides);
        made = {is_.either(made.certain, inner.certain), is_.either(made.possible, inner.possible)};
      }
      return made;
    }
    Certainty made{one, one};
    for (const WatchedCondition& part : condition.parts) {
      const Certainty inner = truth(part, sides);
      made = {is_.both(made.certain, inner.certain), is_.both(made.possible, inner.possible)};
    }
    for (const Watched& element : condition.elements) {
      if (!pack_.watches[element.watch].moves) {
        const int value = is_.part(element.factor, rests_[element.watch]);
        const int holds = condition.kind == Kind::positive      ? is_.is_positive(value)
                          : condition.kind == Kind::nonnegative ? is_.is_at_least_0(value)
                                                                : is_.is_equal(value, 0);
        made = {is_.both(made.certain, holds), is_.both(made.possible, holds)};
        continue;
      }
      const Side& side = sides[element.watch];
      const int holds = is_.is_positive(is_.part(element.factor, side.sign));
      made = {is_.both(made.certain, is_.both(holds, side.known)),
              is_.both(made.possible, is_.either(holds, is_.no(side.known)))};
    }
    return made;
  }

  // --- The event that ends the flight. ---

  /// Requires that nothing is due at the start, that flow sets hold there, and that the event which
  /// may come first is sure. No root may be near the horizon, and both runs have nearly one root
  /// (kApart).
  FlightEnd find_event() {
    FlightEnd end{0, 0, is_.number(-1), {}};
    std::vector<Side> at_start = sides_;
    for (std::size_t w = 0; w < at_start.size(); ++w) at_start[w].known = is_.no(near_0_[w]);
    for (std::size_t e = 0; e < pack_.events.size(); ++e) {
      const PackEvent& event = pack_.events[e];
      if (event.when) graph_.require_true(is_.no(truth(*event.when, at_start).possible));
      if (event.crossing) require_no_crossing(e);
    }
    for (const WatchedCondition& set : pack_.flow_sets)
      graph_.require_true(truth(set, sides_).certain);
    std::vector<Candidate> candidates;
    for (std::size_t w = 0; w < watches_.size(); ++w) add_candidates(w, candidates);
    if (candidates.size() > kMostRoots) throw numbers::NoFormula();
    int first = is_.number(kNoTime), other = is_.number(0), rate = is_.number(1);
    int sure = is_.number(0);
    for (const Side& side : sides_) end.sides.push_back(side.sign);
    for (const Candidate& candidate : candidates) {
      const std::vector<Side> sides = sides_after(candidate);
      Due due = due_at(candidate, sides);
      const int is_before = is_.is_positive(is_.minus(first, candidate.time));
      const int takes =
          is_.both(is_.is_positive(candidate.time), is_.both(is_before, due.possible));
      first = is_.pick(takes, candidate.time, first);
      other = is_.pick(takes, candidate.other, other);
      rate = is_.pick(takes, candidate.rate, rate);
      sure = is_.pick(takes, due.sure, sure);
      end.event = is_.pick(takes, due.event, end.event);
      for (std::size_t w = 0; w < sides.size(); ++w)
        end.sides[w] = is_.pick(takes, sides[w].sign, end.sides[w]);
    }
    const int rest = graph_.input(FlightSystem::rest);
    const int ends = is_.is_positive(is_.minus(first, rest));  // at the horizon
    graph_.require_true(is_.either(ends, sure));
    graph_.require(is_.minus(is_.abs(is_.minus(first, rest)),
                             is_.number(hybrid::kHardly * pack_.scenario->horizon)));
    end.event = is_.pick(ends, is_.number(-1), end.event);
    end.length = is_.pick(ends, rest, first);
    // The root of the second run by Newton's method: both are near each other, as is required.
    end.other_length =
        is_.minus(end.length, is_.pick(ends, is_.number(0), is_.quotient(other, rate, 0)));
    graph_.require(
        is_.minus(is_.part(kApart, end.length), is_.abs(is_.minus(end.other_length, end.length))));
    return end;
  }

  /// Neither the start nor a jump of another event has led through 0 in its direction.
  void require_no_crossing(std::size_t e) {
    const Watched& crossing = *pack_.events[e].crossing;
    const auto found = std::find(made_.crossings.begin(), made_.crossings.end(), e);
    const int before =
        graph_.input(made_.side_before(static_cast<std::size_t>(found - made_.crossings.begin())));
    const int own =
        is_.either(graph_.input(FlightSystem::fresh),
                   is_.is_equal(graph_.input(FlightSystem::jumped), static_cast<double>(e)));
    const int same = is_.is_positive(is_.times(before, sides_[crossing.watch].sign));
    // What starts at 0 and leaves it in the direction of the event is unusual.
    const int away =
        is_.either(is_.no(near_0_[crossing.watch]), is_.no(wanted(e, sides_[crossing.watch].sign)));
    graph_.require_true(is_.both(is_.either(own, same), away));
  }

  /// Whether an event waits for a crossing to this side.
  int wanted(std::size_t e, int side) {
    using Kind = Dynamics::EventKind;
    const Kind kind = pack_.system->dynamics.events[e].kind;
    if (kind == Kind::crosses) return is_.number(1);
    const int own = is_.part(pack_.events[e].crossing->factor, side);
    return is_.is_positive(kind == Kind::rises ? own : is_.minus(own));
  }

  struct Due {
    int possible = 0, sure = 0, event = 0;
  };
  /// The first event that may be due, and whether it is. A flow set that is left is none.
  Due due_at(const Candidate& candidate, const std::vector<Side>& sides) {
    Due due{is_.number(0), is_.number(0), is_.number(-1)};
    const auto add = [&](const Certainty& is, double event) {
      const int is_new = is_.both(is_.no(due.possible), is.possible);
      due.sure = is_.pick(is_new, is.certain, due.sure);
      due.event = is_.pick(is_new, is_.number(event), due.event);
      due.possible = is_.either(due.possible, is.possible);
    };
    for (std::size_t e = 0; e < pack_.events.size(); ++e) {
      const PackEvent& event = pack_.events[e];
      if (event.when) add(truth(*event.when, sides), static_cast<double>(e));
      if (event.crossing && event.crossing->watch == candidate.watch) {
        const int is = wanted(e, sides[candidate.watch].sign);
        const int is_second = is_.both(due.possible, is);
        add({is, is}, static_cast<double>(e));
        // Whether it happens after the jump of another event is left to steps.
        due.sure = is_.pick(is_second, is_.number(0), due.sure);
      }
    }
    for (const WatchedCondition& set : pack_.flow_sets)
      add({is_.number(0), is_.no(truth(set, sides).certain)}, -1);
    // What crosses 0 at nearly the same time may come first.
    for (const std::size_t e : made_.crossings)
      due.sure = is_.both(due.sure, sides[pack_.events[e].crossing->watch].known);
    return due;
  }

  FlightGraph& graph_;
  const PackSystem& pack_;
  FlightSystem& made_;
  LaneTerms& is_;
  FlightSeries& first_;
  std::vector<FlightPair> watches_;
  Nodes rests_;              ///< by watch: its value, of what does not move
  std::vector<Side> sides_;  ///< just after the start
  Nodes near_0_;             ///< by watch: whether it starts as 0, within its error
};

}  // namespace

FlightEnd find_end(FlightGraph& graph) { return EventFinder(graph).find(); }

}  // namespace gainsmith::flights
