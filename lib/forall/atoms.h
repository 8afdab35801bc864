// Scalar functions of tau that a matrix inequality may contain:
//   theta(t) = t^k exp(a t) cos(b t)   or   t^k exp(a t) sin(b t),   k >= 0, b >= 0.
// Their products are again sums of such functions, so every polynomial in tau, exp, sin and cos of
// affine functions of tau is a combination of atoms. Over an interval each atom has a range; the
// ranges make a box, and a matrix that is affine in the atoms is negative definite on the interval
// if it is so at the vertices of the box.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expr/program/rewrite.h"

namespace gainsmith::forall {

struct Atom {
  int power = 0;         ///< k
  double rate = 0;       ///< a, 1/time
  double frequency = 0;  ///< b >= 0, rad/time
  bool sine = false;     ///< sin(b t) instead of cos(b t)

  bool operator==(const Atom&) const = default;
  bool is_one() const { return power == 0 && rate == 0 && frequency == 0 && !sine; }
};

/// theta(t), infinite or NaN where double overflows.
double evaluate(const Atom& atom, double t);

/// The atom of a variable as the result of a program.
int compose(expr::Composer& composer, const Atom& atom, const std::string& variable);

/// "exp(0.03*tau)", with the variable's name; with 17 digits the text gives back the same atom.
std::string to_string(const Atom& atom, const std::string& variable, int digits = 6);

/// An interval [low, high] of values.
struct Range {
  double low = 0;
  double high = 0;
};

/// The smallest and largest value on [begin, end], extrema inside included: exact up to rounding
/// for b = 0 and for k = 0, a bound from outside (within a few percent of a piece of 1/64 half
/// wave) otherwise.
Range range(const Atom& atom, double begin, double end);

/// A t in [begin, end] with theta(t) = value, one of the ends or an extremum between them; none
/// when none of these has it, up to 1e-9 of the largest value there.
std::optional<double> place_of(const Atom& atom, double value, double begin, double end);

/// d theta/dt as a combination of atoms.
/// t^k e^(at) cos(bt) has k t^(k-1) e^(at) cos(bt) + a theta - b t^k e^(at) sin(bt).
std::vector<std::pair<double, Atom>> derivative(const Atom& atom);

/// theta_a theta_b as a combination of atoms.
std::vector<std::pair<double, Atom>> product(const Atom& a, const Atom& b);

}  // namespace gainsmith::forall
