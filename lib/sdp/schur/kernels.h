// Dense kernels in every arithmetic. Products run at the rate of the vector unit in double
// (product.h) and in double-double (pairs.h), as plain loops in 100 digits; factors and inverses
// are blocked on them. Matrices are column-major with a leading dimension; a result must not
// overlap an argument unless it is one.
#pragma once

#include <vector>

#include "sdp/core/view.h"
#include "sdp/schur/linalg.h"

namespace gainsmith::sdp {

/// C = A B, or C -= A B.
template <typename T>
void multiply(const View<const T>& a, const View<const T>& b, const View<T>& c,
              Update update = Update::assign);

/// C = A S, where S has entries only at rows[start[j]] .. rows[start[j+1]-1] of its column j.
template <typename T>
void multiply_sparse(const View<const T>& a, const View<const T>& s, const std::vector<int>& start,
                     const std::vector<int>& rows, const View<T>& c);

/// C = A B', or C -= A B'.
template <typename T>
void multiply_outer(const View<const T>& a, const View<const T>& b, const View<T>& c,
                    Update update = Update::assign);

/// C = A U, C = A L for an upper triangular U, a lower triangular L, with zeros in the other
/// triangle.
template <typename T>
void multiply_upper(const View<const T>& a, const View<const T>& u, const View<T>& c);
template <typename T>
void multiply_lower(const View<const T>& a, const View<const T>& l, const View<T>& c);

/// C = A' A, both triangles, from a lower triangular A with zeros above, and A'.
template <typename T>
void multiply_transposed(const View<const T>& a, const View<const T>& a_transposed,
                         const View<T>& c);

/// A = L L' in place: the lower triangle of A is read and becomes L; the upper one serves as
/// scratch and is not to be read. False when A is not positive definite in this arithmetic.
template <typename T>
bool cholesky(const View<T>& a);

/// result = L^-1, the upper triangle zero. L is the lower triangle of `l`, here and below.
template <typename T>
void invert_lower(const View<const T>& l, const View<T>& result);

/// x := L^-T L^-1 x.
template <typename T>
void solve_factored(const View<const T>& l, Vector<T>& x);

}  // namespace gainsmith::sdp
