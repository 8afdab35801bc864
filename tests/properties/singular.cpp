// Blocks with >=, opposite pairs and singular data.
//
// trace      He(P A) < 0, P > 0, trace(P) <= k and trace(P) >= k, k a whole number: a solution of
//            the Lyapunov inequality may be scaled, so the pair changes nothing of its answer.
// turning    He(P A) <= 0, He(P A) >= 0, P > 0: A = T^-1 [a, w; -w, a] T. a = 0: P = T'T. Otherwise
//            trace(A) = 0 would follow from He(P A) = 0 (multiply by P^-1): none.
// marginal   He(P A) <= 0, P > 0 with A = T^-1 diag(0, -a) T: P = T'T. With A = T^-1 [0, 1; 0, 0] T
//            x'Px would not grow along x(t), which grows without bound: none. Weakly infeasible,
//            as A - e I has a P for every e > 0.
// rank one   u u' - x v v' >= 0, x >= 1/1024: exactly when v is a multiple of u.
// corner     [x, b; *, 0] >= 0: exactly when b = 0; weakly infeasible otherwise.
// bracket    x <= h and x >= l, of whole numbers: exactly when l <= h.
#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

Case trace(Draw& draw) {
  const int n = draw.between(1, 3);
  const Exact rate = draw.unit();
  const ExactMatrix planted = continuous_spectrum(draw, n, -draw.distance(true));
  const ExactMatrix A = rate * similar(draw.coordinates(n), planted);
  return {
      "trace",
      "method:\n  method: trace\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0, decrease: He(P*A) < 0, least: trace(P) >= 4, most: trace(P) "
      "<= 4}\ndata:\n  A: " +
          yaml(A) + "\n",
      draw.is_yes(), false};
}

Case turning(Draw& draw) {
  const Exact rate = draw.unit();
  ExactMatrix A(2, 2);
  A(0, 1) = draw.between(1, 5);
  A(1, 0) = -A(0, 1);
  if (!draw.is_yes()) A(0, 0) = A(1, 1) = draw.distance() * (draw.chance(0.5) ? 1 : -1);
  A = rate * similar(draw.coordinates(2), A);
  return {"turning",
          "method:\n  method: turning\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
          "  require: {positive: P > 0, least: He(P*A) >= 0, most: He(P*A) <= 0}\ndata:\n  A: " +
              yaml(A) + "\n",
          draw.is_yes(), false};
}

Case marginal(Draw& draw) {
  const Exact rate = draw.unit();
  ExactMatrix A(2, 2);
  if (draw.is_yes())
    A(1, 1) = -draw.between(1, 5);
  else
    A(0, 1) = 1;
  A = rate * similar(draw.coordinates(2), A);
  return {"marginal",
          "method:\n  method: marginal\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
          "  require: {positive: P > 0, decrease: He(P*A) <= 0}\ndata:\n  A: " +
              yaml(A) + "\n",
          draw.is_yes(), false};
}

Case rank_one(Draw& draw) {
  const int n = draw.between(2, 3);
  const Coordinates to = draw.scales(n);
  ExactMatrix u(n, 1);
  for (int i = 0; i < n; ++i) u(i, 0) = draw.between(1, 5);
  ExactMatrix v = Exact(draw.between(1, 4)) * u;
  if (!draw.is_yes()) v(draw.below(n), 0) += draw.chance(0.5) ? Exact(1) : ten_to(-6);
  return {"rank-one",
          "method:\n  method: rank-one\n  data: {u: n x 1, v: n x 1}\n  unknowns: {x: scalar}\n"
          "  require: {above: \"u*u' - x*v*v' >= 0\", positive: x >= 1/1024}\ndata:\n  u: " +
              yaml(to.T * u) + "\n  v: " + yaml(to.T * v) + "\n",
          draw.is_yes(), false};
}

Case corner(Draw& draw) {
  const Exact b = draw.is_yes() ? Exact(0) : draw.unit();
  return {"corner",
          "method:\n  method: corner\n  data: {b: scalar}\n  unknowns: {x: scalar}\n"
          "  require: {corner: \"[x, b; *, 0] >= 0\", some: x >= 1}\ndata: {b: " +
              decimal(b) + "}\n",
          draw.is_yes(), false};
}

Case bracket(Draw& draw) {
  const int l = draw.between(1, 9);
  const int h = draw.is_yes() ? l + (draw.chance(0.5) ? 0 : 1) : l - 1;
  const Exact unit = two_to(draw.between(-8, 8));
  return {"bracket",
          "method:\n  method: bracket\n  data: {l: scalar, h: scalar}\n  unknowns: {x: scalar}\n"
          "  require: {least: x >= l, most: x <= h}\ndata: {l: " +
              decimal(unit * l) + ", h: " + decimal(unit * h) + "}\n",
          draw.is_yes(), false};
}

}  // namespace

std::vector<Family> singular_families() {
  return {{"trace", 2, trace},       {"turning", 1, turning}, {"marginal", 1, marginal},
          {"rank-one", 1, rank_one}, {"corner", 1, corner},   {"bracket", 1, bracket}};
}

}  // namespace gainsmith::tests::properties
