// Jordan blocks near and on the axis, wild units, and requirements that decide nothing.
//
// chain    He(P A) < 0, P > 0, A = T^-1 blkdiag(J, D) T with a Jordan block J of [-d] or of [-d, w;
//          -w, -d], D diagonal and below -0.2: exactly when d > 0.
// axis     He(P A) <= 0, P > 0 with the same J, d = 0: solutions of x' = A x would stay bounded.
//          A chain of two or more on the axis grows like t: none, weakly, as A - e I has one for
//          every e > 0. A chain of one is a yes: P = T'T.
// circle   A'P A <= P, P > 0, the same with moduli 1 from [3/5, 4/5; -4/5, 3/5] or 1, -1.
// wild     He(P A) < 0, P > 0 with each state and the time in units of 10^-15 to 10^15: exactly
//          when the largest real part is negative.
// beside   two such inequalities in different unknowns and units, one of them with room to spare,
//          and requirements that exclude nothing, P + k I > 0, 1 < z < 2: the other one decides.
// wide     He(P A - Y C) < 0, P > 0 with 6 to 8 states: A = T^-1 [0, 0; A21, A2] T, C = [I, 0] T,
//          the largest real part of A2 is -d: exactly when d > 0.
// passive  He(P A) < 0, P > 0, P B == C' with A = T^-1 diag(-a) T, B = T^-1 [1; 1; ...], C = [c] T:
//          P = T' diag(c) T is a solution for c > 0. A solution has, with x = -A^-1 B,
//          0 < -x' He(P A) x = 2 x'P B = 2 C x = 2 sum c_i/a_i: a no when that is not positive.
#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

Exact near_axis(Draw& draw) {
  const int digit = draw.between(1, 9);
  const Exact size = digit * ten_to(-draw.between(1, 8));
  if (draw.is_yes()) return size;
  return draw.chance(0.2) ? Exact(0) : Exact(-size);
}

/// A chain of `links` cells at the upper left, ones between them; `rest` states with small elements
/// on the diagonal.
ExactMatrix chained(const ExactMatrix& cell, int links, const std::vector<Exact>& rest) {
  const int width = cell.rows();
  const int n = width * links + static_cast<int>(rest.size());
  ExactMatrix A(n, n);
  for (int k = 0; k < links; ++k)
    for (int i = 0; i < width; ++i) {
      for (int j = 0; j < width; ++j) A(k * width + i, k * width + j) = cell(i, j);
      if (k + 1 < links) A(k * width + i, (k + 1) * width + i) = 1;
    }
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const int at = width * links + static_cast<int>(i);
    A(at, at) = rest[i];
  }
  return A;
}

ExactMatrix turning(const Exact& part, const Exact& turn) {
  ExactMatrix cell(2, 2);
  cell(0, 0) = cell(1, 1) = part;
  cell(0, 1) = turn;
  cell(1, 0) = -turn;
  return cell;
}

ExactMatrix cell_of(Draw& draw, const Exact& part) {
  if (draw.chance(0.5)) return turning(part, draw.between(1, 3));
  return part * ExactMatrix::identity(1);
}

std::vector<Exact> others(Draw& draw, int low, int high) {
  std::vector<Exact> rest;
  for (int i = draw.below(3); i > 0; --i) rest.push_back(draw.hundredths(low, high));
  return rest;
}

Case one_matrix(Draw& draw, const std::string& name, const std::string& decrease,
                const ExactMatrix& A) {
  return {name,
          "method:\n  method: " + name + "\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n" +
              "  require: {positive: P > 0, decrease: " + decrease + "}\ndata:\n  A: " + yaml(A) +
              "\n",
          draw.is_yes(), false};
}

Case chain(Draw& draw) {
  const ExactMatrix cell = cell_of(draw, -near_axis(draw));
  const int links = draw.between(1, 4 / cell.rows());
  const ExactMatrix A = chained(cell, links, others(draw, -300, -20));
  const Exact rate = draw.unit();
  return one_matrix(draw, "chain", "He(P*A) < 0", rate * similar(draw.coordinates(A.rows()), A));
}

Case axis(Draw& draw) {
  const int links = draw.is_yes() ? 1 : draw.between(2, 3);
  const ExactMatrix cell = cell_of(draw, 0);
  const ExactMatrix A = chained(cell, links, others(draw, -300, -20));
  const Exact rate = draw.unit();
  return one_matrix(draw, "axis", "He(P*A) <= 0", rate * similar(draw.coordinates(A.rows()), A));
}

Case circle(Draw& draw) {
  const int links = draw.is_yes() ? 1 : 2;
  const ExactMatrix cell = draw.chance(0.5)
                               ? turning(Exact(6) / 10, Exact(8) / 10)
                               : Exact(draw.chance(0.5) ? 1 : -1) * ExactMatrix::identity(1);
  const ExactMatrix A = chained(cell, links, others(draw, -90, 90));
  return one_matrix(draw, "circle", "A'*P*A <= P", similar(draw.coordinates(A.rows()), A));
}

