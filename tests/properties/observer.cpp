// Observers and state feedback: He(P A - Y C) < 0, P > 0 has a solution exactly when (A, C) is
// detectable, and [P, (P A - Y C)'; *, P] > 0 exactly when it is in discrete time; dually for
// He(A P + B Y) < 0.
//
// A = [A1, 0; A21, A2], C = [C1, 0]: A1 with ones above its diagonal and nothing beyond, C1 the
// first row of the identity, so (A1, C1) is observable; the eigenvalues of A2 are those that no
// output shows. So the answer is that of A2, whatever A1 is.
#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

struct HiddenPlant {
  ExactMatrix A, C;
};

/// `hidden`: A2.
HiddenPlant planted(Draw& draw, const ExactMatrix& hidden, int seen) {
  const int n = seen + hidden.rows();
  HiddenPlant plant{ExactMatrix(n, n), ExactMatrix(1, n)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < seen && (j <= i || i >= seen); ++j)
      plant.A(i, j) = draw.hundredths(-200, 200);
    if (i + 1 < seen) plant.A(i, i + 1) = 1;
  }
  for (int i = seen; i < n; ++i)
    for (int j = seen; j < n; ++j) plant.A(i, j) = hidden(i - seen, j - seen);
  plant.C(0, 0) = 1;
  return plant;
}

HiddenPlant moved(Draw& draw, const HiddenPlant& plant, const Exact& rate) {
  const Coordinates to = draw.coordinates(plant.A.rows());
  const Exact output = draw.unit();
  return {rate * similar(to, plant.A), output * (plant.C * to.T)};
}

std::string data(const HiddenPlant& plant, bool dual) {
  return dual ? "data:\n  A: " + yaml(plant.A.transpose()) + "\n  B: " + yaml(plant.C.transpose()) +
                    "\n"
              : "data:\n  A: " + yaml(plant.A) + "\n  C: " + yaml(plant.C) + "\n";
}

Case observer(Draw& draw) {
  const int hidden = draw.between(1, 2);
  const Exact rate = draw.unit();
  const int seen = draw.between(1, 3);
  const ExactMatrix A2 = continuous_spectrum(draw, hidden, -draw.distance(true));
  const HiddenPlant plant = moved(draw, planted(draw, A2, seen), rate);
  const bool dual = draw.chance(0.3);
  return {"observer",
          (dual ? "method:\n  method: state-feedback\n  data: {A: n x n, B: n x m}\n"
                  "  unknowns: {P: symmetric n, Y: m x n}\n"
                  "  require: {positive: P > 0, decrease: He(A*P + B*Y) < 0}\n"
                : "method:\n  method: observer\n  data: {A: n x n, C: p x n}\n"
                  "  unknowns: {P: symmetric n, Y: n x p}\n"
                  "  require: {positive: P > 0, decrease: He(P*A - Y*C) < 0}\n") +
              data(plant, dual),
          draw.is_yes(), draw.is_easy()};
}

Case discrete_observer(Draw& draw) {
  const int hidden = draw.between(1, 2);
  const int seen = draw.between(1, 3);
  const ExactMatrix A2 = discrete_spectrum(draw, hidden, 1 - draw.small_distance(true));
  const HiddenPlant plant = moved(draw, planted(draw, A2, seen), 1);
  return {"discrete-observer",
          "method:\n  method: discrete-observer\n  data: {A: n x n, C: p x n}\n"
          "  unknowns: {P: symmetric n, Y: n x p}\n  require:\n    positive: P > 0\n"
          "    decrease: \"[P, (P*A - Y*C)'; *, P] > 0\"\n" +
              data(plant, false),
          draw.is_yes(), draw.is_easy()};
}

}  // namespace

std::vector<Family> observer_families() {
  return {{"observer", 12, observer}, {"discrete-observer", 8, discrete_observer}};
}

}  // namespace gainsmith::tests::properties
