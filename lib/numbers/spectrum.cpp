#include "numbers/spectrum.h"

#include "numbers/spectrum_rules.h"

namespace gainsmith::numbers {

template Matrix real_eigenvalues(const Matrix&);
template Matrix stabilising_solution(Riccati, const Matrix&, const Matrix&, const Matrix&,
                                     const Matrix&, const Matrix&);

}  // namespace gainsmith::numbers
