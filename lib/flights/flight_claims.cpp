#include "flights/flight_claims.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/unit_roundoff.h"
#include "claims/tolerances.h"
#include "expr/program/square_of_norm.h"
#include "flights/tolerances.h"
#include "hybrid/tolerances.h"
#include "packs/pack_system.h"
#include "packs/tolerances.h"

namespace gainsmith::flights {

using model::ClaimKind;
using Flown = FlightSystem;

namespace {

constexpr double kLeast = -1e300;
/// Of a flight, to see how large a claim of degree 3 to 5 becomes.
constexpr int kHalvings = 3;

/// The fields of one claim after a flight from those before it (FlightSystem::Field). `above` is
/// `below` of the negated value.
class ClaimCode {
 public:
  ClaimCode(FlightGraph& graph, const claims::Claim& claim, std::size_t number, int length)
      : graph_(graph),
        claim_(graph.pack().claims[number]),
        number_(number),
        length_(length),
        is_(graph.terms()),
        first_(graph.first()) {
    const auto square = claim_.squared ? expr::square_of_norm(claim.value) : std::nullopt;
    const expr::Program& text = square ? *square : claim.value;
    along_ = graph_.pair(first_.of(text), graph_.second().of(text));
    if (claim.kind == ClaimKind::above)
      for (Nodes* nodes : {&along_.first.value, &along_.second})
        for (int& node : *nodes) node = is_.minus(node);
    start_ = {along_.first.value[0], error_up_to(is_.number(0))};
    end_ = {first_.at(along_.first.value, length_), error_up_to(length_)};
    counts_ = claim_.over
                  ? is_.is_equal(graph_.input(Flown::jumped), static_cast<double>(*claim_.over))
                  : is_.number(1);
  }

  /// Appends the fields in the order of their places, each as a node.
  void make(Nodes& fields) {
    FlightSystem& made = graph_.made();
    const FlightSystem::Places& places = made.places[number_];
    for (std::size_t f = 0; f < field_.size(); ++f)
      if (places[f] >= 0)
        field_[f] = graph_.input(made.field_of(number_, static_cast<Flown::Field>(f)));
    begin();
    if (claim_.kind == ClaimKind::below || claim_.kind == ClaimKind::above) compare_with_bound();
    if (claim_.kind == ClaimKind::nonincreasing) compare_with_before();
    const Value last = claim_.over ? start_ : end_;
    field_[Flown::last] = is_.pick(counts_, last.value, field_[Flown::last]);
    field_[Flown::last_error] = is_.pick(counts_, last.error, field_[Flown::last_error]);
    std::vector<std::pair<int, int>> placed;
    for (std::size_t f = 0; f < field_.size(); ++f)
      if (places[f] >= 0) placed.emplace_back(places[f], field_[f]);
    std::sort(placed.begin(), placed.end());
    for (const auto& [place, node] : placed) fields.push_back(node);
  }

 private:
  struct Value {
    int value = 0, error = 0;
  };

  /// At the start of a run; v(0) of a claim over jumps is the first that counts.
  void begin() {
    const int fresh = graph_.input(Flown::fresh);
    const int none = is_.number(0);
    field_[Flown::peak] = is_.pick(fresh, is_.number(kLeast), field_[Flown::peak]);
    for (const Flown::Field field : {Flown::violated, Flown::floor, Flown::seen})
      field_[field] = is_.pick(fresh, none, field_[field]);
    begins_ = is_.both(counts_, is_.no(field_[Flown::seen]));
    field_[Flown::seen] = is_.either(counts_, field_[Flown::seen]);
    for (const Flown::Field field : {Flown::first, Flown::low, Flown::high})
      field_[field] = is_.pick(begins_, start_.value, field_[field]);
    for (const Flown::Field field : {Flown::first_error, Flown::low_error, Flown::high_error})
      field_[field] = is_.pick(begins_, start_.error, field_[field]);
  }

