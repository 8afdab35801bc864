// Other realizations of a linear system: without hidden states, and sampled.
#include <algorithm>
#include <utility>
#include <vector>

#include "expr/binding/emitter.h"
#include "expr/program/number_type.h"

namespace gainsmith::expr {

namespace {

/// What counts as 0 beside the largest singular value, unless minreal gets another tolerance: far
/// above the rounding of some ten products, and below what data say.
constexpr const char* kHidden = "1e-9";
/// By what minreal may change a transfer function, relative.
constexpr double kUnchanged = 1e-6;

/// The largest singular value; 0 of an empty matrix.
int largest_gain(const Emitter& make, int m) {
  if (make.shape(m).size() == 0) return make.zeros({1, 1});
  return make.element(make(Op::singular_values, {m}), 0);
}

}  // namespace

/// [A, B; C, D] in the states V of x = V z, V'V = I.
Bound Binder::in_basis(const Emitter& make, const SystemParts& of, int basis) {
  const int turned = make.transpose(basis);
  return {make.blocks({make.multiply(turned, make.multiply(of.a, basis)),
                       make.multiply(turned, of.b), make.multiply(of.c, basis), of.d},
                      2),
          false, make.shape(basis).cols, -1};
}

/// An orthonormal basis of the range of [B, A B, A^2 B, ...]; what is small beside `size` counts as
/// 0 in B. Each next basis is of [V, A V/|A|], so that powers of A, which lose what is small, are
/// not formed.
int Binder::reachable(const Expression& expression, const Node& node, const Emitter& make,
                      std::pair<int, int> pair, int size, int tolerance) {
  const auto [a, b] = pair;
  const Program known_tolerance = known_program(expression, node, tolerance, "the tolerance");
  const auto rank = [&](int at) {
    const Program matrix = known_program(expression, node, at, "the system of minreal");
    return scope_.known->rank(matrix, &known_tolerance);
  };
  const int n = make.shape(a).rows;
  const auto range = [&](int at, int columns) {
    return emit(expression, node, Op::range_basis, {at}, {n, columns});
  };
  const int beside = make.block_diagonal(b, size);
  int count = std::max(0, rank(beside) - 1);
  int basis = range(b, count);
  const int scale = largest_gain(make, a);
  if (scope_.known->number(extract(scale)) == 0) return basis;
  const int scaled = make(Op::divide, {a, scale});
  while (count > 0 && count < n) {
    const int further = make.blocks({basis, make.multiply(scaled, basis)}, 2);
    const int next = rank(further);
    if (next <= count) break;
    count = next;
    basis = range(further, count);
  }
  return basis;
}

/// In the units of the states in which A, B and C are near 1, with inputs in units of their own.
Bound Binder::in_near_units(const Expression& expression, const Node& node, const Emitter& make,
                            const Bound& system) {
  const SystemParts of = parts_of(make, system);
  const int n = system.states, m = make.shape(of.b).cols, p = make.shape(of.c).rows;
  const std::string why = "the system of minreal";
  const int a = make.blocks({of.a, of.b, make.zeros({m, n}), make.zeros({m, m})}, 2);
  const int c = make.blocks({of.c, make.zeros({p, m})}, 2);
  std::vector<int> exponents = scope_.known->units(known_program(expression, node, a, why),
                                                   known_program(expression, node, c, why));
  exponents.resize(static_cast<std::size_t>(n));
  const int to = powers_of_two(make, exponents, 1), from = powers_of_two(make, exponents, -1);
  return {make.blocks({make.multiply(from, make.multiply(of.a, to)), make.multiply(from, of.b),
                       make.multiply(of.c, to), of.d},
                      2),
          false, n, -1};
}

/// Whether two systems have one transfer function, at real points beside the size of A.
bool Binder::is_same_function(const Expression& expression, const Node& node, const Emitter& make,
                              const Bound& bound, const Bound& other) {
  const auto norm = [&](int at) {
    return scope_.known->number(
        known_program(expression, node, make(Op::norm, {at}), "the system of minreal"));
  };
  int size = largest_gain(make, parts_of(make, bound).a);
  if (norm(size) == 0) size = make.number("1");
  bool seen = false;
  for (const char* share : {"2.7e-12", "1.9e-9", "3.1e-6", "2.3e-3", "0.71"}) {
    // (s I - A)^-1 and C (s I - A)^-1 B + D
    const auto value = [&](const Bound& system) {
      const SystemParts of = parts_of(make, system);
      const int shift = make.identity(make.scale(make.number(share), size), system.states);
      const int inverse = make(Op::inverse, {make.subtract(shift, of.a)});
      return std::pair(inverse, make.add(of.d, make.multiply(of.c, make.multiply(inverse, of.b))));
    };
    const auto [inverse, wanted] = value(bound);
    const int difference = make.subtract(wanted, value(other).second);
    constexpr double kRounding = 1e-13;  // of A, and of the sums of the value
    try {
      const SystemParts of = parts_of(make, bound);
      const double states = norm(make.multiply(inverse, of.b));
      const double outputs = norm(make.multiply(of.c, inverse));
      const double rounding = outputs * states * norm(of.a) + norm(of.c) * states;
      if (!(norm(difference) <= kUnchanged * norm(wanted) + kRounding * rounding)) return false;
      seen = true;
    } catch (const EvaluationError&) {  // a pole
    }
  }
  return seen;
}

/// The states that inputs reach and outputs see, in orthonormal coordinates.
Bound Binder::minimal_realization(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const Bound system = bind_system(expression, *node.children[0]);
  if (system.states == 0) return system;
  const Bound scaled = in_near_units(expression, node, make, system);
  Bound least = system;
  if (node.children.size() == 2) {
    const Node& second = *node.children[1];
    least = reduced(expression, node, make, scaled,
                    materialise(expression, second, bind(expression, second), {}));
  } else {
    const Bound made = reduced(expression, node, make, scaled, make.number(kHidden));
    if (is_same_function(expression, node, make, scaled, made)) least = made;
  }
  if (least.states == system.states) return system;
  if (least.states == 0) return {parts_of(make, least).d, false, 0, -1};
  least.step = system.step;
  return least;
}

Bound Binder::reduced(const Expression& expression, const Node& node, const Emitter& make,
                      const Bound& system, int tolerance) {
  const SystemParts whole = parts_of(make, system);
  Bound least = system;
  for (const bool inputs : {true, false}) {
    if (least.states == 0) break;
    const SystemParts of = parts_of(make, least);
    const auto pair =
        inputs ? std::pair(of.a, of.b) : std::pair(make.transpose(of.a), make.transpose(of.c));
    const int basis = reachable(expression, node, make, pair,
                                largest_gain(make, inputs ? whole.b : whole.c), tolerance);
    if (make.shape(basis).cols < least.states) least = in_basis(make, of, basis);
  }
  return least;
}

/// x+ = Ad x + Bd u of an input that is held over T.
Bound Binder::sampled_system(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const auto [of, states, t] = to_sample(expression, node, make);
  if (states == 0) return {of.d, false, 0, -1};
  const int held = sampled_matrices(make, of.a, of.b, t);
  return {make.blocks({held, make.blocks({of.c, of.d}, 2)}, 1), false, states, t};
}

/// s = (2/T) (z - 1)/(z + 1): with M = (I - A T/2)^-1 the matrices M (I + A T/2), M B T, C M and
/// D + C M B T/2.
Bound Binder::bilinear(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const auto [of, states, t] = to_sample(expression, node, make);
  if (states == 0) return {of.d, false, 0, -1};
  const int half = make(Op::divide, {t, make.number("2")});
  const int step = make.scale(half, of.a);
  const int inverse = make(Op::inverse, {make.subtract(make.identity(states), step)}, {},
                           "tustin: I - A*T/2, since 2/T is a pole of the system,");
  const int input = make.multiply(inverse, of.b);
  return {make.blocks({make.multiply(inverse, make.add(make.identity(states), step)),
                       make.scale(t, input), make.multiply(of.c, inverse),
                       make.add(of.d, make.scale(half, make.multiply(of.c, input)))},
                      2),
          false, states, t};
}

/// The continuous system and the time of f(G, T).
Binder::ToSample Binder::to_sample(const Expression& expression, const Node& node,
                                   const Emitter& make) {
  const Bound system = bind_system(expression, *node.children[0]);
  if (system.step >= 0) fail(expression, *node.children[0], "the system is sampled already");
  const Node& last = *node.children[1];
  return {parts_of(make, system), system.states,
          materialise(expression, last, bind(expression, last), {})};
}

}  // namespace gainsmith::expr
