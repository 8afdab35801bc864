// Both scalars are computed in Decimal100.
#include "numbers/dense/spectrum_rules.h"

namespace gainsmith::numbers {

using Quad = MatrixOf<DoubleDouble>;
template Quad real_eigenvalues(const Quad&);
template Quad stabilising_solution(Riccati, const Quad&, const Quad&, const Quad&, const Quad&,
                                   const Quad&);

using Wide = MatrixOf<Decimal100>;
template Wide real_eigenvalues(const Wide&);
template Wide stabilising_solution(Riccati, const Wide&, const Wide&, const Wide&, const Wide&,
                                   const Wide&);

}  // namespace gainsmith::numbers
