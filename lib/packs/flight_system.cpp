#include "packs/flight_system.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/unit_roundoff.h"
#include "claims/tolerances.h"
#include "expr/square_of_norm.h"
#include "hybrid/tolerances.h"
#include "numbers/scalar_rules.h"
#include "packs/flight_series.h"
#include "packs/pack_system.h"
#include "packs/tolerances.h"

namespace gainsmith::packs {

using lanes::LaneCode;
using model::ClaimKind;
using model::Dynamics;
using numbers::NoFormula;
using numbers::ScalarGraph;
using numbers::ScalarOp;

namespace {

/// Operations on nodes. What is true is 1, what is false 0; a number that is none is not positive.
/// A test that only picks takes no operation of its own.
class Terms {
 public:
  explicit Terms(ScalarGraph& graph) : graph_(graph) {}

  int number(double value) { return graph_.constant(value); }
  int add(int a, int b) { return graph_.add(a, b); }
  int minus(int a, int b) { return graph_.subtract(a, b); }
  int minus(int a) { return graph_.negate(a); }
  int times(int a, int b) { return graph_.multiply(a, b); }
  int part(double a, int b) { return graph_.multiply(number(a), b); }
  int abs(int a) { return graph_.apply(ScalarOp::abs, a); }
  int most(int a, int b) { return graph_.apply(ScalarOp::maximum, a, b); }
  int root(int a) { return graph_.apply(ScalarOp::sqrt, most(a, number(0))); }
  /// a/b; `otherwise` where b is 0.
  int quotient(int a, int b, double otherwise) {
    const int is = is_positive(abs(b));
    return pick(is, graph_.divide(a, pick(is, b, number(1))), number(otherwise));
  }
  int sign(int a) { return pick(is_positive(a), number(1), number(-1)); }

  int is_positive(int a) { return graph_.where(true, a, number(1), number(0)); }
  int is_at_least_0(int a) { return graph_.where(false, a, number(1), number(0)); }
  int is_equal(int a, double b) { return no(is_positive(abs(minus(a, number(b))))); }
  int no(int a) { return pick(a, number(0), number(1)); }
  int both(int a, int b) { return a == b ? a : pick(a, b, number(0)); }
  int either(int a, int b) { return a == b ? a : pick(a, number(1), b); }
  /// What is true picks the first.
  int pick(int is, int a, int b) {
    if (a == b) return a;
    if (graph_.is_constant(is)) return graph_.value(is) > 0 ? a : b;
    const ScalarGraph::Node test = graph_.nodes()[index(is)];
    const bool strict = test.op == ScalarOp::where_positive;
    if (!strict && test.op != ScalarOp::where_nonnegative) return graph_.where(true, is, a, b);
    const auto is_number = [&](int node, double value) {
      return graph_.is_constant(node) && graph_.value(node) == value;
    };
    if (is_number(test.b, 1) && is_number(test.c, 0)) return graph_.where(strict, test.a, a, b);
    if (is_number(test.b, 0) && is_number(test.c, 1)) return graph_.where(strict, test.a, b, a);
    return graph_.where(true, is, a, b);
  }

 private:
  ScalarGraph& graph_;
};

constexpr double never = 1e300;
/// Of all watches: each asks for all conditions.
constexpr std::size_t most_roots = 8;
/// Of a flight, to see how large a claim of degree 3 to 5 becomes.
constexpr int kHalvings = 2;

/// A polynomial in both runs, from the start of a flight of the first on.
struct Pair {
  Series first;
  Nodes second;
};

/// Whether something is certainly so, and whether it may be.
struct Certainty {
  int certain = 0, possible = 0;
};

/// On which side of 0 a watch is just after a moment, and whether that is certain.
struct Side {
  int sign = 0, known = 0;
};

class FlightCode {
 public:
  FlightCode(const PackSystem& pack, FlightSystem& made)
      : pack_(pack),
        made_(made),
        texts_(*pack.system, pack.costs),
        graph_(texts_.graph()),
        is_(graph_),
        first_(texts_, texts_.inputs(), true),
        second_(texts_, second_inputs(), false) {
    made_.whole = pack.whole;
    made_.rows = pack.rows.size();
    made_.claims = pack.claims.size();
    for (std::size_t e = 0; e < pack.events.size(); ++e)
      if (pack.events[e].crossing) made_.crossings.push_back(e);
    for (const PackClaim& claim : pack.claims) place_fields(claim.kind);
    ok_ = is_.number(1);
    shift_ = input(made_.at(FlightSystem::shift));
  }

