#include "response/peak.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "numbers/dense/definite.h"
#include "numbers/dense/spectrum.h"
#include "numbers/types/ball_functions.h"
#include "numbers/types/enclosed_functions.h"
#include "numerics/balance.h"
#include "response/sweep.h"

namespace gainsmith::response {

namespace {

using numbers::Enclosed;
using Balls = Enclosed<double>;

/// x+ = ... as x' = ... by z = (1 + s)/(1 - s), which keeps the gains. With E = (I + A)^-1:
///   E (A - I),  sqrt(2) E B;  sqrt(2) C E,  D - C E B.
/// A is stable, so that -1 is no eigenvalue.
StateSpace as_continuous(const StateSpace& system) {
  if (!system.is_sampled()) return system;
  const Matrix identity = Matrix::Identity(system.states(), system.states());
  const Eigen::PartialPivLU<Matrix> lu(identity + system.A);
  const Matrix through = lu.inverse();
  return {through * (system.A - identity), std::sqrt(2.0) * through * system.B,
          std::sqrt(2.0) * system.C * through, system.D - system.C * through * system.B, 0};
}

/// The frequencies w >= 0 at which a singular value of the continuous system is g = `level`: i w is
/// an eigenvalue of the Hamiltonian matrix, 2n x 2n (Boyd, Balakrishnan & Kabamba 1989),
///   [ A + B R^-1 D'C          B R^-1 B'           ]
///   [ -C'(I + D R^-1 D')C     -(A + B R^-1 D'C)'  ],   R = g^2 I - D'D.
/// None where R is singular. In rising order.
std::vector<double> level_frequencies(const StateSpace& system, double level) {
  const Eigen::Index n = system.states(), m = system.inputs();
  const Matrix R = level * level * Matrix::Identity(m, m) - system.D.transpose() * system.D;
  const Eigen::FullPivLU<Matrix> lu(R);
  if (!lu.isInvertible()) return {};
  const Matrix through = lu.solve(system.D.transpose() * system.C);
  const Matrix A = system.A + system.B * through;
  Matrix H(2 * n, 2 * n);
  H << A, system.B * lu.solve(system.B.transpose()),
      -system.C.transpose() * (system.C + system.D * through), -A.transpose();
  const Matrix all = numbers::real_eigenvalues<double>(H);
  // What is taken as imaginary may be too much: these frequencies are only tried.
  constexpr double kOnAxis = 1e-8, kSlow = 1e-4;
  const double size = kSlow * all.cwiseAbs().maxCoeff();
  std::vector<double> found;
  for (Eigen::Index k = 0; k < all.rows(); ++k)
    if (all(k, 1) >= 0 && std::abs(all(k, 0)) <= kOnAxis * std::max(std::abs(all(k, 1)), size))
      found.push_back(all(k, 1));
  std::sort(found.begin(), found.end());
  return found;
}

class Search {
 public:
  explicit Search(const StateSpace& system) : response_(system), step_(system.step) {}

  void meet(double w) {
    const double gain = response_.largest_gain(w);
    if (!(gain > best_.value) || !std::isfinite(gain)) return;
    best_.value = gain;
    best_.frequency = w;
  }
  /// The largest gain between two frequencies, by 80 steps of golden section.
  void climb(double a, double b) {
    constexpr double kGolden = 0.6180339887498949;
    double left = b - kGolden * (b - a), right = a + kGolden * (b - a);
    double at_left = response_.largest_gain(left), at_right = response_.largest_gain(right);
    for (int k = 0; k < 80 && right > left; ++k) {
      if (at_left > at_right) {
        b = right;
        right = left;
        at_right = at_left;
        left = b - kGolden * (b - a);
        at_left = response_.largest_gain(left);
      } else {
        a = left;
        left = right;
        at_left = at_right;
        right = a + kGolden * (b - a);
        at_right = response_.largest_gain(right);
      }
    }
    meet(left);
    meet(right);
  }
  /// Of a frequency of the continuous system, the one of the system itself: z = (1 + i w)/(1 - i w)
  /// has the angle 2 atan(w) = w' T.
  double frequency_of(double w) const { return step_ > 0 ? 2 * std::atan(w) / step_ : w; }
  Peak& best() { return best_; }