/// Units of 10^-15 to 10^15 for each state.
ExactMatrix in_wild_units(Draw& draw, const ExactMatrix& A) {
  std::vector<int> exponents;
  for (int i = 0; i < A.rows(); ++i) exponents.push_back(draw.between(-15, 15));
  const int rate = draw.between(-15, 15);
  ExactMatrix scaled = A;
  for (int i = 0; i < A.rows(); ++i)
    for (int j = 0; j < A.rows(); ++j)
      scaled(i, j) *= ten_to(exponents[static_cast<std::size_t>(j)] -
                             exponents[static_cast<std::size_t>(i)] + rate);
  return scaled;
}

Case wild(Draw& draw) {
  const int n = draw.between(1, 4);
  const ExactMatrix A = continuous_spectrum(draw, n, -draw.distance(true));
  return one_matrix(draw, "wild", "He(P*A) < 0",
                    in_wild_units(draw, similar(draw.coordinates(n), A)));
}

Case beside(Draw& draw) {
  const int n = draw.between(1, 3);
  const int m = draw.between(1, 3);
  const ExactMatrix planted = continuous_spectrum(draw, n, -draw.distance(true));
  const Exact rate = draw.unit();
  const ExactMatrix A = rate * similar(draw.coordinates(n), planted);
  const ExactMatrix B = continuous_spectrum(draw, m, -draw.hundredths(20, 100));
  const std::string k = decimal(ten_to(draw.between(-6, 6)));
  return {"beside",
          "method:\n  method: beside\n  data: {A: n x n, B: m x m}\n"
          "  unknowns: {P: symmetric n, R: symmetric m, z: scalar}\n  require:\n"
          "    positive: P > 0\n    decrease: He(P*A) < 0\n    idle: P + " +
              k + "*I > 0\n    other: R > I\n    other_decrease: He(R*B) + " + k +
              "*I < 0\n    number: 1 < z < 2\ndata:\n  A: " + yaml(A) +
              "\n  B: " + yaml(in_wild_units(draw, B)) + "\n",
          draw.is_yes(), false};
}

Case wide(Draw& draw) {
  const int n = draw.between(6, 8);
  const int seen = draw.between(1, 4);
  const ExactMatrix hidden = continuous_spectrum(draw, n - seen, -near_axis(draw));
  ExactMatrix A(n, n);
  ExactMatrix C(seen, n);
  for (int i = 0; i < seen; ++i) C(i, i) = 1;
  for (int i = seen; i < n; ++i)
    for (int j = 0; j < n; ++j)
      A(i, j) = j < seen ? draw.between(-2, 2) : hidden(i - seen, j - seen);
  const Coordinates to = draw.coordinates(n);
  return {"wide",
          "method:\n  method: wide\n  data: {A: n x n, C: p x n}\n"
          "  unknowns: {P: symmetric n, Y: n x p}\n"
          "  require: {positive: P > 0, decrease: He(P*A - Y*C) < 0}\ndata:\n  A: " +
              yaml(similar(to, A)) + "\n  C: " + yaml(C * to.T) + "\n",
          draw.is_yes(), false};
}

Case passive(Draw& draw) {
  const int n = draw.between(1, 3);
  ExactMatrix A(n, n);
  ExactMatrix B(n, 1);
  ExactMatrix C(1, n);
  Exact rest = 0;
  for (int i = 0; i < n; ++i) {
    const Exact rate = two_to(draw.between(-2, 2));
    A(i, i) = -rate;
    B(i, 0) = 1;
    const Exact tiny = near_axis(draw);
    C(0, i) = i == 0 && draw.is_yes() ? tiny : draw.hundredths(20, 200);
    if (i == n - 1 && !draw.is_yes()) C(0, i) = rate * (tiny - rest);
    rest += C(0, i) / rate;
  }
  const Coordinates to = draw.coordinates(n);
  return {"passive",
          "method:\n  method: passive\n  data: {A: n x n, B: n x 1, C: 1 x n}\n"
          "  unknowns: {P: symmetric n}\n"
          "  require: {positive: P > 0, decrease: He(P*A) < 0, output: P*B == C'}\ndata:\n  A: " +
              yaml(similar(to, A)) + "\n  B: " + yaml(to.inverse * B) + "\n  C: " + yaml(C * to.T) +
              "\n",
          draw.is_yes(), false};
}

}  // namespace

std::vector<Family> chain_families() {
  return {{"chain", 6, chain},   {"axis", 2, axis}, {"circle", 2, circle},  {"wild", 5, wild},
          {"beside", 5, beside}, {"wide", 1, wide}, {"passive", 3, passive}};
}

}  // namespace gainsmith::tests::properties
