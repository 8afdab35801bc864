// Bounded real inequalities: [He(P A) + C'C, P B; *, -g I] < 0, P > 0 has a solution exactly when A
// is Hurwitz and the largest gain of G(s) = C (sI - A)^-1 B over all frequencies is below sqrt(g).
//
// G is block diagonal, of k a/(s + a), with its largest gain k at 0, and of k w^2/(s^2 + 2 z w s +
// w^2), z = 7/25 or 3/5, with its largest gain k/(2 z sqrt(1 - z^2)), rational as sqrt(1 - z^2) is.
// The largest of the blocks counts. Units of inputs and outputs would change the gain; turns by
// signed permutations do not. k is chosen so that the gains are decimals: k = 2 z sqrt(1 - z^2)
// times one.
#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

struct Plant {
  ExactMatrix A, B, C;
};

/// Writes a part with the largest gain `gain` from state `i` and channel `channel` on; its number
/// of states.
int add_part(Draw& draw, const Exact& gain, const Exact& rate, int i, int channel, bool second,
             Plant& plant) {
  const Exact speed = rate * draw.hundredths(50, 300);
  if (!second) {
    plant.A(i, i) = -speed;
    plant.B(i, channel) = speed;
    plant.C(channel, i) = gain;
    return 1;
  }
  const bool thin = draw.chance(0.5);
  const Exact damping = thin ? Exact(28) / 100 : Exact(6) / 10;
  const Exact root = thin ? Exact(96) / 100 : Exact(8) / 10;
  plant.A(i, i + 1) = speed;
  plant.A(i + 1, i) = -speed;
  plant.A(i + 1, i + 1) = -2 * damping * speed;
  plant.B(i + 1, channel) = speed;
  plant.C(channel, i) = gain * 2 * damping * root;
  return 2;
}

Case bounded_real(Draw& draw) {
  const int parts = draw.between(1, 2);
  const Exact rate = draw.unit();
  const Exact size = draw.unit();
  const Exact largest = size * draw.hundredths(50, 300);
  std::vector<bool> second;
  int n = 0;
  for (int k = 0; k < parts; ++k) {
    second.push_back(draw.chance(0.5));
    n += second.back() ? 2 : 1;
  }
  Plant plant{ExactMatrix(n, n), ExactMatrix(n, parts), ExactMatrix(parts, n)};
  const int worst = draw.below(parts);
  int i = 0;
  for (int k = 0; k < parts; ++k) {
    const Exact gain = k == worst ? largest : Exact(largest * draw.hundredths(10, 90));
    i += add_part(draw, gain, rate, i, k, second[static_cast<std::size_t>(k)], plant);
  }
  const Coordinates to = draw.coordinates(n);
  const Exact g = largest * largest * (1 + draw.small_distance(true));
  return {"bounded-real",
          "method:\n  method: bounded-real\n"
          "  data: {A: n x n, B: n x m, C: p x n, g: scalar}\n  unknowns: {P: symmetric n}\n"
          "  require:\n    positive: P > 0\n"
          "    gain: \"[He(P*A) + C'*C, P*B; *, -g*I] < 0\"\ndata:\n  A: " +
              yaml(similar(to, plant.A)) + "\n  B: " + yaml(to.inverse * plant.B) +
              "\n  C: " + yaml(plant.C * to.T) + "\n  g: " + decimal(g) + "\n",
          draw.is_yes(), draw.is_easy()};
}

}  // namespace

std::vector<Family> bounded_real_families() { return {{"bounded-real", 12, bounded_real}}; }

}  // namespace gainsmith::tests::properties
