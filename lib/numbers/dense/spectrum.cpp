#include "numbers/dense/spectrum.h"

#include "numbers/dense/spectrum_rules.h"

namespace gainsmith::numbers {

template Matrix real_eigenvalues(const Matrix&);
template Matrix stabilising_solution(Riccati, const Matrix&, const Matrix&, const Matrix&,
                                     const Matrix&, const Matrix&);

}  // namespace gainsmith::numbers
