// Functions of time as sums of Chebyshev polynomials on [-1, 1].
//
//   p(x) = sum_k c_k T_k(x),   rows of a matrix are functions, column k their c_k
//
// Where |c_0| > |c_1| + |c_2| + ... the function has no root, since |T_k| <= 1.
#pragma once

#include <Eigen/Core>

#include "numbers/graph/range.h"
#include "numbers/matrix.h"

namespace gainsmith::ode::chebyshev {

/// The highest degree that tables of points are kept for.
inline constexpr int largest_degree = 20;

/// The points -cos(pi k/degree), k = 0 .. degree, in rising order, exact at -1, 0 and 1; of degree
/// 0 the point 1.
const Eigen::VectorXd& points(int degree);

/// Coefficients from the values at points(degree), one column a point.
numbers::Matrix coefficients(const numbers::Matrix& values);

/// p(x), x in [-1, 1]: T_k by the recurrence T_{k+1} = 2 x T_k - T_{k-1}, and a sum.
Eigen::VectorXd at(const numbers::Matrix& coefficients, double x);
/// Of the first function alone, by Clenshaw's recurrence; of a matrix or a row.
template <class Coefficients>
double first(const Coefficients& coefficients, double x) {
  double result = 0;
  double after = 0;
  for (Eigen::Index k = coefficients.cols() - 1; k > 0; --k) {
    const double next = coefficients(0, k) + 2 * x * result - after;
    after = result;
    result = next;
  }
  return coefficients(0, 0) + x * result - after;
}
/// p(x), to `out`.
void at(const numbers::Matrix& coefficients, double x, double* out);

/// Where each function lies on [-1, 1], as |T_k| <= 1, and as it is rounded by at().
numbers::Box ranges(const numbers::Matrix& coefficients);

/// Without the highest degrees, as long as no coefficient of them is above `least`.
numbers::Matrix trimmed(const numbers::Matrix& coefficients, double least);

/// p on [from, to], a part of [-1, 1], as a series of its own.
numbers::Matrix part(const numbers::Matrix& coefficients, double from, double to);

/// p', of one degree less; of a constant one column of 0.
numbers::Matrix derivative(const numbers::Matrix& coefficients);

/// t in [from, to] as a point of [-1, 1].
inline double inner(double t, double from, double to) {
  return to > from ? ((t - from) - (to - t)) / (to - from) : 1;
}

/// A point x of [-1, 1] as a time, exact at both ends.
inline double outer(double x, double from, double to) {
  return x < 0 ? from + (1 + x) / 2 * (to - from) : to - (1 - x) / 2 * (to - from);
}

}  // namespace gainsmith::ode::chebyshev
