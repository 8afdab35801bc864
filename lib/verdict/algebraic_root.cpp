#include "verdict/algebraic_root.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stop.h"
#include "numbers/dense/dense.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numerics::RationalMatrix;

/// Quotient and remainder by b, whose leading coefficient is 1.
std::pair<Polynomial, Polynomial> divided(Polynomial a, const Polynomial& b) {
  if (a.size() < b.size()) return {{}, a};
  Polynomial quotient(a.size() - b.size() + 1);
  for (std::size_t k = quotient.size(); k-- > 0;) {
    const Rational factor = quotient[k] = a[k + b.size() - 1];
    for (std::size_t i = 0; i < b.size(); ++i) a[k + i] -= factor * b[i];
  }
  a.resize(b.size() - 1);
  return {std::move(quotient), std::move(a)};
}

/// Without zeros in front, and 1 first; empty for 0.
Polynomial monic(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  if (p.empty()) return p;
  const Rational leading = p.back();
  for (Rational& c : p) c /= leading;
  return p;
}

/// The monic greatest common divisor, by Euclid's algorithm in fractions.
Polynomial common_divisor(Polynomial a, Polynomial b) {
  a = monic(std::move(a));
  b = monic(std::move(b));
  while (!b.empty()) {
    check_stop();
    Polynomial rest = monic(divided(std::move(a), b).second);
    a = std::exchange(b, std::move(rest));
  }
  return a;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t k = 1; k < p.size(); ++k) result.push_back(p[k] * Rational(k));
  return result;
}

/// p(-x), which has the roots -l.
Polynomial in_minus_x(Polynomial p) {
  for (std::size_t k = 1; k < p.size(); k += 2) p[k] = -p[k];
  return p;
}
/// x^d p(1/x), which has the roots 1/l.
Polynomial reversed(Polynomial p) {
  std::reverse(p.begin(), p.end());
  return p;
}

struct Complex {
  Rational re, im;
};
/// p(at), by Horner's rule.
Complex value(const Polynomial& p, const Complex& at) {
  Complex sum;
  for (std::size_t k = p.size(); k-- > 0;)
    sum = {sum.re * at.re - sum.im * at.im + p[k], sum.re * at.im + sum.im * at.re};
  return sum;
}

Rational power(const Rational& x, Index exponent) {
  Rational result = 1;
  for (Index k = 0; k < exponent; ++k) result *= x;
  return result;
}

/// At least |z|.
Rational parts_of(const Complex& z) { return abs(z.re) + abs(z.im); }

/// To the nearest multiple of 2^-250, some 75 digits, so that fractions do not grow from step to
/// step.
Rational rounded(const Rational& x) {
  static const Rational unit = power(2, 250);
  return Rational(nearest_integer(x * unit)) / unit;
}

/// Whether Rouche's theorem shows exactly one root of p in the disk of radius h <= 1 about `at`:
/// |p| + M h^2/2 < |p'| h at the centre. M = sum_k |c_k| (|at| + 1)^k bounds |p''(x)| on the disk,
/// c_k the coefficients of p''. Moduli are replaced by bounds that need no square root.
bool has_one_root(const Polynomial& p, const Complex& at, const Rational& h) {
  const Polynomial slope = derivative(p), curvature = derivative(slope);
  Rational bound = 0, factor = 1;
  for (const Rational& c : curvature) {
    bound += abs(c) * factor;
    factor *= parts_of(at) + 1;
  }
  const Complex d = value(slope, at);
  return parts_of(value(p, at)) + bound * h * h / 2 < std::max(abs(d.re), abs(d.im)) * h;
}

/// Newton's method x - p/p' in rounded fractions; it proves nothing, has_one_root() does.
Complex newton(const Polynomial& p, Complex at) {
  constexpr int kSteps = 8;  // from 16 digits to 75
  const Polynomial slope = derivative(p);
  for (int k = 0; k < kSteps; ++k) {
    const Complex f = value(p, at), d = value(slope, at);
    const Rational size = d.re * d.re + d.im * d.im;
    if (size == 0) break;
    at = {rounded(at.re - (f.re * d.re + f.im * d.im) / size),
          rounded(at.im - (f.im * d.re - f.re * d.im) / size)};
  }
  return at;
}

