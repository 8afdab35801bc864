// Gains that place the poles of a closed loop.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/emitter.h"

namespace gainsmith::expr {

/// K of A - B K with the poles p: with vectors g of inputs, X of A X - X L = B G and K = G X^-1,
/// where L has the poles (Bhattacharyya and de Souza). A pair s +- i w has the block [s, w; -w, s]
/// of L; of m inputs a pole may be there m times, each further one is coupled to the one m before
/// by a 1 above the diagonal. Columns of X are found one pole at a time: (A - s I) x = B g for a
/// real pole s. For a pair s +- i w it is [A - s I, w I; -w I, A - s I] [x; y] = [B g; 0].
Bound Binder::placed(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const int a = square_argument(expression, node, node.text);
  const int b = input_matrix(expression, node, a);
  const int n = shape(a).rows, m = shape(b).cols;
  if (n == 0 || m == 0) fail(expression, node, "place needs a state and an input");
  // Different directions for each pole, none of which is along an axis.
  const auto direction = [&](int k) {
    std::vector<int> elements;
    for (int i = 0; i < m; ++i)
      elements.push_back(make.number(
          k % m == i ? "1" : fmt::format("{:.3f}", 0.5 * std::cos((k + 1.0) * (i + 2.0)))));
    return make.blocks(std::move(elements), 1);
  };
  std::vector<int> columns, inputs;
  const auto solve = [&](int matrix, int right) {
    return make.multiply(
        make(Op::inverse, {matrix}, {},
             "place: A less a wanted pole, which A has already or which cannot be moved,"),
        right);
  };
  std::optional<Pole> last;
  int turn_of = 0, copies = 0;
  for (const Pole& pole : poles_of(expression, *node.children[2], n)) {
    const int shifted = make.subtract(a, make.identity(pole.real, n));
    inputs.push_back(direction(turn_of++));
    copies = last && last->value == pole.value && last->turn == pole.turn ? copies + 1 : 0;
    const bool again = copies >= m;
    last = pole;
    int moved = make.multiply(b, inputs.back());
    if (!pole.imaginary) {
      columns.push_back(solve(shifted, again ? make.add(moved, *(columns.end() - m)) : moved));
      continue;
    }
    int turned = make.zeros({n, 1});
    if (again) {
      moved = make.add(moved, *(columns.end() - 2 * m));
      turned = *(columns.end() - 2 * m + 1);
    }
    const int turn = make.identity(*pole.imaginary, n);
    const int pair = solve(make.blocks({shifted, turn, make.negate(turn), shifted}, 2),
                           make.blocks({moved, turned}, 1));
    columns.push_back(make.part(pair, 0, n, 0, 1));
    columns.push_back(make.part(pair, n, 2 * n, 0, 1));
    inputs.push_back(make.zeros({m, 1}));
  }
  const int x = make(Op::inverse, {make.blocks(std::move(columns), n)}, {},
                     "place: the matrix of eigenvectors, since a pole of A cannot be moved by B,");
  return {make.multiply(make.blocks(std::move(inputs), n), x)};
}

/// Real ones, then those above the real axis, equal ones beside each other.
std::vector<Binder::Pole> Binder::poles_of(const Expression& expression, const Node& node, int n) {
  const Emitter make(*this, expression, node);
  const int at = sized(expression, node, bind(expression, node));
  const Shape of = shape(at);
  const bool complex = of == Shape{2, n};
  if (!complex && of != Shape{1, n} && of != Shape{n, 1})
    fail(expression, node,
         "place needs " + std::to_string(n) +
             " poles: a row, or their real parts above their imaginary parts, not " +
             describe(expression, node, {at}));
  const auto value = [&](int element) {
    return scope_.known->number(known_program(expression, node, element, "the poles"));
  };
  std::vector<Pole> above, below;
  for (int k = 0; k < n; ++k) {
    const int real = complex ? make.element(at, 0, k) : make.element(at, k);
    Pole pole{value(real), 0, real, std::nullopt};
    const int imaginary = complex ? make.element(at, 1, k) : -1;
    const double turn = complex ? value(imaginary) : 0;
    pole.turn = std::abs(turn);
    if (turn != 0) pole.imaginary = imaginary;
    if (turn < 0) below.push_back(pole);
    if (turn >= 0) above.push_back(pole);
  }
  const auto key = [](const Pole& pole) { return std::pair(pole.turn, pole.value); };
  std::ranges::sort(above, {}, key);
  std::ranges::sort(below, {}, key);
  const auto first_complex =
      std::ranges::find_if(above, [](const Pole& pole) { return pole.turn > 0; });
  if (!std::equal(first_complex, above.end(), below.begin(), below.end(),
                  [&](const Pole& x, const Pole& y) { return key(x) == key(y); }))
    fail(expression, node, "place: a complex pole comes with its conjugate");
  return above;
}

}  // namespace gainsmith::expr
