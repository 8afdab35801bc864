// Lyapunov and Stein inequalities.
//
// He(P A) < 0, P > 0 has a solution exactly when every eigenvalue of A has a negative real part
// (Lyapunov), and A' P A < P, P > 0 exactly when every modulus is below 1 (Stein). The eigenvalues
// are those of the diagonal blocks of a triangular matrix, and A is similar to it by exact
// arithmetic.
#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

Case stability(Draw& draw, const std::string& name, const std::string& condition,
               const ExactMatrix& A) {
  return {name,
          "method:\n  method: " + name + "\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n" +
              "  require: {positive: P > 0, " + condition + "}\ndata:\n  A: " + yaml(A) + "\n",
          draw.is_yes(), draw.is_easy()};
}

Case lyapunov(Draw& draw) {
  const int n = draw.between(1, 5);
  const Exact rate = draw.unit();
  const ExactMatrix A = continuous_spectrum(draw, n, -draw.distance(true));
  return stability(draw, "lyapunov", "decrease: He(P*A) < 0",
                   rate * similar(draw.coordinates(n), A));
}

Case stein(Draw& draw) {
  const int n = draw.between(1, 5);
  const ExactMatrix planted = discrete_spectrum(draw, n, 1 - draw.small_distance(true));
  const ExactMatrix A = similar(draw.coordinates(n), planted);
  const bool whole = draw.chance(0.5);
  return stability(draw, "stein",
                   whole ? "decrease: A'*P*A < P" : "decrease: \"[P, A'*P; *, P] > 0\"", A);
}

/// A disk |s - c| < r of its own: [-r P, P (A - c I); *, -r P] < 0, P > 0 exactly when every
/// eigenvalue of (A - c I)/r has a modulus below 1.
Case disk(Draw& draw) {
  const int n = draw.between(1, 4);
  const Exact centre = draw.between(-9, 9);
  const Exact radius = draw.unit();
  const ExactMatrix planted = discrete_spectrum(draw, n, 1 - draw.small_distance(true));
  const ExactMatrix A =
      radius * similar(draw.coordinates(n), planted) + radius * centre * ExactMatrix::identity(n);
  return {"disk",
          "method:\n  method: disk\n  data: {A: n x n, c: scalar, r: scalar}\n"
          "  unknowns: {P: symmetric n}\n  require:\n    positive: P > 0\n"
          "    disk: \"[-r*P, P*(A - c*I); *, -r*P] < 0\"\ndata:\n  A: " +
              yaml(A) + "\n  c: " + decimal(radius * centre) + "\n  r: " + decimal(radius) + "\n",
          draw.is_yes(), draw.is_easy()};
}

}  // namespace

std::vector<Family> stability_families() {
  return {{"lyapunov", 20, lyapunov}, {"stein", 15, stein}, {"disk", 4, disk}};
}

}  // namespace gainsmith::tests::properties