  void make(const std::vector<claims::Claim>& claims) {
    for (const Watch& watch : pack_.watches)
      watches_.push_back(
          pair(first_.of(*watch.of, watch.element_of), second_.of(*watch.of, watch.element_of)));
    find_sides();
    find_event();
    std::size_t c = 0;
    std::vector<Nodes> results(FlightSystem::results);
    for (const claims::Claim& claim : claims)
      if (claim.stated()) judge(claim, c++, results[FlightSystem::fields]);
    for (std::size_t k = 0; k < pack_.rows.size(); ++k) {
      const Pair row =
          pair(first_.of_value(index(pack_.rows[k])), second_.of_value(index(pack_.rows[k])));
      const int size = first_.at(row.first.size, length_);
      const int moved = is_.part(kMoved, is_.times(size, input(made_.sign_of_row(k))));
      results[FlightSystem::ends].push_back(first_.at(row.first.value, length_));
      results[FlightSystem::other_ends].push_back(
          is_.add(first_.at(row.second, other_length_), moved));
    }
    for (std::size_t k = 0; k < pack_.whole; ++k) {
      const int size = first_.at(first_.of_value(k).size, length_);
      results[FlightSystem::largest].push_back(size);
      require(is_.minus(is_.number(hybrid::kLargestState), size));
    }
    results[FlightSystem::flight] = {length_, is_.minus(other_length_, length_), event_, ok_};
    for (const std::size_t e : made_.crossings)
      results[FlightSystem::sides_after].push_back(sides_after_[pack_.events[e].crossing->watch]);
    std::optional<std::uint32_t> fed_back;
    if (made_.claims > 0) fed_back = static_cast<std::uint32_t>(made_.limit_of(made_.claims));
    made_.code.emplace(graph_, results, made_.all_inputs(), fed_back);
  }

 private:
  int input(std::size_t position) { return graph_.input(static_cast<int>(position)); }

  void place_fields(ClaimKind kind) {
    using Flown = FlightSystem;
    std::vector<Flown::Field> kept = {Flown::peak, Flown::violated};
    if (kind == ClaimKind::shrinks)
      kept = {Flown::first, Flown::first_error, Flown::last, Flown::last_error};
    if (kind == ClaimKind::nonincreasing)
      kept = {Flown::first,      Flown::low,   Flown::low_error, Flown::high,
              Flown::high_error, Flown::floor, Flown::last};
    made_.places.emplace_back().fill(-1);
    for (const Flown::Field one : kept)
      made_.places.back()[one] = static_cast<int>(made_.fields_in_all++);
  }

  Nodes second_inputs() {
    Nodes x;
    for (std::size_t k = 0; k < pack_.whole; ++k)
      x.push_back(input(pack_.whole + index(texts_.kept(static_cast<int>(k)))));
    return x;
  }

  /// What is positive is required.
  void require(int node) { require_true(is_.is_positive(node)); }
  void require_true(int truth) { ok_ = is_.both(truth, ok_); }

  /// The second run is moved back to the time of the first, to first order.
  Pair pair(const Series& first, const Series& second) {
    Pair made{first, second.value};
    for (std::size_t j = 0; j + 1 < made.second.size(); ++j)
      made.second[j] =
          is_.minus(second.value[j],
                    is_.times(is_.part(static_cast<double>(j + 1), shift_), second.value[j + 1]));
    made.second.resize(made.first.value.size(), is_.number(0));
    return made;
  }

