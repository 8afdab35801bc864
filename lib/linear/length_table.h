// Functions of the length of a flow as polynomials.
//
//   f_k(s) = sum_i c_ki sigma^i,   sigma = (s - middle) scale in [-1, 1],   s in [from, to]
//
// They are interpolated at Chebyshev points in 100 digits, cut where what is left is negligible, and
// rounded once. The error of both is known. The functions must be smooth: those of linear flows are entire.
//
// Interpolation at Chebyshev points of an entire function converges faster than geometrically. Its
// error is at most twice the sum of the coefficients of higher degree (Trefethen, Approximation
// Theory and Approximation Practice, 2013). That of a cut series is taken as twice the sum of what
// was cut.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/scalars.h"
#include "base/unit_roundoff.h"

namespace gainsmith::linear {

/// All functions at a length.
using WideFunctions = std::function<std::vector<Decimal100>(const Decimal100& length)>;

struct LengthTable {
  struct Polynomial {
    std::vector<double> powers;  ///< c_0, c_1, ...
    double error = 0;            ///< as lanes compute it, with sigma in double, over the range
    double size = 0;             ///< at least |f| over the range
  };
  double middle = 0;
  double scale = 0;  ///< 0: there is one length, `middle`
  std::vector<Polynomial> functions;
};

/// The functions over [from, to], their coefficients in 100 digits.
struct WideTable {
  double middle = 0;
  double scale = 0;
  std::vector<std::vector<Decimal100>> powers;
  std::vector<double> errors;  ///< what was cut
};

/// None where polynomials of degree kMostLengthDegree do not follow a function.
std::optional<WideTable> make_wide_table(double from, double to, const WideFunctions& functions);
/// The same in double, with a bound of what rounding adds.
LengthTable rounded(const WideTable& table);

/// Functions with other polynomials on each of some pieces of [from, to]: flows have fast modes that
/// live at their start alone.
struct PieceTable {
  std::vector<double> ends;  ///< rising; the last one is `to`
  std::vector<LengthTable> pieces;
  /// That of one piece; of more the sizes and errors on all of them, and no powers.
  LengthTable whole;

  bool has_pieces() const { return pieces.size() > 1; }
  /// All functions at a length, `stride` apart.
  void values(double length, double* out, std::size_t stride) const;
};

/// A piece ends at `shortest`, 2 `shortest`, 4 `shortest`, ... None where a piece has none.
std::optional<PieceTable> make_piece_table(double from, double to, double shortest,
                                           const WideFunctions& functions);

}  // namespace gainsmith::linear
