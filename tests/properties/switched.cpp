// Several matrices, several unknowns.
//
// common    One P for A_1, ..., A_k (in a set, or all their convex combinations): A_i = T^-1 R_i T,
//           R_i upper triangular. With P = diag(1, s, s^2, ...) in these coordinates and s large
//           enough one P serves all whose diagonals are negative (discrete time: below 1 in
//           modulus). A diagonal element >= 0 (>= 1) of one of them is an eigenvalue of it: none.
// diagonal  P diagonal for A = S^-1 (M - d I) S, S diagonal, M with nonnegative elements off its
//           diagonal (a Metzler matrix): P exists exactly when A is Hurwitz. M has the row sums r,
//           so its largest eigenvalue is r: yes when r < d.
// pair      Two unknowns that bound each other: He(P1 A1) < -P2, He(P2 A2) < -P1 after P > 0, for
//           A_i = T^-1 diag(-a_i) T with the same T: the k-th diagonal elements p, q satisfy
//           2 a p > q, 2 b q > p, so 4 a b > 1 for every k (averaging over sign changes makes P1
//           and P2 diagonal).
#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

Case common(Draw& draw) {
  const int n = draw.between(2, 3);
  const int count = draw.between(2, 3);
  const bool discrete = draw.chance(0.4);
  const bool polytope = !discrete && draw.chance(0.5);
  const Exact rate = discrete ? Exact(1) : draw.unit();
  const Coordinates to = draw.coordinates(n);
  const int mode = draw.below(count);
  const int place = draw.below(n);
  const Exact worst = draw.distance(true);
  std::string data;
  std::string declared;
  std::string names;
  for (int k = 0; k < count; ++k) {
    ExactMatrix R(n, n);
    for (int i = 0; i < n; ++i) {
      R(i, i) = discrete ? draw.hundredths(-80, 80) : -draw.hundredths(20, 300);
      for (int j = i + 1; j < n; ++j) R(i, j) = draw.hundredths(-50, 50);
    }
    if (k == mode) R(place, place) = discrete ? 1 - worst / 2 : -worst;
    const std::string name = "A" + std::to_string(k);
    declared += (k > 0 ? ", " : "") + name + ": n x n";
    names += (k > 0 ? ", " : "") + name;
    data += "  " + name + ": " + yaml(rate * similar(to, R)) + "\n";
  }
  return {"common",
          "method:\n  method: common\n  data: {" + declared +
              "}\n  unknowns: {P: symmetric n}\n  require:\n    positive: P > 0\n    decrease: "
              "{forall: \"A in " +
              (polytope ? "conv{" : "{") + names + "}\", that: \"" +
              (discrete ? "A'*P*A < P" : "He(P*A) < 0") + "\"}\ndata:\n" + data,
          draw.is_yes(), draw.is_easy()};
}

Case diagonal(Draw& draw) {
  const int n = draw.between(2, 5);
  const Exact rate = draw.unit();
  const Coordinates to = draw.scales(n);
  const Exact sum = draw.between(2 * n, 3 * n);
  const Exact distance = draw.distance() / 4;
  ExactMatrix A(n, n);
  for (int i = 0; i < n; ++i) {
    Exact rest = sum;
    for (int j = 0; j < n; ++j) {
      if (j == i) continue;
      A(i, j) = draw.hundredths(0, 200);
      rest -= A(i, j);
    }
    A(i, i) = rest - sum * (1 + distance);
  }
  return {"diagonal",
          "method:\n  method: diagonal\n  data: {A: n x n}\n  unknowns: {P: diagonal n}\n"
          "  require: {positive: P > 0, decrease: He(P*A) < 0}\ndata:\n  A: " +
              yaml(rate * similar(to, A)) + "\n",
          draw.is_yes(), draw.is_easy()};
}

Case pair(Draw& draw) {
  const int n = draw.between(1, 3);
  const Coordinates to = draw.coordinates(n);
  const int place = draw.below(n);
  const Exact ratio = draw.unit();
  std::vector<Exact> a;
  std::vector<Exact> b;
  for (int i = 0; i < n; ++i) {
    // 4 a b = 1 + d, or well above 1.
    const Exact power = two_to(draw.between(-3, 3));
    a.push_back(-power / 2 * ratio);
    const Exact product = i == place ? 1 + draw.distance(true) / 2 : 1 + draw.hundredths(20, 300);
    b.push_back(-product / power / 2 / ratio);
  }
  const ExactMatrix A1 = similar(to, ExactMatrix::diagonal(a));
  const ExactMatrix A2 = similar(to, ExactMatrix::diagonal(b));
  return {"pair",
          "method:\n  method: pair\n  data: {A1: n x n, A2: n x n}\n"
          "  unknowns: {P1: symmetric n, P2: symmetric n}\n"
          "  require: {p1: P1 > 0, p2: P2 > 0, one: He(P1*A1) < -P2, two: He(P2*A2) < -P1}\n"
          "data:\n  A1: " +
              yaml(A1) + "\n  A2: " + yaml(A2) + "\n",
          draw.is_yes(), draw.is_easy()};
}

}  // namespace

std::vector<Family> switched_families() {
  return {{"common", 10, common}, {"diagonal", 6, diagonal}, {"pair", 5, pair}};
}

}  // namespace gainsmith::tests::properties