  /// Of coefficient j.
  int error_of(const Pair& one, std::size_t j) {
    const int apart = is_.abs(is_.minus(one.first.value[j], one.second[j]));
    return is_.add(is_.part(kErrorOfFlights, apart),
                   is_.part(hybrid::kTermRounding, one.first.size[j]));
  }

  // --- Sides and roots. ---

  /// Just after the start. What is 0 within its error is on the side to which it moves.
  void find_sides() {
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      const Pair& watch = watches_[w];
      const int value = watch.first.value[0];
      if (!pack_.watches[w].moves) {
        require_true(is_.is_equal(is_.minus(value, watch.second[0]), 0));
        rests_.push_back(value);
        sides_.push_back({is_.sign(value), is_.number(1)});
        near_0_.push_back(is_.number(0));
        continue;
      }
      rests_.push_back(-1);
      const int error = error_of(watch, 0);
      const int clear = is_.is_positive(is_.minus(is_.abs(value), error));
      near_0_.push_back(is_.no(clear));
      int side = is_.sign(value);
      if (watch.first.degree() > 0) {
        const int rate = watch.first.value[1];
        const int leaves = is_.is_positive(is_.minus(is_.abs(rate), error_of(watch, 1)));
        side = is_.pick(clear, side, is_.sign(rate));
        require_true(is_.either(clear, leaves));
      } else {
        require_true(clear);
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

  Candidate candidate(int time, std::size_t w) {
    const Nodes& c = watches_[w].first.value;
    int rate = is_.number(0);
    if (c.size() > 1) rate = c[1];
    if (c.size() > 2) rate = is_.add(rate, is_.part(2, is_.times(c[2], time)));
    return {time, rate, first_.at(watches_[w].second, time), w};
  }

  void add_candidates(std::size_t w, std::vector<Candidate>& candidates) {
    const Pair& watch = watches_[w];
    const std::size_t degree = watch.first.degree();
    if (!pack_.watches[w].moves || degree == 0) return;
    if (degree > 2) throw NoFormula();
    const int none = is_.number(-1);
    if (degree == 1) {
      const int root = is_.quotient(is_.minus(watch.first.value[0]), watch.first.value[1], -1);
      candidates.push_back(candidate(is_.pick(near_0_[w], none, root), w));
      return;
    }
    const Nodes& c = watch.first.value;
    const int discriminant = is_.minus(is_.times(c[1], c[1]), is_.part(4, is_.times(c[0], c[2])));
    const int size = is_.add(is_.times(c[1], c[1]), is_.part(4, is_.abs(is_.times(c[0], c[2]))));
    const int error = is_.add(is_.part(2, is_.times(is_.abs(c[1]), error_of(watch, 1))),
                              is_.part(4, is_.add(is_.times(is_.abs(c[0]), error_of(watch, 2)),
                                                  is_.times(is_.abs(c[2]), error_of(watch, 0)))));
    const int margin = is_.add(error, is_.part(kTouches, size));
    const int has_roots = is_.is_positive(is_.minus(discriminant, margin));
    // A touch is left open, unless all of it rests.
    require_true(is_.either(is_.either(has_roots, near_0_[w]),
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
      const Pair& watch = watches_[w];
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

  void find_event() {
    std::vector<Side> at_start = sides_;
    for (std::size_t w = 0; w < at_start.size(); ++w) at_start[w].known = is_.no(near_0_[w]);
    for (std::size_t e = 0; e < pack_.events.size(); ++e) {
      const PackEvent& event = pack_.events[e];
      if (event.when) require_true(is_.no(truth(*event.when, at_start).possible));
      if (event.crossing) require_no_crossing(e);
    }
    for (const WatchedCondition& set : pack_.flow_sets) require_true(truth(set, sides_).certain);
    std::vector<Candidate> candidates;
    for (std::size_t w = 0; w < watches_.size(); ++w) add_candidates(w, candidates);
    if (candidates.size() > most_roots) throw NoFormula();
    int first = is_.number(never), other = is_.number(0), rate = is_.number(1);
    int sure = is_.number(0);
    event_ = is_.number(-1);
    for (const Side& side : sides_) sides_after_.push_back(side.sign);
    for (const Candidate& one : candidates) {
      const std::vector<Side> sides = sides_after(one);
      Due due = due_at(one, sides);
      const int is_before = is_.is_positive(is_.minus(first, one.time));
      const int takes = is_.both(is_.is_positive(one.time), is_.both(is_before, due.possible));
      first = is_.pick(takes, one.time, first);
      other = is_.pick(takes, one.other, other);
      rate = is_.pick(takes, one.rate, rate);
      sure = is_.pick(takes, due.sure, sure);
      event_ = is_.pick(takes, due.event, event_);
      for (std::size_t w = 0; w < sides.size(); ++w)
        sides_after_[w] = is_.pick(takes, sides[w].sign, sides_after_[w]);
    }
    const int rest = input(made_.at(FlightSystem::rest));
    const int ends = is_.is_positive(is_.minus(first, rest));  // at the horizon
    require_true(is_.either(ends, sure));
    require(is_.minus(is_.abs(is_.minus(first, rest)),
                      is_.number(hybrid::kHardly * pack_.scenario->horizon)));
    event_ = is_.pick(ends, is_.number(-1), event_);
    length_ = is_.pick(ends, rest, first);
    // The root of the second run by Newton's method: both are near each other, as is required.
    other_length_ = is_.minus(length_, is_.pick(ends, is_.number(0), is_.quotient(other, rate, 0)));
    require(is_.minus(is_.part(kApart, length_), is_.abs(is_.minus(other_length_, length_))));
  }

  /// Neither the start nor a jump of another event has led through 0 in its direction.
  void require_no_crossing(std::size_t e) {
    const Watched& crossing = *pack_.events[e].crossing;
    const auto found = std::find(made_.crossings.begin(), made_.crossings.end(), e);
    const int before =
        input(made_.side_before(static_cast<std::size_t>(found - made_.crossings.begin())));
    const int own =
        is_.either(input(made_.at(FlightSystem::fresh)),
                   is_.is_equal(input(made_.at(FlightSystem::jumped)), static_cast<double>(e)));
    const int same = is_.is_positive(is_.times(before, sides_[crossing.watch].sign));
    // What starts at 0 and leaves it in the direction of the event is unusual.
    const int away =
        is_.either(is_.no(near_0_[crossing.watch]), is_.no(wanted(e, sides_[crossing.watch].sign)));
    require_true(is_.both(is_.either(own, same), away));
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
  Due due_at(const Candidate& one, const std::vector<Side>& sides) {
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
      if (event.crossing && event.crossing->watch == one.watch) {
        const int is = wanted(e, sides[one.watch].sign);
        add({is, is}, static_cast<double>(e));
      }
    }
    for (const WatchedCondition& set : pack_.flow_sets)
      add({is_.number(0), is_.no(truth(set, sides).certain)}, -1);
    return due;
  }

  // --- Claims. ---

  struct Value {
    int value = 0, error = 0;
  };

  void judge(const claims::Claim& claim, std::size_t c, Nodes& fields) {
    const PackClaim& packed = pack_.claims[c];
    const auto square = packed.squared ? expr::square_of_norm(claim.value) : std::nullopt;
    const expr::Program& text = square ? *square : claim.value;
    Pair along = pair(first_.of(text), second_.of(text));
    if (claim.kind == ClaimKind::above)
      for (Nodes* nodes : {&along.first.value, &along.second})
        for (int& node : *nodes) node = is_.minus(node);
    const Value start{along.first.value[0], error_along(along, is_.number(0))};
    const Value end{first_.at(along.first.value, length_), error_along(along, length_)};
    using Flown = FlightSystem;
    Fields field{};
    for (std::size_t f = 0; f < field.size(); ++f)
      if (const auto one = static_cast<Flown::Field>(f); made_.has(c, one))
        field[f] = input(made_.field_of(c, one));
    const int fresh = input(made_.at(Flown::fresh));
    const std::pair<Flown::Field, int> begun[] = {
        {Flown::first, start.value},       {Flown::first_error, start.error},
        {Flown::low, start.value},         {Flown::low_error, start.error},
        {Flown::high, start.value},        {Flown::high_error, start.error},
        {Flown::peak, is_.number(-never)}, {Flown::violated, is_.number(0)},
        {Flown::floor, is_.number(0)}};
    for (const auto& [which, value] : begun)
      if (made_.has(c, which)) field[which] = is_.pick(fresh, value, field[which]);
    const int counts = packed.over ? is_.is_equal(input(made_.at(Flown::jumped)),
                                                  static_cast<double>(*packed.over))
                                   : is_.number(1);
    if (packed.kind == ClaimKind::below || packed.kind == ClaimKind::above)
      compare_with_bound(packed, along, packed.over ? start : end, counts, c, field);
    if (packed.kind == ClaimKind::nonincreasing)
      compare_with_before(packed, along, start, end, counts, field);
    field[Flown::last] = end.value;
    field[Flown::last_error] = end.error;
    std::vector<std::pair<int, int>> placed;
    for (std::size_t f = 0; f < field.size(); ++f)
      if (made_.has(c, static_cast<Flown::Field>(f)))
        placed.emplace_back(made_.places[c][f], field[f]);
    std::sort(placed.begin(), placed.end());
    for (const auto& [place, node] : placed) fields.push_back(node);
  }

  using Fields = std::array<int, FlightSystem::fields_of_claim>;

  /// Of the value anywhere up to s.
  int error_along(const Pair& along, int s) {
    Nodes apart;
    for (std::size_t j = 0; j < along.first.value.size(); ++j)
      apart.push_back(is_.abs(is_.minus(along.first.value[j], along.second[j])));
    const int difference = first_.at(apart, s);
    const int size = first_.at(along.first.size, s);
    // At the start of a flight terms may be 0.
    if (s == length_)
      require_true(is_.is_at_least_0(is_.minus(is_.part(kApart, size), difference)));
    return is_.add(is_.part(kErrorOfFlights, difference),
                   is_.part(hybrid::kTermRounding + 8 * kUnitRoundoff, size));
  }

  /// B_0 ... B_n on [0, length].
  Nodes bernstein(const Nodes& c) {
    const std::size_t n = c.size() - 1;
    Nodes scaled;
    int power = is_.number(1);
    for (const int one : c) {
      scaled.push_back(is_.times(one, power));
      power = is_.times(power, length_);
    }
    const auto choose = [](std::size_t of, std::size_t k) {
      double made = 1;
      for (std::size_t i = 0; i < k; ++i)
        made = made * static_cast<double>(of - i) / static_cast<double>(i + 1);
      return made;
    };
    Nodes b;
    for (std::size_t k = 0; k <= n; ++k) {
      int sum = is_.number(0);
      for (std::size_t j = 0; j <= k; ++j)
        sum = is_.add(sum, is_.part(choose(k, j) / choose(n, j), scaled[j]));
      b.push_back(sum);
    }
    return b;
  }

  /// The largest value on the flight, and what it is not above: of a degree above 2 the largest
  /// coefficient of Bernstein.
  std::pair<int, int> highest(const Nodes& c, int end) {
    const int ends = is_.most(c[0], end);
    if (c.size() <= 2) return {ends, ends};
    if (c.size() == 3) {
      const int at = is_.quotient(c[1], is_.part(-2, c[2]), -1);
      const int inside =
          is_.both(is_.both(is_.is_positive(at), is_.is_positive(is_.minus(length_, at))),
                   is_.is_positive(is_.minus(c[2])));
      const int top = is_.pick(inside, is_.add(c[0], is_.part(0.5, is_.times(c[1], at))), ends);
      return {top, top};
    }
    std::pair<int, int> made{ends, ends};
    widen(bernstein(c), kHalvings, made);
    return made;
  }

  /// By the coefficients of halves of halves: those at their ends are values.
  void widen(const Nodes& b, int halvings, std::pair<int, int>& highest) {
    if (halvings == 0) {
      for (const int one : b) highest.second = is_.most(highest.second, one);
      return;
    }
    Nodes left, right = b;
    for (std::size_t last = b.size(); last-- > 0;) {
      left.push_back(right[0]);
      for (std::size_t k = 0; k < last; ++k)
        right[k] = is_.part(0.5, is_.add(right[k], right[k + 1]));
    }
    highest.first = is_.most(highest.first, right[0]);
    widen(left, halvings - 1, highest);
    widen(right, halvings - 1, highest);
  }

  void compare_with_bound(const PackClaim& claim, const Pair& along, const Value& at, int counts,
                          std::size_t c, Fields& field) {
    using Flown = FlightSystem;
    const int always = is_.number(claim.always ? 1 : 0);
    const int limit = input(made_.limit_of(c));
    const auto [top, most] =
        claim.over ? std::pair(at.value, at.value) : highest(along.first.value, at.value);
    const int held = is_.is_at_least_0(is_.minus(limit, is_.add(most, at.error)));
    const int exceeds = is_.is_positive(is_.minus(is_.minus(top, limit), at.error));
    field[Flown::violated] =
        is_.either(field[Flown::violated], is_.both(is_.both(counts, exceeds), is_.no(always)));
    require_true(
        is_.either(is_.either(is_.no(counts), always), is_.either(held, field[Flown::violated])));
    field[Flown::peak] = is_.pick(counts, is_.most(field[Flown::peak], top), field[Flown::peak]);
    // How near it comes is to be known.
    const int scale = is_.pick(is_.abs(limit), is_.abs(limit), is_.number(1));
    if (most != top)
      require_true(is_.is_at_least_0(
          is_.minus(is_.part(kScore, scale), is_.minus(most, field[Flown::peak]))));
  }

  void compare_with_before(const PackClaim& claim, const Pair& along, const Value& start,
                           const Value& end, int counts, Fields& field) {
    using Flown = FlightSystem;
    const int fresh = input(made_.at(Flown::fresh));
    int compares = is_.both(counts, is_.no(fresh));
    // A jump that leaves it bit by bit.
    if (!claim.over)
      compares =
          is_.both(compares, is_.no(is_.is_equal(is_.minus(start.value, field[Flown::last]), 0)));
    compare_at(start, compares, field);
    if (claim.over || along.first.degree() == 0) return;
    const Nodes b = bernstein(along.first.value);
    int falls = is_.number(1);
    for (std::size_t k = 1; k < b.size(); ++k)
      falls = is_.both(
          falls, is_.is_positive(is_.minus(is_.minus(b[k - 1], b[k]), is_.part(2, end.error))));
    const int scale = is_.abs(field[Flown::first]);
    const int size = is_.add(first_.at(along.first.size, length_), end.error);
    const int drowned = is_.is_positive(is_.minus(is_.part(pack_.accuracy, scale), size));
    require_true(is_.either(falls, drowned));
    keep_extremes(end, is_.number(1), field);
  }

  void compare_at(const Value& at, int compares, Fields& field) {
    using Flown = FlightSystem;
    const int above_high = is_.minus(at.value, field[Flown::high]);
    const int above_low = is_.minus(at.value, field[Flown::low]);
    const int violates =
        is_.is_positive(is_.minus(above_high, is_.add(at.error, field[Flown::high_error])));
    const int holds = is_.is_at_least_0(
        is_.minus(is_.add(above_low, is_.add(at.error, field[Flown::low_error]))));
    const int size = is_.add(is_.abs(at.value), at.error);
    const int scale = is_.abs(field[Flown::first]);
    const int least = is_.pick(violates, is_.number(claims::kFloorOfAccuracy * pack_.accuracy),
                               is_.number(pack_.accuracy));
    const int drowned = is_.both(is_.is_positive(scale),
                                 is_.is_at_least_0(is_.minus(is_.times(least, scale), size)));
    require_true(is_.either(is_.no(compares), is_.either(holds, drowned)));
    const int sinks = is_.both(compares, is_.both(is_.no(holds), drowned));
    field[Flown::floor] =
        is_.most(field[Flown::floor], is_.pick(sinks, is_.quotient(size, scale, 0), is_.number(0)));
    keep_extremes(at, compares, field);
  }

  /// The value with the least upper bound so far, and that with the least lower one.
  void keep_extremes(const Value& at, int counts, Fields& field) {
    using Flown = FlightSystem;
    const int lower = is_.minus(is_.minus(field[Flown::low], field[Flown::low_error]),
                                is_.minus(at.value, at.error));
    const int higher = is_.minus(is_.add(field[Flown::high], field[Flown::high_error]),
                                 is_.add(at.value, at.error));
    const int is_low = is_.both(counts, is_.is_positive(lower));
    const int is_high = is_.both(counts, is_.is_positive(higher));
    field[Flown::low] = is_.pick(is_low, at.value, field[Flown::low]);
    field[Flown::low_error] = is_.pick(is_low, at.error, field[Flown::low_error]);
    field[Flown::high] = is_.pick(is_high, at.value, field[Flown::high]);
    field[Flown::high_error] = is_.pick(is_high, at.error, field[Flown::high_error]);
  }

  const PackSystem& pack_;
  FlightSystem& made_;
  PackGraph texts_;
  ScalarGraph& graph_;
  Terms is_;
  FlightSeries first_, second_;
  std::vector<Pair> watches_;
  Nodes rests_;              ///< by watch: its value, of what does not move
  std::vector<Side> sides_;  ///< just after the start
  Nodes near_0_;             ///< by watch: whether it starts as 0, within its error
  Nodes sides_after_;        ///< by watch: at the end
  int shift_ = 0, ok_ = 0, length_ = 0, other_length_ = 0, event_ = 0;
};

/// What flights leave to steps whatever the texts are.
bool may_fly(const PackSystem& pack, const std::vector<claims::Claim>& claims) {
  const Dynamics& dynamics = pack.system->dynamics;
  const bool has_branches = std::any_of(pack.watches.begin(), pack.watches.end(),
                                        [](const Watch& one) { return !one.branches.empty(); });
  const bool is_plain = std::all_of(
      pack.events.begin(), pack.events.end(),
      [](const PackEvent& one) { return (one.when || one.crossing) && !one.only_if && !one.lost; });
  constexpr std::size_t most_events = 64;
  return is_plain && !pack.events.empty() && pack.events.size() <= most_events && !has_branches &&
         pack.kinks.empty() && pack.flats.empty() && pack.costs.empty() && dynamics.noise.empty() &&
         !pack.system->pulses &&
         std::none_of(claims.begin(), claims.end(), [](const claims::Claim& one) {
           return one.stated() &&
                  (one.after > 0 || one.tolerance > 0 || one.kind == ClaimKind::cost);
         });
}

}  // namespace

std::optional<FlightSystem> make_flights(const PackSystem& pack,
                                         const std::vector<claims::Claim>& claims) {
  if (!may_fly(pack, claims)) return std::nullopt;
  FlightSystem made;
  try {
    FlightCode(pack, made).make(claims);
  } catch (const NoFormula&) {
    return std::nullopt;
  }
  return made;
}

}  // namespace gainsmith::packs
