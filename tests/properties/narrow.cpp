// Sets of solutions that are thin, far away or touch a border. Margins of 10^-1 to 10^-14 and sizes
// of 1e20 are not for every case to be decided; a wrong answer is one anywhere.
//
// sliver   x_1 F_1 + ... + x_m F_m > 0, x_1 > 0 (or x_1 = 1, a constant): Y > 0 is planted with
//          F_i.Y = 0 for i > 1, and F_1 = e G - sum k_i F_i with G > 0, so F_1.Y = e G.Y. For
//          e > 0 x = (1, k) gives e G. A solution has 0 < x_1 e G.Y, so for e <= 0 there is none.
//          Bounds -3 <= x_i <= 3 exclude no k.
// budget   He(P A) + Q < 0, trace(W P) < c with A Hurwitz, W > 0, Q = -He(P_0 A): then
//          He((P - P_0) A) < 0, so P > P_0 and trace(W P) > trace(W P_0), as near to it as one
//          likes: exactly when c > trace(W P_0). With <= everywhere P = P_0 serves, so exactly when
//          c >= trace(W P_0). An objective changes nothing.
// box      He(P A) + Q < 0, P < M with A = T^-1 diag(-a) T, Q = T' diag(q) T, M = T' diag(m) T:
//          sign changes make P diagonal, so exactly when q < 2 a m for all modes; with <= exactly
//          when q <= 2 a m.
// tower    [x_i, x_i+1; *, 1] > 0, x_k >= c, x_1 <= h: x_i > x_i+1^2, exactly when h > c^(2^(k-1)),
//          where x_1 is up to 1e20. Without h a yes.
// remote   T'[x, b; *, y] T >= 0, y <= e: x y >= b^2 holds for y = e > 0, x = b^2/e. For e = 0
// there is
//          none, weakly: y = 0 leaves b = 0. With > the same.
#include <array>

#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

/// 10^-1 to 10^-14 times 1 to 9, negative for a no.
Exact thin(Draw& draw) {
  const int digit = draw.between(1, 9);
  const Exact size = digit * ten_to(-draw.between(2, 14));
  return draw.is_yes() ? size : Exact(-size);
}

/// The same, or 0 for a no.
Exact thin_or_none(Draw& draw) {
  const Exact drawn = thin(draw);
  return drawn < 0 && draw.chance(0.2) ? Exact(0) : drawn;
}

/// Coordinates, sometimes in units of 10^-12 to 10^12 besides.
Coordinates wild(Draw& draw, int n) {
  const Coordinates to = draw.coordinates(n);
  if (!draw.chance(0.3)) return to;
  std::vector<Exact> units;
  std::vector<Exact> inverses;
  for (int i = 0; i < n; ++i) {
    units.push_back(ten_to(draw.between(-12, 12)));
    inverses.push_back(1 / units.back());
  }
  return {to.T * ExactMatrix::diagonal(units), ExactMatrix::diagonal(inverses) * to.inverse};
}

ExactMatrix congruent(const Coordinates& to, const ExactMatrix& M) {
  return to.T.transpose() * M * to.T;
}

/// diag of 1 to 5.
ExactMatrix positive(Draw& draw, int n) {
  std::vector<Exact> d;
  for (int i = 0; i < n; ++i) d.push_back(draw.between(1, 5));
  return ExactMatrix::diagonal(d);
}

ExactMatrix he(const ExactMatrix& M) { return M + M.transpose(); }

Case sliver(Draw& draw) {
  const int n = draw.between(2, 4);
  const int m = draw.between(2, n * (n + 1) / 2 - 1 > 4 ? 4 : n * (n + 1) / 2 - 1);
  const Coordinates to = wild(draw, n);
  const ExactMatrix Y = positive(draw, n);
  const Exact whole = trace_product(Y, ExactMatrix::identity(n));
  const bool constant = draw.chance(0.5);
  const bool bounded = draw.chance(0.3);
  const Exact room = thin_or_none(draw);
  ExactMatrix first = room * positive(draw, n);
  std::string declared = "F1: symmetric n";
  std::string unknowns = constant ? "" : "x1: scalar";
  std::string sum = constant ? "F1" : "x1*F1";
  std::string data;
  std::string bounds;
  for (int i = 2; i <= m; ++i) {
    const ExactMatrix drawn = symmetric(draw, n);
    const Exact off = -trace_product(drawn, Y);
    const ExactMatrix F = whole * drawn + off * ExactMatrix::identity(n);
    first = first + Exact(draw.between(-3, 3)) * F;
    const std::string k = std::to_string(i);
    declared += ", F" + k + ": symmetric n";
    unknowns += (unknowns.empty() ? "x" : ", x") + k + ": scalar";
    sum += " + x" + k + "*F" + k;
    data += "  F" + k + ": " + yaml(congruent(to, F)) + "\n";
    if (bounded && constant) bounds += ", b" + k + ": -3 <= x" + k + " <= 3";
  }
  return {"sliver",
          "method:\n  method: sliver\n  data: {" + declared + "}\n  unknowns: {" + unknowns +
              "}\n  require: {sum: " + sum + " > 0" + (constant ? "" : ", first: x1 > 0") + bounds +
              "}\ndata:\n  F1: " + yaml(congruent(to, first)) + "\n" + data,
          draw.is_yes(), false};
}