/// The roots in double, as eigenvalues of the companion matrix.
numbers::ComplexVector guesses(const Polynomial& p) {
  if (p.size() < 2) return {};
  return numbers::eigenvalues(
      companion(p).unaryExpr([](const Rational& x) { return nearest_double(x); }));
}

/// Beside the modulus of a root its part is rounding.
bool is_rounding(double part, std::complex<double> root) {
  return std::abs(part) < 1e-9 * (1 + std::abs(root));
}

}  // namespace

Polynomial square_free(const Polynomial& p) {
  return divided(p, common_divisor(p, derivative(p))).first;
}

RationalMatrix companion(const Polynomial& p) {
  const auto d = static_cast<Index>(p.size()) - 1;
  RationalMatrix C = RationalMatrix::Constant(d, d, Rational(0));
  for (Index i = 0; i + 1 < d; ++i) C(i, i + 1) = 1;
  for (Index j = 0; j < d; ++j) C(d - 1, j) = -p[static_cast<std::size_t>(j)];
  return C;
}

std::vector<Polynomial> factors_to_try(const Polynomial& p) {
  constexpr double kRelative = 1e-12, kLongest = 1e8;
  std::vector<Polynomial> factors;
  const auto add = [&](Polynomial factor) {
    if (factor.size() > 1 && std::ranges::find(factors, factor) == factors.end())
      factors.push_back(std::move(factor));
  };
  for (const std::complex<double>& root : guesses(p)) {
    if (!is_rounding(root.imag(), root)) continue;
    const bool zero = is_rounding(root.real(), 1);
    const auto a = zero ? Rational(0) : short_fraction(Rational(root.real()), kRelative, kLongest);
    if (a && value(p, {*a, 0}).re == 0) add({-*a, 1});
  }
  add(common_divisor(p, in_minus_x(p)));
  add(common_divisor(p, reversed(p)));
  add(p);
  return factors;
}

Root::Bounded Root::twice_real() const {
  return {2 * re, imaginary ? Rational(0) : Rational(2 * h)};
}

Root::Bounded Root::squared_modulus() const {
  if (on_circle) return {1, 0};
  return {re * re + im * im, 2 * h * (abs(re) + abs(im)) + h * h};
}

std::vector<Root> roots(const Polynomial& p) {
  const Rational h = 1 / power(2, 200);
  std::vector<Root> result;
  if (p.size() == 2) return {{-p[0], 0, 0, p[0] == 0, abs(p[0]) == 1}};
  const bool mirrored = monic(in_minus_x(p)) == p, inverted = monic(reversed(p)) == p;
  for (const std::complex<double>& root : guesses(p)) {
    if (!std::isfinite(std::abs(root))) continue;
    const bool imaginary = mirrored && is_rounding(root.real(), root);
    Complex at{Rational(root.real()), Rational(root.imag())};
    if (is_rounding(root.imag(), root)) at.im = 0;
    if (imaginary) at.re = 0;
    at = newton(p, at);
    if (imaginary) at.re = 0;
    if (!has_one_root(p, at, h)) continue;
    // Both l, within h of the centre, and 1/conj(l) are within 8 h of it.
    const Rational off = at.re * at.re + at.im * at.im - 1;
    const bool on_circle = inverted && abs(off) < h && has_one_root(p, at, 8 * h);
    result.push_back({at.re, at.im, h, imaginary, on_circle});
  }
  return result;
}

/// The error of conj(l)^i l^j is at most (i + j) h (|re| + |im| + h)^(i + j - 1).
Root::Bounded form_at(const Root& l, const RationalMatrix& X) {
  Complex sum;  // by Horner's rule in conj(l), of rows by that in l
  Rational error = 0;
  const Rational size = abs(l.re) + abs(l.im) + l.h;
  for (Index i = X.rows(); i-- > 0;) {
    Polynomial row;
    for (Index j = 0; j < X.cols(); ++j) row.push_back(X(i, j));
    const Complex inner = value(row, {l.re, l.im});
    sum = {sum.re * l.re + sum.im * l.im + inner.re, sum.im * l.re - sum.re * l.im + inner.im};
    for (Index j = 0; j < X.cols(); ++j)
      if (const Index of = i + j; of > 0)
        error += abs(X(i, j)) * Rational(of) * l.h * power(size, of - 1);
  }
  return {sum.re, error};
}

}  // namespace gainsmith::verdict
