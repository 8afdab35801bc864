// Eigenvectors of the constant matrices of inequalities, as polynomials in the eigenvalue.
#pragma once

#include <string>
#include <vector>

#include "lmi/inequalities.h"
#include "verdict/algebraic_root.h"

namespace gainsmith::verdict {

struct NamedMatrix {
  std::string name;  ///< "A", "A'", "a matrix of decrease"
  numerics::RationalMatrix value;
};

/// The constant matrices and scalars that the inequalities are made of, each once; none whose
/// fractions are long.
std::vector<NamedMatrix> constant_matrices(const lmi::Inequalities& of);

/// w = V e is an eigenvector of A at each root l of p, e = (1, l, ..., l^(d-1))'.
struct Eigenvector {
  Polynomial p;
  numerics::RationalMatrix V;  ///< n x d; V e is not 0 at any root
};

/// Vectors b to begin with: bases of what each of `others` with fitting columns, or its transpose,
/// does not observe, and the unit vectors.
/// A is n x n; each b is n x 1, none twice.
std::vector<numerics::RationalMatrix> starts_of(const numerics::RationalMatrix& A,
                                                const std::vector<NamedMatrix>& others);

/// With the p of least degree such that p(A) b = 0, (l - A) w(l) = p(l) b for
/// w(l) = (p(l) - p(A))/(l - A) b; also for factors of p that a limit may hang on.
/// Thus V has the columns V_k = sum_(j>k) p_j A^(j-k-1) b, n x d, k = 0 ... d - 1.
std::vector<Eigenvector> eigenvectors_from(const numerics::RationalMatrix& A,
                                           const numerics::RationalMatrix& b);

}  // namespace gainsmith::verdict
