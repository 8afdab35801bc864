// Dense kernels in every arithmetic: BLAS-3 speed in double (Eigen) and in double-double
// (vectorised here), plain loops in the widest. Matrices are column-major with a leading dimension.
#pragma once

#include <vector>

#include "sdp/linalg.h"
#include "sdp/view.h"

namespace gainsmith::sdp {

/// C = A B, or C -= A B. C must not overlap A or B.
template <typename T>
void multiply(const View<const T>& a, const View<const T>& b, const View<T>& c,
              Update update = Update::assign);

/// C = A S, where S has entries only at rows[start[j]] .. rows[start[j+1]-1] of its column j.
template <typename T>
void multiply_sparse(const View<const T>& a, const View<const T>& s, const std::vector<int>& start,
                     const std::vector<int>& rows, const View<T>& c);

/// C = A B'.
template <typename T>
void multiply_outer(const View<const T>& a, const View<const T>& b, const View<T>& c,
                    Update update = Update::assign);

/// C = A U, C = A L for an upper triangular U, a lower triangular L, with zeros in the other
/// triangle.
template <typename T>
void multiply_upper(const View<const T>& a, const View<const T>& u, const View<T>& c);
template <typename T>
void multiply_lower(const View<const T>& a, const View<const T>& l, const View<T>& c);

/// C = A' A, both triangles; A is lower triangular with zeros above.
template <typename T>
void multiply_transposed(const View<const T>& a, const View<const T>& a_transposed,
                         const View<T>& c);

/// A = L L' in place: the lower triangle of A is read and becomes L; the upper one is left alone.
/// False when A is not positive definite in this arithmetic.
template <typename T>
bool cholesky(const View<T>& a);

/// result = L^-1, the upper triangle zero. L is the lower triangle of `l`.
template <typename T>
void invert_lower(const View<const T>& l, const View<T>& result);

/// x := L^-T L^-1 x.
template <typename T>
void solve_factored(const View<const T>& l, Vector<T>& x);

}  // namespace gainsmith::sdp
