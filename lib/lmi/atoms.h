// Scalar functions of tau that a matrix inequality may contain:
//   theta(t) = t^k exp(a t) cos(b t)   or   t^k exp(a t) sin(b t),   k >= 0, b >= 0.
// Their products are again sums of such functions, so every polynomial in tau, exp, sin and cos of
// affine functions of tau is a combination of atoms. Over an interval each atom has a range; the
// ranges make a box, and a matrix that is affine in the atoms is negative definite on the interval
// if it is so at the vertices of the box.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gainsmith::lmi {

struct Atom {
  int power = 0;         ///< k
  double rate = 0;       ///< a, 1/time
  double frequency = 0;  ///< b >= 0, rad/time
  bool sine = false;     ///< sin(b t) instead of cos(b t)

  bool operator==(const Atom&) const = default;
  bool is_one() const { return power == 0 && rate == 0 && frequency == 0 && !sine; }
};

double evaluate(const Atom& atom, double t);

/// "exp(0.03*tau)", with the variable's name.
std::string to_string(const Atom& atom, const std::string& variable);

struct Range {
  double low = 0;
  double high = 0;
};

/// The smallest and largest value on [begin, end], extrema inside included: exact up to rounding
/// for b = 0 and for k = 0, a bound from outside (within a few percent of a piece of 1/64 half
/// wave) otherwise.
Range range(const Atom& atom, double begin, double end);

/// A combination: coefficients and indices into a table.
using Combination = std::vector<std::pair<double, int>>;

/// The atoms in use; index 0 is the constant 1.
class AtomTable {
 public:
  AtomTable() : atoms_{Atom{}} {}

  const Atom& operator[](int index) const { return atoms_[static_cast<std::size_t>(index)]; }
  int size() const { return static_cast<int>(atoms_.size()); }
  int index(const Atom& atom);

  /// atoms_[a] * atoms_[b] as a combination.
  Combination product(int a, int b);
  /// exp, cos or sin of slope * t (the constant part of the argument is handled by the caller).
  int exponential(double slope) { return index({0, slope, 0, false}); }

 private:
  std::vector<Atom> atoms_;
};

}  // namespace gainsmith::lmi
