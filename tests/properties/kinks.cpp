// Functions of tau with kinks, cusps and inner extrema.
//
// kink     He(P (A0 + f(tau) A1)) < 0 for all tau in [a, b], P > 0, f with the range [low, high],
//          attained. A0 = T^-1 D0 T, A1 = T^-1 D1 T with diagonal (or turning) blocks, so the
//          matrices commute and are normal in these coordinates: P = T'T serves all of them when
//          every mode alpha + beta f is negative at both ends of the range; where one is >= 0 at
//          some tau, that matrix has an eigenvalue >= 0 and there is none.
//          The worst mode has its worst value at the kink (a value between two samples) or at
//          an end.
#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

struct Function {
  std::string text;
  Exact from, to;   ///< the interval
  Exact low, high;  ///< the range over it
};

/// f of tau over [0, 2 c], its centre at a decimal of its own so that no grid meets it.
Function drawn_function(Draw& draw) {
  const Exact c = Exact(draw.between(311, 997)) / 1000;
  const Exact end = 2 * c;
  const std::string at = decimal(c);
  const std::string shifted = "(tau - " + at + ")";
  const Exact half = c / 2;
  switch (draw.below(9)) {
    case 0:
      return {"abs" + shifted, 0, end, 0, c};
    case 1:
      return {shifted + "^2", 0, end, 0, c * c};
    case 2:
      return {"sqrt(abs" + shifted + ")", c - Exact(49) / 100, c + Exact(49) / 100, 0,
              Exact(7) / 10};
    case 3:
      return {"min(tau, " + decimal(2 * c) + " - tau)", 0, end, 0, c};
    case 4:
      return {"max(tau, " + decimal(2 * c) + " - tau)", 0, end, c, end};
    case 5:
      return {"clip(tau, " + decimal(half) + ", " + at + ")", 0, end, half, c};
    case 6:
      return {"where(tau < " + at + ", tau, " + decimal(2 * c) + " - tau)", 0, end, 0, c};
    case 7:
      return {"norm([tau - " + at + "; 0.3])", c - Exact(4) / 10, c + Exact(4) / 10, Exact(3) / 10,
              Exact(5) / 10};
    default:
      return {"tau*(" + decimal(end) + " - tau)", 0, end, 0, c * c};
  }
}

Case kink(Draw& draw) {
  const int n = draw.between(1, 3);
  const Function f = drawn_function(draw);
  const Exact rate = draw.unit();
  const bool rises = draw.chance(0.5);
  const int place = draw.below(n);
  const Exact distance = draw.distance(true);
  ExactMatrix D0(n, n);
  ExactMatrix D1(n, n);
  for (int i = 0; i < n; ++i) {
    const bool worst = i == place;
    const Exact slope = draw.hundredths(20, 200) * ((worst ? rises : draw.chance(0.5)) ? 1 : -1);
    const Exact bad = slope > 0 ? f.high : f.low;
    D1(i, i) = slope;
    D0(i, i) = (worst ? -distance : -draw.hundredths(20, 100)) - slope * bad;
  }
  const Coordinates to = draw.coordinates(n);
  return {"kink",
          "method:\n  method: kink\n  data: {A0: n x n, A1: n x n, a: scalar, b: scalar}\n"
          "  unknowns: {P: symmetric n}\n  require:\n    positive: P > 0\n    decrease: {forall: "
          "\"tau in [a, b]\", that: \"He(P*(A0 + " +
              f.text + "*A1)) < 0\"}\ndata:\n  A0: " + yaml(rate * similar(to, D0)) +
              "\n  A1: " + yaml(rate * similar(to, D1)) + "\n  a: " + decimal(f.from) +
              "\n  b: " + decimal(f.to) + "\n",
          draw.is_yes(), draw.is_easy()};
}

}  // namespace

std::vector<Family> kink_families() { return {{"kink", 10, kink}}; }

}  // namespace gainsmith::tests::properties
