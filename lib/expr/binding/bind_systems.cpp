// Linear systems as values: one matrix [A, B; C, D] with the number of its states.
//
//   continuous  x' = A x + B u, y = C x + D u;  transfer function C (s I - A)^-1 B + D
//   sampled     x+ = A x + B u, at the multiples of its step
//
// What is made of systems is made of these matrices by formulas, so that decimals are kept. States
// are in the order of the arguments; none are cancelled.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/emitter.h"

namespace gainsmith::expr {

namespace {

/// [A, B; C, D]; a system without states is D alone, with no sampling time.
Bound system_of(const Emitter& make, const Binder::SystemParts& of, int step) {
  const int n = make.shape(of.a).rows;
  if (n == 0) return {of.d, false, 0, -1};
  return {make.blocks({of.a, of.b, of.c, of.d}, 2), false, n, step};
}

int inputs_of(const Emitter& make, const Bound& system) {
  return make.shape(system.at).cols - system.states;
}
int outputs_of(const Emitter& make, const Bound& system) {
  return make.shape(system.at).rows - system.states;
}

/// d_k of the denominator sum_k d_k (s T)^k of a Pade approximation: (2n - k)!/(k! (n - k)!), whole
/// numbers.
std::vector<std::string> pade_coefficients(int n) {
  std::vector<std::string> all;
  for (int k = 0; k <= n; ++k) {
    double value = 1;
    for (int j = n - k + 1; j <= 2 * n - k; ++j) value *= j;
    for (int j = 2; j <= k; ++j) value /= j;
    all.push_back(fmt::format("{:.0f}", value));
  }
  return all;
}

}  // namespace

bool makes_system(const Node& node) {
  static const std::set<std::string> kMakers = {"ss",     "tf",     "series", "parallel",
                                                "append", "lft",    "augw",   "feedback",
                                                "pade",   "tustin", "minreal"};
  if (node.kind == NodeKind::call) return kMakers.contains(node.text);
  const bool sum = node.kind == NodeKind::add || node.kind == NodeKind::subtract ||
                   node.kind == NodeKind::multiply || node.kind == NodeKind::negate;
  return sum && std::ranges::any_of(node.children,
                                    [](const NodePtr& child) { return makes_system(*child); });
}

Binder::SystemParts Binder::parts_of(const Emitter& make, const Bound& system) {
  const auto [rows, cols] = make.shape(system.at);
  const int n = system.states;
  return {make.part(system.at, 0, n, 0, n), make.part(system.at, 0, n, n, cols),
          make.part(system.at, n, rows, 0, n), make.part(system.at, n, rows, n, cols)};
}

void Binder::refuse_system(const Expression& expression, const Node& node) const {
  const std::string quoted = expression.quote(node);
  const std::string part =
      node.kind == NodeKind::name || node.kind == NodeKind::call ? quoted : "(" + quoted + ")";
  fail(expression, node,
       "'" + quoted + "' is a system: its matrices are written " + part +
           ".A, .B, .C and .D; a closed loop is feedback(G, K)");
}

/// A number, or a multiple of I, is one for each of `size` signals.
Bound Binder::as_system(const Expression& expression, const Node& node, Bound value, int size) {
  if (value.is_system()) return value;
  if (value.identity || (shape(value.at).is_scalar() && size > 1)) {
    const int wanted = std::max(size, 1);
    return {emit(expression, node, Op::identity, {value.at}, {wanted, wanted}), false, 0, -1};
  }
  return {value.at, false, 0, -1};
}

Bound Binder::bind_system(const Expression& expression, const Node& node) {
  return as_system(expression, node, bind_value(expression, node));
}

Bound Binder::part_of_system(const Expression& expression, const Node& node, Bound system,
                             char part) {
  const SystemParts of = parts_of(Emitter(*this, expression, node), system);
  return {part == 'A' ? of.a : part == 'B' ? of.b : part == 'C' ? of.c : of.d};
}

std::optional<Bound> Binder::part_of_name(const Expression& expression, const Node& node) {
  const std::size_t point = node.text.rfind('.');
  if (point == std::string::npos || point + 2 != node.text.size()) return std::nullopt;
  const char part = node.text.back();
  Node owner = node;
  owner.kind = NodeKind::name;
  owner.text.resize(point);
  owner.end -= 2;
  if (part < 'A' || part > 'D' ||
      !(environment_.contains(owner.text) || scope_.definitions.contains(owner.text)))
    return std::nullopt;
  const Bound value = bind_name(expression, owner);
  if (!value.is_system())
    fail(expression, node,
         "'" + owner.text + "' is no system, of which there were a part " +
             node.text.substr(point) + ": systems are made by ss, tf and what is made of them");
  return part_of_system(expression, node, value, part);
}

/// A: n x n, B: n x m, C: p x n, D: p x m.
Bound Binder::state_space(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const int a = square_argument(expression, node, "ss");
  const int n = shape(a).rows;
  const int b = input_matrix(expression, node, a);
  const int c = output_matrix(expression, *node.children[2], a);
  const Node& fourth = *node.children[3];
  const int d =
      materialise(expression, fourth, bind(expression, fourth), {shape(c).rows, shape(b).cols});
  int step = -1;
  if (node.children.size() == 5)
    step = materialise(expression, *node.children[4], bind(expression, *node.children[4]), {});
  return {make.blocks({a, b, c, d}, 2), false, n, step};
}

/// The controllable canonical form: the state is [w^(n-1); ...; w], den(s) w = u.
/// With den = s^n + a_1 s^(n-1) + ... + a_n and num likewise with b_k, after division by the
/// leading coefficient: D = b_0, C = [b_1 - a_1 b_0, ..., b_n - a_n b_0].
Bound Binder::transfer_function(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const auto vector = [&](std::size_t i) {
    const Node& argument = *node.children[i];
    const int at = sized(expression, argument, bind(expression, argument));
    if (shape(at).size() == 0 || (shape(at).rows != 1 && shape(at).cols != 1))
      fail(expression, argument,
           "tf needs the coefficients of a polynomial as a row, not " +
               describe(expression, argument, {at}));
    return at;
  };
  const int num = vector(0), den = vector(1);
  const int n = shape(den).size() - 1, m = shape(num).size() - 1;
  if (m > n)
    fail(expression, *node.children[0],
         "tf needs num no longer than den: a derivative is written with a filter, s/(s*T + 1)");
  int step = -1;
  if (node.children.size() == 3)
    step = materialise(expression, *node.children[2], bind(expression, *node.children[2]), {});
  const int leading = make.element(den, 0);
  const auto over_leading = [&](int at) { return make(Op::divide, {at, leading}); };
  const int d = m == n ? over_leading(make.element(num, 0)) : make.zeros({1, 1});
  if (n == 0) return {d, false, 0, -1};
  std::vector<int> first_row, c;
  for (int k = 1; k <= n; ++k) {
    const int of_den = over_leading(make.element(den, k));
    first_row.push_back(make.negate(of_den));
    const int at = k - (n - m);
    const int of_num = at < 0 ? make.zeros({1, 1}) : over_leading(make.element(num, at));
    c.push_back(m == n ? make.subtract(of_num, make.multiply(d, of_den)) : of_num);
  }
  const int row = make.blocks(std::move(first_row), n);
  const int below = make.blocks({make.identity(n - 1), make.zeros({n - 1, 1})}, 2);
  const int b = make.blocks({make.number("1"), make.zeros({n - 1, 1})}, 1);
  return {make.blocks({make.blocks({row, below}, 1), b, make.blocks(std::move(c), n), d}, 2), false,
          n, step};
}

/// In `series` a signal passes `first` first, then `second`. As A, B, C, D:
///
///   parallel   [A1, 0; 0, A2], [B1; B2], [C1, C2], D1 + D2
///   series     [A1, 0; B2 C1, A2], [B1; B2 D1], [D2 C1, C2], D2 D1
///   append     all four block diagonal
Bound Binder::pair_of_systems(const Expression& expression, const Node& node, Composed how,
                              Bound first, Bound second) {
  const Emitter make(*this, expression, node);
  // A number counts for each signal of the other.
  const bool is_series = how == Composed::series;
  if (how != Composed::append && !second.is_system()) {
    first = as_system(expression, node, first);
    second = as_system(expression, node, second, outputs_of(make, first));
  } else if (how != Composed::append) {
    first = as_system(expression, node, first,
                      is_series ? inputs_of(make, second) : outputs_of(make, second));
  }
  first = as_system(expression, node, first);
  second = as_system(expression, node, second);
  const SystemParts p = parts_of(make, first), q = parts_of(make, second);
  int step = std::max(first.step, second.step);
  if (first.states > 0 && second.states > 0 && first.step != second.step)
    fail(expression, node,
         first.step < 0 || second.step < 0
             ? "a continuous system meets a sampled one: c2d(A, B, T) samples the matrices of one"
             : "systems of different sampling times meet");
  const auto meet = [&](int outputs, int inputs, const char* what) {
    if (outputs != inputs)
      fail(expression, node,
           std::string("the systems do not fit: ") + std::to_string(outputs) + what +
               std::to_string(inputs));
  };
  const int a = make.block_diagonal(p.a, q.a);
  if (how == Composed::append)
    return system_of(make,
                     {a, make.block_diagonal(p.b, q.b), make.block_diagonal(p.c, q.c),
                      make.block_diagonal(p.d, q.d)},
                     step);
  if (how == Composed::parallel) {
    meet(inputs_of(make, first), inputs_of(make, second), " inputs beside ");
    meet(outputs_of(make, first), outputs_of(make, second), " outputs beside ");
    return system_of(
        make, {a, make.blocks({p.b, q.b}, 1), make.blocks({p.c, q.c}, 2), make.add(p.d, q.d)},
        step);
  }
  meet(outputs_of(make, first), inputs_of(make, second), " outputs meet inputs: ");
  const int coupled = make.blocks(
      {p.a, make.zeros({first.states, second.states}), make.multiply(q.b, p.c), q.a}, 2);
  return system_of(make,
                   {coupled, make.blocks({p.b, make.multiply(q.b, p.d)}, 1),
                    make.blocks({make.multiply(q.d, p.c), q.c}, 2), make.multiply(q.d, p.d)},
                   step);
}

Bound Binder::joined(const Expression& expression, const Node& node, Composed how) {
  Bound whole = bind_value(expression, *node.children[0]);
  for (std::size_t k = 1; k < node.children.size(); ++k)
    whole =
        pair_of_systems(expression, node, how, whole, bind_value(expression, *node.children[k]));
  return whole;
}

Bound Binder::sum_of_systems(const Expression& expression, const Node& node, Bound a, Bound b) {
  if (node.kind == NodeKind::subtract)
    b = b.is_system() ? pair_of_systems(expression, node, Composed::series, b,
                                        {number(expression, node, "-1"), true})
                      : Bound{emit(expression, node, Op::negate, {b.at}, shape(b.at)), b.identity};
  return pair_of_systems(expression, node, Composed::parallel, a, b);
}

/// G/x of a number x.
Bound Binder::divided_system(const Expression& expression, const Node& node, Bound system) {
  const Bound by = bind_value(expression, *node.children[1]);
  if (by.is_system())
    fail(expression, node,
         "systems are not divided: a closed loop is feedback(G, K), 1/(1 + L) is feedback(1, L)");
  const Bound bound{number(expression, node, "1"), false, -1, -1};
  return pair_of_systems(expression, node, Composed::series, system,
                         divide(expression, node, bound, by));
}

namespace {

/// u = K y between the last inputs u and outputs y of P; the inverse is of I - D_K D_22.
/// With u = K y, L = (I - D_K D_22)^-1 and the states [x; x_K]: u = L (D_K C_2 x + C_K x_K + D_K
/// D_21 w) and y = C_2 x + D_21 w + D_22 u are put into x', x_K' and the outputs left.
Bound closed(const Emitter& make, const Bound& p, const Bound& k, int step) {
  const Binder::SystemParts of = Binder::parts_of(make, p), by = Binder::parts_of(make, k);
  const int n = p.states, y = inputs_of(make, k), u = outputs_of(make, k);
  const int m = inputs_of(make, p), q = outputs_of(make, p);
  const int b1 = make.part(of.b, 0, n, 0, m - u), b2 = make.part(of.b, 0, n, m - u, m);
  const int c1 = make.part(of.c, 0, q - y, 0, n), c2 = make.part(of.c, q - y, q, 0, n);
  const int d11 = make.part(of.d, 0, q - y, 0, m - u), d12 = make.part(of.d, 0, q - y, m - u, m);
  const int d21 = make.part(of.d, q - y, q, 0, m - u), d22 = make.part(of.d, q - y, q, m - u, m);
  const int loop = make(Op::inverse, {make.subtract(make.identity(u), make.multiply(by.d, d22))},
                        {}, "the loop has no solution, as I - D_K*D");
  const int through = make.multiply(loop, by.d);
  const int ux = make.multiply(through, c2), uk = make.multiply(loop, by.c),
            uw = make.multiply(through, d21);
  const int yx = make.add(c2, make.multiply(d22, ux)), yk = make.multiply(d22, uk),
            yw = make.add(d21, make.multiply(d22, uw));
  return system_of(make,
                   {make.blocks({make.add(of.a, make.multiply(b2, ux)), make.multiply(b2, uk),
                                 make.multiply(by.b, yx), make.add(by.a, make.multiply(by.b, yk))},
                                2),
                    make.blocks({make.add(b1, make.multiply(b2, uw)), make.multiply(by.b, yw)}, 1),
                    make.blocks({make.add(c1, make.multiply(d12, ux)), make.multiply(d12, uk)}, 2),
                    make.add(d11, make.multiply(d12, uw))},
                   step);
}

}  // namespace

Bound Binder::linear_fraction(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const Bound p = bind_system(expression, *node.children[0]);
  const Bound k = bind_system(expression, *node.children[1]);
  if (outputs_of(make, k) > inputs_of(make, p) || inputs_of(make, k) > outputs_of(make, p))
    fail(expression, node,
         "lft(P, K) needs P with at least as many inputs as K has outputs, and outputs as K has "
         "inputs");
  const Bound both = pair_of_systems(expression, node, Composed::append, p, k);
  return closed(make, p, k, both.step);
}

/// lft([I; I]*G*[I, -I], K).
Bound Binder::feedback(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const Bound forward = bind_value(expression, *node.children[0]);
  const Bound given = node.children.size() == 2 ? bind_value(expression, *node.children[1])
                                                : Bound{number(expression, node, "1"), true};
  // A number counts for each signal of the other.
  const Bound g =
      as_system(expression, node, forward, given.is_system() ? inputs_of(make, given) : 1);
  const int inputs = inputs_of(make, g), outputs = outputs_of(make, g);
  const Bound k = as_system(expression, node, given, outputs);
  if (inputs_of(make, k) != outputs || outputs_of(make, k) != inputs)
    fail(expression, node,
         "feedback(G, K) needs K with " + std::to_string(outputs) + " inputs and " +
             std::to_string(inputs) + " outputs, not " + std::to_string(inputs_of(make, k)) +
             " and " + std::to_string(outputs_of(make, k)));
  const Bound both = pair_of_systems(expression, node, Composed::append, g, k);
  const SystemParts of = parts_of(make, g);
  const int minus_d = make.negate(of.d);
  const Bound p =
      system_of(make,
                {of.a, make.blocks({of.b, make.negate(of.b)}, 2), make.blocks({of.c, of.c}, 1),
                 make.blocks({of.d, minus_d, of.d, minus_d}, 2)},
                g.step);
  return closed(make, p, k, both.step);
}

/// A weight of one signal is one for each of several.
Bound Binder::augmented(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const Bound g = bind_system(expression, *node.children[0]);
  const SystemParts of = parts_of(make, g);
  const int m = inputs_of(make, g), p = outputs_of(make, g);
  const int zero_c = make.zeros({m, g.states}), zero_b = make.zeros({g.states, p});
  // [e; u; G u; e], as far as there are weights.
  std::vector<int> c, d;
  const auto add_error = [&] {
    c.push_back(make.negate(of.c));
    d.insert(d.end(), {make.identity(p), make.negate(of.d)});
  };
  add_error();
  const std::size_t weights = node.children.size() - 1;
  if (weights >= 2) {
    c.push_back(zero_c);
    d.insert(d.end(), {make.zeros({m, p}), make.identity(m)});
  }
  if (weights >= 3) {
    c.push_back(of.c);
    d.insert(d.end(), {make.zeros({p, p}), of.d});
  }
  add_error();
  const Bound plant = system_of(make,
                                {of.a, make.blocks({zero_b, of.b}, 2), make.blocks(std::move(c), 1),
                                 make.blocks(std::move(d), 2)},
                                g.step);
  std::optional<Bound> all;
  for (std::size_t k = 0; k < weights; ++k) {
    const int signals = k == 1 ? m : p;
    const Bound weight = as_system(expression, *node.children[k + 1],
                                   bind_value(expression, *node.children[k + 1]), signals);
    const bool single = inputs_of(make, weight) == 1 && outputs_of(make, weight) == 1;
    for (int copies = single ? signals : 1; copies > 0; --copies)
      all = all ? pair_of_systems(expression, node, Composed::append, *all, weight) : weight;
  }
  const Bound error{make.identity(p), false, 0, -1};
  return pair_of_systems(expression, node, Composed::series, plant,
                         pair_of_systems(expression, node, Composed::append, *all, error));
}

/// (sum_k d_k (-s T)^k)/(sum_k d_k (s T)^k), in the time t/T: x' = (A x + B u)/T.
Bound Binder::pade(const Expression& expression, const Node& node) {
  constexpr int kMost = 10;
  const Emitter make(*this, expression, node);
  const int t = materialise(expression, *node.children[0], bind(expression, *node.children[0]), {});
  const auto order = whole_number(expression, *node.children[1]);
  if (!order || *order < 0 || *order > kMost)
    fail(expression, *node.children[1],
         "the order must be a whole number known beforehand, from 0 to " + std::to_string(kMost));
  const int n = *order;
  if (n == 0) return {make.identity(1), false, 0, -1};
  const std::vector<std::string> coefficients = pade_coefficients(n);
  std::vector<int> first_row, c;
  for (int k = n - 1; k >= 0; --k) {
    const int of_den = make.number(coefficients[static_cast<std::size_t>(k)]);
    first_row.push_back(make.negate(of_den));
    const bool same_parity = (n - k) % 2 == 0;
    const int twice = make.scale(make.number("2"), of_den);
    c.push_back(same_parity ? make.zeros({1, 1}) : k % 2 == 0 ? twice : make.negate(twice));
  }
  const int row = make.blocks(std::move(first_row), n);
  const int a =
      make.blocks({row, make.blocks({make.identity(n - 1), make.zeros({n - 1, 1})}, 2)}, 1);
  const int b = make.blocks({make.number("1"), make.zeros({n - 1, 1})}, 1);
  const int d = n % 2 == 0 ? make.number("1") : make.negate(make.number("1"));
  return {
      make.blocks(
          {make(Op::divide, {a, t}), make(Op::divide, {b, t}), make.blocks(std::move(c), n), d}, 2),
      false, n, -1};
}

}  // namespace gainsmith::expr