  /// Of the value anywhere up to s.
  /// kErrorOfFlights sum_j |p_j - q_j| s^j + (kTermRounding + 8 u) sum_j size_j s^j. The
  /// coefficients count with their absolute values, so that the bound holds all along the flight.
  int error_up_to(int s) {
    Nodes apart;
    for (std::size_t j = 0; j < along_.first.value.size(); ++j)
      apart.push_back(is_.abs(is_.minus(along_.first.value[j], along_.second[j])));
    const int difference = first_.at(apart, s);
    const int size = first_.at(along_.first.size, s);
    // At the start of a flight terms may be 0.
    if (s == length_)
      graph_.require_true(is_.is_at_least_0(is_.minus(is_.part(kApart, size), difference)));
    return is_.add(is_.part(kErrorOfFlights, difference),
                   is_.part(hybrid::kTermRounding + 8 * kUnitRoundoff, size));
  }

  /// B_0 ... B_n on [0, length]: B_k = sum_{j<=k} C(k, j)/C(n, j) c_j length^j.
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
  /// De Casteljau's algorithm at 1/2, three times over: eight parts.
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

  /// Held where most + error <= limit, violated where the attained top exceeds limit + error,
  /// otherwise the flight is not ok. A claim over jumps is compared at the start of the flight
  /// after them.
  void compare_with_bound() {
    const Value& at = claim_.over ? start_ : end_;
    const int always = is_.number(claim_.always ? 1 : 0);
    const int limit = graph_.input(graph_.made().limit_of(number_));
    const auto [top, most] =
        claim_.over ? std::pair(at.value, at.value) : highest(along_.first.value, at.value);
    const int held = is_.is_at_least_0(is_.minus(limit, is_.add(most, at.error)));
    const int exceeds = is_.is_positive(is_.minus(is_.minus(top, limit), at.error));
    field_[Flown::violated] =
        is_.either(field_[Flown::violated], is_.both(is_.both(counts_, exceeds), is_.no(always)));
    graph_.require_true(
        is_.either(is_.either(is_.no(counts_), always), is_.either(held, field_[Flown::violated])));
    field_[Flown::peak] =
        is_.pick(counts_, is_.most(field_[Flown::peak], top), field_[Flown::peak]);
    if (most == top) return;
    // How near it comes to its limit is to be known.
    const int peak = field_[Flown::peak];
    const int scale = is_.pick(is_.abs(limit), is_.abs(limit), is_.number(1));
    const int near = is_.part(packs::kScore, is_.add(scale, is_.abs(is_.minus(peak, limit))));
    graph_.require_true(is_.is_at_least_0(is_.minus(near, is_.minus(most, peak))));
  }

  /// v(t) <= the least v so far, at the start of the flight and along it. It falls along the flight
  /// where all differences of coefficients exceed twice the error; or its size is below the
  /// accuracy times |v(0)|.
  void compare_with_before() {
    int compares = is_.both(counts_, is_.no(begins_));
    // A jump that leaves it bit by bit.
    if (!claim_.over)
      compares =
          is_.both(compares, is_.no(is_.is_equal(is_.minus(start_.value, field_[Flown::last]), 0)));
    compare_at(start_, compares);
    if (claim_.over || along_.first.degree() == 0) return;
    const Nodes b = bernstein(along_.first.value);
    int falls = is_.number(1);
    for (std::size_t k = 1; k < b.size(); ++k)
      falls = is_.both(
          falls, is_.is_positive(is_.minus(is_.minus(b[k - 1], b[k]), is_.part(2, end_.error))));
    const int scale = is_.abs(field_[Flown::first]);
    const int size = is_.add(first_.at(along_.first.size, length_), end_.error);
    const int drowned = is_.is_positive(is_.minus(is_.part(graph_.pack().accuracy, scale), size));
    graph_.require_true(is_.either(falls, drowned));
    keep_extremes(end_, is_.number(1));
  }