 private:
  FrequencyResponse response_;
  double step_;
  Peak best_;
};

/// The level method: at a level just above the largest gain so far, between the frequencies that
/// have it, the gain is larger. The middles of these intervals give the next level, until none is
/// larger. Convergence is quadratic (Bruinsma & Steinbuch 1990).
void raise(const StateSpace& system, Search& search) {
  constexpr int kMost = 30;
  constexpr double kAbove = 1e-9;
  const StateSpace continuous = as_continuous(system);
  for (int k = 0; k < kMost; ++k) {
    const double before = search.best().value;
    const std::vector<double> all = level_frequencies(continuous, before * (1 + kAbove));
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      search.meet(search.frequency_of((all[i] + all[i + 1]) / 2));
    if (!(search.best().value > before * (1 + kAbove))) return;
  }
}

Balls block(const Balls& a, const Balls& b, const Balls& c, const Balls& d) {
  Balls whole;
  whole.resize(a.rows() + c.rows(), a.cols() + b.cols());
  whole.mid << a.mid, b.mid, c.mid, d.mid;
  whole.rad << a.rad, b.rad, c.rad, d.rad;
  return whole;
}

Balls exact(const Matrix& matrix) { return numbers::exactly<double>(matrix); }

/// [M, 0; 0, M].
Balls twice(const Matrix& M) {
  const Matrix none = Matrix::Zero(M.rows(), M.cols());
  return block(exact(M), exact(none), exact(none), exact(M));
}

/// A lower bound of the gain at this frequency, |H v|/|v| in balls. H is written over real and
/// imaginary parts, 2p x 2m, and v is its first right singular vector in double.
std::optional<double> proved_gain(const StateSpace& system, double w) {
  const Eigen::Index n = system.states();
  Balls H = twice(system.D);
  if (n > 0 && std::isfinite(w)) {
    // s I - A over real and imaginary parts.
    const double angle = w * system.step;
    Balls real = exact(Matrix::Zero(n, n)), imaginary = exact(w * Matrix::Identity(n, n));
    if (system.is_sampled()) {
      constexpr double kFunction = 0x1p-51;
      real = exact(std::cos(angle) * Matrix::Identity(n, n));
      imaginary = exact(std::sin(angle) * Matrix::Identity(n, n));
      // Of the unit circle some point is as near.
      real.rad.diagonal().setConstant(kFunction);
      imaginary.rad.diagonal().setConstant(kFunction);
    }
    const Balls first = numbers::difference(real, exact(system.A));
    const Balls M = block(first, numbers::negative(imaginary), imaginary, first);
    const Eigen::FullPivLU<Matrix> lu(M.mid);
    if (!lu.isInvertible()) return std::nullopt;
    const Balls inverse = numbers::enclosed::inverse_around<double>(lu.inverse(), M);
    H = numbers::sum(numbers::product(numbers::product(twice(system.C), inverse), twice(system.B)),
                     H);
  }
  const Eigen::JacobiSVD<Matrix> svd(H.mid, Eigen::ComputeFullV);
  const Balls v = exact(svd.matrixV().col(0));
  const auto square = [](const Balls& x) {
    return numbers::product(numbers::transposed(x), x).ball(0);
  };
  const numbers::Ball<double> ratio = square(numbers::product(H, v)) / square(v);
  const double least = numbers::low_end(ratio);
  if (!(least > 0) || !std::isfinite(least)) return std::nullopt;
  return std::sqrt(least) * (1 - 0x1p-51);
}

/// Whether no gain is above the level: by P with
///   -[A'P + P A + C'C, P B + C'D; *, D'D - level^2 I] > 0,  P > 0,
/// of a sampled system -[A'P A - P + C'C, A'P B + C'D; *, B'P B + D'D - level^2 I] > 0.
/// P solves the Riccati equation of equality in the Schur complement, with C'C + share I for C'C:
/// this leaves share I to the strict inequality. P is double; both inequalities are checked in
/// balls.
bool is_proved_below(const StateSpace& system, double level, double share) {
  const Eigen::Index n = system.states(), m = system.inputs();
  const Balls A = exact(system.A), B = exact(system.B), C = exact(system.C), D = exact(system.D);
  const auto by = [](const Balls& x, const Balls& y) {
    return numbers::product(numbers::transposed(x), y);
  };
  const Balls square =
      numbers::product(exact(Matrix::Constant(1, 1, level)), exact(Matrix::Constant(1, 1, level)));
  const Balls bound = numbers::scaled(square.ball(0), exact(Matrix::Identity(m, m)));
  const Balls corner = numbers::difference(by(D, D), bound);
  if (n == 0)
    return numbers::definite<double>(numbers::negative(corner)).sign == numbers::Sign::positive;
  Matrix P;
  try {
    P = numbers::stabilising_solution<double>(
        system.is_sampled() ? numbers::Riccati::discrete : numbers::Riccati::continuous, system.A,
        system.B, system.C.transpose() * system.C + share * Matrix::Identity(n, n), corner.mid,
        system.C.transpose() * system.D);
  } catch (const numbers::NoSolution&) {
    return false;
  }
  const Balls X = exact((P + P.transpose()) / 2);
  const Balls XB = numbers::product(X, B), XA = numbers::product(X, A);
  Balls first, second, third = corner;
  if (system.is_sampled()) {
    first = numbers::difference(by(A, XA), X);
    second = by(A, XB);
    third = numbers::sum(by(B, XB), corner);
  } else {
    first = numbers::sum(numbers::transposed(XA), XA);
    second = XB;
  }
  first = numbers::sum(first, by(C, C));
  second = numbers::sum(second, by(C, D));
  const Balls whole = block(first, second, numbers::transposed(second), third);
  return numbers::definite<double>(X).sign == numbers::Sign::positive &&
         numbers::definite<double>(numbers::negative(whole)).sign == numbers::Sign::positive;
}

}  // namespace

std::optional<Peak> peak(const StateSpace& given) {
  if (!is_stable(given) || given.D.size() == 0) return std::nullopt;
  const StateSpace system = in_units(given, numerics::balance(given.A.cwiseAbs()));
  Search search(system);
  const double infinite = std::numeric_limits<double>::infinity();
  if (!system.is_sampled())
    search.best() = {numbers::Vector(Eigen::JacobiSVD<Matrix>(system.D).singularValues())(0),
                     infinite, std::nullopt, std::nullopt};
  search.meet(0);
  if (system.is_sampled()) search.meet(std::numbers::pi / system.step);
  if (system.states() > 0) {
    const auto [low, high] = range_of(system);
    const Sweep all = sweep(system, low, high);
    std::size_t best = 0;
    double most = -1;
    for (std::size_t k = 0; k < all.frequency.size(); ++k)
      if (const double gain = gains_of(all.response[k])(0); gain > most) {
        most = gain;
        best = k;
      }
    search.meet(all.frequency[best]);
    if (best > 0 && best + 1 < all.frequency.size())
      search.climb(all.frequency[best - 1], all.frequency[best + 1]);
    raise(system, search);
  }
  Peak& found = search.best();
  if (found.value == 0) found.frequency = 0;
  found.low = proved_gain(system, found.frequency);
  // share I beside C'C raises |H|^2 by share |(s I - A)^-1 B|^2: half of level^2 - value^2, at the
  // frequency of the peak.
  const double w = std::isfinite(found.frequency) ? found.frequency : 0;
  const StateSpace to_states{system.A, system.B, Matrix::Identity(system.states(), system.states()),
                             Matrix::Zero(system.states(), system.inputs()), system.step};
  const double states = FrequencyResponse(to_states).largest_gain(w);
  for (const double above : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const double level = found.value * (1 + above);
    const double share = states > 0 ? above * found.value * found.value / (states * states) : 1;
    if (!is_proved_below(system, level, share)) continue;
    found.high = level;
    break;
  }
  return found;
}

}  // namespace gainsmith::response
