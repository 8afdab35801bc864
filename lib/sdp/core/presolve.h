// From the problem as given to the working problem, and back.
#pragma once

#include <vector>

#include "sdp/core/data.h"
#include "sdp/problem.h"

namespace gainsmith::sdp {

/// ||F_i||_F, each off-diagonal entry counted twice.
double frobenius_norm(const std::vector<Entry>& list);

/// How the working problem came about:
///   F'_i = s_i F_i  (i >= 1),  F'_0 = F_0 / gamma_f,  c'_i = s_i c_i / gamma_c,
/// with s_i and the gammas powers of two, so that ||F'_i|| is from 1 to 2 and so is max |c'_i|;
/// restricted to the rows that occur and split into the connected components of the blocks' common
/// pattern (outside of it X is zero, and Y may be). Hence
///   x_i = gamma_f s_i x'_i,  X = gamma_f X',  Y = gamma_c Y'.
/// Rows are not scaled: the direction does not depend on congruences D F_i D.
struct Recovery {
  /// Where a row of the working problem came from.
  struct Row {
    int block = 0;
    int row = 0;
  };
  std::vector<int> constraint;          ///< working i -> original i, from 0
  std::vector<double> s;                ///< by working i
  std::vector<std::vector<Row>> dense;  ///< rows of each working dense block
  std::vector<Row> linear;              ///< entries of the linear part
  double gamma_c = 1;
  double gamma_f = 1;
};

struct Presolved {
  Data data;
  Recovery recovery;
  /// A far starting point X' = far_X I, Y' = far_Y I (after Toh, Todd, Tutuncu 1999 and Borchers
  /// 1999): the sizes that the data suggest for X and Y, times the square root of n, or n,
  ///   far_X = sqrt(n) (1 + max_i ||F_i||_F) / gamma_f,               and at least 1,
  ///   far_Y = n max_{i>0} (1 + |c_i|) / (1 + ||F_i||_F) / gamma_c,   and at least 1.
  double far_X = 1;
  double far_Y = 1;
  /// An i with F_i = 0 and c_i != 0, from 0: x = -sign(c_i) e_i is a certificate; or -1.
  int free_descent = -1;
};

/// Entries of one F_i at the same place add up. F_i = 0 with c_i = 0 are dropped (x_i = 0).
Presolved presolve(const Problem& problem);

/// A point in terms of the original problem, packed as BlockMatrix is.
template <typename T>
struct Point {
  std::vector<T> x;
  std::vector<std::vector<T>> X;
  std::vector<std::vector<T>> Y;
};

/// The point (x, X, Y)/scale of the working problem in terms of the original one.
template <typename Out, typename T>
Point<Out> restore(const Problem& problem, const Presolved& presolved, const Vector<T>& x,
                   const Blocks<T>& X, const Blocks<T>& Y, const T& scale);

/// Back from there, with scale = 1.
template <typename T>
void reduce(const Problem& problem, const Presolved& presolved, const Point<T>& point, Vector<T>& x,
            Blocks<T>& X, Blocks<T>& Y);

}  // namespace gainsmith::sdp