Case budget(Draw& draw) {
  const int n = draw.between(1, 3);
  const bool strict = draw.chance(0.7);
  const Exact rate = draw.unit();
  const Coordinates to = wild(draw, n);
  const ExactMatrix A = continuous_spectrum(draw, n, -draw.hundredths(10, 100));
  const ExactMatrix least = positive(draw, n);
  const ExactMatrix weight = positive(draw, n);
  const Exact reached = trace_product(weight, least);
  Exact distance = thin_or_none(draw);
  if (!strict && distance == 0) distance = -ten_to(-9);
  if (!strict && draw.is_yes() && draw.chance(0.2)) distance = 0;
  const ExactMatrix Q = (-rate) * he(least * A);
  const std::string less = strict ? " < " : " <= ";
  return {
      "budget",
      "method:\n  method: budget\n  data: {A: n x n, Q: symmetric n, W: symmetric n, c: scalar}\n"
      "  unknowns: {P: symmetric n}\n  require: {decrease: He(P*A) + Q" +
          less + "0, cost: trace(W*P)" + less + "c}\n" +
          (draw.chance(0.5) ? "  minimize: trace(W*P)\n" : "") +
          "data:\n  A: " + yaml(rate * similar(to, A)) + "\n  Q: " + yaml(congruent(to, Q)) +
          "\n  W: " + yaml(to.inverse * weight * to.inverse.transpose()) +
          "\n  c: " + decimal(reached * (1 + distance)) + "\n",
      draw.is_yes(), false};
}

Case box(Draw& draw) {
  const int n = draw.between(1, 4);
  const bool strict = draw.chance(0.7);
  const Exact rate = draw.unit();
  const Coordinates to = wild(draw, n);
  const ExactMatrix most = positive(draw, n);
  const int place = draw.below(n);
  Exact distance = thin_or_none(draw);
  if (!strict && distance == 0) distance = -ten_to(-9);
  if (!strict && draw.is_yes() && draw.chance(0.2)) distance = 0;
  ExactMatrix A(n, n);
  ExactMatrix Q(n, n);
  for (int i = 0; i < n; ++i) {
    A(i, i) = rate * -draw.hundredths(10, 300);
    const Exact part = i == place ? Exact(1 - distance) : draw.hundredths(-100, 90);
    Q(i, i) = -2 * A(i, i) * most(i, i) * part;
  }
  const std::string less = strict ? " < " : " <= ";
  return {"box",
          "method:\n  method: box\n  data: {A: n x n, Q: symmetric n, M: symmetric n}\n"
          "  unknowns: {P: symmetric n}\n  require: {decrease: He(P*A) + Q" +
              less + "0, most: P" + less + "M}\ndata:\n  A: " + yaml(similar(to, A)) +
              "\n  Q: " + yaml(congruent(to, Q)) + "\n  M: " + yaml(congruent(to, most)) + "\n",
          draw.is_yes(), false};
}

Case tower(Draw& draw) {
  const int count = draw.between(2, 7);
  // c^(2^(k-1)) is at most 1e20.
  constexpr std::array<int, 6> kWhole = {9, 9, 9, 9, 4, 2};
  constexpr std::array<int, 6> kTens = {10, 5, 2, 1, 0, 0};
  const auto place = static_cast<std::size_t>(count - 2);
  const bool tens = kTens[place] > 0 && draw.chance(0.5);
  const Exact last =
      tens ? ten_to(draw.between(1, kTens[place])) : Exact(draw.between(2, kWhole[place]));
  Exact reached = last;
  std::string unknowns;
  std::string require;
  for (int i = 1; i <= count; ++i) {
    const std::string k = std::to_string(i);
    unknowns += (i > 1 ? ", x" : "x") + k + ": scalar";
    if (i == count) continue;
    reached = reached * reached;
    require += "    step" + k + ": \"[x" + k + ", x" + std::to_string(i + 1) + "; *, 1] > 0\"\n";
  }
  const bool bounded = !draw.is_yes() || draw.chance(0.8);
  const Exact most = reached * (1 + thin_or_none(draw));
  return {"tower",
          "method:\n  method: tower\n  data: {c: scalar, h: {shape: scalar, default: 1}}\n"
          "  unknowns: {" +
              unknowns + "}\n  require:\n" + require + "    last: x" + std::to_string(count) +
              " >= c\n" + (bounded ? "    first: x1 <= h\n" : "") + "data: {c: " + decimal(last) +
              (bounded ? ", h: " + decimal(most) : "") + "}\n",
          draw.is_yes(), false};
}

Case remote(Draw& draw) {
  const std::string greater = draw.chance(0.5) ? " >= " : " > ";
  const Exact size = ten_to(-draw.between(2, 20));
  const Exact most = draw.is_yes() ? size : draw.chance(0.5) ? Exact(0) : Exact(-size);
  const Coordinates to = draw.coordinates(2);
  return {"remote",
          "method:\n  method: remote\n  data: {T: 2 x 2, b: scalar, e: scalar}\n"
          "  unknowns: {x: scalar, y: scalar}\n  require:\n    corner: \"T'*[x, b; *, y]*T" +
              greater + "0\"\n    most: y <= e\ndata:\n  T: " + yaml(to.T) +
              "\n  b: " + decimal(draw.between(1, 9)) + "\n  e: " + decimal(most) + "\n",
          draw.is_yes(), false};
}

}  // namespace

std::vector<Family> narrow_families() {
  return {{"sliver", 6, sliver},
          {"budget", 6, budget},
          {"box", 5, box},
          {"tower", 3, tower},
          {"remote", 3, remote}};
}

}  // namespace gainsmith::tests::properties