  /// Held where v + error <= the least v - error so far. Otherwise the flight is ok only where the
  /// value is below `least` of the value at the start, which `floor` notes. Violations are left to
  /// steps.
  void compare_at(const Value& at, int compares) {
    const int above_high = is_.minus(at.value, field_[Flown::high]);
    const int above_low = is_.minus(at.value, field_[Flown::low]);
    const int violates =
        is_.is_positive(is_.minus(above_high, is_.add(at.error, field_[Flown::high_error])));
    const int holds = is_.is_at_least_0(
        is_.minus(is_.add(above_low, is_.add(at.error, field_[Flown::low_error]))));
    const int size = is_.add(is_.abs(at.value), at.error);
    const int scale = is_.abs(field_[Flown::first]);
    const int least =
        is_.pick(violates, is_.number(claims::kFloorOfAccuracy * graph_.pack().accuracy),
                 is_.number(graph_.pack().accuracy));
    const int drowned = is_.both(is_.is_positive(scale),
                                 is_.is_at_least_0(is_.minus(is_.times(least, scale), size)));
    graph_.require_true(is_.either(is_.no(compares), is_.either(holds, drowned)));
    const int sinks = is_.both(compares, is_.both(is_.no(holds), drowned));
    field_[Flown::floor] = is_.most(field_[Flown::floor],
                                    is_.pick(sinks, is_.quotient(size, scale, 0), is_.number(0)));
    keep_extremes(at, compares);
  }

  /// The value with the least upper bound so far, and that with the least lower one.
  void keep_extremes(const Value& at, int counts) {
    const int lower = is_.minus(is_.minus(field_[Flown::low], field_[Flown::low_error]),
                                is_.minus(at.value, at.error));
    const int higher = is_.minus(is_.add(field_[Flown::high], field_[Flown::high_error]),
                                 is_.add(at.value, at.error));
    const int is_low = is_.both(counts, is_.is_positive(lower));
    const int is_high = is_.both(counts, is_.is_positive(higher));
    field_[Flown::low] = is_.pick(is_low, at.value, field_[Flown::low]);
    field_[Flown::low_error] = is_.pick(is_low, at.error, field_[Flown::low_error]);
    field_[Flown::high] = is_.pick(is_high, at.value, field_[Flown::high]);
    field_[Flown::high_error] = is_.pick(is_high, at.error, field_[Flown::high_error]);
  }

  FlightGraph& graph_;
  const PackClaim& claim_;
  std::size_t number_;
  int length_;
  LaneTerms& is_;
  FlightSeries& first_;
  FlightPair along_;
  Value start_, end_;  ///< of the flight; the latter with the error up to there
  int counts_ = 0;     ///< whether it is claimed on this flight, or at its start
  int begins_ = 0;     ///< for the first time
  std::array<int, FlightSystem::fields_of_claim> field_{};
};

}  // namespace

/// The fields that a kind keeps: bounds keep their peak, `shrinks` both ends, `nonincreasing` the
/// extremes so far.
FlightSystem::Places places_of(const PackClaim& claim, std::size_t& next) {
  std::vector<Flown::Field> kept = {Flown::peak, Flown::violated};
  if (claim.kind == ClaimKind::shrinks)
    kept = {Flown::first, Flown::first_error, Flown::last, Flown::last_error, Flown::seen};
  if (claim.kind == ClaimKind::nonincreasing)
    kept = {Flown::first,      Flown::low,   Flown::low_error, Flown::high,
            Flown::high_error, Flown::floor, Flown::last,      Flown::seen};
  FlightSystem::Places places;
  places.fill(-1);
  for (const Flown::Field field : kept) places[field] = static_cast<int>(next++);
  return places;
}

void add_claim(FlightGraph& graph, const claims::Claim& claim, std::size_t number, int length,
               Nodes& fields) {
  ClaimCode(graph, claim, number, length).make(fields);
}

}  // namespace gainsmith::flights
