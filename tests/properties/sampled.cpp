// Observers for samples that come after T1 to T2.
//
// held-gain    One gain for all intervals, every state measured:
//                [P, (P expm(A tau) - Y)'; *, P] > 0 for all tau in [T1, T2],
//              A = T^-1 diag(a) T. Sign changes of the coordinates T z leave the problem as it is
//              and solutions are convex, so P and Y may be taken diagonal there: it has a solution
//              exactly when every mode has one, |exp(a tau) - l| < 1, that is when
//              exp(a T2) - exp(a T1) < 2 for every a > 0 (those with a < 0 differ by less than 1).
//              Thresholds: T2 = log(2 + exp(a T1))/a for the fastest mode, for T1 = 0 log(3)/a.
// hybrid       The built-in sampled-data-hybrid without weights, A = T^-1 [A1, 0; A21, a] T with
//              C = [C1, 0] T. On the hidden direction v the flow inequality is (2 a + delta) v'P1 v
//              < 0. So 2 a + delta >= 0 is a no. Otherwise A + delta/2 I is Hurwitz (all of A1 is
//              faster): P1 with He(P1 A) + delta P1 < 0, Y = Z = 0, P2 = X = -e I with a small e
//              (X = -P2) satisfy everything: the jump is [-P1, P1; *, -exp(delta T1) P1] <= 0.
// reset        The built-in reset-observer, A = T^-1 [A1, 0; A21, a] T, C = [I, 0] T: with the gain
//              [I; 0] the error after a sample is that of the hidden state times exp(a tau) (and
//              what A21 carries is weighed down by a large weight on the measured states): a < 0
//              is a yes. a >= 0 is a no: the hidden direction never shrinks.
#include <boost/multiprecision/cpp_dec_float.hpp>

#include "properties/families.h"
#include "properties/spectra.h"

namespace gainsmith::tests::properties {

namespace {

using Wide = boost::multiprecision::cpp_dec_float_50;

/// value * (1 + relative), rounded to 30 digits after the point of its first.
Exact rounded(const Wide& value) {
  const int exponent = static_cast<int>(floor(log10(value))) - 30;
  const Wide whole = floor(value * pow(Wide(10), -exponent));
  return Exact(whole.convert_to<boost::multiprecision::cpp_int>()) * ten_to(exponent);
}

Wide wide(const Exact& value) {
  return Wide(boost::multiprecision::numerator(value).str()) /
         Wide(boost::multiprecision::denominator(value).str());
}

Case held_gain(Draw& draw) {
  const int n = draw.between(1, 3);
  std::vector<Exact> rates{draw.hundredths(50, 300)};
  for (int i = 1; i < n; ++i)
    rates.push_back(draw.chance(0.5) ? draw.hundredths(-200, 0)
                                     : rates[0] * draw.hundredths(20, 95));
  const Exact second = draw.unit();
  const Exact first = draw.chance(0.3) ? Exact(0) : draw.hundredths(1, 50) / 2;
  const Wide limit = log(2 + exp(wide(rates[0] * first))) / wide(rates[0]);
  const Exact last = rounded(limit) * (1 - draw.small_distance());
  const ExactMatrix A = similar(draw.coordinates(n), ExactMatrix::diagonal(rates));
  return {
      "held-gain",
      "method:\n  method: held-gain\n  data: {A: n x n, T1: scalar, T2: scalar}\n"
      "  unknowns: {P: symmetric n, Y: n x n}\n  require:\n    positive: P > 0\n    contraction: "
      "{forall: \"tau in [T1, T2]\", that: \"[P, (P*expm(A*tau) - Y)'; *, P] > 0\"}\ndata:\n  "
      "A: " +
          yaml(Exact(1 / second) * A) + "\n  T1: " + decimal(second * first) +
          "\n  T2: " + decimal(second * last) + "\n",
      draw.is_yes(), draw.is_easy()};
}

struct SampledPlant {
  ExactMatrix A, C;
};

/// A1 with real parts below -slack - 0.2, all of it seen in the first row of C or in all rows.
SampledPlant with_hidden_mode(Draw& draw, const Exact& mode, int seen, const Exact& slack,
                              int outputs) {
  const ExactMatrix A1 = continuous_spectrum(draw, seen, -slack - draw.hundredths(20, 200), slack);
  SampledPlant plant{ExactMatrix(seen + 1, seen + 1), ExactMatrix(outputs, seen + 1)};
  for (int i = 0; i < seen; ++i) {
    for (int j = 0; j < seen; ++j) plant.A(i, j) = A1(i, j);
    plant.A(seen, i) = draw.between(-2, 2);
  }
  plant.A(seen, seen) = mode;
  for (int i = 0; i < outputs; ++i) plant.C(i, i) = 1;
  return plant;
}

Case built_in(Draw& draw, const std::string& name, const std::string& method,
              const SampledPlant& plant, const Exact& delta) {
  const Exact second = draw.unit();
  const Coordinates to = draw.coordinates(plant.A.rows());
  const Exact first = draw.hundredths(1, 50);
  const Exact last = first + draw.hundredths(1, 50);
  const Exact output = draw.unit();
  std::string text =
      "method: " + method + "\ndata:\n  A: " + yaml(Exact(1 / second) * similar(to, plant.A)) +
      "\n  C: " + yaml(output * (plant.C * to.T)) + "\n  T1: " + decimal(second * first) +
      "\n  T2: " + decimal(second * last) + "\n";
  if (delta != 0) text += "parameters: {delta: " + decimal(Exact(1 / second) * delta) + "}\n";
  return {name, text, draw.is_yes(), draw.is_easy()};
}

Case hybrid(Draw& draw) {
  const Exact delta = draw.hundredths(5, 50);
  const Exact mode = -delta / 2 * (1 + draw.distance(true));
  const int seen = draw.between(1, 2);
  return built_in(draw, "hybrid", "sampled-data-hybrid",
                  with_hidden_mode(draw, mode, seen, delta / 2, 1), delta);
}

Case reset(Draw& draw) {
  const Exact mode = -draw.distance(true);
  const int seen = draw.between(1, 2);
  return built_in(draw, "reset", "reset-observer", with_hidden_mode(draw, mode, seen, 0, seen), 0);
}

}  // namespace

std::vector<Family> sampled_families() {
  return {{"held-gain", 6, held_gain}, {"hybrid", 6, hybrid}, {"reset", 4, reset}};
}

}  // namespace gainsmith::tests::properties
